"""A recording folder read: channels, steady points, traces."""
