"""A pump in time while its swash plate swings: a control pressure that steps or ramps, at the lumped fidelity."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.effects.switched import stated_laws
from system.inputs.units import TURN
from system.multibody.kinematics import swash_angle
from system.multibody.plate_motion import Mechanism, mechanism
from system.multibody.transient import kernels as kernel
from system.multibody.transient.march import Course, Setting, march
from system.multibody.transient.pistons import Group
from system.multibody.transient.setup import natural_frequency, plate_problem, plate_record, steps_a_pitch
from system.points.lumped import lumped_point
from system.pump.bench import Outside
from system.pump.chamber.cycle import bubbly_volume, specific_volume
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.chamber.problem import ChamberProblem
from system.pump.chamber.setup import chamber_records
from system.pump.chamber.state_kernels import energy_at, oil_of
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
    """Values (M,) at times (M,) s that rise from 0: held from each on, or linear in between and then held."""

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

    rows (N, COLUMNS) of `kernels`; pressure (N, z) of the chambers in Pa; shaft_angle (N,) rad; torque (N,) N m of the
    drive; outside (N,), the flows of effects past the chambers; chamber: one after effects; impulses (N - 1,) N m s on
    stops; swing rad/s, natural frequency of the plate on its oil at the start.
    """

    case: TransientCase
    mechanism: Mechanism
    step: float
    shaft_angle: Array
    rows: Array
    pressure: Array
    torque: Array
    outside: Outside[Array]
    chamber: ChamberProblem
    impulses: Array
    swing: float
    checks: TransientChecks

    @property
    def time(self) -> Array:
        """s."""
        return self.rows[:, kernel.TIME]

    @property
    def swash_angle(self) -> Array:
        """rad, at the actuator."""
        return self.rows[:, kernel.ANGLE]


def run_transient(case: TransientCase) -> Transient:
    """The solution of a case, at held ports and shaft speed, films of given thickness, equal chambers; effects of
    [physics] act by their laws.

    Raises InputError for a step too long, ValueError for chambers that differ, NotConverged where a chamber has no
    pressure or an effect's films have no solution.
    """
    pump, point = case.pump, case.point
    kinds(pump).hold_alike()
    parts = mechanism(pump)
    drive, pistons = drive_at_ratio(full_drive(pump), point.displacement_ratio), pump.pump.pistons
    angle = swash_angle(drive)
    swing = natural_frequency(pump, parts, angle)
    a_pitch = steps_a_pitch(case.step, point.shaft_speed, pistons, swing, parts)
    step = TURN / (a_pitch * pistons) / point.shaft_speed
    held, count = HELD_TURNS * a_pitch * pistons, max(1, round(case.end / step))
    controls = case.control_pressure.over(step, count)
    controls = np.concatenate([np.full((held, 2), controls[0, 0]), controls])
    problem, record = plate_problem(pump, point), plate_record(pump, point, parts, step)
    setting = Setting(Group(pump, point, parts), stated_laws(pump), problem, record, a_pitch, step, held, controls)
    pressure = lumped_point(pump, point).cycle.pressure
    turn = TURN * np.arange(pressure.size) / pressure.size
    at_plate = np.interp(turn + float(drive.dead_centre_shift), turn, pressure, period=TURN)
    found = march(setting, angle, at_plate)
    return Transient(
        case, parts, step, TURN / (a_pitch * pistons) * np.arange(count + 1, dtype=float), found.rows[held:],
        found.pressure[held:], found.torque[held:],
        Outside(*(one[held:] for one in vars(found.outside).values())), found.chamber, found.impulses[held:], swing,
        _checks(found),
    )  # fmt: skip


def flows(found: Transient) -> tuple[Array, Array, Array]:
    """Delivery, inlet and drain flow (N,) m3/s as a bench reads them: means over the step that ends at each time.

    Volumes at the pressure of the port, with their bubbles, which leave the drain's oil.
    """
    rows, outside, point, chamber = found.rows, found.outside, found.case.point, found.chamber
    pressures = np.maximum([point.delivery_pressure, point.inlet_pressure, point.case_pressure], CAVITY_PRESSURE)
    delivery, inlet = (bubbly_volume(float(one), chamber) for one in pressures[:2])
    case = specific_volume(float(pressures[2]), chamber.bulk_modulus)
    return (
        (rows[:, kernel.DELIVERY] * delivery + outside.delivery) * outside.delivery_reading,
        outside.inlet - rows[:, kernel.SUCTION] * inlet,
        rows[:, kernel.CASE] * case + outside.drain,
    )


def _checks(found: Course) -> TransientChecks:
    """Balance errors of oil and energy of the chambers from time 0 on."""
    totals, gained = turn_totals(found.totals), found.gained
    out, work, oil = totals.outflow, totals.indicated_work, found.chamber
    to_case = float(out.gaps * energy_at(oil.case_pressure, oil_of(chamber_records(oil))))
    taken = float(totals.path_energy.total + totals.port_energy.sum()) + to_case + float(gained[1])
    passed = float(abs(out.delivery) + abs(out.suction))
    return TransientChecks(
        mass_balance_error=abs(float(out.total + gained[0])) / passed,
        energy_balance_error=abs(work - taken) / max(abs(work), passed * oil.pressure_span),
    )
