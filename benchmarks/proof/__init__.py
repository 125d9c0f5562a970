"""The proof of the diagnosis: a plant of another make, its bench, the cases, and how the verdicts are judged."""
