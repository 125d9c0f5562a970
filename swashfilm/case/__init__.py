"""A film case file read to a validated problem, and written back."""
