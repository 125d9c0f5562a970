"""Forces between the parts: table, summary, warnings, view on the page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.data.files import Column, read_columns, write_columns
from swashfilm.output.figures import figure_of, legend_below
from swashfilm.output.page import inlined
from swashfilm.output.touch.picture import Picture
from system.multibody.closure import closure
from system.multibody.kinematics import SHAFT
from system.multibody.retainer import guide_loss
from system.multibody.rotating_group import JointForces
from system.pump.assembly import PumpPoint
from system.pump.laws import friction_pairs as pairs
from system.pump.laws.retainer import BallGuide
from system.pump.lumped import piston_forces, piston_motion

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TABLE = "forces.csv"
Columns = dict[str, tuple[str, Array]]


Rows = Sequence[tuple[str, ...]]


def force_columns(joints: JointForces) -> Columns:
    """Return every joint over the shaft angle, by name: unit and values (N,); forces of a chamber are chamber 1's.

    A name contains the acting part and the part acted on; x, y, z are those of the pump's frame. Moments of the
    valve plate are about the middle of its face, those of the trunnion about the pivot.
    """
    one, held, axes = joints.sets[0], joints.hold, joints.group.plate_axes
    rubbing = axes[:2] @ one.plate
    pivot = joints.group.places.pivot * SHAFT
    trunnion, valve, spline = joints.plate.trunnion, joints.block.valve_plate, joints.block.spline
    about_pivot = trunnion[3:] - np.cross(pivot, trunnion[:3], axis=0)
    guide = np.broadcast_to(joints.guide.force[:, None], one.ball.shape)
    return {
        **_vector("piston_on_slipper", one.ball),
        "plate_on_slipper_normal": ("N", one.lift),
        "plate_on_slipper_steepest": ("N", rubbing[0]),
        "plate_on_slipper_across": ("N", rubbing[1]),
        **_vector("bore_edge_on_piston", one.edge),
        **_vector("bore_inner_on_piston", one.inner),
        "pressure_and_friction_on_piston": ("N", joints.loads[0].known.along_bore),
        "retainer_on_slipper_normal": ("N", held.pressing),
        **_vector("retainer_on_slipper_in_plate", held.pushing),
        **_vector("guide_on_retainer", guide),
        **_vector("shaft_on_guide", joints.guide_spline, "xy"),
        **_vector("shaft_on_block", spline, "xy"),
        "shaft_on_block_torque": ("N m", spline[5]),
        "valve_plate_on_block_z": ("N", valve[2]),
        **_vector("valve_plate_on_block_moment", valve[3:], unit="N m"),
        **_vector("front_bearing_on_shaft", joints.shaft.front),
        **_vector("rear_bearing_on_shaft", joints.shaft.rear, "xy"),
        **_vector("trunnion_on_plate", trunnion),
        **_vector("trunnion_on_plate_moment", about_pivot, unit="N m"),
        "actuator_on_plate_z": ("N", joints.plate.actuator[2]),
        "control_moment_on_plate": ("N m", joints.plate.control),
        "drive_torque_on_shaft": ("N m", joints.shaft.torque),
    }


def _vector(name: str, values: Array, axes: str = "xyz", unit: str = "N") -> Columns:
    return {f"{name}_{axis}": (unit, row) for axis, row in zip(axes, values[: len(axes)], strict=True)}


def write_forces(folder: Path, joints: JointForces) -> None:
    """Write forces.csv, units in the head."""
    columns = {"shaft_angle": ("rad", joints.group.shaft_angle), **force_columns(joints)}
    write_columns(folder / TABLE, [Column(name, values, unit) for name, (unit, values) in columns.items()])


def read_forces(folder: Path) -> dict[str, Array]:
    """Return the columns of a folder's forces.csv by name, SI."""
    return read_columns(folder / TABLE)


