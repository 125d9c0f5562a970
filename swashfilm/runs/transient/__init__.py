"""`swashfilm transient`: displacement in time."""
