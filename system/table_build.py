"""Building a response table: a box of inputs, its points solved and kept one by one, what they teach."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from importlib.metadata import version
from pathlib import Path

import numpy as np

from gaps.response import Axis, Response, Samples, Spacing, held_out_points, learnt_points
from reynolds.bodies.cache import content_key, kept
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.mesh import Array
from reynolds.oil import dynamic_viscosity, temperature_of
from system.description import PumpDescription
from system.errors import NotConverged
from system.gap_cycle import Report, silent
from system.operating import OperatingPoint
from system.response_tables import (
    PRESSURE,
    RATIO,
    SPEED,
    VISCOSITY,
    Failed,
    Origin,
    ResponseTable,
)
from system.side_by_side import side_by_side
from system.table_means import MEANINGS, TABLE_FORMAT, mean_ratios, measured_outputs
from system.table_sources import PointSolver, with_held_ports
from system.table_store import KEY_LENGTH, keep_table, pump_key, tables_folder
from system.units import Dimension, format_quantity

LEARNT, HELD_OUT = 120, 30
FEWEST_LEARNT, FEWEST_HELD_OUT = 16, 2
SPEEDS = (0.2, 1.2)
"""Of the rated speed: the box where nothing else is stated."""
PRESSURES = (0.05, 1.15)
"""Of the rated pressure, the lower one beyond inlet and case."""
RATIOS = (0.1, 1.0)
TEMPERATURES = (293.15, 373.15)
"""K: 20 .. 100 degC, as viscosities of the pump's oil."""

Range = tuple[float, float]


@dataclass(frozen=True)
class TableCase:
    """What to condense: a pump, who solves its points, the box, how many points to learn from and to hold out."""

    pump: PumpDescription
    solver: PointSolver
    axes: tuple[Axis, ...]
    learnt: int = LEARNT
    held_out: int = HELD_OUT

    @property
    def points(self) -> Array:
        """All points (n, 4), the learnt ones first."""
        learnt = learnt_points(self.axes, self.learnt)
        return np.concatenate([learnt, held_out_points(self.axes, self.learnt, self.held_out)])


@dataclass(frozen=True)
class Solved:
    """What a point gave: where it stands among the case's, its outputs or why there are none, seconds it took."""

    index: int
    means: Array | None
    reason: str
    seconds: float


def table_axes(
    pump: PumpDescription,
    speeds: Range | None = None,
    pressures: Range | None = None,
    ratios: Range | None = None,
    temperatures: Range | None = None,
) -> tuple[Axis, ...]:
    """The box of a pump's table, SI, temperatures standing for the viscosities of its oil.

    What is None is taken from the rating (SPEEDS, PRESSURES) or as RATIOS and TEMPERATURES. Raises FilmInputError
    for a range that is none, where the oil's law is void, and where no pump is: a delivery pressure that is not
    above inlet and case, a displacement ratio above 1.
    """
    rated = pump.pump
    low, high = speeds or (SPEEDS[0] * rated.rated_speed, SPEEDS[1] * rated.rated_speed)
    cold, hot = temperatures or TEMPERATURES
    floor = max(pump.operating.inlet_pressure, pump.operating.case_pressure)
    if pressures and pressures[0] <= floor:
        found, least = (format_quantity(value, Dimension.PRESSURE, digits=4) for value in (pressures[0], floor))
        raise FilmInputError("range of delivery pressure", f"from {found}", f"more than inlet and case, {least}")
    if ratios and ratios[1] > 1.0:
        raise FilmInputError("range of displacement ratio", f"to {ratios[1]:g}", "at most 1")
    lowest = max(floor, 0.0) + PRESSURES[0] * rated.rated_pressure
    return (
        Axis(SPEED, low, high, Spacing.LOGARITHMIC),
        Axis(PRESSURE, *(pressures or (lowest, PRESSURES[1] * rated.rated_pressure)), Spacing.LOGARITHMIC),
        Axis(RATIO, *(ratios or RATIOS), Spacing.LOGARITHMIC),
        Axis(
            VISCOSITY,
            dynamic_viscosity(pump.oil.fluid, hot),
            dynamic_viscosity(pump.oil.fluid, cold),
            Spacing.LOGARITHMIC,
        ),
    )


