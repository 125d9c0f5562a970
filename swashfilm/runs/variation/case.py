"""A pump to vary, by a command line: its work at its operating points, and its dimensions."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from swashfilm.console.assumed import scaled_warning
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.floating_options import alike_faults, floating_faults, floating_options
from swashfilm.console.inputs import COMMAND_LINE, expect, given_text
from swashfilm.console.settings import set_values
from swashfilm.runs.map.command import set_beside_levels, solving_faults, stated_axes, with_usual
from swashfilm.runs.map.duty.cycle_file import read_cycle
from swashfilm.runs.map.run import POINT_COST, MapCase, kept_table
from swashfilm.runs.variation.options import chosen_keys, needs_keys
from system.description.assumptions import Assumption
from system.description.keys import PumpKey, pump_keys
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults
from system.maps.plan import MapAxis, MapInput, MapPlan, map_plan
from system.maps.point import DirectSolver, LumpedSolver, MapSolver, TableSolver
from system.points.floating_gaps import FloatingOptions
from system.points.table.response_table import ResponseTable
from system.points.table.sources import Source, solver_of
from system.pump_file.file import KnownPump, load_known_pump
from system.variation.sites import Sites, cycle_sites, plan_sites
from system.variation.solving import VariedWork, variable_keys
from system.variation.together import TogetherSolver, solves_together

CYCLE_LEVELS = {MapInput.PRESSURE: 5}
"""Levels of an input that a duty cycle varies and no option states; four of the others."""


@dataclass(frozen=True)
class VariedCase:
    """A pump to vary: the work, the chosen dimensions, the plan and the text of its file; fixed: dimensions that the
    fidelity cannot vary; assumptions: for the values that its file leaves out."""

    work: VariedWork
    keys: Mapping[str, PumpKey]
    fixed: tuple[str, ...]
    fidelity: Fidelity
    plan: MapPlan
    given: str
    cycle: Path | None
    resume: Path | None
    assumptions: tuple[Assumption, ...]

    @property
    def pump(self) -> PumpDescription:
        """The pump as stated."""
        return self.work.pump

    @property
    def input_warnings(self) -> tuple[str, ...]:
        """Warnings of the operating points, such as of those beyond the pump's rating, and of values not stated."""
        return *self.plan.checked().warnings.values(), *scaled_warning(self.assumptions)

    def seconds(self, pumps: int) -> float:
        """Return the processor time (s), about, of so many pumps."""
        return pumps * self.work.solver.cost * len(self.work.sites.points)


def no_faults(pump: PumpDescription, table: ResponseTable | None) -> Sequence[Fault]:
    """Return no fault: the command has no further requirement."""
    return ()


def varied_case(
    options: argparse.Namespace,
    more: Sequence[Fault] = (),
    of_pump: Callable[[PumpDescription, ResponseTable | None], Sequence[Fault]] = no_faults,
    *,
    together: bool = False,
) -> VariedCase:
    """Return the pump to vary; raise InputFaults with every fault, those of the command itself (`more`) and those
    that it finds in the pump and the response table of this fidelity (`of_pump`) too.

    together: lumped points of a pump are solved at once, without its course over the turn.
    """
    faults = [*solving_faults(options), *more]
    set_keys = set_values(options.set, faults)
    own_axes = stated_axes(options, faults)
    expect(options.pump, "pump", "film")
    stated_pump = _stated_pump(options, set_keys, faults)
    pump = stated_pump.pump
    axes = with_usual(options.plan, pump, own_axes)
    axes = axes if options.cycle is None else cycle_axes(pump, axes, options.cycle)
    plan = map_plan(pump, axes)
    faults += [*set_beside_levels(set_keys, axes), *plan.checked().faults, *alike_faults(pump)]
    by_table = options.fidelity == Fidelity.TABLE.value and not faults
    table = table_of(plan, options.table) if by_table else None
    faults += of_pump(pump, table)
    known = variable_keys(pump, table)
    stated = pump_keys(pump)
    keys = chosen_keys(options, known, stated, faults)
    if needs_keys(options):
        faults.append(Fault("--keys", "missing", "chosen dimensions: floating films of each would take hours", "oil.*"))
    if not faults:
        faults += floating_faults(options, pump, options.fidelity)
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    fidelity = Fidelity(options.fidelity)
    at_once = together and fidelity is Fidelity.LUMPED and solves_together(pump)
    solver = TogetherSolver() if at_once else varied_solver(fidelity, floating_options(options, pump), table)
    work = VariedWork(pump, solver, varied_sites(plan, options.cycle))
    fixed = tuple(path for path in stated if path not in known)
    return VariedCase(
        work, keys, fixed, fidelity, plan, given_text(options.pump, set_keys), options.cycle, options.resume,
        stated_pump.assumptions,
    )  # fmt: skip


def _stated_pump(options: argparse.Namespace, values: Mapping[str, object], faults: Sequence[Fault]) -> KnownPump:
    """Return the pump of the command line with these values; raise InputFaults with its faults and `faults`."""
    try:
        return load_known_pump(options.pump, values)
    except InputFaults as reason:
        raise InputFaults(reason.source, [*faults, *reason.faults], reason.lines) from None


def cycle_axes(pump: PumpDescription, axes: Sequence[MapAxis], cycle: Path) -> list[MapAxis]:
    """Return the stated axes, and levels over the range of the cycle for the others that it varies."""
    stated = {axis.input for axis in axes}
    inputs = read_cycle(cycle, map_plan(pump, ()).axes, within=False).inputs
    return [*axes, *(_over(given, inputs[given]) for given in inputs if given not in stated)]


def _over(given: MapInput, values: np.ndarray) -> MapAxis:
    least, most = float(values.min()), float(values.max())
    if least == most:
        return MapAxis(given, (least,))
    return MapAxis(given, tuple(map(float, np.linspace(least, most, CYCLE_LEVELS.get(given, 4)))))


def varied_sites(plan: MapPlan, cycle: Path | None) -> Sites:
    """Return the points of a plan, with equal weights or those of a duty cycle; raise InputFaults as `read_cycle`."""
    return plan_sites(plan) if cycle is None else cycle_sites(plan, read_cycle(cycle, plan.axes))


def table_of(plan: MapPlan, file: Path | None) -> ResponseTable:
    """Return the response table of a file, or a stored one; raise InputFaults where it does not contain all points."""
    return kept_table(MapCase(plan, Fidelity.TABLE, table=file))


def varied_solver(fidelity: Fidelity, floating: FloatingOptions, table: ResponseTable | None) -> MapSolver:
    """Return the solver of a fidelity; floating: options of floating gaps; table: that of the fidelity table."""
    if table is not None:
        return TableSolver(table)
    if fidelity is Fidelity.LUMPED:
        return LumpedSolver()
    return DirectSolver(solver_of(Source(fidelity.value), floating), POINT_COST[fidelity])
