"""The paper's figures and tables: what its text states, the same numbers here, and a verdict on each statement."""
