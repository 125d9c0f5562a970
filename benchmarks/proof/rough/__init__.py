"""The proof's third plant, rough campaigns on pumps known by their type plate: cases, sizes and recordings."""

VERSION = 3
"""Of plant, cases and meters: raised with every change of a reading or of a concealed cause."""
