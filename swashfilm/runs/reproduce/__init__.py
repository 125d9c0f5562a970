"""`swashfilm reproduce`."""
