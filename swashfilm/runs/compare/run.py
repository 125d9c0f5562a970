"""Comparison of two maps: differences, duty cycle, files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.formats.versions import headed
from swashfilm.output.page import keep_pictures
from swashfilm.output.run_folder import write_json
from swashfilm.output.tables import write_csv
from swashfilm.runs.compare.page import write_compare_page
from swashfilm.runs.compare.plots import compare_pictures
from swashfilm.runs.map.duty.run import cycle_warnings, duty_summary, known_error
from swashfilm.runs.map.files import MAP, read_map
from swashfilm.runs.map.run import MapCase, solve_map, worth_starting
from system.inputs.shown import shown_in
from system.maps.compare import Difference, Extreme, MapComparison, compare
from system.maps.data import MapData
from system.maps.duty import Cycle, duty
from system.maps.interpolation import MapError, MapInterpolant
from system.maps.plan import MapAxis, MapInput
from system.maps.rating import rating_warnings
from system.work.processes import process_pool
from system.work.progress import Report


@dataclass(frozen=True)
class Side:
    """One of two maps: its path or pump on the command line, its numbers, and its error between levels."""

    given: str
    data: MapData
    error: MapError | None

    @property
    def name(self) -> str:
        """Name of the pump."""
        return self.data.name

    @property
    def axes(self) -> tuple[MapAxis, ...]:
        """Axes of the map."""
        return self.data.axes

    @property
    def points(self) -> int:
        """Number of points to solve: none."""
        return 0

    def solved(self, _folder: Path, _workers: int, _report: Report) -> Side:
        """Return the map itself."""
        return self


@dataclass(frozen=True)
class SideToSolve:
    """A map to solve: its pump on the command line, and the case of `swashfilm map`."""

    given: str
    case: MapCase

    @property
    def name(self) -> str:
        """Name of the pump."""
        return self.case.plan.pump.name

    @property
    def axes(self) -> tuple[MapAxis, ...]:
        """Axes of the map."""
        return self.case.plan.axes

    @property
    def points(self) -> int:
        """Number of points to solve."""
        return len(self.case.plan.points)

    def solved(self, folder: Path, workers: int, report: Report) -> Side:
        """Solve the map in a new folder and return it."""
        folder.mkdir()
        with process_pool(worth_starting(self.case, workers)) as executor:
            solve_map(self.case, folder, executor, report)
        return Side(self.given, *read_map(folder / MAP))


Sides = tuple[Side, Side]


def side_names(both: Sides) -> tuple[str, str]:
    """Return the names of both sides: of the pumps; where these are equal, with their solver or path."""
    for names in (
        tuple(side.data.name for side in both),
        tuple(f"{side.data.name}, {side.data.words}" for side in both),
        tuple(f"{side.data.name} ({Path(side.given).name})" for side in both),
        tuple(f"{side.data.name} ({side.given})" for side in both),
    ):
        if names[0] != names[1]:
            break
    return names[0], names[1]


def run_compare(both: Sides, cycle: Cycle | None, folder: Path) -> dict[str, Any]:
    """Write differences.csv, summary.json, plots and report.html of a comparison; return the summary.

    Raises InputFaults as `compare`, and for a cycle beyond the maps.
    """
    one, other = both
    found = compare(one.data, other.data, (one.error, other.error))
    names = side_names(both)
    pictures = compare_pictures(found, names)
    summary = {
        **headed("comparison"),
        "names": list(names),
        "given": [side.given for side in both],
        "pumps": [side.data.name for side in both],
        "solvers": [side.data.words for side in both],
        "warnings": [*fidelity_warnings(both), *error_warnings(found, both), *_rating_warnings(found, names, cycle)],
        "box": [
            {"words": axis.input.words, "from": axis.input.text(axis.values[0]), "to": axis.input.text(axis.values[-1])}
            for axis in found.one.axes
        ],
        "same_levels": _same_levels(found, both),
        "differences": [_row(one) for one in found.differences],
        "displacement_m3_per_rev": [_displacement(data) for data in (found.one, found.other)],
        "specific": [_row(one) for one in found.specific],
        "duty": [] if cycle is None else [_duty(side, cycle) for side in both],
        "pictures": list(pictures),
    }
    write_json(folder / "summary.json", summary)
    _write_table(folder / "differences.csv", found.differences)
    for name, own in pictures.items():
        keep_pictures(folder, name, own)
    write_compare_page(folder)
    return summary


def fidelity_warnings(both: Sides) -> Iterator[str]:
    """Yield a warning of two maps of different fidelities."""
    one, other = (side.data.words for side in both)
    if one != other:
        yield (
            f"fidelities_differ: A is {one}, B is {other} (limit: one fidelity for both): differences contain those "
            "between the fidelities, not only the pumps; solve both maps by one fidelity"
        )


def error_warnings(found: MapComparison, both: Sides) -> Iterator[str]:
    """Yield a warning of maps whose unknown error between levels has no part in the errors told."""
    unknown = [letter for letter, side in zip("AB", both, strict=True) if side.error is None]
    if unknown and not _same_levels(found, both):
        yield (
            f"error_unknown: the error of {' and '.join(unknown)} between levels is not known and counts as zero: "
            "differences told as more than the error may be those of interpolation; solve both maps at the same "
            "levels, or with --check 8"
        )


def _same_levels(found: MapComparison, both: Sides) -> bool:
    """Return True for maps that are compared at their own points."""
    return found.one.axes == both[0].data.axes == both[1].data.axes


def _rating_warnings(found: MapComparison, names: tuple[str, str], cycle: Cycle | None) -> Iterator[str]:
    """Yield the warnings of points, and of rows of the cycle, beyond the rating of either pump."""
    for letter, name, data in zip("AB", names, (found.one, found.other), strict=True):
        said = f"{letter}, {name}, "
        yield from rating_warnings(data, data.grid, "points", said)
        yield from cycle_warnings(data, cycle, said) if cycle is not None else ()


def _displacement(data: MapData) -> float:
    """Return the largest geometric displacement of a map, m3/rev."""
    return float(np.nanmax(data.values["geometric_displacement"]))


def _row(one: Difference) -> dict[str, Any]:
    found: Mapping[str, Any] = asdict(one)
    extremes = {name: _extreme(getattr(one, name)) for name in ("rise", "fall", "largest")}
    return {**found, **extremes, "told": one.significant}


def _extreme(one: Extreme) -> dict[str, Any]:
    at = {given.value: value for given, value in one.at.items()}
    return {"value": one.value, "at": at, "error": one.error, "told": one.significant}


def _duty(side: Side, cycle: Cycle) -> dict[str, Any]:
    known = known_error(side.data, side.error)
    return duty_summary(side.data, duty(MapInterpolant(side.data), cycle, known))


def _write_table(path: Path, differences: tuple[Difference, ...]) -> None:
    places = [f"at {given.words} [{given.shown.unit}]" for given in MapInput]
    heads = "number", "unit", "A mean", "B mean", "largest B - A", "error of both"
    rows = []
    for row in differences:
        at, shown = row.largest.at, shown_in(row.unit)
        means = shown.of(row.one), shown.of(row.other)
        changes = shown.difference(row.largest.value), shown.difference(row.largest.error)
        numbers = [*means, *changes, *(given.shown.of(at[given]) for given in MapInput)]
        rows.append([row.words, shown.unit, *(f"{number:.8g}" for number in numbers)])
    write_csv(path, [*heads, *places], rows)
