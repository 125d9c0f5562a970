"""A pump in time while its swash plate swings: a control pressure that steps or ramps, at the lumped fidelity."""

from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.effects.switched import hold_plain
from system.inputs.units import TURN
from system.multibody.kinematics import swash_angle
from system.multibody.plate_motion import Mechanism, mechanism
from system.multibody.transient import kernels as kernel
from system.multibody.transient.setup import natural_frequency, plate_problem, plate_record, start_states, steps_a_pitch
from system.points.lumped import lumped_point
from system.pump.chamber.cycle import flow_energy
from system.pump.chamber.layout import INTEGRALS
from system.pump.chamber.problem import ChamberProblem
from system.pump.chamber.setup import constants
from system.pump.chamber.turn import turn_totals
from system.pump.chamber_kinds import kinds
from system.pump.laws.kinematics import drive_at_ratio
from system.pump.lumped import full_drive
from system.pump.operating import OperatingPoint

HELD_TURNS = 2
"""Turns with the plate held before time 0, in which chambers and actuator settle."""


class Transition(Enum):
    """Transition of a value from one stated time to the next."""

    STEP = "step"
    RAMP = "ramp"


@dataclass(frozen=True)
class ControlPressure:
    """Values (M,) at times (M,) s that rise from 0: held from each on, or straight in between and then held."""

    times: Array
    values: Array
    course: Transition = Transition.STEP

    def over(self, step: float, count: int) -> Array:
        """Values at begin and end of `count` steps from time 0, (count, 2); a jump waits for the next step."""
        begins = step * np.arange(count)
        if self.course is Transition.RAMP:
            return np.stack([np.interp(at, self.times, self.values) for at in (begins, begins + step)], axis=1)
        at = np.searchsorted(self.times, begins + 1e-9 * step, side="right") - 1
        return np.repeat(self.values[at][:, None], 2, axis=1)


@dataclass(frozen=True)
class TransientCase:
    """A transient: a pump at a point, whose displacement is that of the start; its control pressure (Pa) over
    time; until `end` s, in equal steps of about `step` rad of shaft angle, None: by the plate's swing.
    """

    pump: PumpDescription
    point: OperatingPoint
    control_pressure: ControlPressure
    end: float
    step: float | None = None


@dataclass(frozen=True)
class TransientChecks:
    """mass_balance_error: oil gained and passed by chambers, over the flow through their ports;
    energy_balance_error: work of the walls on their oil against its sinks, over that work, not imposed.
    """

    mass_balance_error: float
    energy_balance_error: float


@dataclass(frozen=True)
class Transient:
    """The course from time 0 on at N times, step s apart.

    rows (N, COLUMNS) of `transient_kernels`; pressure (N, z) of the chambers in Pa; shaft_angle (N,) rad; impulses
    (N - 1,) N m s that stops took; swing rad/s, natural frequency of the plate on its oil at the start.
    """

    case: TransientCase
    mechanism: Mechanism
    step: float
    shaft_angle: Array
    rows: Array
    pressure: Array
    impulses: Array
    swing: float
    checks: TransientChecks

    @property
    def time(self) -> Array:
        """s."""
        return self.rows[:, kernel.TIME]

    @property
    def swash_angle(self) -> Array:
        """rad."""
        return self.rows[:, kernel.ANGLE]


@dataclass(frozen=True)
class _Filled:
    """Arrays that the compiled solution fills, of so many steps in all."""

    steps: int
    pistons: int
    rows: Array = field(init=False)
    pressures: Array = field(init=False)
    totals: Array = field(init=False)
    impulses: Array = field(init=False)
    before: Array = field(init=False)

    def __post_init__(self) -> None:
        for name, shape in (
            ("rows", (self.steps + 1, kernel.COLUMNS)),
            ("pressures", (self.steps + 1, self.pistons)),
            ("totals", INTEGRALS),
            ("impulses", self.steps),
            ("before", 2),
        ):
            object.__setattr__(self, name, np.zeros(shape))


def run_transient(case: TransientCase) -> Transient:
    """The solution of a case, at held ports and shaft speed, films of given thickness, equal chambers.

    Raises InputError for a step too long and for [physics], ValueError for chambers that differ, NotConverged
    where a chamber finds no pressure.
    """
    pump, point = case.pump, case.point
    hold_plain(pump)
    kinds(pump).hold_alike()
    highest = float(np.max(case.control_pressure.values))
    parts = mechanism(pump, replace(point, displacement_ratio=1.0), highest)
    drive, pistons = drive_at_ratio(full_drive(pump), point.displacement_ratio), pump.pump.pistons
    angle = swash_angle(drive)
    swing = natural_frequency(pump, parts, angle)
    a_turn = pistons * steps_a_pitch(case.step, point.shaft_speed, pistons, swing, parts)
    step = TURN / a_turn / point.shaft_speed
    problem = plate_problem(pump, point)
    records = constants(problem)[0], plate_record(pump, point, parts, step)
    held, count = HELD_TURNS * a_turn, max(1, round(case.end / step))
    controls = case.control_pressure.over(step, count)
    controls = np.concatenate([np.full((held, 2), controls[0, 0]), controls])
    cycle = lumped_point(pump, point).cycle
    shift = float(drive.dead_centre_shift)
    states = start_states(pump, parts, records, angle, shift, cycle.pressure, controls[0, 0])
    filled = _Filled(held + count, pistons)
    failed = kernel.course(
        *records, held, step, controls, np.array([angle, 0.0, 0.0]), states, filled.rows, filled.pressures,
        filled.totals, filled.impulses, filled.before,
    )  # fmt: skip
    if failed:
        at = 1e3 * step * (failed - 1 - held)
        raise NotConverged(
            f"transient: a chamber or the actuator finds no pressure at {at:.4g} ms; "
            "check dead volumes, bulk modulus, the orifice's area and the step"
        )
    turned = TURN / a_turn * np.arange(count + 1, dtype=float)
    checks = _checks(problem, filled, kernel.contents(records[0], states[:-1]))
    rows, pressure, impulses = filled.rows[held:], filled.pressures[held:], filled.impulses[held:]
    return Transient(case, parts, step, turned, rows, pressure, impulses, swing, checks)


def _checks(problem: ChamberProblem, filled: _Filled, after: Array) -> TransientChecks:
    """Balance errors of oil and energy of the chambers from time 0 on."""
    totals, gained = turn_totals(filled.totals), after - filled.before
    out, work = totals.outflow, totals.indicated_work
    to_case = float(out.gaps * flow_energy(problem.case_pressure, problem.bulk_modulus))
    taken = float(totals.path_energy.total + totals.port_energy.sum()) + to_case + float(gained[1])
    passed = float(abs(out.delivery) + abs(out.suction))
    return TransientChecks(
        mass_balance_error=abs(float(out.total + gained[0])) / passed,
        energy_balance_error=abs(work - taken) / max(abs(work), passed * problem.pressure_span),
    )
