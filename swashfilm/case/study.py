"""Study table of a film case: varied keys, their values, and the resulting cases."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum
from itertools import product
from pathlib import Path
from shlex import quote
from typing import Any, Generic, TypeVar

import numpy as np

from swashfilm.case.axis import StudyAxis, dimension_of, listed_axis, place_words, stepped
from swashfilm.case.file import Case, read_case
from swashfilm.case.gap.switches import switches_of
from swashfilm.case.settings import STEP, put, read_set, with_comments
from system.inputs.faults import Fault, InputFaults, UnknownKey, nearest_choice
from system.inputs.toml_table import Table, fault_lines, quoted
from system.inputs.units import Dimension, parse_quantity
from system.pump_file.tables import TABLES

MOST_POINTS = 10_000
Point = tuple[int, ...]
CaseT = TypeVar("CaseT")


class Combine(Enum):
    """Combination of several keys: every value with every value of the others, or all together."""

    ALL = "all"
    TOGETHER = "together"


class RangeSpacing(Enum):
    """Spacing of a range: equal differences or equal ratios."""

    LINEAR = "linear"
    LOG = "log"


@dataclass(frozen=True)
class Study(ABC, Generic[CaseT]):
    """Points over varied keys, each a case: their name, the text of the file, the keys and their combination."""

    name: str
    text: str
    axes: tuple[StudyAxis, ...]
    combine: Combine

    @abstractmethod
    def case(self, point: Point) -> CaseT:
        """Return the case of a point; raise InputFaults with its faults."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of points along each direction of the study: a direction per key, or one for all together."""
        lengths = tuple(len(axis.values) for axis in self.axes)
        return lengths if self.combine is Combine.ALL else lengths[:1]

    @property
    def points(self) -> list[Point]:
        """Index of each point's value of each key; the last key varies fastest."""
        if self.combine is Combine.TOGETHER:
            return [(k,) * len(self.axes) for k in range(self.shape[0])]
        return list(product(*(range(len(axis.values)) for axis in self.axes)))

    def values(self, point: Point) -> dict[str, Any]:
        """Return the varied keys of a point and their values as written in a case."""
        return {axis.key: axis.values[k] for axis, k in zip(self.axes, point, strict=True)}

    def words(self, point: Point) -> str:
        """Return the varied keys of a point and their values in the units in which they are shown."""
        return place_words(self.axes, self.values(point))


@dataclass(frozen=True)
class StudyCase(Study[Case]):
    """A study of films: the path of its file, its tables without [study], and the table of the keys, `where`."""

    path: Path
    tables: Mapping[str, Any]
    where: str = "study"

    def case(self, point: Point) -> Case:
        """Return the case of a point; raise InputFaults with its faults."""
        return self.case_with(self.values(point))

    def case_with(self, values: Mapping[str, Any]) -> Case:
        """Return the case with these values of its keys; raise InputFaults with its faults."""
        tables = copy.deepcopy(dict(self.tables))
        for key, value in values.items():
            put(tables, key, value)
        text = "".join(f"# {self.where}: {key} = {value}\n" for key, value in values.items()) + self.text
        return read_case(self.path, text, tables)


def load_film(
    path: Path, switched: Mapping[str, str] | None = None, values: Mapping[str, object] | None = None
) -> Case | StudyCase:
    """Return the content of a film case file: a film, a pump gap, or a study. Raise InputFaults with every fault.

    `switched`: values of [revolution], by key, that the command line sets; `values`: those of dotted keys.
    """
    text, tables = read_switched(path, switched or {}, values or {})
    if "table" in tables:
        fault = Fault(
            "table", "ranges of a response table", "a film without [table]", f"swashfilm table {quote(str(path))}"
        )
        raise InputFaults(str(path), [fault], fault_lines(text, [fault]))
    return read_study(path, text, tables) if "study" in tables else read_case(path, text, tables)


