"""Effects by their id, the inputs of their laws, and the changes they make in the pump."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from enum import Enum
from typing import Any, Generic

import numpy as np
from typing_extensions import TypeVar

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription

Value = TypeVar("Value", float, Array, default=Array)
"""Numbers of one point, or arrays (N,) of N points."""


class Kind(Enum):
    """Kind of cause of a mismatch, as in the verdict."""

    MISSING_PHYSICS = "missing_physics"
    SENSOR_FAULT = "sensor_fault"
    WRONG_PARAMETER = "wrong_parameter"
    UNKNOWN_PHYSICS = "unknown_physics"
    NO_MISMATCH = "no_mismatch"


class EffectId(Enum):
    """The ids of the catalogue: missing physics, sensor faults, wrong parameters, and unknown physics."""

    FILM_HEATING = "film_heating"
    VISCOSITY_PRESSURE = "viscosity_pressure"
    ENTRAINED_AIR = "entrained_air"
    INCOMPLETE_FILLING = "incomplete_filling"
    SHEAR_THINNING = "shear_thinning"
    MIXED_FRICTION = "mixed_friction"
    ELASTIC_OPENING = "elastic_opening"
    THERMAL_CLEARANCE = "thermal_clearance"
    SQUEEZE_PUMPING = "squeeze_pumping"
    SLIPPER_LIFT = "slipper_lift"
    BLOCK_TIPPING = "block_tipping"
    FILM_RUPTURE = "film_rupture"
    WORN_PROFILE = "worn_profile"
    CHURNING = "churning"
    SEAL_DRAG = "seal_drag"
    CHARGE_PUMP_DRAG = "charge_pump_drag"
    PORT_SHORT_CIRCUIT = "port_short_circuit"
    NOTCH_EROSION = "notch_erosion"
    PORT_THROTTLING = "port_throttling"
    COMPRESSION_LOSS = "compression_loss"
    CONTROL_FLOW = "control_flow"
    SWASH_DROOP = "swash_droop"
    LINE_RESONANCE = "line_resonance"
    LAMINAR_CROSS_LEAK = "laminar_cross_leak"
    TORQUE_OFFSET = "torque_offset"
    TORQUE_GAIN = "torque_gain"
    Q_OUT_GAIN = "Q_out_gain"
    Q_IN_GAIN = "Q_in_gain"
    Q_CASE_OFFSET = "Q_case_offset"
    Q_CASE_DRIFT = "Q_case_drift"
    Q_CASE_GAIN = "Q_case_gain"
    FLOW_LAG = "flow_lag"
    P_OUT_OFFSET = "p_out_offset"
    T_CASE_OFFSET = "T_case_offset"
    T_IN_OFFSET = "T_in_offset"
    FILM_THICKNESS = "film_thickness"
    VISCOSITY_GRADE = "viscosity_grade"
    BULK_MODULUS = "bulk_modulus"
    DEAD_VOLUME = "dead_volume"
    FRICTION_COEFFICIENT = "friction_coefficient"
    DISPLACEMENT = "displacement"
    UNKNOWN_PHYSICS = "unknown_physics"


@dataclass(frozen=True)
class GapCourse:
    """One gap over the turn at N points, M shaft angles each: arrays (N, M), of one piston, one slipper, the ring.

    pressure: chamber over case pressure in Pa; sliding_speed: of the two walls in m/s, never negative; film: thickness
    in m; normal_force: the force that Coulomb friction multiplies, N; coulomb, viscous: loss in W without any effect;
    leakage: through the lands, m3/s, without any effect; width (N,): of the film across its sliding, m; land_area (N,):
    of the sealing lands in m2.
    """

    pressure: Array
    sliding_speed: Array
    film: Array
    normal_force: Array
    coulomb: Array
    viscous: Array
    leakage: Array
    width: Array
    land_area: Array


@dataclass(frozen=True)
class BenchState(Generic[Value]):
    """N bench points as inputs of laws: rad/s, Pa gauge, Pa s, K, h run; arrays (N,). `geometry` is the pump.

    BenchState[float]: one point.
    """

    speed: Value
    displacement_ratio: Value
    delivery_pressure: Value
    inlet_pressure: Value
    case_pressure: Value
    viscosity: Value
    temperature: Value
    hours: Value
    geometry: PumpDescription


@dataclass(frozen=True)
class Effects(Generic[Value]):
    """Changes by a law at N points and M angles; ones and zeros change nothing.

    conductance, viscous, coulomb: (3, N, M), factors on leakage, shear and Coulomb friction of the gaps in the
    order of `Gap`; gap_flow: (3, N, M), m3/s, of oil that walls drag out of one chamber into each gap;
    extra_coulomb: (5, N, M), W, of one piston, one slipper, the valve plate, one socket, the ball guide. Then (N,)
    each, flows in m3/s of volume at the port they leave: cross_flow (delivery to inlet), drain_flow (delivery to
    case), drain_from_inlet; torque in N m on the shaft; ideal: factor on the displacement; intake: share of the
    displaced volume that is filled with oil; delivery_reading: factor on the reading of the delivery's meter;
    groove_advance in rad and groove_area, factor: earlier and wider opening of the relief grooves ahead of both
    kidneys; suction_area: factor on the kidney of the suction side; suction_loss: Pa that the inlet loses ahead of
    the suction port; free_air, of the oil's volume at one atmosphere: bubbles in the chambers, whose volume goes
    with the absolute pressure to the power -air_exponent; carried_off: W, power of the flows and the torque, a sink
    of the power balance. Effects[float]: one point, its arrays (3, M) and (5, M).
    """

    conductance: Array
    viscous: Array
    coulomb: Array
    gap_flow: Array
    extra_coulomb: Array
    cross_flow: Value
    drain_flow: Value
    drain_from_inlet: Value
    torque: Value
    ideal: Value
    intake: Value
    delivery_reading: Value
    groove_advance: Value
    groove_area: Value
    suction_area: Value
    suction_loss: Value
    free_air: Value
    air_exponent: Value
    carried_off: Value

    def at(self, point: int) -> Effects[float]:
        """The effects at one of N points."""
        every: dict[str, Any] = vars(self)
        own: dict[str, Any] = {
            name: one[:, point] if one.ndim > 1 else float(one[point]) for name, one in every.items()
        }
        return Effects(**own)


FACTORS = (
    "conductance", "viscous", "coulomb", "ideal", "intake", "delivery_reading", "groove_area", "suction_area",
)  # fmt: skip
"""Fields of `Effects` that multiply; the others add."""


def neutral(points: int, angles: int) -> Effects:
    """Neutral effects: no change."""
    of_gaps = dict.fromkeys(("conductance", "viscous", "coulomb", "gap_flow"), (3, points, angles))
    shapes = {**of_gaps, "extra_coulomb": (5, points, angles)}
    return Effects(
        **{
            field.name: np.full(shapes.get(field.name, (points,)), 1.0 if field.name in FACTORS else 0.0)
            for field in fields(Effects)
        }
    )


def both(one: Effects, other: Effects) -> Effects:
    """Two laws at once, each independent of the other: factors multiply, all else adds; bubbles of both have the mean
    exponent of their volumes.
    """
    pairs = {field.name: (getattr(one, field.name), getattr(other, field.name)) for field in fields(Effects)}
    found = Effects(**{name: a * b if name in FACTORS else a + b for name, (a, b) in pairs.items()})
    share = np.divide(other.free_air, found.free_air, out=np.zeros_like(found.free_air), where=found.free_air > 0.0)
    return replace(found, air_exponent=one.air_exponent + share * (other.air_exponent - one.air_exponent))
