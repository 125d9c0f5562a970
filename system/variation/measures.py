"""Numbers of a varied pump: what is kept of each point, and what becomes of them over all points."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.shown import PERCENT, Shown, shown_in
from system.inputs.units import TURN
from system.maps.point import GAPS
from system.points.table.means import SolvedPoint

_BENCH = (
    "shaft_torque", "delivery_pressure", "inlet_pressure", "delivery_flow", "inlet_flow", "drain_flow", "shaft_speed",
)  # fmt: skip
NUMBERS = (
    *_BENCH, "loss", "swept_displacement", "delivery_flow_ripple", "chamber_pressure_peak",
    *(f"leakage.{gap}" for gap in GAPS), *(f"film_least.{gap}" for gap in GAPS),
    *(f"film_temperature.{gap}" for gap in GAPS),
)  # fmt: skip
"""Numbers that are kept of a point, SI."""


def point_numbers(solved: SolvedPoint) -> list[float]:
    """Return the NUMBERS of a solved point; ripple from the least to the largest flow over the turn."""
    point = solved.pump_point
    found = [
        *(getattr(point.bench, name) for name in _BENCH),
        point.power.shaft - point.power.hydraulic,
        point.derived_displacement,
        np.ptp(point.delivery_flow_ripple),
        max(np.max(own.pressure) for own in point.chambers),
        *(getattr(point.leakage_flow, gap) for gap in GAPS),
        *(getattr(solved.film_least, gap) for gap in GAPS),
        *(point.point.temperature + getattr(solved.film_rise, gap) for gap in GAPS),
    ]
    return [float(value) for value in found]


def significant(number: float, digits: int) -> str:
    """Return a number rounded to significant digits, large ones without an exponent."""
    return f"{float(f'{number:.{digits}g}'):.12g}"


Columns = Mapping[str, Array]
"""NUMBERS by name, arrays (.., P)."""


@dataclass(frozen=True)
class Measure:
    """A number of a pump over its operating points.

    unit: SI; of: value (..,) of the numbers (.., P) and the weights (P,). film: known only where films are solved.
    """

    name: str
    words: str
    unit: str
    of: Callable[[Columns, Array], Array]
    film: bool = False

    @property
    def reading(self) -> Shown:
        """The unit that people read: shares are efficiencies."""
        return PERCENT if self.unit == "1" else shown_in(self.unit, self.words)

    @property
    def shown(self) -> str:
        """Symbol of the unit that people read."""
        return self.reading.unit

    @property
    def scale(self) -> float:
        """Number of units that people read in one SI unit."""
        return self.reading.factor

    def text(self, value: float, digits: int = 4) -> str:
        """Return a value as people read it; a temperature in degC."""
        return f"{significant(float(self.read(np.asarray(value))), digits)} {self.shown}"

    def read(self, values: Array) -> Array:
        """Return SI values in the unit that people read."""
        return self.reading.of(values)

    @property
    def unit_of_change(self) -> str:
        """The unit of a change as people read it: percentage points of a share, K of a temperature."""
        return {"%": "points", "degC": "K"}.get(self.shown, self.shown)

    def change(self, value: float, digits: int = 3) -> str:
        """Return a change as people read it, with its sign."""
        return f"{'+' if value >= 0.0 else ''}{significant(value * self.scale, digits)} {self.unit_of_change}"


def _mean(name: str) -> Callable[[Columns, Array], Array]:
    return lambda numbers, weights: numbers[name] @ weights


def _efficiencies(numbers: Columns, weights: Array) -> tuple[Array, Array, Array]:
    """Overall, volumetric and hydromechanical by ISO 4409 with the swept displacement: mean over mean."""
    speed, volume = numbers["shaft_speed"], numbers["swept_displacement"]
    high, low = numbers["delivery_pressure"], numbers["inlet_pressure"]
    given = (high * numbers["delivery_flow"] - low * numbers["inlet_flow"]) @ weights
    shaft = (speed * numbers["shaft_torque"]) @ weights
    ideal = (speed * volume / TURN) @ weights
    hydraulic = ((high - low) * speed * volume / TURN) @ weights
    return given / shaft, numbers["delivery_flow"] @ weights / ideal, hydraulic / shaft


def _gap(name: str, gap: str, words: str, most: bool) -> Measure:
    key = f"{name}.{gap}"

    def worst(numbers: Columns, weights: Array) -> Array:
        return np.asarray(np.max(numbers[key], axis=-1) if most else np.min(numbers[key], axis=-1))

    return Measure(key, f"{words}, {gap.replace('_', ' ')}", "K" if most else "m", worst, film=True)


def _efficiency(place: int, part: str) -> Measure:
    words = f"{part} efficiency, ISO 4409"
    return Measure(f"efficiency.{part}", words, "1", lambda n, w: _efficiencies(n, w)[place])


LOSS = "loss"
EFFICIENCY = "efficiency.overall"
DRAIN = "drain_flow"
RIPPLE = "delivery_flow_ripple"
MEASURES = {
    one.name: one
    for one in (
        Measure(LOSS, "total loss", "W", _mean("loss")),
        *(_efficiency(place, part) for place, part in enumerate(("overall", "volumetric", "hydromechanical"))),
        Measure(DRAIN, "case drain", "m3/s", _mean("drain_flow")),
        *(
            Measure(
                f"leakage.{gap}", f"leakage, {gap.replace('_', ' ')}", "m3/s", _mean(f"leakage.{gap}")
            )
            for gap in GAPS
        ),
        Measure("delivery_flow", "delivery flow", "m3/s", _mean("delivery_flow")),
        Measure(RIPPLE, "delivery flow ripple", "m3/s", _mean(RIPPLE)),
        Measure("shaft_torque", "shaft torque", "N m", _mean("shaft_torque")),
        Measure(
            "chamber_pressure_peak", "highest chamber pressure", "Pa",
            lambda numbers, _: np.asarray(np.max(numbers["chamber_pressure_peak"], axis=-1)),
        ),
        *(_gap("film_least", gap, "least film", most=False) for gap in GAPS),
        *(_gap("film_temperature", gap, "hottest oil", most=True) for gap in GAPS),
    )
}  # fmt: skip
"""All measures by name."""


def measures_of(films: bool, ripple: bool = True) -> tuple[Measure, ...]:
    """Return the measures that a fidelity knows: of films where it solves them, of the ripple where a point has it."""
    known = (one for one in MEASURES.values() if films or not one.film)
    return tuple(one for one in known if ripple or one.name != RIPPLE)


def measured(numbers: Array, weights: Array, measures: tuple[Measure, ...]) -> Array:
    """Return the measures (.., M) of numbers (.., P, NUMBERS) over points of weights (P,)."""
    columns = dict(zip(NUMBERS, np.moveaxis(numbers, -1, 0), strict=True))
    return np.stack([np.asarray(one.of(columns, weights)) for one in measures], axis=-1)
