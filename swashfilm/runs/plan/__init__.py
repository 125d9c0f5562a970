"""Command `swashfilm plan`: what a test will tell apart, and which points and meters to add."""
