"""JSON Schema of an optimisation."""

from __future__ import annotations

from swashfilm.case.gap.pump import pump_tables_schema
from swashfilm.runs.variation.optimise.asked import RANGE, WITH
from swashfilm.runs.variation.optimise.case import FORMAT, OptimiseSection
from swashfilm.runs.variation.optimise.points import CYCLE, KEYS
from system.inputs.sections.json_schema import Schema, section_schema, tables_schema
from system.variation.measures import MEASURES
from system.variation.optimisation.problem import Aim

_TEXTS: Schema = {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}, "minItems": 1}]}


def optimise_schema() -> Schema:
    """Return the JSON Schema of an optimisation; names of measures are quoted keys."""
    aims: Schema = {"enum": [one.value for one in Aim]}
    properties = {
        "format": {"const": FORMAT},
        "optimise": section_schema(OptimiseSection),
        **pump_tables_schema(),
        "points": _points(),
        "vary": {"type": "object", "additionalProperties": _bounds(), "minProperties": 1,
                 "description": "dimensions of the pump with their bounds"},
        "objectives": {"type": "object", "properties": dict.fromkeys(MEASURES, aims), "minProperties": 1,
                       "additionalProperties": False, "description": "measures that shall be least, or most"},
        "constraints": {"type": "object", "properties": dict.fromkeys(MEASURES, _TEXTS), "additionalProperties": False,
                        "description": "limits of measures, of a value or of the start"},
    }  # fmt: skip
    return tables_schema("Swashfilm optimisation", properties, ("format", "optimise", "vary", "objectives"))


def _points() -> Schema:
    level: Schema = {"type": ["string", "number"]}
    levels: Schema = {"anyOf": [level, {"type": "array", "items": level, "minItems": 1}]}
    keys = dict.fromkeys(KEYS, levels) | {CYCLE: {"type": "string"}}
    return {"type": "object", "description": "operating points: levels of inputs, or a duty cycle", "properties": keys,
            "additionalProperties": False}  # fmt: skip


def _bounds() -> Schema:
    two: Schema = {"type": "array", "items": {"type": ["string", "number"]}, "minItems": 2, "maxItems": 2}
    bounds: Schema = {"anyOf": [{"type": "string"}, two]}
    tied: Schema = {"type": "object", "properties": {RANGE: bounds, WITH: _TEXTS}, "required": [RANGE],
                    "additionalProperties": False}  # fmt: skip
    return {"anyOf": [*bounds["anyOf"], tied]}
