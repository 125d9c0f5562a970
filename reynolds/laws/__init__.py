"""Constitutive laws of oil and of rough walls, each value with its slope."""
