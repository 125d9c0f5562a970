"""Pump files: TOML with units to a PumpDescription and back; every fault of a file at once."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from reynolds.laws.oil import ISO_GRADES
from system.description.ports import PortsSection
from system.description.pump import FORMAT, SINGLE_PARTS, PumpDescription
from system.inputs.coefficients.flow_files import FlowCoefficients
from system.inputs.faults import Fault, InputFaults, key_lines, nearest_choice, nearest_path, stated
from system.inputs.sections.fields import fields_of
from system.inputs.sections.reader import (
    ABSOLUTE,
    Reading,
    Special,
    is_number,
    left_out_section,
    read_entry,
    read_section,
)
from system.inputs.sections.values import HERE
from system.inputs.sections.writer import section_rows
from system.inputs.toml_table import toml_tables
from system.pump.ports.flow_coefficients import file_law
from system.pump_file import bodies, films, geometry, losses, operating, parts, ports, values
from system.pump_file.check import CheckReport, checks_in, run_checks
from system.pump_file.parts import single_parts_checked

_CHECKS = tuple(
    check
    for module in (geometry, ports, losses, films, operating, parts, bodies, values)
    for check in checks_in(vars(module))
)
GRADE_KEYS = ("kinematic_viscosity_40C", "kinematic_viscosity_100C")
LAW_KEYS = ("flow_coefficient", "critical_reynolds")
_TABLES = {name: model for name, own in fields_of(PumpDescription).items() if (model := own.table)}


def _built_in() -> Traversable:
    return files("system.description") / "pumps"


def builtin_pumps() -> tuple[str, ...]:
    """Return the names of the pumps that come with the program."""
    names = (item.name for item in _built_in().iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))


def load_pump(source: str | Path, overrides: Mapping[str, object] | None = None) -> PumpDescription:
    """Return the description of a built-in pump (by name) or of a pump file (by path), in SI.

    `overrides` puts values in place of the file's, as written there: {"operating.speed": "1500 rpm"}.
    A file that a value names is looked for beside the pump file; with a built-in pump, in the working directory.
    Raises InputFaults with everything that is wrong: in the file's form, its units, its values and its
    geometry. Doubtful values raise nothing; `check_pump` reports them.
    """
    label, text = _read(source)
    tables = _parse(label, text)
    lines: dict[str, int | None] = {**key_lines(text)}
    for path, value in (overrides or {}).items():
        *within, key = path.split(".")
        table = tables
        for name in within:
            if not isinstance(table.get(name), dict):
                table[name] = {}
            table = table[name]
        table.pop(key + ABSOLUTE, None)
        table[key] = value
        lines[path] = None
    folder = HERE if str(source) in builtin_pumps() else Path(source).parent
    return _describe(label, tables, lines, folder)


def pump_of_tables(label: str, tables: Mapping[str, Any], folder: Path = HERE) -> PumpDescription:
    """Return the description of a pump file's tables, as TOML gives them; files are looked for from the folder.

    Raises InputFaults, under the name `label`, with everything that is wrong with them.
    """
    return _describe(label, tables, {}, folder)


def check_pump(pump: PumpDescription) -> CheckReport:
    """Return what is impossible and what is doubtful about a description and its own operating point."""
    return single_parts_checked(_CHECKS, pump, run_checks(_CHECKS, pump))


def resolved_toml(pump: PumpDescription) -> str:
    """Return a pump file that loads to this very description: every value, with its unit, to the last bit."""
    rows = [f"name = {json.dumps(pump.name, ensure_ascii=False)}", f"format = {pump.format}"]
    for name in _TABLES:
        rows += section_rows(name, getattr(pump, name))
    for name in SINGLE_PARTS:
        for chamber, part in getattr(pump, f"single_{name}s"):
            rows += section_rows(f"{name}.{chamber}", part, getattr(pump, name))
    return "\n".join(rows) + "\n"


def _read(source: str | Path) -> tuple[str, str]:
    """Return what to call the source, and its text."""
    name = str(source)
    if name in builtin_pumps():
        return f"built-in pump {name}", _built_in().joinpath(f"{name}.toml").read_text("utf-8")
    path = Path(source)
    try:
        return name, path.read_text("utf-8-sig")  # some editors put a byte order mark first
    except FileNotFoundError:
        raise InputFaults(name, [_not_there(path)]) from None
    except (OSError, UnicodeDecodeError) as reason:
        raise InputFaults(name, [Fault("file", f"cannot be read: {reason}", "a TOML file in UTF-8")]) from None


def _not_there(path: Path) -> Fault:
    """Return the fault of a name that is neither a built-in pump nor a file, with what comes nearest."""
    builtin = builtin_pumps()
    nearest = nearest_choice(str(path), builtin) or nearest_path(path)
    return Fault(
        "pump",
        f"'{path}', which is no built-in pump and no file",
        f"a built-in pump ({', '.join(builtin)}) or the path of a pump file (.toml)",
        nearest,
    )


def _parse(label: str, text: str) -> dict[str, Any]:
    """Return the tables of a TOML text of the known format."""
    tables = toml_tables(label, text)
    number = tables.get("format")
    if isinstance(number, bool) or number != FORMAT:
        fault = Fault("format", stated(number), f"format = {FORMAT}, the pump file format of this version")
        raise InputFaults(label, [fault], key_lines(text))
    return tables


def _describe(label: str, tables: Mapping[str, Any], lines: Mapping[str, int | None], folder: Path) -> PumpDescription:
    """Return the description of the tables, or raise all their faults, those of the checks included."""
    reading = Reading(folder, _SPECIAL, SINGLE_PARTS)
    name = tables.get("name")
    known = ["name", "format", *_TABLES]
    for key in tables:
        if key not in known:
            reading.unknown("", key, known)
    if "name" not in reading.faulty and not (isinstance(name, str) and name.isprintable() and name):
        reading.fault("name", stated(name), "the pump's name, one line of text")
    sections: dict[str, Any] = {
        key: read_section(key, model, tables[key], reading)
        if key in tables
        else left_out_section(key, model, reading, required=fields_of(PumpDescription)[key].required)
        for key, model in _TABLES.items()
    }
    singles: dict[str, Any] = {
        f"single_{key}s": _singles(key, sections[key], tables.get(key), reading) for key in SINGLE_PARTS
    }
    pump = PumpDescription(name=str(name), format=FORMAT, **sections, **singles)
    report = run_checks(_CHECKS, pump, reading.trusted)
    reading.faults += [fault for fault in report.faults if fault.path not in reading.faulty]
    if not reading.faults:
        reading.faults += single_parts_checked(_CHECKS, pump, report).faults
    if reading.faults:
        raise InputFaults(label, reading.faults, lines)
    return pump


def _singles(name: str, base: Any, table: object, reading: Reading) -> tuple[tuple[int, Any], ...]:
    """Return the single parts of a table by chamber, each complete: [piston.3] over [piston]."""
    numbered = {key: part for key, part in table.items() if is_number(key)} if isinstance(table, dict) else {}
    return tuple(
        (int(key), read_section(f"{name}.{key}", type(base), part, reading, base)) for key, part in numbered.items()
    )


def _file_law(raw: object, table: Mapping[str, object], reading: Reading) -> dict[str, object]:
    """Return [ports] coefficient_file and, where the table does not state them, the law nearest to the file."""
    field = fields_of(PortsSection)["coefficient_file"]
    found = read_entry("ports.coefficient_file", field, raw, reading)
    if not isinstance(found, FlowCoefficients):
        reading.faulty |= {f"ports.{key}" for key in LAW_KEYS}
        return {}
    law = file_law(found)
    return {"coefficient_file": found} | {key: getattr(law, key) for key in LAW_KEYS if key not in table}


def grade_viscosities(grade: object, table: Mapping[str, object], reading: Reading) -> dict[str, float]:
    """Return the two viscosities of an ISO grade in m2/s, or none with the fault noted."""
    if stated := [key for key in GRADE_KEYS if key in table]:
        reading.fault("oil.grade", f"grade beside {' and '.join(stated)}", "the grade or the two viscosities")
    elif not isinstance(grade, str) or grade not in ISO_GRADES:
        expected = f"one of {', '.join(ISO_GRADES)}, or {' and '.join(GRADE_KEYS)} in its place"
        reading.fault("oil.grade", repr(grade), expected, nearest_choice(str(grade), ISO_GRADES))
    else:
        return asdict(ISO_GRADES[grade])
    reading.faulty |= {f"oil.{key}" for key in GRADE_KEYS}
    return {}


_SPECIAL: Mapping[str, Special] = {"oil.grade": grade_viscosities, "ports.coefficient_file": _file_law}
"""Keys that set others too."""
