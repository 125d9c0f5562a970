"""Case of a gap with a table [table]: ranges of its keys for the response table."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gaps.response import Axis, Spacing
from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import content_key
from swashfilm.case.axis import stepped
from swashfilm.case.file import Case, FilmCase
from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.case.study import (
    Combine,
    Ends,
    RangeSpacing,
    StudyCase,
    hold_to_case,
    is_key_of_case,
    read_ends,
    read_switched,
)
from swashfilm.output.headline import headline_numbers
from swashfilm.runs.film.series.films import digest, solved_summary
from system.inputs.faults import Fault, InputFaults
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity
from system.work.sampled_points import usual_counts

TABLE = "table"
FORMAT = 1
"""Number of the format, raised when the same case yields other numbers in a table."""
MOST_INPUTS = 8
OF_A_TURN = (
    "leakage_flow_m3_per_s", "friction_power_W", "rubbing_power_W", "film_thickness_mean_m",
    "film_thickness_min_m", "least_gap_m", "tilt_max_rad", "contact_load_mean_N", "pressure_max_Pa",
)  # fmt: skip
OF_AN_INSTANT = (
    "leakage_flow_m3_per_s", "friction_power_W", "film_thickness_mean_m", "film_thickness_min_m", "carried_load_N",
    "contact_load_N", "pressure_max_Pa",
)  # fmt: skip
"""Keys of a gap's summary in its table: over the turn (means, largest, least), or at an instant."""


@dataclass(frozen=True)
class GapTableCase:
    """Response table to build: a gap's case, ranges of its keys, numbers of fitted and held-out points.

    study: the case at the corners of the box; dimensions: of each axis, None for bare numbers; outputs: keys of
    the gap's summary. A `SamplingTask`.
    """

    study: StudyCase
    axes: tuple[Axis, ...]
    dimensions: tuple[Dimension | None, ...]
    outputs: tuple[str, ...]
    learnt: int
    held_out: int

    @property
    def name(self) -> str:
        """Name of the case."""
        return self.study.name

    def values(self, x: Array) -> dict[str, Any]:
        """Return the keys at a point (d,), SI, and their values as written in a case."""
        return {
            axis.name: float(value) if dimension is None else format_quantity(float(value), dimension)
            for axis, dimension, value in zip(self.axes, self.dimensions, x, strict=True)
        }

    def case(self, x: Array) -> Case:
        """Return the gap's case at a point (d,); raise InputFaults with its faults."""
        return self.study.case_with(self.values(x))

    def key(self, x: Array) -> str:
        """Return the name of a point's content: its case and the format; for an invalid case its faults."""
        try:
            return content_key("gap of a response table", FORMAT, self.outputs, digest(self.case(x)))
        except InputFaults as reason:
            return content_key("no case", str(reason))

    def solve(self, x: Array) -> Array:
        """Return the `outputs` of the gap at a point, SI."""
        numbers = headline_numbers(solved_summary(self.case(x)))
        return np.array([numbers[key] for key in self.outputs])


def load_gap_table(
    path: Path, switched: Mapping[str, str] | None = None, values: Mapping[str, object] | None = None
) -> GapTableCase:
    """Return the response table of a file with a table [table], by default with the points of `usual_counts`.

    `switched`: values of [revolution], by key, that replace those of the file; `values`: those of dotted keys.
    Raises InputFaults with every fault: ranges, unknown keys, a film that is not a gap of a pump, or no corner of
    the box with a valid case.
    """
    text, tables = read_switched(path, switched or {}, values or {})
    given = tables.get(TABLE)
    ranges = Table(TABLE, given if isinstance(given, dict) else {}, [])
    if not ranges.values:
        ranges.faults.append(Fault(TABLE, repr(given) if given else "missing", _EXAMPLE))
    if "study" in tables:
        ranges.faults.append(Fault("study", "a study beside [table]", "one of the two"))
    ends = {key: found for key in ranges.values if (found := _ends(ranges, key))}
    if len(ends) > MOST_INPUTS:
        ranges.faults.append(Fault(TABLE, f"{len(ends)} keys", f"at most {MOST_INPUTS}"))
    base = {key: value for key, value in tables.items() if key not in (TABLE, "study")}
    corners = tuple(stepped(key, (of.low, of.high), of.dimension) for key, of in ends.items())
    study = StudyCase(path.stem, text, corners, Combine.ALL, path, base, TABLE)
    hold_to_case(study, ranges.faults)
    case = _first_case(study)
    if isinstance(case, FilmCase):
        fault = Fault("film", "a free film", "the gap of a pump: gap, pump, and revolution = true or an instant")
        raise InputFaults(str(path), [fault])
    return GapTableCase(
        study,
        tuple(_axis(key, of) for key, of in ends.items()),
        tuple(of.dimension for of in ends.values()),
        OF_A_TURN if isinstance(case, RevolutionCase) else OF_AN_INSTANT,
        *usual_counts(len(ends)),
    )


_EXAMPLE = 'a table [table] of ranges, such as "operating.pressure" = { from = "5 MPa", to = "30 MPa" }'


def _ends(ranges: Table, key: str) -> Ends | None:
    """Return the range of one key; None with its fault listed."""
    raw = ranges.get(key)
    if not is_key_of_case(ranges, key):
        return None
    own = Table(f'{TABLE}."{key}"', raw if isinstance(raw, dict) else {}, ranges.faults)
    if not own.values:
        ranges.faults.append(Fault(own.path, repr(raw), "a range { from, to }, optionally with spacing"))
        return None
    found = read_ends(own)
    own.close()
    if found and not found.low < found.high:
        own.fault("to", f"{own.values['to']!r}, from {own.values['from']!r}", "the lower end first")
        return None
    return found


def _axis(key: str, ends: Ends) -> Axis:
    scale = Spacing.LOGARITHMIC if ends.spacing is RangeSpacing.LOG else Spacing.LINEAR
    return Axis(key, ends.low, ends.high, scale)


def _first_case(study: StudyCase) -> Case:
    """Return the case of the first corner with a valid case."""
    for point in study.points:
        try:
            return study.case(point)
        except InputFaults:
            continue
    raise AssertionError("hold_to_case lets no study pass without a case")
