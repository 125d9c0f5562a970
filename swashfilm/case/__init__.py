"""Film case files: read to a validated problem, and written back."""
