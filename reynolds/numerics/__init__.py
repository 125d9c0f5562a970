"""Numerical methods independent of the film: array loops, fixed point, GMRES, implicit steps, shooting, disk cache."""
