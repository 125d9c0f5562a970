"""The balance of a film and its slopes in compiled loops: `equation` and `solve` for marches of many films."""
