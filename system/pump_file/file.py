"""Pump files: TOML with units to a PumpDescription and back; every fault of a file at once."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reynolds.errors import InputError
from reynolds.numerics.files import read_text
from system.description.assumptions import Assumption
from system.description.keys import with_values
from system.description.pump import FORMAT, SINGLE_PARTS, PumpDescription
from system.inputs.faults import Fault, InputFaults, key_lines, nearest_choice, nearest_path
from system.inputs.sections.reader import ABSOLUTE
from system.inputs.sections.values import HERE
from system.inputs.sections.writer import section_rows
from system.inputs.toml_table import toml_tables
from system.inputs.versions import version_fault
from system.pump_file.check import CheckReport, run_checks
from system.pump_file.parts import single_parts_checked
from system.pump_file.scaled.completed import completed, is_scant
from system.pump_file.tables import BUILT_IN, CHECKS, GRADE_KEYS, TABLES, pump_of_tables

GRADE = "oil.grade"
VISCOSITIES = frozenset(f"oil.{key}" for key in GRADE_KEYS)
Variant = tuple[tuple[str, float], ...]
"""Paths of a pump's dimensions with the values (SI) that stand in place of its own."""


@dataclass(frozen=True)
class KnownPump:
    """A pump with the `stated` paths of its file, and the `assumptions` for the others.

    scant: most of it is scaled; its [tolerance] is then wide where the file does not state it.
    """

    pump: PumpDescription
    scant: bool
    stated: frozenset[str]
    assumptions: tuple[Assumption, ...]


def known_pump(pump: PumpDescription | KnownPump) -> KnownPump:
    """Return the pump itself if it is partly known, else a pump that is stated in full."""
    return pump if isinstance(pump, KnownPump) else KnownPump(pump, False, frozenset(), ())


def builtin_pumps() -> tuple[str, ...]:
    """Return the names of the pumps that come with the program."""
    names = (item.name for item in BUILT_IN.iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))


def load_pump(source: str | Path, overrides: Mapping[str, object] | None = None) -> PumpDescription:
    """Return the description of a built-in pump (by name) or of a pump file (by path), in SI.

    `overrides` puts values in place of the file's, as written there: {"operating.speed": "1500 rpm"}. An oil's grade
    takes the place of its two viscosities, and they that of the grade. A file named in a value is sought beside the
    pump file; with a built-in pump, in the working directory. A scant file is completed;
    `load_known_pump` lists the assumptions. Raises InputFaults with all faults: in the file's form, its units, its
    values and its geometry. Doubtful values raise no exception; `check_pump` reports them.
    """
    return load_known_pump(source, overrides).pump


def load_known_pump(source: str | Path, overrides: Mapping[str, object] | None = None) -> KnownPump:
    """Return a pump as `load_pump` does, with its stated paths and its assumptions.

    A file is scant if it lacks one of the tables [slipper], [valve_plate], [ports]: it states little more than
    displacement, pistons and oil, and the rest is REF90's, scaled. Raises InputFaults as `load_pump`; for a scant file
    also if pump.displacement, pump.pistons or the oil's viscosity is not stated.
    """
    label, text = _read(source)
    tables = toml_tables(label, text)
    lines: dict[str, int | None] = {**key_lines(text)}
    built_in = str(source) in builtin_pumps()
    scant = not built_in and is_scant(tables)
    _replace(tables, overrides or {}, lines)
    if not scant or "format" in tables:
        _check_format(label, tables, lines)
    folder = HERE if built_in else Path(source).parent
    if not scant:
        return known_pump(pump_of_tables(label, tables, folder, lines))
    whole = completed(label, tables, Path(source).stem, lines, folder)
    pump = pump_of_tables(label, whole.tables, folder, lines)
    return KnownPump(pump, True, whole.stated, whole.assumptions)


