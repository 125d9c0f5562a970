"""JSON Schemas (draft 2020-12) of files, from the sections that read them: by these an editor checks keys."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from typing import Any

from system.inputs.sections.fields import FieldType, Points, Text, fields_of
from system.inputs.sections.reader import ABSOLUTE
from system.inputs.sections.values import PURE_UNITS

DRAFT = "https://json-schema.org/draft/2020-12/schema"
QUANTITY = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?\s*(1/|[^\s\d.,]).*$"
"""A number and a unit; the program checks which units measure a key."""
Schema = dict[str, Any]


def file_schema(title: str, schema: Schema) -> Schema:
    """Return the schema of a file with its title and draft."""
    return {"$schema": DRAFT, "title": title, **schema}


def tables_schema(title: str, properties: Schema, required: Iterable[str]) -> Schema:
    """Return the schema of a file of these keys and tables, and no others."""
    whole = {"type": "object", "properties": properties, "required": [*required], "additionalProperties": False}
    return file_schema(title, whole)


def section_schema(model: type[Any], *, complete: bool = True, inner_complete: bool = True) -> Schema:
    """Return the schema of a table; with `complete` its required keys are required, also in the tables in it.

    A pressure may be stated as KEY or as KEY_abs.
    """
    properties: Schema = {}
    required: list[str] = []
    either: list[Schema] = []
    for key, own in fields_of(model).items():
        properties[key] = field_schema(own, complete=inner_complete)
        if own.may_be_absolute:
            properties[key + ABSOLUTE] = properties[key]
            names = [key, key + ABSOLUTE]
            exactly = {"oneOf": [{"required": [name]} for name in names]}
            either.append(exactly if own.required and complete else {"not": {"required": names}})
        elif own.required and complete:
            required.append(key)
    found: Schema = {
        "type": "object",
        "description": described(model),
        "properties": properties,
        "additionalProperties": False,
    }
    return found | ({"required": required} if required else {}) | ({"allOf": either} if either else {})


def described(model: type[Any]) -> str:
    """Return the docstring of a section in one line, without the table's name ahead of it."""
    text = " ".join((inspect.getdoc(model) or "").split())
    return text.partition("]: ")[2] or text


def field_schema(own: FieldType, *, complete: bool = True) -> Schema:
    """Return the schema of one key; with `complete` the required keys of a table are required."""
    if own.tables is not None:
        return {"type": "array", "items": section_schema(own.tables)}
    if own.table is not None:
        return section_schema(own.table, complete=complete, inner_complete=complete)
    if own.named is not None:
        return {"type": "object", "additionalProperties": field_schema(own.named)}
    value: Schema = _value_schema(own, complete)
    if own.several is not None and own.several.count:
        value = {"type": "array", "items": value, "minItems": own.several.count, "maxItems": own.several.count}
    elif own.several is not None:
        value = {"anyOf": [value, {"type": "array", "items": value, "minItems": 1}]}
    return value | ({"description": words} if (words := _words(own)) else {})


def quantity_schema(example: str) -> Schema:
    """Return the schema of a quantity with its unit."""
    return {"type": "string", "pattern": QUANTITY, "examples": [example]}


def _value_schema(own: FieldType, complete: bool) -> Schema:
    if own.forms:
        alone: list[Schema] = [{"enum": [member.value for member in own.choices]}] if own.choices else []
        alone += [{"type": "string", "minLength": 1}] if own.file else []
        return {"anyOf": [*alone, *map(section_schema, own.forms)]}
    if own.formula is not None:
        return {"type": "string", "minLength": 1} if own.formula.dimension else {"type": ["number", "string"]}
    if own.dimension is not None:
        return quantity_schema(own.example)
    if own.layouts:
        rows = [_rows_schema(layout, own.limits.fewest) for layout in own.layouts]
        table = [section_schema(own.from_table.section, complete=complete)] if own.from_table else []
        return {"anyOf": [{"type": "string"}, *rows, *table]}
    if own.choices:
        return {"enum": [member.value for member in own.choices]}
    if own.unit is not None and own.unit.dimension is None:
        return {"enum": list(PURE_UNITS)}
    if own.format is not None:
        return {"const": own.format.number}
    if own.text is Text.WORDS:
        return {"type": "string"}
    if own.text is Text.NAMES:
        return {"type": "array", "items": {"type": "string", "minLength": 1}, "minItems": 1}
    if own.text is not None or own.unit is not None:
        return {"type": "string", "minLength": 1}
    limits = own.limits
    bounds = {
        "exclusiveMinimum": limits.above,
        "minimum": limits.least,
        "exclusiveMaximum": limits.below,
        "maximum": limits.most,
    }
    kind = "integer" if own.whole else "number"
    return {"type": kind, **{key: bound for key, bound in bounds.items() if bound is not None}}


def _rows_schema(layout: Points, fewest: int) -> Schema:
    row = {
        "type": "array",
        "prefixItems": [quantity_schema(example) for example in layout.example],
        "minItems": len(layout.columns),
        "items": False,
    }
    return {"type": "array", "items": row, "minItems": fewest, "examples": [[list(layout.example)]]}


def _words(own: FieldType) -> str:
    """Return the meaning of a key: the comment behind its field, and the noun of its quantity."""
    dimension = own.formula.dimension if own.formula else own.dimension
    noun = dimension.noun if dimension is not None else ""
    formula = f"or a formula in {dimension.si_unit}" if own.formula and dimension else ""
    return "; ".join(part for part in (noun, formula, own.meaning) if part)
