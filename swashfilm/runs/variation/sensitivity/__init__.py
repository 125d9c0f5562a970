"""Command `swashfilm sensitivity`: the cost of a change of each dimension of a pump."""
