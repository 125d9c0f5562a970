"""Tables of a pump file to a PumpDescription: every section read, every fault at once."""

from collections.abc import Mapping
from dataclasses import asdict
from importlib.resources import files
from pathlib import Path
from typing import Any

from reynolds.laws.oil import ISO_GRADES
from system.description.drawing import drawing_faults
from system.description.ports import PortsSection
from system.description.pump import FORMAT, SINGLE_PARTS, PumpDescription
from system.inputs.coefficients.flow_files import FlowCoefficients
from system.inputs.faults import Fault, InputFaults, nearest_choice, stated
from system.inputs.sections.fields import fields_of
from system.inputs.sections.reader import (
    Reading,
    Special,
    is_number,
    left_out_section,
    partial_section,
    read_entry,
    read_section,
)
from system.inputs.sections.values import HERE
from system.pump.ports.flow_coefficients import file_law
from system.pump_file import bodies, films, geometry, losses, operating, parts, ports, values
from system.pump_file.check import checks_in, run_checks
from system.pump_file.parts import single_parts_checked

BUILT_IN = files("system.description") / "pumps"
"""Folder of the pump files that come with the program."""
CHECKS = tuple(
    check
    for module in (geometry, ports, losses, films, operating, parts, bodies, values)
    for check in checks_in(vars(module))
)
GRADE_KEYS = ("kinematic_viscosity_40C", "kinematic_viscosity_100C")
LAW_KEYS = ("flow_coefficient", "critical_reynolds")
TABLES = {name: model for name, own in fields_of(PumpDescription).items() if (model := own.table)}


def pump_of_tables(
    label: str, tables: Mapping[str, Any], folder: Path = HERE, lines: Mapping[str, int | None] | None = None
) -> PumpDescription:
    """Return the description of a pump file's tables, as TOML gives them; paths of files start from the folder.

    lines: of the file's paths. Raises InputFaults, under the name `label`, with all faults of the tables, those of the
    checks included.
    """
    reading, name = _reading(tables, folder), tables.get("name")
    if "name" not in reading.faulty and not (isinstance(name, str) and name.isprintable() and name):
        reading.fault("name", stated(name), "the pump's name, one line of text")
    sections: dict[str, Any] = {
        key: read_section(key, model, tables[key], reading)
        if key in tables
        else left_out_section(key, model, reading, required=fields_of(PumpDescription)[key].required)
        for key, model in TABLES.items()
    }
    singles: dict[str, Any] = {
        f"single_{key}s": _singles(key, sections[key], tables.get(key), reading) for key in SINGLE_PARTS
    }
    pump = PumpDescription(name=str(name), format=FORMAT, **sections, **singles)
    report = run_checks(CHECKS, pump, reading.trusted)
    reading.faults += [fault for fault in report.faults if fault.path not in reading.faulty]
    if not reading.faults:
        reading.faults += single_parts_checked(CHECKS, pump, report).faults
        reading.faults += drawing_faults(pump)
    if reading.faults:
        raise InputFaults(label, reading.faults, lines)
    return pump


def faults_as_written(tables: Mapping[str, Any], folder: Path = HERE) -> list[Fault]:
    """Return the faults of the keys that the tables of a pump file have, each by itself, without those they lack."""
    reading = _reading(tables, folder)
    for key, model in TABLES.items():
        if key in tables:
            read_section(key, model, tables[key], reading, partial_section(model, {}))
    return reading.faults


def _reading(tables: Mapping[str, Any], folder: Path) -> Reading:
    """Return the reading of a pump file, its unknown tables noted."""
    reading = Reading(folder, _SPECIAL, SINGLE_PARTS)
    known = ["name", "format", *TABLES]
    for key in tables:
        if key not in known:
            reading.unknown("", key, known)
    return reading


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
        other = [key for key in GRADE_KEYS if key not in stated]
        near = f"{other[0]} too, in place of the grade" if other else ""
        reading.fault("oil.grade", f"grade beside {' and '.join(stated)}", "the grade or the two viscosities", near)
    elif not isinstance(grade, str) or grade not in ISO_GRADES:
        expected = f"one of {', '.join(ISO_GRADES)}, or {' and '.join(GRADE_KEYS)} in its place"
        reading.fault("oil.grade", repr(grade), expected, nearest_choice(str(grade), ISO_GRADES))
    else:
        return asdict(ISO_GRADES[grade])
    reading.faulty |= {f"oil.{key}" for key in GRADE_KEYS}
    return {}


_SPECIAL: Mapping[str, Special] = {"oil.grade": grade_viscosities, "ports.coefficient_file": _file_law}
"""Keys that set others too."""
