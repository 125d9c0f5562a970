"""Pumps known by their type plate: levels from the recording, and the place of their own fit."""
