"""Webs that divide a port of the valve plate into several kidneys: their cover of the block kidney over them."""

from dataclasses import dataclass

import numba
import numpy as np

from reynolds.numerics.arrays import Array

MOST_WEBS = 8
WEBS_SIZE = 2 + 2 * MOST_WEBS
"""Numbers of a port's webs as compiled code reads them: count, half the kidney's arc, from and to of each."""


@dataclass(frozen=True)
class PortWebs:
    """Arc of the block's kidney (rad), and the webs' (from, to) in rad from the port's own dead centre.

    Webs are flush with the plate's face. Raises ValueError for more than MOST_WEBS and for webs without a kidney.
    """

    kidney_arc: float = 0.0
    spans: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        if len(self.spans) > MOST_WEBS or (self.spans and not self.kidney_arc > 0.0):
            found = f"{len(self.spans)} under a kidney of {np.degrees(self.kidney_arc):g} deg"
            raise ValueError(f"webs of a port: found {found}, expected at most {MOST_WEBS} and a kidney's arc")

    @property
    def row(self) -> Array:
        """The webs as compiled code reads them, (WEBS_SIZE,)."""
        found = np.zeros(WEBS_SIZE)
        found[:2] = len(self.spans), 0.5 * self.kidney_arc
        found[2 : 2 + 2 * len(self.spans)] = np.array(self.spans).ravel()
        return found

    @property
    def breaks(self) -> tuple[float, ...]:
        """Angles (rad) of the kidney's middle at which either of its ends meets a web's edge."""
        half = 0.5 * self.kidney_arc
        return tuple(edge + side for span in self.spans for edge in span for side in (-half, half))


@numba.njit("f8(f8,f8[:])", cache=True)
def covered_share(angle, webs):  # type: ignore[no-untyped-def]
    """Share of a kidney with its middle at an angle (rad) that webs cover; `webs` is a `PortWebs.row`."""
    covered = 0.0
    for n in range(int(webs[0])):
        covered += max(min(angle + webs[1], webs[3 + 2 * n]) - max(angle - webs[1], webs[2 + 2 * n]), 0.0)
    return covered / (2.0 * webs[1]) if covered > 0.0 else 0.0
