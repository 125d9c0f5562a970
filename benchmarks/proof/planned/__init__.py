"""The check of planned campaigns: pairs that a grid leaves open, and those that a planned campaign decides."""
