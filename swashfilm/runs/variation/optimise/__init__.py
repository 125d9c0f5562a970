"""Command `swashfilm optimise`: dimensions of a pump between bounds, chosen by objectives under constraints."""
