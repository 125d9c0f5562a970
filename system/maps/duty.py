"""A duty cycle by a map: energies over the time, each with the map's error between its levels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.inputs.faults import Fault, InputFaults
from system.maps.data import LOSSES, MapData
from system.maps.interpolation import MapError, MapInterpolant, box_text, outside, weights
from system.maps.plan import MapAxis, MapInput
from system.pump.efficiency import EfficiencyDefinition

GAUSS_POINTS = 4
"""Places in each stretch of a cycle, Gauss and Legendre's: exact for powers of the seventh degree along it."""


@dataclass(frozen=True)
class Cycle:
    """Inputs of a map over time (s), SI, (N,) each and linear between rows; inputs that the map holds may be left
    out.

    A repeated time is a step. Raises InputError for fewer than two rows, and for times that fall or do not increase.
    """

    time: Array
    inputs: Mapping[MapInput, Array]

    def __post_init__(self) -> None:
        if len(self.time) < 2 or np.any(np.diff(self.time) < 0.0) or not self.time[-1] > self.time[0]:
            found = f"{len(self.time)} rows" if len(self.time) < 2 else "times that fall, or do not pass"
            raise InputError("cycle", found, "two rows or more, in the order of their time")

    @property
    def duration(self) -> float:
        """From the first row to the last, s."""
        return float(self.time[-1] - self.time[0])


@dataclass(frozen=True)
class Energy:
    """An energy over the cycle and its error by interpolation, J."""

    value: float
    error: float


@dataclass(frozen=True)
class Duty:
    """Energies and losses of a pump over a cycle.

    energies: shaft, hydraulic, loss and every sink of the loss, by name; efficiency: mean overall one by
    definition, energy over energy, with its error, empty unless both energies are positive; marked: part of the time
    between points with a warning, by its name; volume: delivered, m3; shown_by: source of the measured error.
    """

    duration: float
    volume: Energy
    energies: Mapping[str, Energy]
    efficiency: Mapping[EfficiencyDefinition, Energy]
    marked: Mapping[str, float]
    shown_by: str


def duty(interpolant: MapInterpolant, cycle: Cycle, error: MapError) -> Duty:
    """A cycle's energies; raises InputFaults for a cycle that leaves the map's box, with the place.

    The error of each energy is the largest measured one of that power, over the whole time: it is valid anywhere in the
    box.
    """
    _hold_inside(interpolant.data.axes, cycle)
    places, share = _stretches(cycle)
    interpolated = interpolant.at(places)
    interpolated["loss"] = interpolated["shaft_power"] - interpolated["hydraulic_power"]

    def over_time(values: Array) -> float:
        return float(share @ values)

    time, largest = cycle.duration, dict(error.largest)
    largest["loss"] = largest["shaft_power"] + largest["hydraulic_power"]
    names = {"shaft_power": "shaft", "hydraulic_power": "hydraulic", "loss": "loss", **LOSSES}
    energies = {words: Energy(over_time(interpolated[name]), time * largest[name]) for name, words in names.items()}
    absent = {words for words in LOSSES.values() if energies[words] == Energy(0.0, 0.0)}
    return Duty(
        duration=time,
        volume=Energy(over_time(interpolated["delivery_flow"]), time * largest["delivery_flow"]),
        energies={words: energy for words, energy in energies.items() if words not in absent},
        efficiency=_efficiencies(interpolated, share, energies),
        marked=_marked(interpolant.data, places, share / time),
        shown_by=f"{error.count} {error.shown_by}",
    )


def node_weights(axes: Sequence[MapAxis], cycle: Cycle) -> Array:
    """Weights (P,) of the points of a grid by which their sum is the mean over a cycle, the last axis changing first.

    A map between its levels, as `MapInterpolant` has it, is linear in the numbers at its points. Raises InputFaults as
    `duty`.
    """
    _hold_inside(axes, cycle)
    places, share = _stretches(cycle)
    kernel = np.ones((len(share), 1))
    for axis in axes:
        own = weights(axis, places.get(axis.input, np.full(len(share), axis.values[0])))
        kernel = (kernel[:, :, None] * own[:, None, :]).reshape(len(share), -1)
    return np.asarray(share @ kernel / cycle.duration)


