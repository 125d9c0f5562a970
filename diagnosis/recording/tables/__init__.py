"""Tables of numbers, one reader a file format."""