def forces_summary(joints: JointForces, found: PumpPoint) -> dict[str, Any]:
    """Return the summary of the joints: closing errors, sizes over the turn, comparison with the law of losses.

    sizes: mean, least and largest of each joint's force or moment. nominal_law: forces by joints, and by the law
    of the losses.
    """
    torque = found.shaft_torque
    return {
        "closure": {f"{name}_error": value for name, value in asdict(closure(joints)).items()}
        | {"torque_error": float(np.max(np.abs(joints.shaft.torque - torque)) / np.mean(np.abs(torque)))},
        "sizes": {name: _spread(unit, values) for name, (unit, values) in _sizes(joints).items()},
        "nominal_law": _laws(joints, found),
    }


def force_warnings(joints: JointForces) -> list[str]:
    """Return warnings of slippers that lift: the swash plate would have to pull them."""
    pulled = [one.lift < 0.0 for one in joints.sets]
    if not any(one.any() for one in pulled):
        return []
    number = int(np.argmax([one.sum() for one in pulled]))
    lift, degrees = joints.sets[number].lift, np.degrees(joints.group.shaft_angle)
    worst = int(np.argmin(lift))
    share = f"{pulled[number].sum()} of {lift.size} shaft angles"
    return [
        f"slipper_lifts: the slipper of chamber {number + 1} lifts at {share}: it needs a pull of up to "
        f"{-lift[worst]:.0f} N at {degrees[worst]:.0f} deg (limit 0), which the retainer supports in addition to "
        "its part of the spring force; raise the inlet pressure, or lower the speed"
    ]


def _spread(unit: str, values: Array) -> dict[str, float]:
    found = {"mean": np.mean(values), "min": np.min(values), "max": np.max(values)}
    return {f"{part}_{unit}": float(value) for part, value in found.items()}


def _sizes(joints: JointForces) -> dict[str, tuple[str, Array]]:
    """Return unit and series over the turn of each joint: magnitude, or signed value along a fixed direction."""
    one = joints.sets[0]
    forces = {
        "piston_on_slipper": one.ball,
        "bore_edge_on_piston": one.edge,
        "bore_inner_on_piston": one.inner,
        "retainer_on_slipper_in_plate": joints.hold.pushing,
        "guide_on_retainer": np.broadcast_to(joints.guide.force[:, None], one.ball.shape),
        "shaft_on_guide": joints.guide_spline[:3],
        "shaft_on_block": joints.block.spline[:3],
        "valve_plate_on_block": joints.block.valve_plate[:3],
        "front_bearing_on_shaft": joints.shaft.front[:3],
        "rear_bearing_on_shaft": joints.shaft.rear[:3],
        "trunnion_on_plate": joints.plate.trunnion[:3],
    }
    return {
        **{name: ("N", np.linalg.norm(force, axis=0)) for name, force in forces.items()},
        "plate_on_slipper_normal": ("N", one.lift),
        "retainer_on_slipper_normal": ("N", joints.hold.pressing),
        "valve_plate_on_block_tipping": ("Nm", np.hypot(*joints.block.valve_plate[3:5])),
        "actuator_on_plate": ("N", joints.plate.actuator[2]),
        "control_moment_on_plate": ("Nm", joints.plate.control),
        "drive_torque_on_shaft": ("Nm", joints.shaft.torque),
    }


