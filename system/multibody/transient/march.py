"""A transient pitch by pitch: before each the effects of [physics] are renewed, by the instants of a first pass."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.effects.extension import Law, Values
from system.inputs.units import TURN
from system.multibody.transient import kernels as kernel
from system.multibody.transient.effects import Acting, acting_over, affected_chamber
from system.multibody.transient.pistons import Group, Instants
from system.multibody.transient.setup import chamber_pair, start_states
from system.multibody.transient.torque import drive_torque
from system.pump.bench import Outside
from system.pump.chamber.layout import INTEGRALS
from system.pump.chamber.problem import ChamberProblem


@dataclass(frozen=True)
class Setting:
    """Constants of a course: the group, its laws of [physics] with their values, a chamber without them, the plate's
    record; so many steps of `step` s to a pitch, `held` steps before the plate is released; controls (N, 2) Pa before
    the actuator's orifice at begin and end of each step."""

    group: Group
    laws: Sequence[tuple[Law, Values]]
    problem: ChamberProblem
    plate: np.ndarray
    a_pitch: int
    step: float
    held: int
    controls: Array

    @property
    def steps(self) -> int:
        """Steps of the whole course."""
        return len(self.controls)


@dataclass(frozen=True)
class Course:
    """A course of N steps: rows (N + 1, COLUMNS), pressure (N + 1, z) Pa, torque (N + 1,) N m of the drive, outside (N
    + 1,): the flows past the chambers, impulses (N,) N m s on stops.

    From the release of the plate on: totals (INTEGRALS,) of all chambers, gained (2,) of `kernels.contents`. chamber:
    one after effects, at the end.
    """

    rows: Array
    pressure: Array
    torque: Array
    outside: Outside[Array]
    impulses: Array
    totals: Array
    gained: Array
    chamber: ChamberProblem


@dataclass(frozen=True)
class _State:
    """State at the end of the rows so far: tilt (3,), oil (z + 1, 2), and the effects that act."""

    tilt: Array
    oil: Array
    acting: Acting


def march(setting: Setting, angle: float, pressure: Array) -> Course:
    """The course from a plate at rest at an angle (rad), chambers at pressures (M,) Pa over their own angles.

    Raises NotConverged where a chamber has no pressure.
    """
    steps, pistons = setting.steps, setting.group.pump.pump.pistons
    found = Course(
        np.zeros((steps + 1, kernel.COLUMNS)), np.zeros((steps + 1, pistons)), np.zeros(steps + 1),
        Outside(*(np.zeros(steps + 1) for _ in fields(Outside))), np.zeros(steps), np.zeros(INTEGRALS), np.zeros(2),
        setting.problem,
    )  # fmt: skip
    state = _begun(setting, angle, pressure, found)
    for begin, end in _pitches(steps, setting.a_pitch):
        if begin == setting.held:
            found.gained[:] -= _contents(setting, state)
        state, totals = _pitch(setting, state, begin, end, found)
        if begin >= setting.held:
            found.totals[:] += totals
        new = slice(begin + 1, end + 1)
        found.torque[new] = drive_torque(setting.group, _instants(setting, found, new), state.acting)
        for own in fields(Outside):
            getattr(found.outside, own.name)[new] = getattr(state.acting.outside, own.name)
    found.gained[:] += _contents(setting, state)
    return replace(found, chamber=affected_chamber(setting.problem, state.acting.effects))


def _pitches(steps: int, a_pitch: int) -> Iterator[tuple[int, int]]:
    """Begin and end of each pitch."""
    return ((begin, min(begin + a_pitch, steps)) for begin in range(0, steps, a_pitch))


def _begun(setting: Setting, angle: float, pressure: Array, found: Course) -> _State:
    """The state at row 0, filled: effects are those of the pressures over a turn at rest."""
    group, pistons = setting.group, setting.group.pump.pump.pistons
    turned: Array = TURN / (setting.a_pitch * pistons) * np.arange(setting.a_pitch, dtype=float)
    rows = np.zeros((turned.size, kernel.COLUMNS))
    rows[:, kernel.ANGLE] = angle
    at_rest = Instants(turned, rows, np.zeros((turned.size, pistons)))
    turn = TURN * np.arange(pressure.size) / pressure.size
    at_rest.pressure[:] = np.interp(at_rest.own_angle, turn, pressure, period=TURN)
    acting = acting_over(group, setting.laws, at_rest)
    records, tilt = _records(setting, acting), np.array([angle, 0.0, 0.0])
    oil = start_states(
        group.pump, group.parts, (records, setting.plate), angle, acting.droop, at_rest.pressure[0],
        setting.controls[0, 0],
    )  # fmt: skip
    found.rows[0, kernel.DROOP] = acting.droop
    at = 0, setting.held, setting.step
    kernel.place(records, setting.plate, acting.table, at, tilt, oil, found.rows[0], found.pressure[0])
    return _State(tilt, oil, acting)


def _contents(setting: Setting, state: _State) -> Array:
    """Oil of the chambers and its energy, (2,)."""
    return np.asarray(kernel.contents(_records(setting, state.acting)[:1], state.oil[:-1]))


def _records(setting: Setting, acting: Acting) -> np.ndarray:
    return chamber_pair(affected_chamber(setting.problem, acting.effects), setting.problem)


def _pitch(setting: Setting, state: _State, begin: int, end: int, found: Course) -> tuple[_State, Array]:
    """The state at the end of a pitch, rows up to there filled, and totals (INTEGRALS,) of its chambers.

    With laws twice: with the effects of the pitch before, and with those of the instants that these lead to.
    """
    acting, totals = state.acting, np.zeros(INTEGRALS)
    window = slice(end + 1 - setting.a_pitch, end + 1)
    for again in range(2 if setting.laws else 1):
        if again:
            acting = acting_over(setting.group, setting.laws, _instants(setting, found, window))
        tilt, oil = state.tilt.copy(), state.oil.copy()
        _impose_droop(setting, acting.droop, found.rows[begin : end + 1])
        failed = kernel.course(
            _records(setting, acting), setting.plate, acting.table, begin, end, setting.held, setting.step,
            setting.controls, tilt, oil, found.rows, found.pressure, found.impulses, totals,
        )  # fmt: skip
        if failed:
            at = 1e3 * setting.step * (failed - 1 - setting.held)
            raise NotConverged(
                f"transient: a chamber or the actuator finds no pressure at {at:.4g} ms; "
                "check dead volumes, bulk modulus, the orifice's area and the step"
            )
    return _State(tilt, oil, acting), totals


def _impose_droop(setting: Setting, droop: float, rows: Array) -> None:
    """Fill the droop of rows behind the first, evenly from its own to the new one (rad)."""
    rows[:, kernel.DROOP] = np.linspace(rows[0, kernel.DROOP], droop, len(rows))
    rows[1:, kernel.DROOP_RATE] = (rows[1, kernel.DROOP] - rows[0, kernel.DROOP]) / setting.step


def _instants(setting: Setting, found: Course, part: slice) -> Instants:
    """Some instants of the course."""
    numbers = np.arange(part.start, part.stop) - setting.held
    turned = TURN / (setting.a_pitch * setting.group.pump.pump.pistons) * numbers
    return Instants(turned, found.rows[part], found.pressure[part])
