"""Command `swashfilm new`: a commented file to start from, of a pump, a recording or a film."""
