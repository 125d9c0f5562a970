"""Bench readings at the paper's test plan, made from solved points, and Eq. (21) of the same points."""

from collections.abc import Sequence

import numpy as np

from system.bench.calibration.equation_21 import EqTwentyOne, paper_priors
from system.bench.points import BenchPoints
from system.estimation.observations import Channel, Observations
from system.inputs.channels import ChannelName
from system.paper.points import PRESSURES, RATIOS, SPEEDS, LossReading, PaperPoint, PaperPoints
from system.pump.laws.friction_pairs import Pair

SEED = 13
NOISE = {
    ChannelName.Q_OUT: (0.08 / 6e4, 0.0006),
    ChannelName.Q_IN: (0.12 / 6e4, 0.001),
    ChannelName.Q_CASE: (0.015 / 6e4, 0.004),
    ChannelName.TORQUE: (0.25, 0.0006),
}
"""One sigma of a channel, SI: so much, and so much of the reading; the sensors of a good test bench."""
MADE = "made, not measured"
PLAN = tuple((speed, pressure, ratio) for ratio in RATIOS[1:] for speed in SPEEDS for pressure in PRESSURES)
"""The paper's test plan, 112 points."""


def made_readings(source: PaperPoints) -> tuple[BenchPoints, Observations]:
    """Readings of a bench with sensors of NOISE at PLAN; the same at each call."""
    rows = [source.at(*place) for place in PLAN]
    true = np.array([
        [of.delivery_flow, of.inlet_flow, of.drain_flow, of.shaft_torque] for of in (one.bench for one in rows)
    ])  # fmt: skip
    sigma = np.array([one for one, _ in NOISE.values()]) + np.array([share for _, share in NOISE.values()]) * np.abs(
        true
    )
    values = true + sigma * np.random.default_rng(SEED).standard_normal(true.shape)
    channels = tuple(Channel(name.value, name.dimension) for name in NOISE)
    count = len(rows)
    readings = Observations(channels, values, sigma, (), np.zeros((count, 0)), np.zeros(4), np.arange(count))
    return _bench_points(rows, source), readings


def _bench_points(rows: Sequence[PaperPoint], source: PaperPoints) -> BenchPoints:
    at, count = source.pump.operating, len(rows)
    held = np.full(count, at.temperature)
    return BenchPoints(
        speed=np.array([one.bench.shaft_speed for one in rows]),
        displacement_ratio=np.array([ratio for _, _, ratio in PLAN]),
        p_out=np.array([one.bench.delivery_pressure for one in rows]),
        p_in=np.array([one.bench.inlet_pressure for one in rows]),
        p_case=np.array([one.bench.drain_pressure for one in rows]),
        T_case=held,
        T_in=held,
        hours=np.zeros(count),
        order=np.arange(count, dtype=float),
        warming=np.zeros(count),
    )


def equation_of(model: PaperPoints) -> EqTwentyOne:
    """Eq. (21) at PLAN: each pair's Coulomb loss at a coefficient of 1, and the rest of Eq. (2)."""
    priors, _ = paper_priors(model.pump)
    rows = [model.at(*place) for place in PLAN]
    pairs = [Pair(prior.name.rpartition(".")[2]) for prior in priors]
    stated = np.array([getattr(model.pump.friction, pair.value) for pair in pairs])
    losses = np.array([[one.coulomb[list(Pair).index(pair)] for pair in pairs] for one in rows])
    loss = np.array([one.split(LossReading.WITH_SHEAR).hydromechanical for one in rows])
    shear = np.array([sum(one.viscous) for one in rows])
    return EqTwentyOne(loss - losses.sum(axis=1), losses / stated, shear, priors)
