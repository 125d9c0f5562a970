"""Common to the proof's second and third plant: form of a case, score, trial, gates."""
