"""Effects of [physics] in a transient: each by its law, over a moving turn.

Chamber by chamber, the instants of a piston pitch cover all angles of a turn. They are the turn of the laws. Effects of
the pressure, sliding or load of an instant act at that instant and chamber; effects of means over a turn have those of
the pitch, and its displacement. A film is in balance with its heat at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np

from reynolds.numerics.arrays import Array
from system.effects.applied import affected_wear, effects_at
from system.effects.effect import Effects
from system.effects.extension import Law, Values
from system.effects.gap_states import bench_state
from system.effects.outside import outside
from system.inputs.units import TURN
from system.multibody.transient import kernels as kernel
from system.multibody.transient.pistons import Group, Instants, pistons_at, stroke_ratio
from system.pump.bench import Outside
from system.pump.chamber.problem import ChamberProblem
from system.pump.lumped import PistonMotion, Pressures
from system.pump.operating import columns
from system.pump.ports.wear import AS_DRAWN, worn_ports

LEAST_RATIO = 1e-6
"""Displacement for the laws of an upright plate: some of them divide by it."""


@dataclass(frozen=True)
class Acting:
    """Changes by [physics] over a turn: effects at M own angles of a piston from 0; outside, the flows past the
    chambers; droop rad, by which the plate tilts less under the pistons than at its actuator."""

    effects: Effects[float]
    outside: Outside[float]
    droop: float

    @property
    def table(self) -> Array:
        """Rows (ACTING, M) as the compiled solution reads them."""
        found = self.effects
        rows = [*found.conductance, found.coulomb[0], found.viscous[0], found.extra_coulomb[0]]
        return np.ascontiguousarray(np.stack(rows))

    def at_instants(self, instants: Instants) -> Effects[Array]:
        """The effects on friction at T instants, arrays (3, T, z) and (5, T, z)."""
        found = self.effects
        own = _columns_of(instants, found.viscous.shape[1])
        changed: Any = replace(
            found,
            viscous=found.viscous[:, own],
            coulomb=found.coulomb[:, own],
            extra_coulomb=found.extra_coulomb[:, own],
        )
        return cast(Effects[Array], changed)


def acting_over(group: Group, laws: Sequence[tuple[Law, Values]], instants: Instants) -> Acting:
    """The changes by laws, at the instants (T,) of one piston pitch in equal steps: T z own angles.

    Over centre the laws have the magnitude of the displacement.
    """
    tilt = float(np.mean(instants.rows[:, kernel.ANGLE]))
    ratio = max(abs(float(stroke_ratio(group.pump, np.array(tilt)))), LEAST_RATIO)
    point = replace(group.point, displacement_ratio=ratio)
    pressure, motion = _turned(instants.pressure, instants), _turn_of(group, instants)
    at, none = columns(point), np.zeros(1)
    effects = effects_at(group.pump, at, motion, lambda: Pressures(pressure), laws, none).effects.at(0)
    left = replace(point, inlet_pressure=point.inlet_pressure - effects.suction_loss)
    droop = tilt - float(np.arctan(effects.ideal * np.tan(tilt)))
    return Acting(effects, outside(effects, bench_state(group.pump, left, 0.0)), droop)


def affected_chamber(problem: ChamberProblem, effects: Effects[float]) -> ChamberProblem:
    """A chamber with the ports, the oil and the pressure behind the suction port after effects."""
    wear = affected_wear(AS_DRAWN, effects)
    suction, delivery = worn_ports(problem.suction_port, problem.delivery_port, wear)
    return replace(
        problem,
        suction_port=suction,
        delivery_port=delivery,
        inlet_pressure=problem.inlet_pressure - effects.suction_loss,
        free_air=effects.free_air,
        air_exponent=effects.air_exponent,
    )


def _turn_of(group: Group, instants: Instants) -> PistonMotion[Array]:
    """One piston over the turn composed of the instants of a pitch, arrays (1, M); its drive of their mean tilt."""
    found = pistons_at(group, instants).motion
    mean = float(np.mean(found.drive.swash_angle))
    changed = {
        name: _turned(value, instants) for name, value in vars(found).items() if name not in ("drive", "shaft_angle")
    }
    count = instants.pressure.size
    return replace(
        found,
        drive=replace(found.drive, swash_angle=np.full((1, 1), mean)),
        shaft_angle=TURN * np.arange(count) / count,
        **changed,
    )


def _turned(values: Array, instants: Instants) -> Array:
    """Values (T, z) of a pitch over the own angle of a piston, (1, T z)."""
    found = np.empty((1, values.size))
    found[0, _columns_of(instants, values.size)] = values
    return found


def _columns_of(instants: Instants, count: int) -> Array:
    """Number (T, z) of each chamber's own angle among `count` equidistant ones from 0."""
    return np.asarray(np.rint(instants.own_angle / TURN * count).astype(int) % count)
