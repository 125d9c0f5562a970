"""Piston, slipper and block films at one time: physics, what drives them, friction."""
