"""Loads on the parts: ball joint, side forces of the piston, tipping of the block."""
