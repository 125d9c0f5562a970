"""`swashfilm reference` and `coefficients`."""
