"""The paper's Eq. (21): friction coefficients of the seven pairs by the hydromechanical loss of Eq. (2)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.bench.outputs import coefficient_losses, losses
from system.bench.parameters import friction_key
from system.bench.points import BenchPoints
from system.bench.setting import Setting
from system.bench.simulator import LumpedBench
from system.description.drawing import drawn_sigmas
from system.description.pump import PumpDescription
from system.estimation.fit import maximum_posterior
from system.estimation.folds import levels
from system.estimation.observations import Channel, Observations
from system.estimation.parameters import Parameter, Role, Scale
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension
from system.pump.bench import BenchReading, paper_losses
from system.pump.laws.friction_pairs import Pair

LOSS = "hydromechanical_loss"
_METALS = (0.008, 0.03)  # brass on hardened steel
_BEARINGS = (0.0006, 0.0012)
RANGES: Mapping[Pair, tuple[float, float]] = {
    Pair.PISTON_CYLINDER: _METALS,
    Pair.SLIPPER_SWASH_PLATE: _METALS,
    Pair.VALVE_PLATE_CYLINDER: _METALS,
    Pair.PISTON_SLIPPER_SOCKET: _METALS,
    Pair.BALL_GUIDE_RETAINER: (0.112, 0.141),
    Pair.FRONT_BEARING: _BEARINGS,
    Pair.REAR_BEARING: _BEARINGS,
}
"""The paper's reasonable ranges of the friction coefficients."""
LOSS_CHANNELS = (ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE, ChannelName.TORQUE)
"""Readings that Eq. (2) needs, beside speed and pressures."""
RANK_NOISE = 1e-3  # of the loss: no bench is better
BEYOND = 2.0  # times the range's ends: no coefficient is looked for farther away


def paper_priors(
    pump: PumpDescription, pairs: Iterable[Pair] = tuple(RANGES)
) -> tuple[tuple[Parameter, ...], tuple[str, ...]]:
    """friction.PAIR of these pairs about the pump's coefficients, as wide as the paper's ranges, and notes.

    On a logarithmic scale: one sigma is half the range, the bounds are BEYOND its ends. A coefficient of 0 has no
    parameter; one outside the bounds is of another kind of pair than the paper's and keeps its sigma, with a note.
    """
    found: list[Parameter] = []
    notes: list[str] = []
    for pair in pairs:
        low, high = RANGES[pair]
        centre, lower, upper = getattr(pump.friction, pair.value), low / BEYOND, high * BEYOND
        name, spread = f"friction.{pair.value}", 0.5 * float(np.log(high / low))
        if lower < centre < upper:
            source = f"the paper's {low:g} to {high:g}"
            found.append(Parameter(name, Role.BASE, Scale.LOG, centre, spread, lower, upper, None, source))
        elif centre > 0.0:
            notes.append(f"{name}: {centre:g} is far from the paper's {low:g} to {high:g}; sigma as in a diagnosis")
    return tuple(found), tuple(notes)


def unstated_priors(pump: PumpDescription) -> tuple[tuple[Parameter, ...], tuple[str, ...]]:
    """`paper_priors` of the coefficients that have no sigma in the pump's [tolerance], and a note of each."""
    drawn = drawn_sigmas(pump)
    left = [
        pair
        for pair in RANGES
        if getattr(pump.tolerance, friction_key(pair.value)) is None and f"friction.{pair.value}" not in drawn
    ]
    priors, notes = paper_priors(pump, left)
    told = (f"{one.name}: [tolerance] states no sigma; assumed as uncertain as {one.source}" for one in priors)
    return priors, (*told, *notes)


