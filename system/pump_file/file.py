"""Pump files: TOML with units to a PumpDescription and back; every fault of a file at once."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from reynolds.laws.oil import ISO_GRADES
from system.description.pump import FORMAT, SINGLE_PARTS, PortsSection, PumpDescription
from system.description.values import HERE, bound, read_value, wanted, written_value
from system.inputs.faults import Fault, InputFaults, key_lines, nearest_choice, nearest_path
from system.inputs.fields import Section, dimension_of, table_of, tables_of
from system.inputs.toml_table import toml_tables
from system.inputs.units import Dimension, QuantityError, to_gauge
from system.pump.ports.flow_coefficients import coefficients_of, file_law
from system.pump_file.bodies import BODY_CHECKS
from system.pump_file.check import CheckReport, run_checks
from system.pump_file.films import FILM_CHECKS
from system.pump_file.geometry import GEOMETRY_CHECKS
from system.pump_file.losses import LOSS_CHECKS
from system.pump_file.operating import OPERATING_CHECKS
from system.pump_file.parts import PARTS_CHECKS, single_parts_checked
from system.pump_file.ports import PORT_CHECKS
from system.pump_file.values import VALUE_CHECKS

ABSOLUTE = "_abs"  # a pressure key that ends so is absolute
_CHECKS = (
    *GEOMETRY_CHECKS,
    *PORT_CHECKS,
    *LOSS_CHECKS,
    *FILM_CHECKS,
    *OPERATING_CHECKS,
    *PARTS_CHECKS,
    *BODY_CHECKS,
    *VALUE_CHECKS,
)
_VISCOSITIES = ("kinematic_viscosity_40C", "kinematic_viscosity_100C")
_OF_LAW = ("flow_coefficient", "critical_reynolds")
_TABLES = {name: model for name, info in PumpDescription.model_fields.items() if (model := table_of(info))}


def _built_in() -> Traversable:
    return files("system.description") / "pumps"


def builtin_pumps() -> tuple[str, ...]:
    """Return the names of the pumps that come with the program."""
    names = (item.name for item in _built_in().iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))


def load_pump(source: str | Path, overrides: Mapping[str, object] | None = None) -> PumpDescription:
    """Return the description of a built-in pump (by name) or of a pump file (by path), in SI.

    `overrides` puts values in place of the file's, as they would stand there: {"operating.speed": "1500 rpm"}.
    A file that a value names is looked for beside the pump file; with a built-in pump, in the working directory.
    Raises InputFaults with everything that is wrong: in the file's form, its units, its values and its
    geometry. Doubtful values raise nothing; `check_pump` tells them.
    """
    label, text = _read(source)
    tables = _parse(label, text)
    lines: dict[str, int | None] = {**key_lines(text)}
    for path, value in (overrides or {}).items():
        *within, key = path.split(".")
        table: object = tables
        for name in within:
            table = table.setdefault(name, {}) if isinstance(table, dict) else None
        if isinstance(table, dict):
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
        rows += _table_rows(name, getattr(pump, name))
    for name in SINGLE_PARTS:
        for chamber, part in getattr(pump, f"single_{name}s"):
            rows += _table_rows(f"{name}.{chamber}", part, getattr(pump, name))
    return "\n".join(rows) + "\n"


def _table_rows(name: str, section: Section, base: Section | None = None) -> Iterator[str]:
    """Yield a table's lines and those of the tables in it; with `base`, only what differs from that one."""
    stated = {
        key: (info, value)
        for key, info in type(section).model_fields.items()
        if (value := getattr(section, key)) not in (None, ()) and value != getattr(base, key, None)
    }
    own = {key: row for key, row in stated.items() if table_of(row[0]) is None}
    if own:
        yield from ("", f"[{name}]")
    for key, (info, value) in own.items():
        yield f"{key} = {written_value(info, value)}"
    for key, (_, value) in stated.items():
        if key not in own:
            yield from _table_rows(f"{name}.{key}", value)


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
    stated = tables.get("format")
    if isinstance(stated, bool) or stated != FORMAT:
        found = "no such key" if stated is None else repr(stated)
        fault = Fault("format", found, f"format = {FORMAT}, the pump file format of this version")
        raise InputFaults(label, [fault], key_lines(text))
    return tables