def read_switched(path: Path, switched: Mapping[str, str], values: Mapping[str, object]) -> tuple[str, dict[str, Any]]:
    """Return text and tables of a case file, values of [revolution] replaced by key with `switched`.

    `values`: of dotted keys. Raises InputFaults as `read_toml`, and for a case without revolution.
    """
    text, tables = read_set(path, values)
    if switched:
        _switch(tables, switched)
        text = with_comments(text, {f"revolution.{key}": value for key, value in switched.items()})
    return text, tables


def _switch(tables: dict[str, Any], switched: Mapping[str, str]) -> None:
    """Set values in [revolution]; raise InputFaults for a case without revolution."""
    film = tables.get("film")
    if not isinstance(film, dict) or film.get("revolution") is not True:
        case = "a case with revolution = true in [film]"
        faults = [Fault(switch, "a switch of floating gaps", case) for switch in switches_of(switched)]
        raise InputFaults("command line", faults)
    for key, value in switched.items():
        put(tables, f"revolution.{key}", value)


def read_study(path: Path, text: str, tables: Mapping[str, Any]) -> StudyCase:
    """Return the study of a file with a table [study].

    Raises InputFaults for faults of the table, for an unknown key, and where no point is a valid case; a single
    point with a fault is not a fault of the study.
    """
    table = Table("study", tables["study"] if isinstance(tables["study"], dict) else {}, [])
    if not isinstance(tables["study"], dict):
        table.faults.append(Fault("study", repr(tables["study"]), "a table [study]"))
    combine = table.choice("combine", Combine, Combine.ALL)
    axes = [_axis(table, key) for key in table.values if key != "combine"]
    if not axes and not table.faults:
        table.faults.append(Fault("study", "no varied key", '"film.KEY" = [...] or { from, to, points }'))
    base = {key: value for key, value in tables.items() if key != "study"}
    found = [axis for axis in axes if axis]
    study = StudyCase(path.stem, text, tuple(found), combine or Combine.ALL, path, base)
    if not table.faults:
        _check_size(table, study)
    hold_to_case(study, table.faults)
    return study


def hold_to_case(study: StudyCase, faults: list[Fault]) -> None:
    """Raise InputFaults with `faults`; without any, for unknown keys, or where no point is valid."""
    found = [*faults, *_unknown_constants(study), *_beyond_lists(study)] or _case_faults(study)
    if found:
        raise InputFaults(str(study.path), found, fault_lines(study.text, found))


def _axis(table: Table, key: str) -> StudyAxis | None:
    raw = table.get(key)
    if not is_key_of_case(table, key):
        return None
    if isinstance(raw, list) and raw:
        return listed_axis(key, raw)
    if isinstance(raw, dict):
        return _ranged(Table(_named(table.path, key), raw, table.faults), key)
    expected = "a list of values, or a range { from, to, points }"
    table.faults.append(Fault(_named(table.path, key), repr(raw), expected))
    return None


def is_key_of_case(table: Table, key: str) -> bool:
    """Return whether a key of [study] or [table] is a dotted key of the case; its fault is listed."""
    if "." in key and all(STEP.fullmatch(step) for step in key.split(".")):
        return True
    expected = 'a key of the case in quotes, such as "film.thickness"'
    table.faults.append(Fault(_named(table.path, key), f"'{key}'", expected))
    return False


@dataclass(frozen=True)
class Ends:
    """A range of one key, SI: its ends, the dimension of both (None: bare numbers), and its spacing."""

    low: float
    high: float
    dimension: Dimension | None
    spacing: RangeSpacing


def read_ends(table: Table) -> Ends | None:
    """Return the range of `from`, `to` and `spacing` in a table; None with the faults listed."""
    ends, spacing = (
        [table.get(end) for end in ("from", "to")],
        table.choice("spacing", RangeSpacing, RangeSpacing.LINEAR),
    )
    plain = all(isinstance(end, (int, float)) and not isinstance(end, bool) for end in ends)
    dimension = None if plain else dimension_of(ends)
    if not plain and dimension is None:
        found = f"from {ends[0]!r} to {ends[1]!r}"
        table.faults.append(Fault(table.path, found, "two quantities of one kind, or two bare numbers"))
        return None
    low, high = (float(end) if dimension is None else parse_quantity(end, dimension) for end in ends)
    if spacing is RangeSpacing.LOG and min(low, high) <= 0.0:
        table.fault("spacing", "'log' over a range that is not above zero", "'linear', or two ends above zero")
        return None
    return Ends(low, high, dimension, spacing) if spacing else None


