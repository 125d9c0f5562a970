"""Runs, one room a command: options, solution, run folder, page."""
