"""Run of an operating map: points solved and stored one by one, then tables, pictures and page."""

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.console.assumed import scaled_warning
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.schemas import write_new
from swashfilm.output.run_folder import write_json
from swashfilm.runs.map.files import write_map, write_tables
from swashfilm.runs.map.summary import map_summary
from system.description.assumptions import Assumption
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults
from system.maps.data import MapData, map_data
from system.maps.interpolation import CHECKED, MapError, MapInterpolant, check_points, fresh_error, left_out_error
from system.maps.plan import MapInput, MapPlan, point_words
from system.maps.point import DirectSolver, LumpedSolver, MapSolver, MapWork, TableSolver, columns
from system.points.floating_gaps import FloatingOptions
from system.points.table.build import TableCase, build_table, table_axes
from system.points.table.response_table import PRESSURE, RATIO, SPEED, VISCOSITY, ResponseTable, point_text
from system.points.table.sources import PointSolver, Source, solver_of
from system.points.table.store import find_table, own_table
from system.pump.operating import OperatingPoint
from system.pump_file.file import resolved_toml
from system.work.kept_results import POINTS, KeptOutcomes, KeptPoints, points_of_run, run_kept
from system.work.progress import Report
from system.work.sampled_points import usual_counts
from system.work.tasks import Executor, PartOutcome, PartStatus

POINT_COST = {Fidelity.FIXED: 2.0, Fidelity.FLOATING: 60.0}
"""Approximate processor time of a point whose films are solved, s (`swashfilm map ref90 --direct`)."""
CLOSED_COST = {Fidelity.LUMPED: LumpedSolver.cost, Fidelity.TABLE: TableSolver.cost}
"""The same of a point without solved films."""
FEW_CHECKED = 8
"""Fresh points of a map whose points cost much, where an axis has two levels: at most, and no more than its own."""
START = 4.0
"""Seconds to start another process: each one must have more work."""
ROW = 7
"""Points of a map that are solved one after the other, each started from its neighbour's films."""
PART = 0.2
"""Least seconds of work in a batch, for which the data sent with it are negligible."""


@dataclass(frozen=True)
class MapCase:
    """A map to solve: plan, fidelity, pump file as text, number of fresh points (None: default), earlier run.

    assumptions: for the values that the pump file leaves out.
    """

    plan: MapPlan
    fidelity: Fidelity
    given: str = ""
    table: Path | None = None
    direct: bool = False
    checks: int | None = None
    resume: Path | None = None
    floating: FloatingOptions = field(default_factory=FloatingOptions)
    assumptions: tuple[Assumption, ...] = ()

    @property
    def cost(self) -> float:
        """Approximate processor time, s."""
        return self.point_seconds * (sum(self.table_points) if self.by_table else self.plan.size + self.fresh)

    @property
    def fresh(self) -> int:
        """Number of fresh points that measure the error between levels: as stated, or many where they cost little.

        Else few where an axis has two levels, which do not measure it, and none where the levels themselves do.
        """
        if self.checks is not None:
            return self.checks
        if self.by_table or self.fidelity in CLOSED_COST:
            return CHECKED
        return min(FEW_CHECKED, self.plan.size) if any(len(axis.values) == 2 for axis in self.plan.axes) else 0

    @property
    def point_seconds(self) -> float:
        """Approximate processor time of one solved point, s."""
        return (POINT_COST | CLOSED_COST)[self.fidelity]

    @property
    def points_words(self) -> str:
        """The points to solve, in words."""
        own = f"{self.plan.size} {self.fidelity.value} points"
        return f"{own} by a table of {sum(self.table_points)} solved ones" if self.by_table else own

    @property
    def by_table(self) -> bool:
        """True if points are those of a response table that is built first: it needs fewer than the map."""
        solves = self.fidelity in POINT_COST and bool(self.varied) and not self.direct
        return solves and sum(self.table_points) < self.plan.size

    @property
    def table_points(self) -> tuple[int, int]:
        """Points that a table over the plan's box learns, and that measure its error."""
        return usual_counts(len(self.varied))

    @cached_property
    def varied(self) -> frozenset[MapInput]:
        """Inputs of several levels."""
        return frozenset(axis.input for axis in self.plan.axes if len(axis.values) > 1)


def worth_starting(asked: MapCase, wanted: int) -> int:
    """Return the number of processes, at most `wanted`, that have enough work to justify their start."""
    return max(1, min(wanted, math.floor(asked.cost / START)))


def run_map(asked: MapCase, folder: Path, executor: Executor, report: Report) -> dict[str, Any]:
    """Write the files of `solve_map` and the page; return the summary. Raises as `solve_map`."""
    summary = solve_map(asked, folder, executor, report)
    from swashfilm.runs.map.page import write_map_page

    write_map_page(folder)
    return summary