def build_table(
    case: TableCase, *, workers: int = 1, report: Report = silent, folder: Path | None = None
) -> ResponseTable:
    """The table of a case, kept in the cache; points that are kept there already are not solved again.

    Interrupted, it goes on where it was at the next call. Raises NotConverged where too few points have a result.
    """
    points, key = case.points, pump_key(case.pump)
    place = tables_folder(folder) / "points"
    task = partial(solve_point, case, place)
    parts = list(enumerate(points))
    known = [(k, x) for k, x in parts if (place / f"{point_key(case, x)}.npz").is_file()]
    found = {k: task((k, x)) for k, x in known}
    todo = [(k, x) for k, x in parts if k not in found]
    report(0, len(todo), f"{len(known)} points kept" if known else "solving")
    for done, solved in enumerate(side_by_side(task, todo, workers), start=1):
        found[solved.index] = solved
        report(done, len(todo), "point failed" if solved.reason else "point solved")
    table = ResponseTable(_origin(case, key, points, found), _response(case, points, found))
    keep_table(table, tables_folder(folder) / f"{key}-{case_key(case)}")
    return table


def solve_point(case: TableCase, folder: Path, part: tuple[int, Array]) -> Solved:
    """A point of a case by its index and place, solved and kept in `folder`, or taken from there.

    One that does not converge, or leaves the range of a law, says why and is tried again the next time.
    """
    index, x = part
    began = time.process_time()
    try:
        arrays = kept(point_key(case, x), partial(_solve, case, x), folder).arrays
    except (NotConverged, FilmNotConverged, FilmInputError) as fault:
        return Solved(index, None, str(fault), time.process_time() - began)
    return Solved(index, arrays["means"], "", float(arrays["seconds"]))


def _solve(case: TableCase, x: Array) -> Mapping[str, Array]:
    began = time.process_time()
    held = with_held_ports(case.pump)
    means = mean_ratios(held, case.solver.solve(held, point_at(case.pump, x)))
    return {"means": means, "seconds": np.array(time.process_time() - began)}


def point_at(pump: PumpDescription, x: Array) -> OperatingPoint:
    """The operating point of a place (4,) in the box: at the temperature at which the oil has its viscosity."""
    speed, pressure, ratio, viscosity = (float(value) for value in x)
    return OperatingPoint(
        shaft_speed=speed,
        delivery_pressure=pressure,
        inlet_pressure=pump.operating.inlet_pressure,
        case_pressure=pump.operating.case_pressure,
        displacement_ratio=ratio,
        temperature=temperature_of(pump.oil.fluid, viscosity),
        viscosity=viscosity,
    )


def point_key(case: TableCase, x: Array) -> str:
    """Name of a point's content: the pump, the solver with what it states, the format, the place."""
    solver = case.solver
    return content_key(pump_key(case.pump), TABLE_FORMAT, solver.source.value, sorted(solver.stated.items()), x)


def case_key(case: TableCase) -> str:
    """Name of a case among those of its pump."""
    content = (case.solver.source.value, sorted(case.solver.stated.items()), case.axes, case.learnt, case.held_out)
    return content_key(*content)[:KEY_LENGTH]


def _origin(case: TableCase, key: str, points: Array, found: Mapping[int, Solved]) -> Origin:
    failed = (Failed(tuple(map(float, points[k])), found[k].reason) for k in sorted(found) if found[k].reason)
    return Origin(
        pump=case.pump.name,
        pump_key=key,
        source=case.solver.source,
        stated=dict(case.solver.stated),
        package=version("swashfilm"),
        inlet_pressure=case.pump.operating.inlet_pressure,
        case_pressure=case.pump.operating.case_pressure,
        failed=tuple(failed),
        seconds=float(np.mean([solved.seconds for solved in found.values()])),
    )


def _response(case: TableCase, points: Array, found: Mapping[int, Solved]) -> Response:
    """Learnt and held-out points that have a result."""

    def samples(indices: range) -> Samples:
        good = [k for k in indices if found[k].means is not None]
        values = np.array([found[k].means for k in good]).reshape(-1, len(MEANINGS))
        return Samples(points[good], values)

    learnt, held_out = samples(range(case.learnt)), samples(range(case.learnt, len(points)))
    if len(learnt.points) < FEWEST_LEARNT or len(held_out.points) < FEWEST_HELD_OUT:
        reasons = [solved.reason for solved in found.values() if solved.reason]
        raise NotConverged(
            f"response table: {len(reasons)} of {len(points)} points have no result, expected {FEWEST_LEARNT} to "
            f"learn from and {FEWEST_HELD_OUT} held out; the first: {reasons[0]}; try a smaller box"
        )
    outputs = measured_outputs(np.concatenate([learnt.values, held_out.values]))
    return Response(case.axes, outputs, learnt, held_out)
