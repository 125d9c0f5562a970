"""Levels of a scaled pump from its recording: displacement, films and friction before any hypothesis.

A pump of which little is known is REF90 scaled: its leakage and friction may be wrong by a factor of several, where
slopes at the prior mean are not valid for the pump on the bench. A robust fit of a few common factors moves the mean:

    min over x, b of sum rho((y - f(x) - B b)/s) + |x|^2 + |b|^2,
    x = ln of factors on displacement, films, friction in their spreads

rho: soft l1 (scipy), s: share of a channel's median. B b: parts of a drain flow besides the leakage of films, so that
these do not take a wrong level: a zero of its meter and an orifice, which grows with the root of the pressure. It has
no part in a verdict: priors stay as wide as before.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import least_squares

from diagnosis.checks.check import with_notes
from diagnosis.recording.model import Recording
from diagnosis.study.inputs import bench_points, complete, measured
from diagnosis.study.scaled.far import far_levels
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.bench.outputs import SIMULATED
from system.bench.parameters import base_parameters, pump_with
from system.bench.simulator import LumpedBench
from system.description.assumptions import Assumption
from system.description.gap import Gap
from system.description.tolerances import Tolerances
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension, format_quantity
from system.pump_file.file import KnownPump

SHARES = {ChannelName.Q_OUT: 0.003, ChannelName.Q_IN: 0.003}
"""Scale s of a channel's residuals, share of its median; the others SHARE."""
SHARE = 0.05
FARTHEST = np.log(8.0)
"""Of the logarithm of a common factor."""
SPREAD, DISPLACEMENT_SPREAD = 0.7, 0.01
"""One sigma of the logarithm of a factor, and of that on displacement."""
BESIDE = 0.3
"""One sigma of zero and orifice in the drain flow, shares of its median."""
FAR = 1e3
"""Residual where a pump cannot be simulated."""
STEPS = 100
"""Of the fit at most; it takes some 25."""
POINTS = 40
"""Points of the recording that the fit uses, evenly in their order."""
AT_LEVEL = "at the level of the recording"
NEAR_LEVEL = f"near the level of the recording, which a fit of {STEPS} steps has not reached; state it if it is known"
_FILMS = tuple(f"film_thickness.{gap.value}" for gap in Gap)
_DISPLACEMENT, _FRICTION = "displacement", "friction."
_FLOWS = {ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE}


def at_level(known: KnownPump, recording: Recording, tolerances: Tolerances) -> tuple[KnownPump, Recording]:
    """A pump at the level of its recording (`levelled`), and that with warnings of what is far from the type plate."""
    moved = levelled(known, recording, tolerances)
    return moved, with_notes(recording, far_levels(known.pump, moved.pump, tolerances))


def levelled(known: KnownPump, recording: Recording, tolerances: Tolerances) -> KnownPump:
    """A scant pump with displacement, films and friction at the level of its recording, and these as assumptions.

    A pump that is stated in full is returned unchanged.
    """
    usable = complete(recording)
    channels = measured(usable, SIMULATED)
    if not known.scant or not channels:
        return known
    chosen = _some(usable)
    parameters = base_parameters(known.pump, tolerances)
    points, _ = bench_points(chosen, known.pump)
    bench = LumpedBench(known.pump, points, channels, parameters, inputs=())
    order = list(ChannelName)
    readings = chosen.steady.values[:, [order.index(name) for name in channels]]
    scale = np.array([SHARES.get(name, SHARE) for name in channels]) * np.nanmedian(np.abs(readings), axis=0)
    names = [one.name for one in parameters]
    groups = _groups(names, channels)
    beside = _beside_leakage(points.p_out, channels, readings, scale)
    values, ended = _fitted(bench, readings, scale, groups, beside)
    moved = {names[k]: float(values[k]) for _, members in groups for k in members}
    assumed = _assumed(moved, AT_LEVEL if ended else NEAR_LEVEL)
    return replace(known, pump=pump_with(known.pump, moved), assumptions=(*known.assumptions, *assumed))


Groups = Sequence[tuple[str, list[int]]]


def _beside_leakage(pressure: Array, channels: Sequence[ChannelName], readings: Array, scale: Array) -> Array:
    """One sigma (N, C, 2) of zero and orifice in the drain flow, in units of the residuals; pressure (N,) in Pa."""
    found = np.zeros((*readings.shape, 2))
    if ChannelName.Q_CASE in channels:
        at = channels.index(ChannelName.Q_CASE)
        root = np.sqrt(np.maximum(pressure, 0.0))
        median = np.nanmedian(np.abs(readings[:, at]))
        found[:, at] = BESIDE * median / scale[at] * np.stack((np.ones_like(root), root / max(root.max(), 1.0)), axis=1)
    return found


def _fitted(bench: LumpedBench, readings: Array, scale: Array, groups: Groups, beside: Array) -> tuple[Array, bool]:
    """Values (k,) of the bench's parameters with each group at its factor; whether the fit has ended in `STEPS`."""
    centre = np.array([one.centre for one in bench.parameters])
    spread = np.array([DISPLACEMENT_SPREAD if name == _DISPLACEMENT else SPREAD for name, _ in groups])
    known = np.isfinite(readings)
    columns = beside[known]
    solved = np.linalg.solve(columns.T @ columns + np.eye(columns.shape[1]), columns.T)

    def values_of(x: Array) -> Array:
        found = centre.copy()
        for factor, (_, members) in zip(np.exp(spread * x), groups, strict=True):
            found[members] *= factor
        return found

    def residuals(x: Array) -> Array:
        try:
            offset = (readings - bench.predict(values_of(x))) / scale
        except NotConverged:
            offset = np.full_like(readings, FAR)
        b = solved @ offset[known]
        return np.concatenate([offset[known] - columns @ b, x, b])

    farthest = FARTHEST / spread
    fit = least_squares(
        residuals, np.zeros(len(groups)), loss="soft_l1", diff_step=1e-2, max_nfev=STEPS, bounds=(-farthest, farthest)
    )
    return values_of(fit.x), fit.status > 0


def _some(recording: Recording) -> Recording:
    """At most `POINTS` points of a recording, evenly in their order."""
    steady = recording.steady
    rows = np.unique(np.linspace(0, len(steady.values) - 1, POINTS).round().astype(int))
    return replace(recording, steady=steady.at(rows), traces=())


def _groups(names: Sequence[str], channels: Collection[ChannelName]) -> Groups:
    """Places of parameters that share a factor: displacement and films where flows are measured, friction by torque."""
    flows, torque = _FLOWS & set(channels), ChannelName.TORQUE in channels
    own = [(name, [k]) for k, name in enumerate(names) if flows and name in (_DISPLACEMENT, *_FILMS)]
    friction = [k for k, name in enumerate(names) if torque and name.startswith(_FRICTION)]
    return [*own, (_FRICTION, friction)] if friction else own


def _assumed(moved: dict[str, float], reason: str) -> tuple[Assumption, ...]:
    return tuple(
        Assumption(
            name,
            format_quantity(value, Dimension.LENGTH, digits=3) if name.startswith("film") else f"{value:.4g}",
            reason,
        )
        for name, value in moved.items()
    )
