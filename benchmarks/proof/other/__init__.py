"""The proof's second plant: its cases, sizes and recordings."""

VERSION = 1
"""Of plant, cases and bench: raised with every change of a reading or of a concealed cause."""
