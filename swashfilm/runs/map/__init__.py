"""`swashfilm map`, `duty` and `compare`."""
