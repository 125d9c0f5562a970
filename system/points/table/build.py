"""Building a pump's response table: its box of operating points, and the response learnt from the solved ones."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path

import numpy as np

from gaps.response import Axis, Response, Samples, Spacing
from reynolds.errors import InputError
from reynolds.laws.oil import dynamic_viscosity, temperature_of
from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import content_key
from system.description.keys import key_value
from system.description.pump import PumpDescription
from system.inputs.units import Dimension, format_quantity
from system.points.table.means import MEANINGS, TABLE_FORMAT, mean_ratios, measured_outputs
from system.points.table.point import table_point
from system.points.table.pump_numbers import numbers_error, pump_numbers
from system.points.table.response_table import (
    INPUTS,
    PRESSURE,
    RATIO,
    SPEED,
    VISCOSITY,
    Failed,
    ResponseTable,
    TableOrigin,
)
from system.points.table.sources import PointSolver, films_alone
from system.points.table.store import KEY_LENGTH, keep_table, pump_key
from system.pump.chamber_kinds import kinds
from system.pump.operating import OperatingPoint, operating_point
from system.pump_file.file import Variant, varied
from system.work.processes import HERE
from system.work.progress import Report, silent
from system.work.sampled_points import SampledPoint, points_of, samples_of, solved_points, tables_folder
from system.work.tasks import Executor

SPEEDS = (0.2, 1.2)
"""Of the rated speed: the default box."""
PRESSURES = (0.05, 1.15)
"""Of the rated pressure, the lower one beyond inlet and case."""
RATIOS = (0.1, 1.0)
TEMPERATURES = (293.15, 373.15)
"""K: 20 .. 100 degC, as viscosities of the pump's oil."""

Range = tuple[float, float]


@dataclass(frozen=True)
class TableCase:
    """A table to build: a pump, the solver of its points, the box, numbers of learnt and held-out points.

    INPUTS without an axis are held at the pump's own operating point; axes beside INPUTS are dimensions of the pump by
    their path. A `SamplingTask`.
    """

    pump: PumpDescription
    solver: PointSolver
    axes: tuple[Axis, ...]
    learnt: int
    held_out: int

    @property
    def held(self) -> dict[str, float]:
        """The inputs that are held, SI."""
        varied, point = {axis.name for axis in self.axes}, operating_point(self.pump)
        return {name: getattr(point, name) for name in INPUTS if name not in varied}

    @property
    def dimensions(self) -> dict[str, float]:
        """The dimensions with an axis, as the pump states them, SI."""
        return {axis.name: key_value(self.pump, axis.name) for axis in self.axes if axis.name not in INPUTS}

    def key(self, x: Array) -> str:
        """Name of a point's content: the pump, the solver with its inputs, the format, the place."""
        solver, point = self.solver, point_at(self, x)
        place = np.array([getattr(point, name) for name in INPUTS])
        # The stated pump with the values beside it: a place without a possible pump has a name too.
        made_by = pump_key(self.pump), TABLE_FORMAT, solver.source.value, sorted(solver.stated.items())
        return content_key(*made_by, place, *_variant(self, x))

    def solve(self, x: Array) -> Array:
        """The gaps' means over the turn, by their ratios to the lumped law; after them the pump's numbers.

        Raises as the solver, InputFaults where no pump has the dimensions, ValueError where chambers differ.
        """
        kinds(self.pump).hold_alike()
        pump = films_alone(pump_at(self, x))
        solved = self.solver.solve(pump, point_at(self, x))
        return np.concatenate([mean_ratios(pump, solved), pump_numbers(solved.pump_point)])


def dimension_axis(path: str, low: float, high: float) -> Axis:
    """The axis of a pump's dimension, SI; raises InputError for ends in the wrong order."""
    return Axis(path, low, high, Spacing.LOGARITHMIC if low > 0.0 else Spacing.LINEAR)


