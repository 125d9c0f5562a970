"""`swashfilm compare`: two maps side by side."""