def _laws(joints: JointForces, found: PumpPoint) -> dict[str, dict[str, float]]:
    """Return mean forces over the turn by joints and by the simpler law of REF90's nominal losses."""
    pump, point = joints.group.pump, found.point
    motion, guide = piston_motion(pump, point), pump.ball_guide
    _, side = piston_forces(pump, point, motion, found.cycle)
    lever = (motion.engaged_length + 2.0 * motion.overhang) / motion.engaged_length
    sides, one = float(np.mean(pairs.over_chambers([side], found.pistons))), joints.sets[0]
    ends = np.linalg.norm(one.edge, axis=0) + np.linalg.norm(one.inner, axis=0)
    circle = BallGuide(guide.radius, guide.contact_latitude)
    friction, speed = pump.friction.ball_guide_retainer, point.shaft_speed
    rubbing = guide_loss(friction, joints.group.spring, circle, joints.group.plate_axes, speed)
    radial = [float(np.mean(np.hypot(force[0], force[1]))) for force in (joints.shaft.front, joints.shaft.rear)]
    bore = float(np.mean(ends)), float(np.mean(side * lever))
    return {
        "bore_reactions_of_a_piston": {"joints_N": bore[0], "law_N": bore[1]},
        "front_bearing": {"joints_N": radial[0], "law_N": pump.bearings.front_share * sides},
        "rear_bearing": {"joints_N": radial[1], "law_N": pump.bearings.rear_share * sides},
        "ball_guide_retainer_loss": {"joints_W": rubbing, "law_W": rubbing * float(joints.group.plate_axes[2, 2])},
    }


@dataclass(frozen=True)
class ForcesView:
    """Forces on the page: rows of sizes, of laws and of closing errors; the picture."""

    sizes: Rows
    laws: Rows
    closure: Rows
    picture: Picture


def forces_view(folder: Path, summary: Mapping[str, Any]) -> ForcesView | None:
    """Return the forces of a run folder; None where an earlier version wrote it without them."""
    if "forces" not in summary or not (folder / TABLE).is_file():
        return None
    found = summary["forces"]
    sizes, laws = (
        [(name.replace("_", " "), *(_shown(*value) for value in numbers.items())) for name, numbers in part.items()]
        for part in (found["sizes"], found["nominal_law"])
    )
    shares = {
        "force_error": "force, relative to the largest slipper force",
        "moment_error": "moment, relative to that force at the pitch radius",
        "power_error": "power, relative to the shaft power",
        "torque_error": "drive torque, difference from the shaft's, relative to its mean",
    }
    closing = [(shares[key], f"{value:.2g}") for key, value in found["closure"].items()]
    picture = inlined(forces_plot(read_forces(folder)))
    return ForcesView(sizes, laws, closing, picture)


def _shown(key: str, value: float) -> str:
    unit = key.rpartition("_")[2]
    return f"{value:.5g} {'N m' if unit == 'Nm' else unit}"


def forces_plot(data: Mapping[str, Array]) -> Figure:
    """Draw forces of one piston and slipper, of splines and bearings (kN), moments (N m) over the shaft angle."""
    figure = figure_of(10.0, 3.6)
    left, middle, right = figure.subplots(1, 3)
    angle = np.degrees(data["shaft_angle"])
    chamber = {
        "ball joint": _size(data, "piston_on_slipper"),
        "swash plate, normal": data["plate_on_slipper_normal"],
        "bore, case edge": _size(data, "bore_edge_on_piston"),
        "bore, inner end": _size(data, "bore_inner_on_piston"),
    }
    shaft = {
        "block spline": _size(data, "shaft_on_block", "xy"),
        "front bearing": _size(data, "front_bearing_on_shaft", "xy"),
        "rear bearing": _size(data, "rear_bearing_on_shaft", "xy"),
    }
    for axes, curves in ((left, chamber), (middle, shaft)):
        for name, force in curves.items():
            axes.plot(angle, 1e-3 * force, label=name)
    right.plot(angle, data["control_moment_on_plate"], label="control, on the plate")
    right.plot(angle, data["drive_torque_on_shaft"], label="drive, on the shaft")
    left.set(ylabel="force [kN]", title="one piston and slipper")
    middle.set(ylabel="force across the shaft [kN]", title="shaft", ylim=(0.0, None))
    right.set(ylabel="moment [N m]", title="swash plate and shaft")
    for axes in (left, middle, right):
        axes.set(xlabel="shaft angle [deg]", xlim=(0, 360))
        legend_below(axes)
    return figure


def _size(data: Mapping[str, Array], name: str, axes: str = "xyz") -> Array:
    return np.asarray(np.linalg.norm([data[f"{name}_{axis}"] for axis in axes], axis=0))
