"""The pump put on its gap films: parts, walls, heat, drives; films at given positions."""
