"""Inputs that both commands on varied pumps share: pump, operating points, fidelity, dimensions."""
