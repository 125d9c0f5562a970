"""Response table of one gap: its numbers over ranges of keys of its case; built, stored and evaluated."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from gaps.response import Axis, Measure, Output, Response
from reynolds.numerics.arrays import Array
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.formats.versions import headed
from swashfilm.output.headline import named
from swashfilm.runs.film.revolution.solve import NO_RUBBING
from swashfilm.runs.table.gap_case import FORMAT, GapTableCase
from swashfilm.runs.table.run import TABLE, table_warnings, write_table_files
from system.films.parts import floating_parts
from system.inputs.units import Dimension, parse_quantity
from system.points.table.response_table import PRESSURE, RATIO, SPEED, axis_value
from system.points.table.store import read_response, response_record, write_response
from system.work.processes import process_pool
from system.work.progress import Report
from system.work.sampled_points import SampledPoint, points_of, samples_of, solved_points

POSITIVE = (
    "leakage_flow_m3_per_s", "friction_power_W", "film_thickness_mean_m", "film_thickness_min_m",
    "pressure_max_Pa",
)  # fmt: skip
"""Outputs fitted as logarithms, with relative error, where they are positive at all points."""
NOTHING = {
    "leakage_flow_m3_per_s": 1e-9, "friction_power_W": 0.1, "rubbing_power_W": 0.1, "least_gap_m": 1e-8,
    "tilt_max_rad": 1e-6, "contact_load_mean_N": 1.0, "contact_load_N": 1.0, "carried_load_N": 1.0,
}  # fmt: skip
"""Reference of the error of other outputs, where their largest magnitude is below it."""
MEANINGS = {
    "leakage_flow_m3_per_s": "flow out of the film into the case",
    "friction_power_W": "power of viscous friction and contact friction",
    "rubbing_power_W": "power of contact friction",
    "film_thickness_mean_m": "film, mean over its area",
    "film_thickness_min_m": "least film anywhere",
    "least_gap_m": "least distance of the mean planes, negative where rough walls overlap",
    "tilt_max_rad": "largest tilt",
    "contact_load_mean_N": "force of the asperities",
    "contact_load_N": "force of the asperities",
    "carried_load_N": "load supported by film, pocket and contact",
    "pressure_max_Pa": "largest film pressure",
}


@dataclass(frozen=True)
class GapTable:
    """A gap's response, the dimensions of its axes (None: bare numbers), and the record of its origin."""

    response: Response
    dimensions: tuple[Dimension | None, ...]
    record: Mapping[str, Any]

    def at(self, values: Mapping[str, Any]) -> dict[str, float]:
        """Return the numbers by key, SI, at these values of the box's keys, written as in a case.

        Raises InputError outside the box, QuantityError for a value of another dimension, KeyError where a key
        of the box is missing.
        """
        x = [
            float(values[axis.name]) if dimension is None else parse_quantity(values[axis.name], dimension)
            for axis, dimension in zip(self.response.axes, self.dimensions, strict=True)
        ]
        found = self.response.at(np.array([x]))[0]
        return {one.name: float(value) for one, value in zip(self.response.outputs, found, strict=True)}


def run_gap_table(asked: GapTableCase, folder: Path, report: Report, *, workers: int = 1) -> dict[str, Any]:
    """Build a gap's table and write table.npz, table.json, points.csv, the case, summary.json and report.html.

    The cache stores the points, like those of a pump's table. Returns the summary. Raises NotConverged where too
    few points have a result.
    """
    with process_pool(workers) as executor:
        found = solved_points(asked, executor=executor, report=report)
    learnt, held_out = samples_of(asked, found)
    outputs = _measured(asked.outputs, np.concatenate([learnt.values, held_out.values]))
    response = Response(asked.axes, outputs, learnt, held_out)
    record = _record(asked, found, response)
    write_response(folder / TABLE, response, record)
    case = _case(asked, found)
    (folder / "input.toml").write_text(asked.study.text, encoding="utf-8")
    (folder / "resolved.toml").write_text(case.resolved, encoding="utf-8")
    summary = record | {
        **headed("gap_table"),
        "name": asked.name,
        "condensed": _condensed(case, asked.axes),
        "outputs": [
            row | {"unit": named(row["name"])[1] or "1", "meaning": MEANINGS[row["name"]]} for row in record["outputs"]
        ],
        "assumptions": [NO_RUBBING, *map(str, floating_parts(case.rotor.pump).taken)],
        "warnings": table_warnings(response, record),
    }
    write_table_files(folder, response, summary)
    return summary


def read_gap_table(path: Path) -> GapTable:
    """Return the table that `swashfilm table CASE` wrote, by its .json or .npz; raise InputFaults for others."""
    return read_response(path, FORMAT, _of_record)


def _of_record(record: Mapping[str, Any], response: Response) -> GapTable:
    names = (axis["dimension"] for axis in record["axes"])
    return GapTable(response, tuple(None if name is None else Dimension[name] for name in names), record)


def _record(asked: GapTableCase, found: Sequence[SampledPoint], response: Response) -> dict[str, Any]:
    """Return the content of table.json."""
    points = points_of(asked)
    of_axes = zip(asked.axes, asked.dimensions, strict=True)
    dimensions = {axis.name: dimension for axis, dimension in of_axes if dimension is not None}
    return {
        "kind": "gap_table_data",
        "table_format": FORMAT,
        "package": version("swashfilm"),
        "case": asked.name,
        "units": "SI; of the outputs as their names end",
        **response_record(response, dimensions),
        "failed": [{"at": points[one.index].tolist(), "reason": one.reason} for one in found if one.outputs is None],
        "seconds": float(np.mean([one.seconds for one in found])),
    }


def _measured(keys: Sequence[str], values: Array) -> tuple[Output, ...]:
    """Return the outputs with their error measure, by their values (n, m) at all points."""
    return tuple(
        Output(key, Measure.RELATIVE)
        if key in POSITIVE and np.all(column > 0.0)
        else Output(key, Measure.OF_LARGEST, NOTHING.get(key, 0.0))
        for key, column in zip(keys, values.T, strict=True)
    )


def _case(asked: GapTableCase, found: Sequence[SampledPoint]) -> GapCase | RevolutionCase:
    """Return the case at the first point with a result, for the data common to all points."""
    first = next(one.index for one in found if one.outputs is not None)
    case = asked.case(points_of(asked)[first])
    assert isinstance(case, GapCase | RevolutionCase)
    return case


def _condensed(case: GapCase | RevolutionCase, axes: Sequence[Axis]) -> dict[str, str]:
    """Return the origin of the table, and the operating point without quantities that an axis varies."""
    varied, point = {axis.name for axis in axes}, case.rotor.point
    if isinstance(case, RevolutionCase):
        physics, when = case.options.physics, "over the revolution"
    else:
        physics, when = case.physics, f"at shaft angle {np.degrees(case.shaft_angle):g} deg"
    left_out = ", ".join(effect.value.replace("_", " ") for effect in physics.left_out)
    held = {
        SPEED: "operating.speed",
        PRESSURE: "operating.pressure",
        RATIO: "operating.displacement_ratio",
        "temperature": "operating.temperature",
        "inlet_pressure": "operating.inlet_pressure",
        "case_pressure": "operating.case_pressure",
    }
    return {
        "condensed from": f"{case.gap.value.replace('_', ' ')} of {case.rotor.pump.name}, {when}",
        "physics left out": left_out or "nothing",
        **{
            name.replace("_", " "): axis_value(name, getattr(point, name))
            for name, key in held.items()
            if key not in varied
        },
    }
