"""Choice of the search: by derivatives or a model for one objective, by evolution for several and for jumps."""

from __future__ import annotations

from enum import Enum

from system.variation.optimisation.problem import Problem

_KINKED = (
    "chamber_pressure_peak", "delivery_flow_ripple", "inlet_flow_ripple", "swash_moment.amplitude", "cavitated_share",
    "film_least", "film_temperature", "load_carried",
)  # fmt: skip
"""Beginnings of measures that are the largest or the least of something: their slope jumps where another takes over."""


class Method(Enum):
    """Search of an optimisation."""

    EVOLUTION = "evolution"
    GRADIENT = "gradient"
    TRUST_REGION = "trust_region"


def usual_method(problem: Problem, *, costly: bool) -> tuple[Method, str]:
    """Return the suitable search for a problem, and the reason; costly: its films are solved, in seconds or minutes."""
    if len(problem.objectives) > 1:
        return Method.EVOLUTION, f"{len(problem.objectives)} objectives have a set of best designs, no single one"
    if costly:
        return Method.TRUST_REGION, "a quadratic model of one objective needs the fewest of costly designs"
    kinked = [one.words for one in problem.asked if one.name.startswith(_KINKED)]
    if kinked:
        return Method.EVOLUTION, f"the slope of {kinked[0]} jumps, so derivatives mislead"
    return Method.GRADIENT, "one smooth objective has derivatives, which need fewer designs"
