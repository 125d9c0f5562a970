"""The discrete Reynolds equation: coefficients, flow balance and its slopes, wall deformation."""
