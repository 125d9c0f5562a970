"""Page of the check of planned campaigns, from the kept trials."""
