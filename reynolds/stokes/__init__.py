"""Stokes and Navier-Stokes flow in a section of a gap: the reference by which the film equation is judged."""
