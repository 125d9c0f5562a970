"""Readers of the case file, one per table."""
