"""`swashfilm run`: one operating point of a pump."""
