"""`swashfilm run --vary`: a pump over ranges of keys of its file."""
