"""Sections to tables of TOML, every value with its unit, so that reading gives it back to the last bit."""

from __future__ import annotations

from collections.abc import Iterator

from system.inputs.sections.fields import Section, fields_of
from system.inputs.sections.values import written_value


def section_rows(path: str, section: Section, base: Section | None = None) -> Iterator[str]:
    """Yield a table's lines and those of the tables in it; with `base`, only what differs from that one."""
    stated = {
        key: (own, value)
        for key, own in fields_of(type(section)).items()
        if (value := getattr(section, key)) not in (None, (), {}) and value != getattr(base, key, None)
    }
    flat = {key: row for key, row in stated.items() if row[0].table is None}
    if flat:
        yield from ("", f"[{path}]")
    for key, (own, value) in flat.items():
        dimension = own.formula.dimension if own.formula else None
        yield f"{key} = {written_value(own, value)}" + (f"  # {dimension.si_unit}" if dimension else "")
    for key, (_, value) in stated.items():
        if key not in flat:
            yield from section_rows(f"{path}.{key}", value)
