"""Displacement in time: swash plate, actuator and every chamber."""
