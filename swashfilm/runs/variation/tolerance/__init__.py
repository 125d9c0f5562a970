"""Command `swashfilm tolerance`: the scatter of a series of pumps by the tolerances of their drawing."""
