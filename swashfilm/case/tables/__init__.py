"""Readers of the case file, one a table."""
