"""Films and pumps drawn at random: geometry, oil, operating point, and what became of each."""
