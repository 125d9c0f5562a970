"""Solved films as laws of a bench map: gaps by response tables, in place of the lumped law.

A table has leakage and friction of films at an operating point, as ratios to the lumped law. Tables of one pump without
and with a part of the film physics give the effect of this part on the readings.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from math import prod
from typing import Self

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.effect import BenchState, EffectId, Effects, GapCourse
from system.effects.extension import Values
from system.effects.friction import OF_GAP, SOCKET
from system.effects.priors import path_of
from system.effects.state import GAPS, unchanged
from system.points.table.gap_numbers import LEAST_FACTOR, PortDraws, gap_leaks, gap_losses, port_draws
from system.points.table.response_table import ResponseTable
from system.pump.chamber.problem import LeakTable
from system.pump.laws.friction_pairs import FrictionPairs, Pair
from system.pump.lumped import PistonMotion, Pressures, lumped_leaks, lumped_pairs, piston_motion
from system.pump.operating import OperatingPoint

RUBBED = (*OF_GAP.values(), Pair.PISTON_SLIPPER_SOCKET)
"""Pairs whose losses a table has."""
SHARE = "share"
"""Last part of a parameter's name: 0 for the films without a part of the physics, 1 for the films with it."""
Courses = Mapping[Gap, GapCourse]


def share_name(physics: EffectId) -> str:
    """Name of the parameter by which a part of the film physics acts."""
    return path_of(physics, SHARE)


@dataclass(frozen=True)
class GapState:
    """Gaps of N points over M angles.

    conductance, drag_flow: of a chamber's leakage, (3, N, M); coulomb, viscous: losses of the pairs of RUBBED, W of one
    piston, one slipper, the ring and one socket, (4, N, M); draws: from the delivery and the suction port, (2, N).
    """

    conductance: Array
    drag_flow: Array
    coulomb: Array
    viscous: Array
    draws: Array

    @staticmethod
    def of(leaks: LeakTable, losses: FrictionPairs[Array], draws: PortDraws) -> GapState:
        """The state of leaks (N, 3, M), losses (N, M) and draws (N,)."""
        return GapState(
            np.moveaxis(leaks.conductance, -2, 0),
            np.moveaxis(leaks.drag_flow, -2, 0),
            np.stack([losses.loss(pair).coulomb for pair in RUBBED]),
            np.stack([losses.loss(pair).viscous for pair in RUBBED]),
            np.stack([draws.delivery, draws.suction]),
        )


@dataclass(frozen=True)
class SolvedFilms:
    """The law of a pump whose films are those of response tables, in place of the lumped law's.

    pump: as the tables have it; base: its films without the physics that the simulation leaves out; single, pairs: with
    one or two parts of this physics. With G the state of the gaps and s the shares of the parts,

        G = G0 + sum s_a (G_a - G0) + sum s_a s_b (G_ab - G_a - G_b + G0),

    the tables' own at shares of 0 or 1, three and more parts by their pairs. off: shifts of outputs of the base table,
    in their own measure, for the influence of the table's error. Parameters of a fit act as on the lumped law.
    """

    pump: PumpDescription
    base: ResponseTable
    single: Mapping[EffectId, ResponseTable] = field(default_factory=dict)
    pairs: Mapping[frozenset[EffectId], ResponseTable] = field(default_factory=dict)
    off: Mapping[str, float] = field(default_factory=dict)

    def __call__(self, values: Values, courses: Courses, state: BenchState) -> Effects:
        """The effects at the state's points; values: by name, those of `share_name` act."""
        at = _Points.of(self.pump, courses, state)
        shares = {one: values.get(share_name(one), 0.0) for one in self.single}
        weights = self._weights({one: share for one, share in shares.items() if share != 0.0})
        return _between(
            at.lumped(), _blend([(weight, at.tabled(table, off)) for weight, table, off in weights]), courses
        )

    def _weights(self, shares: Mapping[EffectId, float]) -> Iterator[tuple[float, ResponseTable, Mapping[str, float]]]:
        """The tables that act, with their weights, of sum one."""
        both = {pair: product for pair in map(frozenset, combinations(shares, 2))
                if (product := prod(shares[one] for one in pair)) and pair in self.pairs}  # fmt: skip
        yield 1.0 - sum(shares.values()) + sum(both.values()), self.base, self.off
        for one, share in shares.items():
            yield share - sum(product for pair, product in both.items() if one in pair), self.single[one], {}
        for pair, product in both.items():
            yield product, self.pairs[pair], {}


