"""Response tables of the gaps: build, store, and the point by table."""
