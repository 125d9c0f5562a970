"""Faults of a problem before a pump is solved: bounds that no geometry has, constraints that no pump meets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import inf

import numpy as np
from scipy.stats import qmc

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults
from system.inputs.units import parse_quantity
from system.pump.operating import OperatingPoint
from system.pump_file.file import Variant, varied
from system.variation.measures import CAVITY, PEAK, Measure
from system.variation.optimisation.problem import Constraint, Problem, Varied
from system.variation.scatter import Bound

DRAWN = 64
"""Designs drawn to find one that has a bound's value, where the stated pump lacks it."""
HALVINGS = 12
"""Halvings by which the nearest valid bound is found: to 1/4096 of the way from the stated value."""
KEPT = 0.99
"""Share of the way to the nearest valid bound that is proposed."""
_NOT_NEGATIVE = ("loss", "delivery_flow_ripple", "inlet_flow_ripple", "reverse_flow", "pressure_rate",
                 "swash_moment.amplitude", "slipper_balance")  # fmt: skip


def bound_faults(pump: PumpDescription, problem: Problem) -> Iterator[tuple[Varied, Fault]]:
    """Yield the fault of each bound that no pump within the other bounds has, with the nearest valid one."""
    drawn = np.asarray(qmc.LatinHypercube(len(problem.space), rng=1).random(DRAWN))
    for at, one in enumerate(problem.space):
        for place, end in ((0.0, one.low), (1.0, one.high)):
            reason = _refusal(pump, one.at(end))
            if reason is None or _some(pump, problem, drawn, at, place):
                continue
            found = f"{one.key.shown(end)}: {reason.path}: {reason.found}"
            yield one, Fault(one.name, found, reason.expected, _nearest(pump, one, end))


def _some(pump: PumpDescription, problem: Problem, drawn: Array, at: int, place: float) -> bool:
    """True where a drawn design with a dimension at its bound is a pump."""
    for own in drawn:
        own = own.copy()
        own[at] = place
        if _refusal(pump, problem.variant(own)) is None:
            return True
    return False


def _refusal(pump: PumpDescription, variant: Variant) -> Fault | None:
    try:
        varied(pump, variant)
    except InputFaults as reason:
        return reason.faults[0]
    return None


def _nearest(pump: PumpDescription, one: Varied, end: float) -> str:
    """Return about the value nearest to a bound that the pump as stated can have, in the fewest digits that it has."""
    good, bad = one.key.value, end
    for _ in range(HALVINGS):
        middle = 0.5 * (good + bad)
        good, bad = (good, middle) if _refusal(pump, one.at(middle)) else (middle, bad)
    kept = one.key.value + KEPT * (good - one.key.value)
    for digits in (3, 4, 5):
        text = one.key.shown(kept, digits)
        value = float(text) if one.key.dimension is None else parse_quantity(text, one.key.dimension)
        if _refusal(pump, one.at(value)) is None:
            return text
    return one.key.shown(good)


def constraint_faults(
    pump: PumpDescription, points: Sequence[OperatingPoint], problem: Problem
) -> Iterator[tuple[Constraint, Fault]]:
    """Yield the fault of each constraint that no design can meet: by its nature, or beside another one."""
    for one in problem.constraints:
        if one.of_start is not None:
            continue
        low, high, why = _reach(pump, points, problem, one.measure)
        if one.bound is Bound.MOST and one.value < low:
            yield (
                one,
                Fault(
                    one.measure.name, one.text, f"{one.measure.text(low)} or more: {why}", f"<= {one.measure.text(low)}"
                ),
            )
        if one.bound is Bound.LEAST and one.value > high:
            yield (
                one,
                Fault(
                    one.measure.name,
                    one.text,
                    f"{one.measure.text(high)} or less: {why}",
                    f">= {one.measure.text(high)}",
                ),
            )
    for one, other in combinations(problem.constraints, 2):
        known = one.of_start is None and other.of_start is None
        if known and one.measure is other.measure and {one.bound, other.bound} == {Bound.MOST, Bound.LEAST}:
            least, most = (one, other) if one.bound is Bound.LEAST else (other, one)
            if least.value > most.value:
                found = f"{least.text} and {most.text}"
                yield other, Fault(one.measure.name, found, "a least value below the most", "one of the two")


def _reach(
    pump: PumpDescription, points: Sequence[OperatingPoint], problem: Problem, measure: Measure
) -> tuple[float, float, str]:
    """Return the least and the largest possible value of a measure, SI, and the reason."""
    name = measure.name
    if name == PEAK:
        return max(one.delivery_pressure for one in points), inf, "chambers deliver at the delivery pressure"
    if name.startswith("film_temperature"):
        return max(one.temperature for one in points), inf, "films are no colder than the case"
    if name == CAVITY:
        return 0.0, 1.0, "a share of the turn"
    if name.startswith("efficiency"):
        return 0.0, 1.0, "an efficiency"
    if name == "film_least.piston":
        own = {one.name: one.high for one in problem.space}
        clearance = own.get("piston.radial_clearance", pump.piston.radial_clearance)
        return -inf, clearance, "the largest radial clearance of the piston"
    return (0.0, inf, "it is never negative") if name.startswith(_NOT_NEGATIVE) else (-inf, inf, "")