@dataclass(frozen=True)
class _Points:
    """N points of a pump with the pressures of its chambers (N, M)."""

    pump: PumpDescription
    point: OperatingPoint[Array]
    cycle: Pressures

    @classmethod
    def of(cls, pump: PumpDescription, courses: Courses, state: BenchState) -> Self:
        """Return the points of a state, with the pressures of the courses."""
        point = OperatingPoint(
            shaft_speed=state.speed[:, None],
            delivery_pressure=state.delivery_pressure[:, None],
            inlet_pressure=state.inlet_pressure[:, None],
            case_pressure=state.case_pressure[:, None],
            displacement_ratio=state.displacement_ratio[:, None],
            temperature=state.temperature[:, None],
            viscosity=state.viscosity[:, None],
        )
        return cls(pump, point, Pressures(courses[Gap.PISTON].pressure + point.case_pressure))

    def lumped(self) -> GapState:
        """The gaps by the lumped law."""
        motion, none = self._motion, np.zeros(len(self.point.shaft_speed))
        losses = lumped_pairs(self.pump, self.point, motion, self.cycle)
        return GapState.of(lumped_leaks(self.pump, self.point, motion), losses, PortDraws(none, none))

    def tabled(self, table: ResponseTable, off: Mapping[str, float]) -> GapState:
        """The gaps by a table, with some of its outputs shifted."""
        given, means = (self.pump, self.point, self._motion, self.cycle), table.nearest(self.pump, self.point, off)
        return GapState.of(
            gap_leaks(*given, means), gap_losses(*given, means), port_draws(self.pump, self.point, means)
        )

    @property
    def _motion(self) -> PistonMotion[Array]:
        return piston_motion(self.pump, self.point, self.cycle.pressure.shape[-1] // self.pump.pump.pistons)


def _blend(parts: Sequence[tuple[float, GapState]]) -> GapState:
    """The weighted sum of states."""
    return GapState(*(sum(weight * getattr(state, name) for weight, state in parts) for name in vars(parts[0][1])))


def _between(lumped: GapState, solved: GapState, courses: Courses) -> Effects:
    """Changes from the lumped law's gaps to the solved ones.

    Contact of a pair without Coulomb friction by the law (a coefficient of 0) is added.
    """
    gaps, extra = slice(len(GAPS)), unchanged(courses).extra_coulomb
    extra[gaps] = np.where(lumped.coulomb[gaps] > 0.0, 0.0, solved.coulomb[gaps])
    extra[SOCKET] = solved.coulomb[-1] - lumped.coulomb[-1]
    delivery, suction = solved.draws - lumped.draws
    return replace(
        unchanged(courses),
        conductance=_factor(lumped.conductance, solved.conductance),
        gap_flow=solved.drag_flow - lumped.drag_flow,
        viscous=_factor(lumped.viscous[gaps], solved.viscous[gaps]),
        coulomb=_factor(lumped.coulomb[gaps], solved.coulomb[gaps]),
        extra_coulomb=extra,
        drain_flow=delivery,
        drain_from_inlet=suction,
    )


def _factor(one: Array, other: Array) -> Array:
    """Factor from one quantity to the other, LEAST_FACTOR at least; 1 where it is 0."""
    return np.maximum(np.divide(other, one, out=np.ones_like(other), where=one > 0.0), LEAST_FACTOR)
