"""The gap films of a pump: parts, walls, heat, drives; films at given positions."""
