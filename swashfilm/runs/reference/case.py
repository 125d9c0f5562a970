"""Case file of `swashfilm reference`: kind of passage, its sizes, and Reynolds numbers."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from itertools import product
from pathlib import Path
from typing import Annotated

from swashfilm.runs.reference.passages import GroovePassage, OrificePassage, Passage, SlotPassage, StepPassage
from system.inputs.faults import Fault, InputFaults
from system.inputs.sections.fields import Length, Limits, Positive, Several
from system.inputs.sections.json_schema import Schema, section_schema, tables_schema
from system.inputs.sections.reader import Reading, read_section
from system.inputs.toml_table import Table, fault_lines, read_toml
from system.inputs.units import Dimension

FORMAT = 1
CELLS, FEWEST_CELLS, MOST_CELLS = 6, 2, 24
MOST_REYNOLDS = 2000.0
"""Largest Reynolds number: flows are laminar and steady; most passages have a lower limit of convergence."""
WIDEST = 100.0
"""Largest ratio of two sizes of a passage: the cell size across the smaller one applies to the whole mesh."""
Numbers = tuple[float, ...]
Ratios = Annotated[Numbers, Several(), Limits(least=1.0 / WIDEST, most=WIDEST)]
Sizes = Annotated[Numbers, Several(), Dimension.LENGTH, Positive]


class ReferenceKind(Enum):
    """Kinds of passages."""

    STEP = "step"
    GROOVE = "groove"
    ORIFICE = "orifice"
    SLOT = "slot"


@dataclass(frozen=True, kw_only=True)
class PassageSection:
    """[reference]: a passage whose flow is solved."""

    kind: ReferenceKind
    reynolds: Annotated[Numbers, Several(), Limits(least=0.0, most=MOST_REYNOLDS)]
    cells: Annotated[int, Limits(least=FEWEST_CELLS, most=MOST_CELLS)] = CELLS  # across the passage


@dataclass(frozen=True, kw_only=True)
class StepSection(PassageSection):
    """[reference]: a step of a film."""

    film_ratio: Ratios  # film behind / film before


@dataclass(frozen=True, kw_only=True)
class FilmGrooveSection(PassageSection):
    """[reference]: a groove across a film."""

    film_ratio: Annotated[Numbers, Several(), Limits(above=1.0, most=WIDEST)]  # film in the groove / film
    width_ratio: Ratios  # width of the groove / film


@dataclass(frozen=True, kw_only=True)
class PipeSection(PassageSection):
    """[reference]: a passage between two wider pipes."""

    length: Length
    pipe_ratio: Annotated[float, Limits(above=1.0, most=WIDEST)]  # size of the pipes / size of the passage


@dataclass(frozen=True, kw_only=True)
class OrificeSection(PipeSection):
    """[reference]: a bore."""

    diameter: Sizes


@dataclass(frozen=True, kw_only=True)
class SlotSection(PipeSection):
    """[reference]: a slot, such as a port that begins to open."""

    height: Sizes
    width: Length


SECTIONS: dict[ReferenceKind, type[PassageSection]] = {
    ReferenceKind.STEP: StepSection,
    ReferenceKind.GROOVE: FilmGrooveSection,
    ReferenceKind.ORIFICE: OrificeSection,
    ReferenceKind.SLOT: SlotSection,
}


@dataclass(frozen=True)
class ReferenceCase:
    """Passages of one kind, to be solved at ascending Reynolds numbers u h/nu, with `cells` across the passage.

    `text`: of the file.
    """

    name: str
    text: str
    kind: ReferenceKind
    passages: tuple[Passage, ...]
    reynolds: Numbers
    cells: int


def load_reference(path: Path) -> ReferenceCase:
    """Return the case of a file; raise InputFaults with every fault."""
    text, tables = read_toml(path)
    faults: list[Fault] = []
    root = Table("", tables, faults)
    if (stated := root.get("format")) != FORMAT:
        root.fault("format", "missing" if stated is None else repr(stated), f"format = {FORMAT}")
    table = root.table("reference", needed="with kind and its sizes") or Table("reference", {}, [])
    root.close()
    kind = table.choice("kind", ReferenceKind) if table.values else None
    section = None if kind is None else read_section("reference", SECTIONS[kind], table.values, Reading(faults=faults))
    if isinstance(section, StepSection) and 1.0 in getattr(section, "film_ratio", ()):
        table.fault("film_ratio", "1, which is not a step", "ratios other than one")
    if faults or section is None:
        raise InputFaults(str(path), faults, fault_lines(text, faults))
    reynolds = tuple(sorted(set(section.reynolds)))
    return ReferenceCase(path.stem, text, section.kind, _passages(section), reynolds, section.cells)


def reference_schema() -> Schema:
    """Return the JSON Schema of a reference case: one form of [reference] for each kind."""
    forms = []
    for kind, model in SECTIONS.items():
        form = section_schema(model)
        form["properties"]["kind"] = {"const": kind.value}
        forms.append(form)
    properties = {"format": {"const": FORMAT}, "reference": {"oneOf": forms}}
    return tables_schema("Swashfilm reference", properties, properties)


def _passages(section: PassageSection) -> tuple[Passage, ...]:
    """Return every passage of the kind: each value of one key with each of the others."""
    match section:
        case StepSection(film_ratio=ratios):
            return tuple(StepPassage(ratio) for ratio in ratios)
        case FilmGrooveSection(film_ratio=deep, width_ratio=wide):
            return tuple(GroovePassage(*sizes) for sizes in product(deep, wide))
        case OrificeSection(diameter=diameters, length=length, pipe_ratio=ratio):
            return tuple(OrificePassage(diameter, length, ratio) for diameter in diameters)
        case SlotSection(width=width, height=heights, length=length, pipe_ratio=ratio):
            return tuple(SlotPassage(width, height, length, ratio) for height in heights)
        case _:
            raise TypeError(f"{section.kind} is not a kind of passage")
