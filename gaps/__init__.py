"""The three gaps of an axial piston pump: geometry, rigid motion and force balance.

Piston, slipper and valve plate, each a film problem with named boundaries.
"""
