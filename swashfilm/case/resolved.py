"""Text of a resolved film case: every key, defaults filled in, with units."""

from __future__ import annotations

from swashfilm.case.gap.instant import FORMAT
from swashfilm.case.statement import FilmStatement
from swashfilm.case.tables.boundary import BoundaryTables
from swashfilm.case.tables.constants import constant_rows
from system.inputs.sections.values import written_entries
from system.inputs.sections.writer import section_rows


def resolved_text(stated: FilmStatement) -> str:
    """Return the text of this case."""
    rows = [f"format = {FORMAT}", *section_rows("film", stated.film)]
    rows += ["", *constant_rows(stated.constants)] if stated.constants else []
    rows += ["", "[boundary]  # boundaries not named are closed", *written_entries(BoundaryTables, stated.boundary)]
    sections = {
        "oil": stated.oil,
        "thermal": stated.thermal,
        "elastic": stated.elastic.stated if stated.elastic else None,
    }
    for name, section in sections.items():
        rows += section_rows(name, section) if section else []
    rows += stated.rough.rows if stated.rough else []
    rows += section_rows("time", stated.time) if stated.time else []
    return "\n".join(rows) + "\n"
