"""Coefficients of ports and edges from CFD or test bench, with an OpenFOAM reader."""