@dataclass
class _Reading:
    """What has been made of a file so far: its faults, the paths these tell of, and the paths to be trusted.

    `folder`: from where the paths of files in it are counted.
    """

    folder: Path
    faults: list[Fault] = field(default_factory=list)
    told: set[str] = field(default_factory=set)
    trusted: set[str] = field(default_factory=set)

    def fault(self, path: str, found: str, expected: str, nearest: str = "") -> None:
        self.faults.append(Fault(path, found, expected, nearest))
        self.told.add(path)

    def unknown(self, section: str, key: str, known: Sequence[str]) -> None:
        """Tell of an unknown key; it stands for the known one it is spelt like, so that one slip is one fault."""
        near = nearest_choice(key, known)
        self.fault(f"{section}{key}", "unknown key", f"one of {', '.join(known)}", near)
        self.told.add(f"{section}{near}")


def _describe(
    label: str, tables: Mapping[str, Any], lines: Mapping[str, int | None], folder: Path
) -> PumpDescription:
    """Return the description of the tables, or raise all their faults, those of the checks included."""
    reading = _Reading(folder)
    name = tables.get("name")
    known = ["name", "format", *_TABLES]
    for key in tables:
        if key not in known:
            reading.unknown("", key, known)
    if "name" not in reading.told and not (isinstance(name, str) and name.isprintable() and name):
        reading.fault("name", "no such key" if name is None else repr(name), "the pump's name, one line of text")
    sections: dict[str, Any] = {
        key: _section(key, model, tables[key], reading) if key in tables else _left_out(key, model, reading)
        for key, model in _TABLES.items()
    }
    singles: dict[str, Any] = {
        f"single_{key}s": _singles(key, sections[key], tables.get(key), reading) for key in SINGLE_PARTS
    }
    pump = PumpDescription.model_construct(name=name, format=FORMAT, **sections, **singles)
    report = run_checks(_CHECKS, pump, reading.trusted)
    reading.faults += [fault for fault in report.faults if fault.path not in reading.told]
    if not reading.faults:
        reading.faults += single_parts_checked(_CHECKS, pump, report).faults
    if reading.faults:
        raise InputFaults(label, reading.faults, lines)
    return pump


def _left_out(name: str, model: type[Section], reading: _Reading) -> Section:
    """Return a table that the file does not have: the empty one, with a fault where the pump needs it."""
    if PumpDescription.model_fields[name].is_required() and name not in reading.told:
        reading.fault(name, "no such table", f"a table [{name}] with {', '.join(_keys(name, model))}")
    return model.model_construct()


def _singles(name: str, base: Section, table: object, reading: _Reading) -> tuple[tuple[int, Section], ...]:
    """Return the single parts of a table by chamber, each complete: [piston.3] over [piston]."""
    numbered = {key: part for key, part in table.items() if _is_chamber(key)} if isinstance(table, dict) else {}
    return tuple(
        (int(key), _section(f"{name}.{key}", type(base), part, reading, base)) for key, part in numbered.items()
    )


def _is_chamber(key: str) -> bool:
    """True for the name of a single part's table: a chamber's number, written one way only."""
    return key.isdecimal() and key == str(int(key))


def _section(
    name: str, model: type[Section], table: object, reading: _Reading, base: Section | None = None
) -> Section:
    """Return one table as its model; with faults, one that holds the good values only.

    What the table leaves out is that of `base`, whose own faults are told elsewhere.
    """
    if not isinstance(table, dict):
        reading.fault(name, repr(table), f"a table [{name}] with {', '.join(_keys(name, model))}")
        return model.model_construct()
    stated: dict[str, Any] = _values(name, model, table, reading)
    values = {**dict(base or {}), **stated}
    try:
        section = model.model_validate(values)
    except ValidationError as invalid:
        for error in invalid.errors():
            if not error["loc"]:  # of the table as a whole
                reading.fault(name, ", ".join(stated) or "an empty table", str(error["ctx"]["error"]))
                continue
            key = str(error["loc"][0])
            info, path = model.model_fields[key], f"{name}.{key}"
            if error["type"] != "missing":
                raw = table.get(key, table.get(key + ABSOLUTE))
                if key in stated:
                    reading.fault(path, str(raw), bound(info, error.get("ctx", {})))
            elif path not in reading.told and base is None:
                reading.fault(path, "no such key", wanted(info))
        section = model.model_construct(**{k: v for k, v in values.items() if f"{name}.{k}" not in reading.told})
    reading.trusted |= {f"{name}.{key}" for key in section.model_fields_set} - reading.told
    return section


