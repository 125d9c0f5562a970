"""Case file of `swashfilm reference`: kind of passage, its sizes, and Reynolds numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from itertools import product
from pathlib import Path
from typing import Annotated, Literal, assert_never

from reynolds.errors import InputError
from swashfilm.case.settings import read_set
from swashfilm.runs.reference.passages import GroovePassage, OrificePassage, Passage, SlotPassage, StepPassage
from system.inputs.faults import InputFaults
from system.inputs.sections.fields import Format, Length, Limits, Positive, Several
from system.inputs.sections.json_schema import Schema, file_schema, section_schema
from system.inputs.sections.reader import Reading, read_section
from system.inputs.toml_table import fault_lines
from system.inputs.units import Dimension

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

    kind: Literal[ReferenceKind.STEP]
    film_ratio: Ratios  # film behind / film before

    def __post_init__(self) -> None:
        if 1.0 in self.film_ratio:
            raise InputError("film_ratio", "1, which is not a step", "ratios other than one")


@dataclass(frozen=True, kw_only=True)
class FilmGrooveSection(PassageSection):
    """[reference]: a groove across a film."""

    kind: Literal[ReferenceKind.GROOVE]
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

    kind: Literal[ReferenceKind.ORIFICE]
    diameter: Sizes


@dataclass(frozen=True, kw_only=True)
class SlotSection(PipeSection):
    """[reference]: a slot, such as a port that begins to open."""

    kind: Literal[ReferenceKind.SLOT]
    height: Sizes
    width: Length


Section = StepSection | FilmGrooveSection | OrificeSection | SlotSection


@dataclass(frozen=True, kw_only=True)
class ReferenceFile:
    """A reference case: a passage, one form of [reference] for each kind."""

    format: Annotated[int, Format(1, "reference")]
    reference: Section


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


def load_reference(path: Path, values: Mapping[str, object] | None = None) -> ReferenceCase:
    """Return the case of a file with other `values` of dotted keys; raise InputFaults with every fault."""
    text, tables = read_set(path, values or {})
    reading = Reading()
    section = getattr(read_section("", ReferenceFile, tables, reading), "reference", None)
    if reading.faults or section is None:
        raise InputFaults(str(path), reading.faults, fault_lines(text, reading.faults))
    reynolds = tuple(sorted(set(section.reynolds)))
    return ReferenceCase(path.stem, text, section.kind, _passages(section), reynolds, section.cells)


def reference_schema() -> Schema:
    """Return the JSON Schema of a reference case."""
    return file_schema("Swashfilm reference", section_schema(ReferenceFile))


def _passages(section: Section) -> tuple[Passage, ...]:
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
    assert_never(section)
