"""Closed laws of the pump: kinematics, retainer, leakage, seven friction pairs."""
