"""A pump whose dimensions vary: the cost of a change of each, and the scatter of a series of pumps."""
