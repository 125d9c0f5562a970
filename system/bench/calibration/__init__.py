"""Calibration: Eq. (21), Hersey curves, held-out comparison, fitted pump as file."""
