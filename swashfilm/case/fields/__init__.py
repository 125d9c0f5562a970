"""Fields of a case: quantity, formula or mesh data."""