def solve_map(asked: MapCase, folder: Path, executor: Executor, report: Report) -> dict[str, Any]:
    """Solve a map's points and write points/, map.nc, map.csv, shares.csv, best.csv and summary.json.

    Returns the summary. A point that fails carries its reason. Raises InputFaults where the earlier run has no
    points or no table holds all of them, and as `build_table`.
    """
    began, plan = time.monotonic(), asked.plan
    (folder / "input.toml").write_text(asked.given, encoding="utf-8")
    write_new(folder / "resolved.toml", "pump", resolved_toml(plan.pump))
    solver = _solver(asked, executor, report)
    work = MapWork(plan.pump, solver)
    fresh, size = check_points(plan, asked.fresh), plan.size
    kept = _solved(work, (*plan.points, *fresh), asked.resume, folder, executor, report)
    report(len(kept.outcomes), len(kept.outcomes), "writing the map and its pictures")
    data = map_data(plan, solver.words, kept.outcomes[:size])
    error = _error(data, fresh, kept.outcomes[size:])
    summary = map_summary(plan, work, data, kept, error, fresh) | {
        "workers": executor.workers,
        "wall_s": time.monotonic() - began,
    }
    summary["assumptions"] += map(str, asked.assumptions)
    summary["warnings"] += scaled_warning(asked.assumptions)
    write_map(folder / "map.nc", data, error, summary | {"resolved_toml": resolved_toml(plan.pump)})
    write_tables(folder, data)
    write_json(folder / "summary.json", summary)
    return summary


def _solved(
    work: MapWork,
    points: tuple[OperatingPoint, ...],
    resume: Path | None,
    folder: Path,
    executor: Executor,
    report: Report,
) -> KeptOutcomes:
    """Return the outcomes of all points; each one is written to points/ as soon as it is solved."""
    store, earlier = KeptPoints(folder / POINTS), points_of_run(resume) if resume else None
    order, batch = list(range(len(points))), max(1, round(PART / work.solver.cost))
    if isinstance(work.solver, DirectSolver) and work.solver.solver.source is Source.FLOATING:
        order.sort(key=lambda k: _place_in_rows(points[k]))
        batch = ROW
    kept = run_kept(
        work, [points[k] for k in order], store, executor, earlier=earlier, batch=batch, described=_progress_text,
        report=report,
    )  # fmt: skip
    outcomes = dict(zip(order, kept.outcomes, strict=True))
    return KeptOutcomes(tuple(outcomes[k] for k in range(len(points))), kept.known)


def _place_in_rows(point: OperatingPoint) -> tuple[float, ...]:
    """Sort key of a point: rows along the pressure, from the highest, at equal other inputs."""
    held = point.shaft_speed, point.displacement_ratio, point.temperature, point.inlet_pressure
    return *held, -point.delivery_pressure


def _progress_text(point: OperatingPoint, outcome: PartOutcome) -> str:
    return f"{point_words(point)}: {outcome.status.value}"


def _solver(asked: MapCase, executor: Executor, report: Report) -> MapSolver:
    """Return the solver of the points; a table of films is built first, over the box of the plan."""
    match asked.fidelity:
        case Fidelity.LUMPED:
            return LumpedSolver()
        case Fidelity.TABLE:
            return TableSolver(kept_table(asked))
    solver = solver_of(Source(asked.fidelity.value), asked.floating)
    if not asked.by_table:
        return DirectSolver(solver, POINT_COST[asked.fidelity])
    return TableSolver(build_table(_table_case(asked, solver), executor=executor, report=report))


def _table_case(asked: MapCase, solver: PointSolver) -> TableCase:
    """Return the response table over a plan's box; inputs with one level are constant."""
    plan = asked.plan
    pump, ends = at_levels(plan), {axis.input: (axis.values[0], axis.values[-1]) for axis in plan.axes}
    names = {MapInput.SPEED: SPEED, MapInput.PRESSURE: PRESSURE, MapInput.RATIO: RATIO, MapInput.TEMPERATURE: VISCOSITY}
    held = [name for given, name in names.items() if ends[given][0] == ends[given][1]]
    speeds, pressures, ratios, temperatures = (None if name in held else ends[given] for given, name in names.items())
    axes = table_axes(pump, speeds, pressures, ratios, temperatures, held)
    return TableCase(pump, solver, axes, *asked.table_points)


def at_levels(plan: MapPlan) -> PumpDescription:
    """Return the pump with the plan's first level of every input as its operating point."""
    first = plan.points[0]
    own = replace(
        plan.pump.operating,
        speed=first.shaft_speed,
        pressure=first.delivery_pressure,
        displacement_ratio=first.displacement_ratio,
        temperature=first.temperature,
        inlet_pressure=first.inlet_pressure,
    )
    return replace(plan.pump, operating=own)


def kept_table(asked: MapCase) -> ResponseTable:
    """Return the table of a file, or a stored one; raise InputFaults where it does not contain all points."""
    plan, pump = asked.plan, at_levels(asked.plan)
    middle = plan.points[len(plan.points) // 2]
    table = own_table(asked.table, pump) if asked.table else find_table(pump, middle)
    out = [point for point in plan.points if not table.holds(pump, point)]
    if out:
        found = f"{len(out)} of {plan.size} points outside its box, the first: {point_text(out[0])}"
        raise InputFaults("response table", [Fault("--table", found, "a table whose box contains the whole map")])
    return table


def _error(data: MapData, fresh: tuple[OperatingPoint, ...], found: tuple[PartOutcome, ...]) -> MapError | None:
    """Return the error of the map between its levels, by fresh points or, without them, by its own levels."""
    if not np.all(data.solved):
        return None
    good = [k for k, outcome in enumerate(found) if outcome.status is PartStatus.SOLVED]
    if not good:
        return left_out_error(data)
    rows: list[Mapping[str, float]] = [found[k].record["numbers"] for k in good]
    numbers = {column: np.array([row[f"{column} [{unit}]"] for row in rows]) for column, unit, _ in columns()}
    return fresh_error(MapInterpolant(data), [fresh[k] for k in good], numbers)
