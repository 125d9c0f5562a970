"""What the proof's second and third plant share: form of a case, score, trial, gates."""
