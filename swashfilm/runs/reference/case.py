"""The case file of `swashfilm reference`: which passage, of what sizes, at which Reynolds numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import product
from pathlib import Path
from typing import Any

from swashfilm.runs.reference.passages import Groove, Orifice, Passage, Slot, Step
from system.inputs.faults import Fault, InputFaults
from system.inputs.toml_table import Table, fault_lines, read_toml
from system.inputs.units import Dimension, QuantityError, parse_quantity

FORMAT = 1
CELLS, FEWEST_CELLS, MOST_CELLS = 6, 2, 24
MOST_REYNOLDS = 2000.0
"""Flows are laminar and steady: what is asked beyond is refused; most passages end earlier by themselves."""
WIDEST = 100.0
"""Ratio of two sizes of a passage, at most: cells across the smaller one stand over the whole mesh."""
Numbers = tuple[float, ...]


class ReferenceKind(Enum):
    """The passages whose flow is solved."""

    STEP = "step"
    GROOVE = "groove"
    ORIFICE = "orifice"
    SLOT = "slot"


@dataclass(frozen=True)
class ReferenceCase:
    """Passages of one kind to be solved at ascending Reynolds numbers u h/nu, `cells` across the passage.

    `text`: of the file.
    """

    name: str
    text: str
    kind: ReferenceKind
    passages: tuple[Passage, ...]
    reynolds: Numbers
    cells: int


def load_reference(path: Path) -> ReferenceCase:
    """The case of a file; raises InputFaults with everything that is wrong with it."""
    text, tables = read_toml(path)
    faults: list[Fault] = []
    root = Table("", tables, faults)
    if (stated := root.get("format")) != FORMAT:
        root.fault("format", "no such key" if stated is None else repr(stated), f"format = {FORMAT}")
    table = root.table("reference", needed="with kind and its sizes") or Table("reference", {}, [])
    root.close()
    kind = table.choice("kind", ReferenceKind) if table.values else None
    reynolds = _listed(table, "reynolds", 0.0, MOST_REYNOLDS)
    cells = table.number("cells", float(CELLS))
    if cells is not None and (cells != int(cells) or not FEWEST_CELLS <= cells <= MOST_CELLS):
        table.fault("cells", f"{cells:g}", f"a whole number from {FEWEST_CELLS} to {MOST_CELLS}")
    passages = _passages(table, kind) if kind else ()
    if kind:
        table.close()
    if faults or kind is None or cells is None:
        raise InputFaults(str(path), faults, fault_lines(text, faults))
    return ReferenceCase(path.stem, text, kind, passages, tuple(sorted(set(reynolds))), int(cells))


def _passages(table: Table, kind: ReferenceKind) -> tuple[Passage, ...]:
    """Every passage of the kind: each value of one key with each of the others."""
    match kind:
        case ReferenceKind.STEP:
            ratios = _listed(table, "film_ratio", 1.0 / WIDEST, WIDEST)
            if 1.0 in ratios:
                table.fault("film_ratio", "1, which is no step", "ratios other than one")
            return tuple(Step(ratio) for ratio in ratios)
        case ReferenceKind.GROOVE:
            deep = _listed(table, "film_ratio", 1.0, WIDEST, above=True)
            wide = _listed(table, "width_ratio", 1.0 / WIDEST, WIDEST)
            return tuple(Groove(*sizes) for sizes in product(deep, wide))
        case ReferenceKind.ORIFICE:
            return tuple(
                Orifice(*sizes) for sizes in product(_sizes(table, "diameter"), *_pipe(table, "diameter"))
            )
        case ReferenceKind.SLOT:
            width = table.positive("width", Dimension.LENGTH) or 1.0
            heights = _sizes(table, "height")
            return tuple(Slot(width, *sizes) for sizes in product(heights, *_pipe(table, "height")))


def _pipe(table: Table, across: str) -> tuple[Numbers, Numbers]:
    """Length in m of the passage and width of the pipes beside it over its own."""
    length = table.positive("length", Dimension.LENGTH) or 1.0
    ratio = table.number("pipe_ratio")
    if ratio is not None and not 1.0 < ratio <= WIDEST:
        table.fault(
            "pipe_ratio", f"{ratio:g}", f"above 1, up to {WIDEST:g}: the pipes' over the passage's {across}"
        )
    return (length,), (ratio or WIDEST,)


def _listed(table: Table, key: str, least: float, most: float, *, above: bool = False) -> Numbers:
    """A bare number or a list of them; faulted where one is no number or outside its range."""
    raw = table.get(key)
    wanted = f"numbers {'above' if above else 'from'} {least:g} to {most:g}"
    if raw is None:
        table.fault(key, "no such key", wanted)
    found = _as_list(raw)
    wrong = [one for one in found if not _fits(one, least, most, above)]
    for one in wrong:
        table.fault(key, repr(one), wanted)
    if raw is not None and not found:
        table.fault(key, "an empty list", wanted)
    return () if wrong else tuple(float(one) for one in found)


def _fits(one: Any, least: float, most: float, above: bool) -> bool:
    """Whether a raw value is a number of a range, its lower end left out where `above`."""
    if isinstance(one, bool) or not isinstance(one, (int, float)):
        return False
    return least <= one <= most and not (above and one == least)


def _sizes(table: Table, key: str) -> Numbers:
    """One length or a list of them, m; faulted where one is none."""
    raw, found = table.get(key), []
    if raw is None:
        table.fault(key, "no such key", "a length with its unit, such as '0.9 mm', or a list of them")
    for one in _as_list(raw):
        try:
            size = parse_quantity(one, Dimension.LENGTH)
        except QuantityError as reason:
            table.fault(key, reason.found, reason.expected, reason.nearest)
            continue
        if size > 0.0:
            found.append(size)
        else:
            table.fault(key, repr(one), "a length above zero")
    return tuple(found)


def _as_list(raw: Any) -> Sequence[Any]:
    return raw if isinstance(raw, list) else [] if raw is None else [raw]
