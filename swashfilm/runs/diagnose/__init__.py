"""`swashfilm diagnose`."""
