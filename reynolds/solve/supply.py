"""Where the pressure of a pocket starts from, so that Newton's method finds its way along a supply's law.

Behind an orifice, q ~ sqrt(p_supply - p), Newton's method from a pressure far from the supply's steps over it, to
the mirrored one, and back. From where the supply sends what it sent before, it does not.
"""

from __future__ import annotations

from collections.abc import Callable

Feed = Callable[[float], tuple[float, float]]

NARROW = 1e3  # Pa: of the first interval searched
MOST_DOUBLINGS = 60
NEAR = 1e-8  # of the interval
BENT = 0.1  # change of the slope on the way: of less, a straight step makes nothing


def pressure_sending(feed: Feed, flow: float, start: float) -> float:
    """A pressure (Pa) at which a feed sends about a flow (m3/s); `start` where none does or the law is straight.

    `feed` as `film.Pocket` has it: (m3/s, its slope by pressure), never rising.
    """
    from scipy.optimize import brentq

    def lacks(pressure: float) -> float:
        return feed(pressure)[0] - flow

    first = lacks(start)
    if first == 0.0 or feed(start)[1] == 0.0:
        return start
    last, width = start, NARROW if first > 0.0 else -NARROW
    for _ in range(MOST_DOUBLINGS):
        other = last + width
        if lacks(other) * first <= 0.0:
            found = float(brentq(lacks, last, other, xtol=NEAR * abs(width)))
            return start if abs(feed(found)[1] / feed(start)[1] - 1.0) < BENT else found
        last, width = other, 2.0 * width
    return start
