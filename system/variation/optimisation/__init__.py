"""Optimisation of a pump: dimensions, objectives, search, Pareto set, obstacles."""
