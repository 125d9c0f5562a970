"""Data of a transient: labelled arrays (results.nc), table (course.csv) and summary."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from swashfilm.formats.versions import headed
from swashfilm.output.data.files import columns_of, write_columns
from swashfilm.runs.pump.summary import effect_lists
from swashfilm.runs.transient.stops import contact_summary, stop_contacts
from system.effects.switched import switched_on
from system.inputs.units import Dimension, format_quantity
from system.multibody.transient import kernels as kernel
from system.multibody.transient.pistons import stroke_ratio
from system.multibody.transient.solver import Transient, flows
from system.pump.chamber.layout import CAVITY_PRESSURE

if TYPE_CHECKING:
    import xarray

COURSE = "course.csv"
MOMENTS = {
    "pressure_moment": kernel.MOMENT_PRESSURE,
    "inertia_moment": kernel.MOMENT_INERTIA,
    "piston_friction_moment": kernel.MOMENT_FRICTION,
    "actuator_moment": kernel.MOMENT_ACTUATOR,
    "spring_moment": kernel.MOMENT_SPRING,
    "drag_moment": kernel.MOMENT_DRAG,
    "stop_moment": kernel.MOMENT_STOP,
}
"""Moments on the swash plate by cause, positive where they increase the swash angle."""


def transient_dataset(found: Transient, name: str) -> xarray.Dataset:
    """Return series over `time` (s), units in the attributes; chamber pressures also over `chamber`.

    Flows are means over the step that ends at the time, at the pressure of their port, the drain at case pressure, with
    the flows of [physics] past the chambers, and as read by their meters.
    """
    import xarray

    rows = found.rows
    delivery, inlet, drain = flows(found)
    columns = {
        "shaft_angle": (found.shaft_angle, "rad"),
        "swash_angle": (rows[:, kernel.ANGLE], "rad"),
        "swash_rate": (rows[:, kernel.RATE], "rad/s"),
        "displacement_ratio": (stroke_ratio(found.case.pump, found.swash_angle), "1"),
        "control_pressure": (rows[:, kernel.CONTROL], "Pa"),
        "actuator_pressure": (rows[:, kernel.ACTUATOR], "Pa"),
        **{name: (rows[:, column], "N m") for name, column in MOMENTS.items()},
        "delivery_flow": (delivery, "m3/s"),
        "inlet_flow": (inlet, "m3/s"),
        "drain_flow": (drain, "m3/s"),
        "shaft_torque": (found.torque, "N m"),
    }
    chambers = np.arange(1, found.pressure.shape[1] + 1)
    return xarray.Dataset(
        {
            **{key: ("time", values, {"units": unit}) for key, (values, unit) in columns.items()},
            "chamber_pressure": (("time", "chamber"), found.pressure, {"units": "Pa"}),
        },
        coords={"time": ("time", found.time, {"units": "s"}), "chamber": chambers},
        attrs={"name": name, "kind": "transient", "pressures": "gauge"},
    )


def write_course(folder: Path, data: xarray.Dataset) -> None:
    """Write course.csv, units in the head."""
    write_columns(folder / COURSE, columns_of(data, "time"))


def transient_summary(found: Transient, name: str, data: xarray.Dataset) -> dict[str, Any]:
    """Return the summary: swash angle at start and end, its speed, pressures of chambers, contacts with stops."""
    angle, ratio = found.swash_angle, data["displacement_ratio"].values
    turn = 2.0 * np.pi / found.case.point.shaft_speed
    return {
        **headed("transient"),
        "name": name,
        "pump": found.case.pump.name,
        "swash_angle": {
            "start_rad": float(angle[0]),
            "end_rad": float(angle[-1]),
            "least_rad": float(angle.min()),
            "largest_rad": float(angle.max()),
            "fastest_rad_per_s": float(np.abs(data["swash_rate"]).max()),
        },
        "displacement_ratio_start": float(ratio[0]),
        "displacement_ratio_end": float(ratio[-1]),
        "travel_10_to_90_s": _travel(found.time, angle),
        "first_turn": _turn(data, found.time < turn),
        "last_turn": _turn(data, found.time > found.time[-1] - turn),
        "chamber_pressure_largest_Pa": float(found.pressure.max()),
        "actuator_pressure_largest_Pa": float(data["actuator_pressure"].max()),
        "stops": [contact_summary(one) for one in stop_contacts(found)],
        "plate_frequency_Hz": found.swing / (2.0 * np.pi),
        "step_s": found.step,
        "steps": int(found.time.size - 1),
        "physics": effect_lists((), tuple(dict.fromkeys(one.id for one, _ in switched_on(found.case.pump)))),
        "checks": asdict(found.checks),
        "assumptions": [str(one) for one in found.mechanism.taken],
        "warnings": _warnings(found),
    }


def _travel(time: Array, angle: Array) -> float | None:
    """Return the time from 10 to 90 % of the way between start and end angle, s; None where they are equal."""
    way = angle[-1] - angle[0]
    if abs(way) < 1e-9:
        return None
    share = (angle - angle[0]) / way
    begins, ends = (float(time[np.argmax(share >= part)]) for part in (0.1, 0.9))
    return ends - begins


def _turn(data: xarray.Dataset, within: NDArray[np.bool_]) -> Mapping[str, float]:
    """Return means over the instants of a turn; flows of the first instant belong to the previous turn."""
    part = data.isel(time=np.flatnonzero(within)[1:])
    return {
        "delivery_flow_m3_per_s": float(part["delivery_flow"].mean()),
        "shaft_torque_Nm": float(part["shaft_torque"].mean()),
        "pressure_moment_Nm": float(part["pressure_moment"].mean()),
    }


def _oversized(found: Transient) -> Iterator[str]:
    """Yield a warning of an actuator that is wider than the circle of the pistons."""
    bore = 2.0 * math.sqrt(found.mechanism.actuator.area / math.pi)
    limit = 2.0 * found.case.pump.pump.pitch_radius
    if bore > limit:
        wide, circle = (format_quantity(length, Dimension.LENGTH, digits=3) for length in (bore, limit))
        yield (
            f"actuator_oversized: the actuator's piston has a diameter of {wide} (limit {circle}, the pistons' pitch "
            "circle): no pump holds it; state actuator.area, or a weaker actuator.spring_preload"
        )


def _warnings(found: Transient) -> list[str]:
    warnings = [*_oversized(found)]
    low = found.pressure.min(axis=1) <= CAVITY_PRESSURE
    if low.any():
        first = float(found.time[np.argmax(low)])
        warnings.append(
            f"chamber_cavitates: a cavity opens in a chamber at {np.count_nonzero(low)} of {low.size} instants, "
            f"first at {first * 1e3:.4g} ms; raise the inlet pressure, or open the ports earlier"
        )
    if found.rows[:, kernel.ACTUATOR].min() <= CAVITY_PRESSURE:
        warnings.append(
            "actuator_cavitates: the swash plate moves the actuator's piston faster than its orifice fills it; "
            "choose a larger orifice, or a higher control pressure"
        )
    return warnings
