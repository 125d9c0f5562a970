"""Stokes and Navier-Stokes flow in a section of a gap: the reference for the film equation."""
