"""Optimisation of a pump: what varies, what it aims at, the search, the Pareto set, what is in the way."""
