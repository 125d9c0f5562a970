"""The variable displacement mechanism: swash plate with its inertia, stops and friction, actuator and spring.

[swash_plate] and [actuator] state every value, or it is assumed and listed. An actuator pushes the plate along
the shaft by a pin at `arm` from the tilt axis: its displacement is arm (sin g - sin g_min), or arm (sin g_max -
sin g) where its pressure strokes the plate down; the spring acts against it.
"""

from dataclasses import dataclass

import numpy as np

from system.description.assumptions import Assumption, Taken
from system.description.parts import Stroking
from system.description.pump import PumpDescription
from system.films.parts import STEEL
from system.inputs.units import Dimension
from system.multibody.places import actuator_arm, slippers_reach, stroking
from system.multibody.rotating_group import joint_forces
from system.points.lumped import lumped_point
from system.pump.operating import OperatingPoint

FILLS = 0.1  # s in which an assumed orifice fills the actuator
DROP = 1e6  # Pa over it meanwhile


@dataclass(frozen=True)
class SwingingPlate:
    """The plate about its tilt axis: inertia kg m2, pivot_offset m, stops rad, damping N m s/rad, rubbing N m."""

    inertia: float
    pivot_offset: float
    angle_min: float
    angle_max: float
    damping: float
    rubbing: float


@dataclass(frozen=True)
class Actuator:
    """strokes; piston area m2, arm m, dead_volume m3, orifice_area m2, leakage m3/(s Pa); spring N/m, and N at the
    actuator's innermost place."""

    strokes: Stroking
    area: float
    arm: float
    dead_volume: float
    orifice_area: float
    leakage: float
    spring_rate: float
    spring_force: float

    @property
    def sense(self) -> float:
        """1 where its pressure increases the angle, -1 where it decreases it."""
        return 1.0 if self.strokes is Stroking.UP else -1.0


@dataclass(frozen=True)
class Mechanism:
    """Plate and actuator, complete; taken: the assumed values."""

    plate: SwingingPlate
    actuator: Actuator
    taken: tuple[Assumption, ...]


def mechanism(pump: PumpDescription, point: OperatingPoint, control_pressure: float) -> Mechanism:
    """The mechanism of a pump. An actuator that is not stated balances the pump with `control_pressure` (Pa) at
    `point`, at full displacement.
    """
    taken = Taken()
    plate = swinging_plate(pump, taken)
    return Mechanism(plate, _actuator(pump, plate, point, control_pressure, taken), tuple(taken.assumptions))


def swinging_plate(pump: PumpDescription, taken: Taken) -> SwingingPlate:
    """The swash plate of a pump, every value stated or noted in `taken`."""
    stated, reach = pump.swash_plate, slippers_reach(pump)
    material = pump.materials.swash_plate
    density = STEEL.density if material is None or material.density is None else material.density
    return SwingingPlate(
        inertia=taken.value(
            "swash_plate.inertia", stated.inertia, 0.5 * np.pi * density * reach**5,
            "half a solid cylinder about the tilt axis, its radius and half its length out to the slippers' rims",
            Dimension.INERTIA,
        ),
        pivot_offset=taken.value(
            "swash_plate.pivot_offset", stated.pivot_offset, 0.0, "the plate pivots on the shaft's axis",
            Dimension.LENGTH,
        ),
        angle_min=taken.value(
            "swash_plate.angle_min", stated.angle_min, 0.0, "the lower stop is at no displacement", Dimension.ANGLE
        ),
        angle_max=pump.pump.swash_angle_max,
        damping=taken.value(
            "swash_plate.damping", stated.damping, 0.0, "orifice and oil alone damp", Dimension.ANGULAR_DAMPING
        ),
        rubbing=taken.value(
            "swash_plate.trunnion_friction", stated.trunnion_friction, 0.0, "rolling bearings", Dimension.TORQUE
        ),
    )  # fmt: skip


def _actuator(
    pump: PumpDescription, plate: SwingingPlate, point: OperatingPoint, control_pressure: float, taken: Taken
) -> Actuator:
    stated = pump.actuator
    strokes, arm = stroking(pump, taken), actuator_arm(pump, taken)
    rate = taken.value("actuator.spring_rate", stated.spring_rate, 0.0, "no spring", Dimension.STIFFNESS)
    force = taken.value("actuator.spring_preload", stated.spring_preload, 0.0, "no spring", Dimension.FORCE)
    area = stated.area
    if area is None:
        # that keeps the plate at rest, over the turn
        moment = float(np.max(np.abs(joint_forces(pump, lumped_point(pump, point)).plate.control)))
        needed = moment / (arm * np.cos(plate.angle_max)) + force
        holding = control_pressure - point.case_pressure
        why = f"the highest control pressure holds the pump's largest moment, {moment:.4g} N m, and the spring"
        area = taken.value("actuator.area", None, needed / holding, why, Dimension.AREA)
    swept = area * arm * float(np.sin(plate.angle_max) - np.sin(plate.angle_min))
    flow = pump.ports.flow_coefficient * np.sqrt(2.0 * DROP / pump.oil.density)
    return Actuator(
        strokes, area, arm,
        taken.value("actuator.dead_volume", stated.dead_volume, swept, "as much as it sweeps", Dimension.VOLUME),
        taken.value(
            "actuator.orifice_area", stated.orifice_area, swept / (FILLS * flow),
            f"fills it within {FILLS:g} s at 1 MPa", Dimension.AREA,
        ),
        taken.value(
            "actuator.leakage", stated.leakage, 0.0, "a sealed piston", Dimension.HYDRAULIC_CONDUCTANCE
        ),
        rate, force,
    )  # fmt: skip
