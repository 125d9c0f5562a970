"""The adjoint of a steady film: derivatives of its load, flows and losses by the film thickness at every place."""