def _hold_inside(axes: Sequence[MapAxis], cycle: Cycle) -> None:
    """Raise InputFaults with each input's first row outside the box; between rows a cycle cannot leave it."""
    if out := outside(axes, cycle.inputs):
        raise InputFaults("cycle", [_beyond(axis, cycle, row) for axis, row in out])


def _beyond(axis: MapAxis, cycle: Cycle, row: int) -> Fault:
    given = axis.input
    found = f"{given.text(float(cycle.inputs[given][row]))} at {cycle.time[row]:.6g} s"
    return Fault(given.words, found, box_text([axis]))


def _stretches(cycle: Cycle) -> tuple[dict[MapInput, Array], Array]:
    """Inputs (M,) at Gauss' places of every stretch of the cycle, and the seconds that each represents."""
    nodes, weights = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    part, span = 0.5 * (nodes + 1.0), np.diff(cycle.time)
    places = {
        given: (values[:-1, None] + np.diff(values)[:, None] * part)[span > 0.0].ravel()
        for given, values in cycle.inputs.items()
    }
    return places, (0.5 * span[:, None] * weights)[span > 0.0].ravel()


def _efficiencies(
    interpolated: Mapping[str, Array], share: Array, energies: Mapping[str, Energy]
) -> dict[EfficiencyDefinition, Energy]:
    """Mean overall efficiency of each definition: useful energy over that of the shaft.

    None of a cycle that does not take energy at the shaft or gives none to the oil: it stands still, or motors.
    """
    shaft, hydraulic = energies["shaft"], energies["hydraulic"]
    if not (shaft.value > 0.0 and hydraulic.value > 0.0):
        return {}
    delivered = interpolated["port_delivery_pressure"] * interpolated["delivery_flow"]
    ports = float(share @ (delivered - interpolated["port_inlet_pressure"] * interpolated["inlet_flow"]))
    kept = float(share @ interpolated["compression_power"])
    useful: dict[EfficiencyDefinition, float] = {
        EfficiencyDefinition.PAPER: ports,
        EfficiencyDefinition.ISO_SWEPT: ports,
        EfficiencyDefinition.ISO_TOET: ports,
        EfficiencyDefinition.ENERGY_RETURNED: hydraulic.value + kept,
        EfficiencyDefinition.ENERGY_NOT_RETURNED: hydraulic.value,
    }
    relative = hydraulic.error / hydraulic.value + shaft.error / shaft.value
    return {
        definition: Energy(value / shaft.value, abs(value) / shaft.value * relative)
        for definition, value in useful.items()
    }


def _marked(data: MapData, places: Mapping[MapInput, Array], share: Array) -> dict[str, float]:
    """Part of the time in cells of the map with a warning at a corner, by the warning's name."""
    cell: list[tuple[np.ndarray, np.ndarray]] = []
    for axis in data.axes:
        levels = np.array(axis.values)
        at = places.get(axis.input, np.full(len(share), levels[0]))
        lower = np.clip(np.searchsorted(levels, at, side="right") - 1, 0, max(0, len(levels) - 2))
        cell.append((lower, np.minimum(lower + 1, len(levels) - 1)))
    names = sorted({name for remarks in data.warnings.flat for name, _ in remarks})
    found = {}
    for name in names:
        here = np.array([any(name == one for one, _ in remarks) for remarks in data.warnings.flat]).reshape(data.shape)
        corners = [
            here[tuple(ends[corner >> k & 1] for k, ends in enumerate(cell))] for corner in range(2 ** len(cell))
        ]
        found[name] = float(share @ np.logical_or.reduce(corners))
    return {name: part for name, part in found.items() if part > 0.0}
