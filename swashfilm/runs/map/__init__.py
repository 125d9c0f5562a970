"""`swashfilm map`."""
