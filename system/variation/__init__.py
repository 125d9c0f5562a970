"""A pump whose dimensions vary: what a change of each costs, and how a series of pumps scatters."""
