"""JSON Schema of a pump file."""

from collections.abc import Iterator
from typing import Any

from reynolds.laws.oil import ISO_GRADES
from system.description.pump import FORMAT, SINGLE_PARTS, PumpDescription
from system.inputs.sections.fields import fields_of
from system.inputs.sections.json_schema import Schema, section_schema, tables_schema
from system.pump_file.tables import GRADE_KEYS, LAW_KEYS


def pump_schema() -> Schema:
    """Return the JSON Schema of a pump file: tables, single parts by number, keys that set others."""
    types = {name: own for name, own in fields_of(PumpDescription).items() if own.table is not None}
    tables: dict[str, Any] = {name: section_schema(own.table) for name, own in types.items() if own.table}
    for name in SINGLE_PARTS:
        part = types[name].table
        if part is not None:
            tables[name]["patternProperties"] = {"^[1-9][0-9]?$": section_schema(part, complete=False)}
    grade = {"enum": list(ISO_GRADES), "description": "ISO viscosity grade, in place of the two viscosities"}
    tables["oil"]["properties"]["grade"] = grade
    _either(tables["oil"], "grade", GRADE_KEYS)
    tables["ports"]["required"] = [key for key in tables["ports"]["required"] if key not in LAW_KEYS]
    tables["ports"]["anyOf"] = [{"required": ["coefficient_file"]}, {"required": list(LAW_KEYS)}]
    head = {
        "name": {"type": "string", "minLength": 1, "description": "name of the pump, one line"},
        "format": {"const": FORMAT, "description": "pump file format"},
    }
    required = (*head, *(name for name, own in types.items() if own.required))
    return tables_schema("Swashfilm pump file", {**head, **tables}, required)


def _either(table: Schema, key: str, others: tuple[str, ...]) -> None:
    """Let one key replace others."""
    table["required"] = [name for name in table["required"] if name not in others]
    none_of_others = {"not": {"anyOf": [{"required": [name]} for name in others]}}
    table["oneOf"] = [{"required": [key], **none_of_others}, {"required": list(others), "not": {"required": [key]}}]


def section_models() -> Iterator[tuple[str, type[Any]]]:
    """Yield name and class of every table in the order of the file; of one inside another as `outer.inner`."""
    yield from _tables_in(PumpDescription, "")


def _tables_in(model: type[Any], above: str) -> Iterator[tuple[str, type[Any]]]:
    for name, own in fields_of(model).items():
        inner = own.table or own.tables or (own.from_table.section if own.from_table else None)
        if inner is not None:
            yield above + name, inner
            yield from _tables_in(inner, f"{above}{name}.")
