"""General methods that know no film: array loops, fixed point, GMRES, implicit steps, shooting, disk cache."""