def _values(name: str, model: type[Section], table: Mapping[str, object], reading: _Reading) -> dict[str, object]:
    """Return the SI values of a table, and tell of every entry that gives none."""
    values: dict[str, object] = {}
    for written, raw in table.items():
        path, key = f"{name}.{written}", written.removesuffix(ABSOLUTE)
        info = model.model_fields.get(key)
        absolute = key != written
        if (name, written) == ("oil", "grade"):
            values |= _grade_viscosities(raw, table, reading)
        elif (name, written) == ("ports", "coefficient_file"):
            values |= _file_law(raw, table, reading)
        elif name in SINGLE_PARTS and _is_chamber(written):
            continue  # a single part: `_singles`
        elif info is None or (absolute and dimension_of(info) is not Dimension.PRESSURE):
            reading.unknown(f"{name}.", written, _keys(name, model))
        elif absolute and key in table:
            reading.fault(path, f"both {key} and {written}", "one of the two, gauge or absolute")
        elif inner := tables_of(info):
            values[key] = _inner_tables(path, inner, raw, reading)
        elif inner := table_of(info):
            values[key] = _section(path, inner, raw, reading)
            if any(fault.path.startswith(f"{path}.") for fault in reading.faults):
                reading.told.add(path)
        else:
            try:
                value = read_value(info, raw, reading.folder)
            except QuantityError as reason:
                reading.fault(path, reason.found, reason.expected, reason.nearest)
                reading.told.add(f"{name}.{key}")
            else:
                values[key] = to_gauge(value) if absolute and isinstance(value, float) else value
    return values


def _file_law(raw: object, table: Mapping[str, object], reading: _Reading) -> dict[str, object]:
    """Return [ports] coefficient_file and, where the table does not state them, the law nearest to the file."""
    path = "ports.coefficient_file"
    try:
        file = read_value(PortsSection.model_fields["coefficient_file"], raw, reading.folder)
        law = file_law(coefficients_of(Path(str(file))))
    except (QuantityError, InputFaults) as reason:
        faults = reason.faults if isinstance(reason, InputFaults) else [reason]
        for fault in faults:
            where = f"{fault.path}: " if isinstance(fault, Fault) else ""
            reading.fault(path, where + fault.found, fault.expected, fault.nearest)
        reading.told |= {f"ports.{key}" for key in _OF_LAW}
        return {}
    return {"coefficient_file": file} | {key: getattr(law, key) for key in _OF_LAW if key not in table}


def _inner_tables(path: str, model: type[Section], raw: object, reading: _Reading) -> tuple[Section, ...]:
    """Return the tables of a list of such; none where one has a fault."""
    if not isinstance(raw, list):
        reading.fault(path, repr(raw), f"a list of tables with {', '.join(_keys(path, model))}")
        return ()
    found = tuple(_section(f"{path}.{n}", model, table, reading) for n, table in enumerate(raw, start=1))
    if any(fault.path.startswith(f"{path}.") for fault in reading.faults):
        reading.told.add(path)
        return ()
    return found


def _keys(name: str, model: type[Section]) -> list[str]:
    """Return the keys that a table may have."""
    return [*model.model_fields, *(["grade"] if name == "oil" else [])]


def _grade_viscosities(grade: object, table: Mapping[str, object], reading: _Reading) -> dict[str, float]:
    """Return the two viscosities of an ISO grade in m2/s, or none with the fault told."""
    if stated := [key for key in _VISCOSITIES if key in table]:
        reading.fault("oil.grade", f"grade beside {' and '.join(stated)}", "the grade or the two viscosities")
    elif not isinstance(grade, str) or grade not in ISO_GRADES:
        expected = f"one of {', '.join(ISO_GRADES)}, or {' and '.join(_VISCOSITIES)} in its place"
        reading.fault("oil.grade", repr(grade), expected, nearest_choice(str(grade), ISO_GRADES))
    else:
        return asdict(ISO_GRADES[grade])
    reading.told |= {f"oil.{key}" for key in _VISCOSITIES}
    return {}
