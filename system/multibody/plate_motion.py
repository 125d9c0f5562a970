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
from system.inputs.units import Dimension, format_quantity
from system.multibody.places import actuator_arm, slippers_reach, stroking
from system.multibody.rotating_group import joint_forces
from system.points.lumped import lumped_point
from system.pump.operating import operating_point

FILLS = 0.1  # s in which an assumed orifice fills the actuator
DROP = 1e6  # Pa over it meanwhile
HOLDING_PRESSURE = 2.5e6
"""Control pressure (Pa above the case) that an assumed actuator holds the plate with: usual of servo controls."""


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


def mechanism(pump: PumpDescription) -> Mechanism:
    """The mechanism of a pump. An actuator that is not stated holds the pump at its rating with HOLDING_PRESSURE: it
    is that of the pump, whatever it is driven with.
    """
    taken = Taken()
    plate = swinging_plate(pump, taken)
    return Mechanism(plate, _actuator(pump, plate, taken), tuple(taken.assumptions))


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


def _largest_moment(pump: PumpDescription) -> float:
    """Largest moment (N m) over a turn that keeps the plate at rest at the rating and full displacement."""
    rated = pump.pump
    at = operating_point(
        pump, shaft_speed=rated.rated_speed, delivery_pressure=rated.rated_pressure, displacement_ratio=1.0
    )
    return float(np.max(np.abs(joint_forces(pump, lumped_point(pump, at)).plate.control)))


def _actuator(pump: PumpDescription, plate: SwingingPlate, taken: Taken) -> Actuator:
    stated = pump.actuator
    strokes, arm = stroking(pump, taken), actuator_arm(pump, taken)
    rate = taken.value("actuator.spring_rate", stated.spring_rate, 0.0, "no spring", Dimension.STIFFNESS)
    force = taken.value("actuator.spring_preload", stated.spring_preload, 0.0, "no spring", Dimension.FORCE)
    area = stated.area
    if area is None:
        moment = _largest_moment(pump)
        needed = moment / (arm * np.cos(plate.angle_max)) + force
        held = format_quantity(HOLDING_PRESSURE, Dimension.PRESSURE, digits=3)
        why = f"{held} above the case hold the largest moment at the rating, {moment:.4g} N m, and the spring"
        area = taken.value("actuator.area", None, needed / HOLDING_PRESSURE, why, Dimension.AREA)
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
