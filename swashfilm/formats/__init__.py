"""Formats of written files: the version of each kind of run folder, and the schema of each version."""
