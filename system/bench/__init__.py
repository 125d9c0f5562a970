"""A bench map simulated as a whole, with sensors and uncertain parameters."""
