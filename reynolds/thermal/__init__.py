"""Temperature across and along the film, and its effect on the viscosity."""
