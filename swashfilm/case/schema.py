"""JSON Schema of a film case: a free film, or a gap of a pump at one instant or over the revolution."""

from __future__ import annotations

from reynolds.laws.oil import ISO_GRADES
from swashfilm.case.gap.instant import FORMAT, InstantSection
from swashfilm.case.gap.physics import SwitchesSection
from swashfilm.case.gap.position import LOADS, POSITIONS
from swashfilm.case.gap.pump import pump_tables_schema
from swashfilm.case.gap.revolution import RevolutionSection
from swashfilm.case.study import Combine, RangeSpacing
from swashfilm.case.tables.boundary import BoundaryTables
from swashfilm.case.tables.elastic import ElasticSection
from swashfilm.case.tables.film import FilmSection
from swashfilm.case.tables.oil import FilmOilSection
from swashfilm.case.tables.roughness import ContactSection, RoughnessSection
from swashfilm.case.tables.thermal import ThermalSection
from swashfilm.case.tables.time_steps import TimeStepsSection
from system.inputs.sections.json_schema import Schema, field_schema, section_schema, tables_schema

SECTIONS = {
    "oil": FilmOilSection,
    "thermal": ThermalSection,
    "elastic": ElasticSection,
    "roughness": RoughnessSection,
    "contact": ContactSection,
    "time": TimeStepsSection,
    "physics": SwitchesSection,
    "revolution": RevolutionSection,
}
FORMS = {"position": POSITIONS, "load": LOADS}


def case_schema() -> Schema:
    """Return the JSON Schema of a film case, with the table [study] or [table]."""
    tables = {name: section_schema(model) for name, model in SECTIONS.items()}
    tables["oil"]["properties"]["grade"] = {"enum": list(ISO_GRADES), "description": "ISO viscosity grade"}
    instant, of_pump = section_schema(InstantSection), pump_tables_schema()
    properties = {
        "format": {"const": FORMAT},
        **instant["properties"],
        "pump": {"anyOf": [instant["properties"]["pump"], of_pump["pump"]]},
        "operating": of_pump["operating"],
        "film": {"anyOf": [section_schema(FilmSection), *_gap_films(instant)]},
        "constants": {"type": "object", "additionalProperties": {"type": ["number", "string"]}},
        "boundary": field_schema(BoundaryTables),
        **tables,
        **{name: {"anyOf": [*map(field_schema, dict.fromkeys(forms.values()))]} for name, forms in FORMS.items()},
        "study": _study(),
        "table": {"type": "object", "additionalProperties": _range()},
    }
    whole = tables_schema("Swashfilm film case", properties, ["format"])
    return whole | {"anyOf": [{"required": ["film"]}, {"required": ["gap", "pump"]}]}


def _gap_films(instant: Schema) -> list[Schema]:
    """Return [film] of a gap at one instant and over the revolution."""
    keys = instant["properties"]
    rows = {"type": "array", "items": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}}
    over_turn = {
        "gap": keys["gap"],
        "pump": keys["pump"],
        "revolution": {"const": True},
        "chamber_pressure": {"anyOf": [keys["chamber_pressure"], {"type": "string"}, rows]},
    }
    required = ["gap", "pump", "revolution"]
    return [
        instant | {"properties": keys | {"revolution": {"const": False}}},
        {"type": "object", "properties": over_turn, "required": required, "additionalProperties": False},
    ]


def _study() -> Schema:
    varied = {"anyOf": [{"type": "array", "minItems": 1}, _range(points={"type": "integer", "minimum": 2})]}
    combine = {"enum": [way.value for way in Combine]}
    return {"type": "object", "properties": {"combine": combine}, "additionalProperties": varied}


def _range(**more: Schema) -> Schema:
    """Return the schema of a range of one key; `more` keys are required."""
    end = {"type": ["number", "string"]}
    keys = {"from": end, "to": end, "spacing": {"enum": [way.value for way in RangeSpacing]}, **more}
    required = ["from", "to", *more]
    return {"type": "object", "properties": keys, "required": required, "additionalProperties": False}
