"""Numbers of a varied pump: those kept of each point, and their measures over all points."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.inputs.shown import PERCENT, Shown, shown_in
from system.inputs.units import TURN
from system.maps.point import GAPS
from system.points.table.means import SolvedPoint
from system.pump.bench import EFFICIENCIES
from system.variation.chamber_numbers import OF_FLOW, OF_PRESSURE, flow_numbers, pressure_numbers

_BENCH = (
    "shaft_torque", "delivery_pressure", "inlet_pressure", "delivery_flow", "inlet_flow", "drain_flow", "shaft_speed",
)  # fmt: skip
NUMBERS = (
    *_BENCH, "loss", "swept_displacement", *OF_PRESSURE, *OF_FLOW,
    *(f"{name}.{gap}" for name in ("leakage", "film_least", "film_temperature", "load_carried") for gap in GAPS),
)  # fmt: skip
"""Numbers that are kept of a point, SI."""


def point_numbers(pump: PumpDescription, solved: SolvedPoint) -> list[float | None]:
    """Return the NUMBERS of a solved point of a pump with equal chambers; None for those that its fidelity lacks."""
    point = solved.pump_point
    found = {
        **{name: getattr(point.bench, name) for name in _BENCH},
        "loss": point.power.shaft - point.power.hydraulic,
        "swept_displacement": point.derived_displacement,
        **pressure_numbers(pump, point.point, point.cycle.pressure),
        **flow_numbers(point),
        **{f"leakage.{gap}": getattr(point.leakage_flow, gap) for gap in GAPS},
        **{f"film_least.{gap}": getattr(solved.film_least, gap) for gap in GAPS},
        **{f"film_temperature.{gap}": point.point.temperature + getattr(solved.film_rise, gap) for gap in GAPS},
    }
    if solved.load_carried is not None:
        found |= {f"load_carried.{gap}": getattr(solved.load_carried, gap) for gap in GAPS}
    return [float(found[name]) if name in found else None for name in NUMBERS]


def significant(number: float, digits: int) -> str:
    """Return a number rounded to significant digits, large ones without an exponent."""
    return f"{float(f'{number:.{digits}g}'):.12g}"


Columns = Mapping[str, Array]
"""NUMBERS by name, arrays (.., P)."""
_Over = Callable[[str], Callable[[Columns, Array], Array]]


class Needs(Enum):
    """Solution that a number needs of a fidelity: each holds those before it."""

    PRESSURE = 0  # in the chambers, at the sampled angles
    COURSE = 1  # of the flows over the turn
    FILMS = 2  # by a table or by themselves
    LOADS = 3  # of films at every angle


@dataclass(frozen=True)
class Measure:
    """A number of a pump over its operating points.

    unit: SI; of: value (..,) of the numbers (.., P) and the weights (P,). needs: the solution that it requires of a
    fidelity.
    """

    name: str
    words: str
    unit: str
    of: Callable[[Columns, Array], Array]
    needs: Needs = Needs.PRESSURE

    @property
    def reading(self) -> Shown:
        """The unit that people read: shares are efficiencies."""
        return PERCENT if self.unit == "1" else shown_in(self.unit, self.words)

    @property
    def shown(self) -> str:
        """Symbol of the unit that people read."""
        return self.reading.unit

    @property
    def within_one(self) -> bool:
        """True for a share that no pump has above 1: an efficiency, a part of the turn."""
        return self.name == CAVITY or self.name.startswith("efficiency.")

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


def _largest(name: str) -> Callable[[Columns, Array], Array]:
    return lambda numbers, _: np.asarray(np.max(numbers[name], axis=-1))


def _smallest(name: str) -> Callable[[Columns, Array], Array]:
    return lambda numbers, _: np.asarray(np.min(numbers[name], axis=-1))


def _gaps(name: str, words: str, unit: str, of: _Over, needs: Needs) -> Iterator[Measure]:
    """Yield the measures of a number of each gap."""
    for gap in GAPS:
        key = f"{name}.{gap}"
        yield Measure(key, f"{words}, {gap.replace('_', ' ')}", unit, of(key), needs)


def _efficiency(place: int, part: str) -> Measure:
    words = f"{part} efficiency, ISO 4409"
    return Measure(f"efficiency.{part}", words, "1", lambda n, w: _efficiencies(n, w)[place])


def _flow(name: str, words: str) -> Measure:
    return Measure(name, words, "m3/s", _mean(name), Needs.COURSE)


LOSS = "loss"
EFFICIENCY = "efficiency.overall"
DRAIN = "drain_flow"
PEAK = "chamber_pressure_peak"
CAVITY = "cavitated_share"
MEASURES = {
    one.name: one
    for one in (
        Measure(LOSS, "total loss", "W", _mean("loss")),
        *(_efficiency(place, part) for place, part in enumerate(EFFICIENCIES)),
        Measure(DRAIN, "case drain", "m3/s", _mean(DRAIN)),
        *_gaps("leakage", "leakage", "m3/s", _mean, Needs.PRESSURE),
        Measure("delivery_flow", "delivery flow", "m3/s", _mean("delivery_flow")),
        _flow("delivery_flow_ripple", "delivery flow ripple"),
        _flow("inlet_flow_ripple", "inlet flow ripple"),
        _flow("reverse_flow.delivery", "flow back out of the delivery port"),
        _flow("reverse_flow.inlet", "flow back into the inlet"),
        Measure("shaft_torque", "shaft torque", "N m", _mean("shaft_torque")),
        Measure(PEAK, "highest chamber pressure", "Pa", _largest(PEAK)),
        Measure("pressure_rate", "rate of the chamber pressure, rms", "Pa/s", _mean("pressure_rate")),
        Measure(CAVITY, "share of the turn with a cavity", "1", _largest(CAVITY)),
        Measure("swash_moment.mean", "moment of the pressure towards a larger swash angle", "N m",
                _mean("swash_moment.mean")),
        Measure("swash_moment.amplitude", "amplitude of the moment of the pressure on the swash plate", "N m",
                _mean("swash_moment.amplitude")),
        Measure("slipper_balance", "hydrostatic balance of the slipper", "1", _smallest("slipper_balance")),
        *_gaps("film_least", "least film", "m", _smallest, Needs.FILMS),
        *_gaps("film_temperature", "hottest oil", "K", _largest, Needs.FILMS),
        *_gaps("load_carried", "share of the load that the film carries", "1", _smallest, Needs.LOADS),
    )
}  # fmt: skip
"""All measures by name."""


def measures_of(known: Needs) -> tuple[Measure, ...]:
    """Return the measures of a fidelity: all that need no more than its solution."""
    return tuple(one for one in MEASURES.values() if one.needs.value <= known.value)


def measured(numbers: Array, weights: Array, measures: tuple[Measure, ...]) -> Array:
    """Return the measures (.., M) of numbers (.., P, NUMBERS) over points of weights (P,)."""
    columns = dict(zip(NUMBERS, np.moveaxis(numbers, -1, 0), strict=True))
    return np.stack([np.asarray(one.of(columns, weights)) for one in measures], axis=-1)
