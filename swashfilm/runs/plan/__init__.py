"""Command `swashfilm plan`: the causes that a test will separate, and the points and meters to add."""
