"""Operating maps, duty cycles, comparison, derived displacement."""
