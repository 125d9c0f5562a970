"""The check of planned campaigns: pairs that a grid leaves open, and those that a campaign as planned settles."""
