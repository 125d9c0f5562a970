"""Checks of the readings before any simulation."""