@dataclass(frozen=True)
class EqTwentyOne:
    """Hydromechanical loss of N points: rest + sum of coefficient x column; a `Simulator` of one channel.

    rest: (N,) W, parts of Eq. (2) beside Coulomb friction (shear, throttling, compression charged or not);
    columns: (N, k) W, each pair's Coulomb loss at a coefficient of 1; shear: (N,) W of the films, a part of the
    rest. Coefficients do not move the chambers' pressure, so this is exact.
    """

    rest: Array
    columns: Array
    shear: Array
    parameters: tuple[Parameter, ...]

    @property
    def mixed(self) -> EqTwentyOne:
        """The same for coefficients that hold the films' shear, as the paper's do: none of it is in the rest."""
        return replace(self, rest=self.rest - self.shear, shear=np.zeros_like(self.shear))

    def predict(self, values: Array) -> Array:
        """Loss (N, 1) in W at the coefficients (k,)."""
        return np.asarray(self.rest + self.columns @ values)[:, None]

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d loss / d coefficient, (N, 1, len(names)), in W."""
        places = [[parameter.name for parameter in self.parameters].index(name) for name in names]
        return self.columns[:, None, places]

    def input_slopes(self, values: Array) -> Array:
        """(N, 1, 0): the inputs are part of the noise of `measured_losses`."""
        return np.zeros((len(self.rest), 1, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> EqTwentyOne:
        """The same with other priors; raises InputError for a name that is no coefficient of it."""
        new = {parameter.name: parameter for parameter in parameters}
        own = tuple(new.pop(parameter.name, parameter) for parameter in self.parameters)
        if new:
            raise InputError("Eq. (21)", ", ".join(new), f"{', '.join(one.name for one in own)}")
        return replace(self, parameters=own)


def eq_twenty_one(bench: LumpedBench, values: Array, parameters: tuple[Parameter, ...]) -> EqTwentyOne:
    """Eq. (21) of a bench, all coefficients except those of `parameters` held at `values` (of the bench's own).

    Friction that laws of [physics] add is part of the rest: it does not go with a coefficient.
    """
    solved = bench.solved(values)
    simulated = solved.truth
    at, found, by_coefficient = solved.setting, losses(solved), coefficient_losses(solved)
    friction = at.pump.friction
    columns = []
    for parameter in parameters:
        pair = Pair(parameter.name.rpartition(".")[2])
        own = by_coefficient.loss(pair)
        power = _mean_power(at, own.count * own.coulomb)
        columns.append(power / getattr(friction, pair.value))
    matrix = np.stack(columns, axis=-1)
    stated = np.array([getattr(friction, parameter.name.rpartition(".")[2]) for parameter in parameters])
    loss = _hydromechanical(bench.points, {name: simulated[:, n] for n, name in enumerate(LOSS_CHANNELS)})
    every = [found.loss(pair) for pair in Pair]
    shear = np.sum([_mean_power(at, one.count * one.viscous) for one in every], axis=0)
    return EqTwentyOne(loss - matrix @ stated, matrix, shear, parameters)


def measured_losses(points: BenchPoints, observations: Observations) -> Observations:
    """Eq. (2) of the readings, (N, 1) W, with the joint sigma of readings and inputs.

    The effect of an input's noise on the simulated loss is neglected: a small part of that on the power.
    Raises InputError where a flow or the torque was not measured.
    """
    names = [channel.name for channel in observations.channels]
    missing = [channel.value for channel in LOSS_CHANNELS if channel.value not in names]
    if missing:
        raise InputError("Eq. (21)", f"no {', '.join(missing)}", "both port flows, the drain and the torque")
    own = {channel: observations.values[:, names.index(channel.value)] for channel in LOSS_CHANNELS}
    loss = _hydromechanical(points, own)
    variance = np.zeros_like(loss)
    for channel in LOSS_CHANNELS:
        at = names.index(channel.value)
        sigma = np.hypot(observations.sigma[:, at], observations.quantum[at] / np.sqrt(12.0))
        moved = _hydromechanical(points, {**own, channel: own[channel] + sigma})
        variance += (moved - loss) ** 2
    for at, name in enumerate(observations.inputs):
        sigma = observations.input_sigma[:, at]
        moved = _hydromechanical(replace(points, **{name: getattr(points, name) + sigma}), own)
        variance += (moved - loss) ** 2
    return Observations(
        channels=(Channel(LOSS, Dimension.POWER),),
        values=loss[:, None],
        sigma=np.sqrt(variance)[:, None],
        inputs=(),
        input_sigma=np.zeros((len(loss), 0)),
        quantum=np.zeros(1),
        blocks=observations.blocks,
    )


@dataclass(frozen=True)
class EqFit:
    """Eq. (21) of some points: at one speed (rad/s) and displacement ratio, or (None) of the whole map.

    posterior: bounded, with priors. rank: number of combinations of coefficients that these points can separate at
    a noise of RANK_NOISE; known: number that the readings determine better than the priors. printed, condition:
    plain least squares of the same points (k,), and the condition of its matrix, columns scaled to equal length
    (inf: fewer points than coefficients).
    """

    speed: float | None
    ratio: float | None
    points: int
    posterior: Posterior
    rank: int
    known: int
    printed: Array
    condition: float


def eq_fits(eq: EqTwentyOne, readings: Observations, points: BenchPoints, rated_speed: float) -> tuple[EqFit, ...]:
    """Eq. (21) at the speed next to the rated one, displacement by displacement, then of the whole map."""
    speeds, ratios = levels(points.speed), levels(points.displacement_ratio)
    nearest = speeds == speeds[int(np.argmin(np.abs(points.speed - rated_speed)))]
    cells = [nearest & (ratios == level) for level in np.unique(ratios)]
    found = [
        _fit(eq, readings, cell, float(points.speed[cell].mean()), float(points.displacement_ratio[cell].mean()))
        for cell in cells
        if np.any(cell & readings.measured[:, 0])
    ]
    return (*found, _fit(eq, readings, np.ones(len(speeds), dtype=bool), None, None))


def _fit(
    eq: EqTwentyOne, readings: Observations, rows: NDArray[np.bool_], speed: float | None, ratio: float | None
) -> EqFit:
    own = readings.without(~rows)
    used = own.measured[:, 0]
    posterior = maximum_posterior(eq, own)
    values = np.linalg.svd(posterior.slopes, compute_uv=False)
    matrix = eq.columns[used]
    printed = np.linalg.lstsq(matrix, own.values[used, 0] - eq.rest[used], rcond=0.0)[0]
    sizes = np.linalg.svd(matrix / np.linalg.norm(matrix, axis=0), compute_uv=False)
    condition = float(sizes[0] / sizes[-1]) if len(matrix) >= matrix.shape[1] else np.inf
    rank, known = int(np.sum(sizes > RANK_NOISE * sizes[0])), int(np.sum(values > 1.0))
    return EqFit(speed, ratio, int(used.sum()), posterior, rank, known, printed, condition)


def _hydromechanical(points: BenchPoints, readings: Mapping[ChannelName, Array]) -> Array:
    """Eq. (2) at N points."""
    columns = (
        points.speed,
        readings[ChannelName.TORQUE],
        points.p_out,
        points.p_in,
        points.p_case,
        readings[ChannelName.Q_OUT],
        readings[ChannelName.Q_IN],
        readings[ChannelName.Q_CASE],
    )
    return np.array([paper_losses(BenchReading(*row)).hydromechanical for row in zip(*columns, strict=True)])


def _mean_power(setting: Setting, power: Array) -> Array:
    """Mean over the turn (N,) of a power over the motion's angles."""
    return np.asarray(np.mean(power + np.zeros_like(setting.motion.velocity), axis=-1))
