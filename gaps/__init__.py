"""The three gaps of an axial piston pump: geometry, rigid motion and force balance of piston, slipper and valve plate."""
