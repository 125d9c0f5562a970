"""A second pump of the bench's drawing: lumped, its own code, another published law for every effect."""
