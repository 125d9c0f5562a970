"""One operating point of the pump by each fidelity: lumped, films, floating, table."""
