"""`swashfilm film`: one film."""
