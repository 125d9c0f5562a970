"""Text of a resolved film case: every key, defaults filled in, with units."""

from __future__ import annotations

from collections.abc import Mapping

from swashfilm.case.gap.instant import FORMAT
from swashfilm.case.statement import FilmStatement
from swashfilm.case.tables.boundary import BoundaryTables
from system.inputs.sections.fields import field_type
from system.inputs.sections.values import written_entries
from system.inputs.sections.writer import section_rows

NUMBERS = field_type(Mapping[str, float])


def resolved_text(stated: FilmStatement) -> str:
    """Return the text of this case."""
    rows = [f"format = {FORMAT}", *section_rows("film", stated.film)]
    rows += ["", "[constants]  # SI", *written_entries(NUMBERS, stated.constants)] if stated.constants else []
    rows += ["", "[boundary]  # boundaries not named are closed", *written_entries(BoundaryTables, stated.boundary)]
    sections = {
        "oil": stated.oil,
        "thermal": stated.thermal,
        "elastic": stated.elastic.stated if stated.elastic else None,
        "roughness": stated.roughness,
        "contact": stated.contact,
        "time": stated.time,
    }
    for name, section in sections.items():
        rows += section_rows(name, section) if section else []
    return "\n".join(rows) + "\n"
