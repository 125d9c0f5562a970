"""Procedure of a diagnosis: its stages, the next test, the pump without and with the finding."""
