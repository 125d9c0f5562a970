"""Channels and units of a bare table, guessed from its heads and sizes."""
