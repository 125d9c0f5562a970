"""The three gaps of an axial piston pump: geometry, rigid motion and force balance.

Piston, slipper and valve plate, each a film problem with named boundaries.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
