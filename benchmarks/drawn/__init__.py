"""Films and pumps drawn at random: geometry, oil, operating point, and the outcome of each."""