def table_axes(
    pump: PumpDescription,
    speeds: Range | None = None,
    pressures: Range | None = None,
    ratios: Range | None = None,
    temperatures: Range | None = None,
    held: Collection[str] = (),
) -> tuple[Axis, ...]:
    """The box of a pump's table, SI, with temperatures for the viscosities of its oil, without the inputs `held`.

    None: the default, from the rating (SPEEDS, PRESSURES) or as RATIOS and TEMPERATURES. Raises InputError for an empty
    range, where the oil's law is not valid, and where no pump runs: a delivery pressure that is not above inlet and
    case, a displacement ratio above 1.
    """
    rated = pump.pump
    low, high = speeds or (SPEEDS[0] * rated.rated_speed, SPEEDS[1] * rated.rated_speed)
    cold, hot = temperatures or TEMPERATURES
    thin, thick = (dynamic_viscosity(pump.oil.fluid, at) for at in (hot, cold))
    floor = max(pump.operating.inlet_pressure, pump.operating.case_pressure)
    if pressures and pressures[0] <= floor:
        found, least = (format_quantity(value, Dimension.PRESSURE, digits=4) for value in (pressures[0], floor))
        raise InputError("range of delivery pressure", f"from {found}", f"more than inlet and case, {least}")
    if ratios and ratios[1] > 1.0:
        raise InputError("range of displacement ratio", f"to {ratios[1]:g}", "at most 1")
    lowest = max(floor, 0.0) + PRESSURES[0] * rated.rated_pressure
    box = (
        Axis(SPEED, low, high, Spacing.LOGARITHMIC),
        Axis(PRESSURE, *(pressures or (lowest, PRESSURES[1] * rated.rated_pressure)), Spacing.LOGARITHMIC),
        Axis(RATIO, *(ratios or RATIOS), Spacing.LOGARITHMIC),
        Axis(VISCOSITY, thin, thick, Spacing.LOGARITHMIC),
    )
    return tuple(axis for axis in box if axis.name not in held)


def build_table(
    case: TableCase, *, executor: Executor = HERE, report: Report = silent, folder: Path | None = None
) -> ResponseTable:
    """The table of a case, kept in the cache; its points as `solved_points`.

    Held-out points are also run by the table, for its error in the pump's numbers. Raises NotConverged where too
    few points have a result, and as `table_point`.
    """
    found = solved_points(case, executor=executor, report=report, folder=folder)
    (learnt, _), (held_out, numbers) = (_parted(samples) for samples in samples_of(case, found))
    outputs = measured_outputs(np.concatenate([learnt.values, held_out.values]))
    table = ResponseTable(_origin(case, found), Response(case.axes, outputs, learnt, held_out))
    predicted = [
        pump_numbers(table_point(films_alone(pump_at(case, x)), point_at(case, x), table).pump_point)
        for x in held_out.points
    ]
    table = replace(table, numbers=numbers_error(np.array(predicted), numbers))
    keep_table(table, tables_folder(folder) / f"{table.origin.pump_key}-{case_key(case)}")
    return table


def _parted(samples: Samples) -> tuple[Samples, Array]:
    """Samples of the outputs alone, and the pump's numbers (n, r) there."""
    count = len(MEANINGS)
    return Samples(samples.points, samples.values[:, :count]), samples.values[:, count:]


def point_at(case: TableCase, x: Array) -> OperatingPoint:
    """The operating point of a place (d,) in the box: at the temperature at which the oil has its viscosity."""
    stated = {axis.name: float(value) for axis, value in zip(case.axes, x, strict=True) if axis.name in INPUTS}
    if VISCOSITY in stated:
        stated["temperature"] = temperature_of(case.pump.oil.fluid, stated[VISCOSITY])
    return replace(operating_point(case.pump), **stated)


def pump_at(case: TableCase, x: Array) -> PumpDescription:
    """The pump of a place (d,) in the box; raises InputFaults where no pump has its dimensions."""
    variant = _variant(case, x)
    return varied(case.pump, variant) if variant else case.pump


def _variant(case: TableCase, x: Array) -> Variant:
    """The dimensions of a place."""
    return tuple((axis.name, float(value)) for axis, value in zip(case.axes, x, strict=True) if axis.name not in INPUTS)


def case_key(case: TableCase) -> str:
    """Name of a case among those of its pump."""
    source = case.solver.source.value, sorted(case.solver.stated.items())
    return content_key(*source, case.axes, sorted(case.held.items()), case.learnt, case.held_out)[:KEY_LENGTH]


def _origin(case: TableCase, found: Sequence[SampledPoint]) -> TableOrigin:
    points = points_of(case)
    failed = (Failed(tuple(map(float, points[one.index])), one.reason) for one in found if one.reason)
    return TableOrigin(
        pump=case.pump.name,
        pump_key=pump_key(case.pump),
        source=case.solver.source,
        stated=dict(case.solver.stated),
        package=version("swashfilm"),
        inlet_pressure=case.pump.operating.inlet_pressure,
        case_pressure=case.pump.operating.case_pressure,
        held=case.held,
        dimensions=case.dimensions,
        failed=tuple(failed),
        seconds=float(np.mean([solved.seconds for solved in found])),
    )
