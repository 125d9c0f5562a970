"""Command `swashfilm tolerance`: how a series of pumps scatters by the tolerances of their drawing."""
