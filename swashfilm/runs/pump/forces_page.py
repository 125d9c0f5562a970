"""The section of a run's page on the forces between the parts, from its forces.csv and summary.json alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.output.page import inlined
from swashfilm.runs.pump.forces_data import TABLE, read_forces

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Rows = Sequence[tuple[str, ...]]


@dataclass(frozen=True)
class ForcesView:
    """What the page shows: rows of sizes, of laws and of closing errors; the picture, base64."""

    sizes: Rows
    laws: Rows
    closure: Rows
    picture: str


def forces_view(folder: Path, summary: Mapping[str, Any]) -> ForcesView | None:
    """The forces of a run folder; None of one that an earlier version wrote without them."""
    if "forces" not in summary or not (folder / TABLE).is_file():
        return None
    found = summary["forces"]
    sizes, laws = (
        [
            (name.replace("_", " "), *(_shown(*value) for value in numbers.items()))
            for name, numbers in part.items()
        ]
        for part in (found["sizes"], found["nominal_law"])
    )
    shares = {
        "force_error": "force, of the largest on a slipper",
        "moment_error": "moment, of that at the pitch radius",
        "power_error": "power, of the shaft's",
        "torque_error": "drive torque against the torque of the energy balance",
    }
    closing = [(shares[key], f"{value:.2g}") for key, value in found["closure"].items()]
    picture = inlined(forces_plot(read_forces(folder)))
    return ForcesView(sizes, laws, closing, picture)


def _shown(key: str, value: float) -> str:
    unit = key.rpartition("_")[2]
    return f"{value:.5g} {'N m' if unit == 'Nm' else unit}"


def forces_plot(data: Mapping[str, Array]) -> Figure:
    """Forces of one piston and slipper, of splines and bearings (kN), and moments (N m) over the shaft angle."""
    figure = figure_of(10.0, 3.6)
    left, middle, right = figure.subplots(1, 3)
    angle = data["shaft_angle"]
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
    left.set(ylabel="force / kN", title="one piston and slipper")
    middle.set(ylabel="force across the shaft / kN", title="shaft", ylim=(0.0, None))
    right.set(ylabel="moment / N m", title="swash plate and shaft")
    for axes in (left, middle, right):
        axes.set(xlabel="shaft angle / deg", xlim=(0, 360))
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2, fontsize="small", frameon=False)
    return figure


def _size(data: Mapping[str, Array], name: str, axes: str = "xyz") -> Array:
    return np.asarray(np.linalg.norm([data[f"{name}_{axis}"] for axis in axes], axis=0))
