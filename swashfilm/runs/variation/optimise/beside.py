"""The chosen design beside the start: a run folder of `swashfilm compare` inside that of the optimisation."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from swashfilm.runs.compare.run import Side, run_compare
from swashfilm.runs.map.duty.cycle_file import read_cycle
from swashfilm.runs.variation.case import VariedCase
from swashfilm.runs.variation.optimise.files import CHOSEN
from system.description.pump import PumpDescription
from system.maps.data import MapData, map_data
from system.maps.point import columns
from system.variation.optimisation.problem import Design
from system.work.tasks import PartOutcome, PartStatus

BESIDE = "compare"


def write_beside(folder: Path, case: VariedCase, start: Design, pump: PumpDescription, chosen: Design) -> None:
    """Write the folder compare/: start (A) and chosen design (B), a pump, at the points and over the cycle."""
    place = folder / BESIDE
    place.mkdir()
    one = Side("resolved.toml", design_map(case, case.pump, start), None)
    other = Side(CHOSEN, design_map(case, pump, chosen), None)
    cycle = None if case.cycle is None else read_cycle(case.cycle, case.plan.axes)
    run_compare((one, other), cycle, place)


def design_map(case: VariedCase, pump: PumpDescription, design: Design) -> MapData:
    """Return the numbers of a design, a pump, at the operating points as a map."""
    heads = [f"{column} [{unit}]" for column, unit, _ in columns()]
    records = [{"numbers": dict(zip(heads, row, strict=True)), "warnings": remarks} for row, remarks in design.of_map]
    found = [PartOutcome("", PartStatus.SOLVED, "", record, 0.0, "") for record in records]
    return map_data(replace(case.plan, pump=pump), case.work.solver.words, tuple(found))
