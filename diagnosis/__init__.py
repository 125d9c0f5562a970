"""Simulation against recordings: where they differ, and which physics was left out."""
