"""The film solved: boundary values, Newton, active set, time steps; loads and export of a solution."""
