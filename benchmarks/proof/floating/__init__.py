"""The proof with floating films: a plant of all film physics, a simulation without one or two parts of it."""
