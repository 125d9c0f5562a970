"""Piston, slipper and block films at one time: physics, drives, friction."""
