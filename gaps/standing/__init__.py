"""A gap whose parts do not move across the film: film, conductances, temperature."""
