"""The numbers of an operating map over its axes: efficiencies by definition, displacements, best points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import nan

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.maps.displacement import Derived, toet_displacement
from system.maps.plan import MapAxis, MapInput, MapPlan
from system.maps.point import columns
from system.pump.assembly import PointWarning
from system.pump.bench import BenchReading
from system.pump.efficiency import EfficiencyBasis, EfficiencyDefinition, efficiency
from system.pump.laws.friction_pairs import Pair
from system.work.tasks import PartOutcome, PartStatus

READING = {
    "shaft_torque": "shaft_torque",
    "delivery_pressure": "port_delivery_pressure",
    "inlet_pressure": "port_inlet_pressure",
    "drain_pressure": "drain_pressure",
    "delivery_flow": "delivery_flow",
    "inlet_flow": "inlet_flow",
    "drain_flow": "drain_flow",
}
"""Fields of a bench reading beside the speed, by the map's numbers."""
LOSSES = {
    **{f"pair_loss.{pair.value}": f"{pair.words} friction" for pair in Pair},
    "leakage_loss.piston": "piston leakage",
    "leakage_loss.slipper": "slipper leakage",
    "leakage_loss.valve_plate": "valve plate leakage",
    "compression_power": "compression",
    "throttling_delivery": "delivery throttling",
    "throttling_suction": "suction throttling",
    "ripple_power": "line ripple",
    "extended_loss": "effects of [physics]",
}
"""Losses that add up to the shaft power minus the hydraulic power, with their names."""


@dataclass(frozen=True)
class MapData:
    """A map: numbers over the five axes, nan where a point has no result.

    name: the pump's; words: how points were solved; bulk_modulus: the oil's, Pa; values: arrays by column, SI;
    status, reason: text of each point; warnings: its remarks, (name, text). rated: speed and pressure of the pump.
    """

    name: str
    words: str
    bulk_modulus: float
    axes: tuple[MapAxis, ...]
    values: Mapping[str, Array]
    status: np.ndarray
    reason: np.ndarray
    warnings: np.ndarray
    rated: Mapping[MapInput, float]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of levels of each axis."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def solved(self) -> np.ndarray:
        """Mask of the points with a result."""
        return np.asarray(self.status == PartStatus.SOLVED.value)

    @cached_property
    def grid(self) -> dict[MapInput, Array]:
        """Each input at every point."""
        levels = np.meshgrid(*(axis.values for axis in self.axes), indexing="ij")
        return {axis.input: level for axis, level in zip(self.axes, levels, strict=True)}

    @property
    def losses(self) -> dict[str, Array]:
        """Sinks of the shaft power less the hydraulic power, W, by name; zero ones left out."""
        found = {words: self.values[column] for column, words in LOSSES.items()}
        return {words: loss for words, loss in found.items() if np.nansum(np.abs(loss)) > 0.0}

    @property
    def loss(self) -> Array:
        """Shaft power less the power p Q at all ports, W."""
        return np.asarray(self.values["shaft_power"] - self.values["hydraulic_power"])

    @cached_property
    def toet(self) -> dict[tuple[int, int, int], Derived]:
        """Displacement by Toet's method, m3/rev, by the index of displacement ratio, temperature, inlet pressure.

        Of all points that pump; absent for fewer than two speeds and two pressures.
        """
        found = {}
        speed, pressure = (self.grid[given] for given in (MapInput.SPEED, MapInput.PRESSURE))
        difference = pressure - self.values["port_inlet_pressure"]
        for index in np.ndindex(*self.shape[2:]):
            good = self._pumps[:, :, *index]
            if not np.any(good):
                continue
            taken = (values[:, :, *index][good] for values in (speed, difference, self.values["delivery_flow"]))
            try:
                found[index] = toet_displacement(*taken)
            except InputError:
                continue  # not defined: nan, and by `toet_notes`
        return found

    @property
    def _pumps(self) -> np.ndarray:
        """Mask of the points with a result and a delivery; elsewhere efficiencies are not defined."""
        flows = (self.values[name] > 0.0 for name in ("delivery_flow", "inlet_flow", "shaft_power"))
        return np.logical_and.reduce([self.solved, *flows])

    def efficiency(self, definition: EfficiencyDefinition) -> MapEfficiency:
        """The efficiencies of a definition at every point; nan without pumping or without a value."""
        parts = np.full((3, *self.shape), nan)
        for index in map(tuple, np.argwhere(self._pumps)):
            derived = self.toet.get(index[2:])
            if definition is EfficiencyDefinition.ISO_TOET and derived is None:
                continue
            swept = float(self.values["swept_displacement"][index])
            basis = EfficiencyBasis(self.reading(index), self.bulk_modulus, swept, derived.value if derived else None)
            found = efficiency(definition, basis)
            parts[:, *index] = found.overall, found.volumetric, found.hydromechanical
        return MapEfficiency(*parts)

    def reading(self, index: tuple[int, ...]) -> BenchReading:
        """Bench readings at a point."""
        read = {field: float(self.values[column][index]) for field, column in READING.items()}
        return BenchReading(shaft_speed=float(self.grid[MapInput.SPEED][index]), **read)


