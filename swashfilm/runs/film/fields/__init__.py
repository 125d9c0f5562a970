"""Fields of a film: over time, as maps, and along sections."""
