"""Mutations of the physics, and the default tests that must notice them."""
