"""The lumped pump and what every fidelity shares: loads, power, efficiencies, assembly."""
