"""Tables, data set, chosen pump of an optimisation's run folder, and in compare/ that pump beside the start."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.output.data.files import write_netcdf
from swashfilm.output.tables import write_csv
from swashfilm.runs.compare.run import Side, run_compare
from swashfilm.runs.map.duty.cycle_file import read_cycle
from swashfilm.runs.variation.case import VariedCase
from swashfilm.runs.variation.words import key_unit
from system.description.pump import PumpDescription
from system.maps.data import MapData, map_data
from system.maps.point import columns
from system.pump_file.file import Variant, varied
from system.variation.measures import NUMBERS
from system.variation.optimisation.optimum import Optimisation
from system.variation.optimisation.problem import Design
from system.work.tasks import PartOutcome, PartStatus

DATA, DESIGNS, PARETO, CHOSEN, BESIDE = "results.nc", "designs.csv", "pareto.csv", "chosen.toml", "compare"


def write_designs(folder: Path, found: Optimisation) -> None:
    """Write designs.csv, all designs, and pareto.csv, those of the Pareto set in the order of the first objective."""
    designs, feasible = found.designs, found.problem.feasible(found.designs)
    heads = [*(f"{one.name} [{key_unit(one.key)[0]}]" for one in found.problem.space),
             *(f"{one.name} [{one.shown}]" for one in found.problem.measures)]  # fmt: skip
    members = {at: row for row, at in enumerate(found.pareto.members, start=1)}
    rows = [
        [str(at), str(one.generation), one.status.value, "yes" if feasible[at - 1] else "no", *_cells(found, one),
         one.reason]
        for at, one in enumerate(designs, start=1)
    ]  # fmt: skip
    write_csv(folder / DESIGNS, ["design", "generation", "status", "feasible", *heads, "reason"], rows)
    chosen = [[str(row), str(at + 1), *_cells(found, designs[at])] for at, row in members.items()]
    write_csv(folder / PARETO, ["row", "design", *heads], chosen)


def _cells(found: Optimisation, design: Design) -> list[str]:
    """Return dimensions and measures of a design in the units that people read; measures empty without a result."""
    values = dict(found.problem.variant(design.place))
    own = [f"{values[one.name] * key_unit(one.key)[1]:.8g}" for one in found.problem.space]
    if not design.solved:
        return own + [""] * len(found.problem.measures)
    return own + [f"{one.read(value):.8g}" for one, value in zip(found.problem.measures, design.numbers, strict=True)]


def chosen_pump(pump: PumpDescription, variant: Variant) -> PumpDescription:
    """Return the pump with the values of a design, and a name of its own."""
    return replace(varied(pump, variant), name=f"{pump.name}-chosen")


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


def write_data(path: Path, case: VariedCase, found: Optimisation) -> None:
    """Write dimensions and measures of all designs and of the start, the Pareto set and its growth; SI."""
    import xarray

    problem, designs = found.problem, found.designs
    points = case.work.sites.points
    inputs: Mapping[str, Any] = {name: ("point", [getattr(one, name) for one in points]) for name in vars(points[0])}
    values = np.array([[dict(problem.variant(one.place))[own.name] for own in problem.space] for one in designs])
    start = [one.key.value for one in problem.space]
    data = xarray.Dataset(
        {
            "dimension": (("design", "key"), values.reshape(len(designs), len(problem.space))),
            "value": (("design", "measure"), _stacked(designs, "numbers", (len(problem.measures),))),
            "number": (("design", "point", "name"), _stacked(designs, "at_sites", (len(points), len(NUMBERS)))),
            "generation": ("design", [one.generation for one in designs]),
            "feasible": ("design", problem.feasible(designs).astype(int)),
            "pareto": ("design", [int(at in found.pareto.members) for at in range(len(designs))]),
            "start_dimension": ("key", start),
            "start_value": ("measure", found.start.numbers),
            "start_number": (("point", "name"), found.start.at_sites),
            "growth": ("generation_number", found.pareto.growth),
            "weight": ("point", case.work.sites.weights),
            **inputs,
        },
        coords={
            "key": [one.name for one in problem.space],
            "measure": [one.name for one in problem.measures],
            "name": list(NUMBERS),
        },
        attrs={"pump": case.pump.name, "units": "SI", "fidelity": case.fidelity.value},
    )
    for name in ("dimension", "value", "number", "start_dimension", "start_value", "start_number"):
        data[name].attrs["units"] = "SI of each"
    write_netcdf(data, path, "optimisation")


def _stacked(designs: Sequence[Design], part: str, shape: tuple[int, ...]) -> Any:
    """Return a part of all designs, nan for those without a result."""
    return np.stack([getattr(one, part) if one.solved else np.full(shape, np.nan) for one in designs])
