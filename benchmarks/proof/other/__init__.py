"""The proof's second plant: its cases, sizes and recordings."""

VERSION = 1
"""Of plant, cases and bench: raised with every change that moves a reading or conceals something else."""
