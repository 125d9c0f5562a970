"""End of a search that stops by itself: whether its objective has settled, and why it ended."""

from dataclasses import dataclass

from scipy.optimize import OptimizeResult

from system.variation.optimisation.method import Method

_OUT_OF_STEPS = {Method.TRUST_REGION: 5, Method.GRADIENT: 9}
"""Status of COBYQA and of SLSQP where their number of designs or of steps is used up."""


@dataclass(frozen=True)
class Ending:
    """End of a search: whether it has settled as near as asked, or else used up its steps; why, in its own words."""

    settled: bool
    out_of_steps: bool
    why: str


def ending(found: OptimizeResult, method: Method) -> Ending:
    """Return the end that a search of scipy by a method tells of itself."""
    return Ending(bool(found.success), int(found.status) == _OUT_OF_STEPS[method], str(found.message))
