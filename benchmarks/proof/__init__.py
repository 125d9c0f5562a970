"""The proof of the diagnosis: a plant of another make, its bench, the cases, and the judgement of the verdicts."""
