"""The verdict: what may be claimed, and how surely."""
