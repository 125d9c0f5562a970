"""Checks of a film: its extent and seam before it is solved, its numbers afterwards; sizes of round-off."""