def check_pump(pump: PumpDescription) -> CheckReport:
    """Return the impossible and the doubtful values of a description and its own operating point."""
    return single_parts_checked(CHECKS, pump, run_checks(CHECKS, pump))


def varied(pump: PumpDescription, variant: Variant) -> PumpDescription:
    """Return the pump with the values of a variant; raise InputFaults where no pump has them.

    The faults are those of the single value and of the geometry: no value is cut to a limit.
    """
    try:
        made = with_values(pump, dict(variant))
        faults = check_pump(made).faults
    except InputError as reason:
        faults = (Fault(reason.where, reason.found, reason.expected),)
    except ValueError as reason:
        faults = (Fault(", ".join(path for path, _ in variant), str(reason), "a value that a pump can have"),)
    if faults:
        raise InputFaults(pump.name, faults)
    return made


def resolved_toml(pump: PumpDescription) -> str:
    """Return a pump file that loads to this very description: every value, with its unit, to the last bit."""
    rows = [f"name = {json.dumps(pump.name, ensure_ascii=False)}", f"format = {pump.format}"]
    for name in TABLES:
        rows += section_rows(name, getattr(pump, name))
    for name in SINGLE_PARTS:
        for chamber, part in getattr(pump, f"single_{name}s"):
            rows += section_rows(f"{name}.{chamber}", part, getattr(pump, name))
    return "\n".join(rows) + "\n"


def _read(source: str | Path) -> tuple[str, str]:
    """Return the name of the source, and its text."""
    name = str(source)
    if name in builtin_pumps():
        return f"built-in pump {name}", BUILT_IN.joinpath(f"{name}.toml").read_text("utf-8")
    path = Path(source)
    try:
        return name, read_text(path)
    except FileNotFoundError:
        raise InputFaults(name, [_not_there(path)]) from None
    except (OSError, UnicodeDecodeError) as reason:
        raise InputFaults(name, [Fault("file", f"cannot be read: {reason}", "a TOML file in UTF-8")]) from None


def _not_there(path: Path) -> Fault:
    """Return the fault of a name that is neither a built-in pump nor a file, with the nearest one."""
    builtin, beside = builtin_pumps(), nearest_path(path)
    nearest = nearest_choice(str(path), builtin) or (beside if Path(beside).suffix in ("", ".toml") else "")
    return Fault(
        "pump",
        f"'{path}', which is no built-in pump and no file",
        f"a built-in pump ({', '.join(builtin)}) or the path of a pump file (.toml)",
        nearest,
    )


def _replace(tables: dict[str, Any], values: Mapping[str, object], lines: dict[str, int | None]) -> None:
    """Put values by their paths in place of the file's, and of what else of it states the same; they have no line."""
    for path in _same(values).difference(values):
        _table_of(tables, path).pop(path.rpartition(".")[2], None)
    for path, value in values.items():
        _table_of(tables, path)[path.rpartition(".")[2]] = value
        lines[path] = None


def _same(values: Mapping[str, object]) -> set[str]:
    """Return the paths of a file that state what these do: a pressure gauge or absolute, a grade or its viscosities."""
    found = {path.removesuffix(ABSOLUTE) if path.endswith(ABSOLUTE) else path + ABSOLUTE for path in values}
    if GRADE in values:
        found |= VISCOSITIES
    if values.keys() >= VISCOSITIES:
        found.add(GRADE)
    return found


def _table_of(tables: dict[str, Any], path: str) -> dict[str, Any]:
    """Return the table that holds a path, new where the file has none."""
    table = tables
    for name in path.split(".")[:-1]:
        if not isinstance(table.get(name), dict):
            table[name] = {}
        table = table[name]
    return table


def _check_format(label: str, tables: Mapping[str, Any], lines: Mapping[str, int | None]) -> None:
    """Raise InputFaults for another format than that of this version."""
    if fault := version_fault("format", tables.get("format"), FORMAT, "pump file"):
        raise InputFaults(label, [fault], lines)
