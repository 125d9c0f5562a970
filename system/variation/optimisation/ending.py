"""End of a search that stops by itself: whether its objective has settled, and why it ended."""

from dataclasses import dataclass

from scipy.optimize import OptimizeResult

_OUT_OF_STEPS = {5, 9}
"""Status of COBYQA and of SLSQP where their number of designs or of steps is used up."""


@dataclass(frozen=True)
class Ending:
    """End of a search: whether it has settled as near as asked, or else used up its steps; why, in its own words."""

    settled: bool
    out_of_steps: bool
    why: str


def ending(found: OptimizeResult) -> Ending:
    """Return the end that a search of scipy tells of itself."""
    return Ending(bool(found.success), int(found.status) in _OUT_OF_STEPS, str(found.message))
