"""How the parts of a gap stand beside its film at an instant."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Stand:
    """Reach (m) of a piston's chamber end inside the guide's case edge; turned parts.

    Angles (rad) in the film's axes: moving part (piston, slipper, block) and fixed one (bushing, plate).
    """

    reach: float = 0.0
    moving: float = 0.0
    fixed: float = 0.0
