"""Command `swashfilm sensitivity`: what a change of each dimension of a pump costs."""
