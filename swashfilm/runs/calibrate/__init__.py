"""`swashfilm calibrate`."""
