"""A gap over the turn."""
