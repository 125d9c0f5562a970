"""Files of coefficients in a run: source, range, and warnings beyond the range."""
