"""`swashfilm table`: response tables."""