def _ranged(table: Table, key: str) -> StudyAxis | None:
    points, ends = table.get("points"), read_ends(table)
    table.close()
    if type(points) is not int or not 2 <= points <= MOST_POINTS:
        table.fault("points", "missing" if points is None else repr(points), f"a whole number, 2 to {MOST_POINTS}")
        return None
    if ends is None:
        return None
    steps = (np.geomspace if ends.spacing is RangeSpacing.LOG else np.linspace)(ends.low, ends.high, points)
    return stepped(key, [float(f"{step:.12g}") for step in steps], ends.dimension)


def _unknown_constants(study: StudyCase) -> list[Fault]:
    """Return faults of varied constants that the case does not have: they have no effect."""
    constants = study.tables.get("constants")
    known = [f"constants.{name}" for name in constants] if isinstance(constants, dict) else []
    expected = f"one of {', '.join(known)}" if known else "a table [constants] with it"
    return [
        Fault(_named(study.where, axis.key), "no such constant", expected, nearest_choice(axis.key, known))
        for axis in study.axes
        if axis.key.startswith("constants.") and axis.key not in known
    ]


def _beyond_lists(study: StudyCase) -> list[Fault]:
    """Return faults of varied entries beyond a list of the case, such as `film.velocity[7]`."""
    faults = []
    for axis in study.axes:
        at: Any = study.tables
        path, _, index = axis.key.rstrip("]").partition("[")
        for step in path.split("."):
            at = at.get(step) if isinstance(at, dict) else None
        if index.isdecimal() and isinstance(at, list) and int(index) >= len(at):
            expected = f"an entry from 0 to {len(at) - 1}"
            faults.append(Fault(_named(study.where, axis.key), f"entry {index} of {path}", expected))
    return faults


def _check_size(table: Table, study: StudyCase) -> None:
    lengths = {axis.key: len(axis.values) for axis in study.axes}
    if study.combine is Combine.TOGETHER and len(set(lengths.values())) > 1:
        found = ", ".join(f"{count} of {key}" for key, count in lengths.items())
        table.faults.append(Fault("study.combine", f"'together' with {found}", "as many values of each key"))
    elif (count := int(np.prod(study.shape))) > MOST_POINTS:
        table.faults.append(Fault("study", f"{count} points", f"at most {MOST_POINTS}"))


def _case_faults(study: StudyCase) -> list[Fault]:
    """Return faults of the first point, where a varied key is unknown or where no point is valid."""
    first: list[Fault] = []
    for point in study.points:
        try:
            study.case(point)
        except InputFaults as reason:
            found = [_at_study(fault, study) for fault in reason.faults]
            first = first or found
            if any(isinstance(fault, UnknownKey) and fault.path.startswith(f"{study.where}.") for fault in found):
                return found
            continue
        return []
    return first


def _at_study(fault: Fault, study: StudyCase) -> Fault:
    """Return a fault of a varied key at the study's key."""
    for axis in study.axes:
        if axis.key == fault.path:
            near = fault.nearest
            if isinstance(fault, UnknownKey) and near:
                near = f'"{axis.key.rpartition(".")[0]}.{near}"'
            return replace(fault, path=_named(study.where, axis.key), nearest=near)
        head, _, rest = axis.key.partition(".")
        if fault.path == head and head not in study.tables:
            film = study.tables.get("film")
            of_pump = head in TABLES and isinstance(film, dict) and "gap" in film
            near = f"pump.{head}" if of_pump else nearest_choice(head, list(study.tables))
            nearest = f'"{near}.{rest}"' if near else ""
            return UnknownKey(_named(study.where, axis.key), "unknown key", fault.expected, nearest)
    return fault


def _named(where: str, key: str) -> str:
    return f"{where}.{quoted(key)}"