@dataclass(frozen=True)
class MapEfficiency:
    """Overall, volumetric and hydromechanical efficiency over a map's axes."""

    overall: Array
    volumetric: Array
    hydromechanical: Array


@dataclass(frozen=True)
class Best:
    """The point of the highest overall efficiency by a definition: its index, SI inputs, and the efficiency."""

    definition: EfficiencyDefinition
    index: tuple[int, ...]
    inputs: Mapping[MapInput, float]
    overall: float


def map_data(plan: MapPlan, words: str, outcomes: tuple[PartOutcome, ...]) -> MapData:
    """The map of a plan's outcomes, which are in the order of its points; words: their solver."""
    numbers = [outcome.record.get("numbers", {}) for outcome in outcomes]
    remarks = [tuple((name, text) for name, text in one.record.get("warnings", ())) for one in outcomes]
    return MapData(
        name=plan.pump.name,
        words=words,
        bulk_modulus=plan.pump.oil.bulk_modulus,
        axes=plan.axes,
        values={
            column: np.array([row.get(f"{column} [{unit}]", nan) for row in numbers]).reshape(plan.shape)
            for column, unit, _ in columns()
        },
        status=objects([outcome.status.value for outcome in outcomes], plan.shape),
        reason=objects([outcome.reason for outcome in outcomes], plan.shape),
        warnings=objects(remarks, plan.shape),
        rated={MapInput.SPEED: plan.pump.pump.rated_speed, MapInput.PRESSURE: plan.pump.pump.rated_pressure},
    )


def objects(values: Sequence[object], shape: tuple[int, ...]) -> np.ndarray:
    """Values in a row as an array of objects over a map's axes."""
    found = np.empty(len(values), dtype=object)
    for k, value in enumerate(values):
        found[k] = value
    return found.reshape(shape)


def best_points(data: MapData) -> tuple[Best, ...]:
    """The best point of each definition that has any efficiency."""
    found = []
    for definition in EfficiencyDefinition:
        overall = data.efficiency(definition).overall
        if not np.any(np.isfinite(overall)):
            continue
        index = np.unravel_index(int(np.nanargmax(overall)), overall.shape)
        place = tuple(int(k) for k in index)
        inputs = {given: float(values[place]) for given, values in data.grid.items()}
        found.append(Best(definition, place, inputs, float(overall[place])))
    return tuple(found)


def warning_counts(data: MapData) -> dict[str, tuple[int, str]]:
    """Each warning of the points by name: number of points, and its text at the first of them."""
    found: dict[str, tuple[int, str]] = {}
    for name, text in (remark for remarks in data.warnings.flat for remark in remarks):
        count, first = found.get(name, (0, text))
        found[name] = count + 1, first
    return found


def toet_notes(data: MapData) -> tuple[str, ...]:
    """Displacements by Toet that use fewer levels than ISO 8426-1 requires, or that are not defined."""
    void = int(np.prod(data.shape[2:])) - len(data.toet)
    notes = list(dict.fromkeys(note for derived in data.toet.values() for note in derived.notes))
    if void:
        notes.append(f"void at {void} settings: fewer than two speeds and two pressures that deliver")
    cavities = warning_counts(data).get(PointWarning.CHAMBER_CAVITATES.value, (0, ""))[0]
    if cavities:
        notes.append(f"{cavities} of the points have a cavity in the chamber, and are taken as they are")
    return tuple(notes)
