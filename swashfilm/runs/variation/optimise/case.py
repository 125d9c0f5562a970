"""Optimisation of a TOML file: pump, operating points, dimensions, objectives, constraints and search, validated."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from swashfilm.case.gap.pump import read_case_pump
from swashfilm.case.settings import read_set
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.floating_options import alike_faults, floating_faults, floating_options
from swashfilm.runs.variation.case import VariedCase, table_of, varied_sites, varied_solver
from swashfilm.runs.variation.optimise.asked import beyond_box, constraints_of, objectives_of, varied_of
from swashfilm.runs.variation.optimise.points import points_plan
from swashfilm.runs.variation.options import costly, known_measures
from system.description.keys import pump_keys
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.sections.fields import Limits, Text
from system.inputs.sections.reader import Reading, read_section
from system.inputs.toml_table import Table, fault_lines
from system.inputs.versions import version_fault
from system.pump.operating import OperatingPoint
from system.variation.optimisation.checks import bound_faults, constraint_faults
from system.variation.optimisation.gradient import gradient_designs
from system.variation.optimisation.method import Method, usual_method
from system.variation.optimisation.problem import Problem
from system.variation.optimisation.trust_region import fewest_designs
from system.variation.solving import VariedWork, variable_keys

FORMAT = 1
DESIGNS, GENERATIONS, SEED = 40, 40, 1
NUMBERS = {
    Method.EVOLUTION: ("designs", "generations"),
    Method.GRADIENT: ("generations",),
    Method.TRUST_REGION: ("designs",),
}
"""Keys of the length of a search."""
KNEE = "knee"
TABLES = ("vary", "objectives", "constraints", "points")


@dataclass(frozen=True, kw_only=True)
class OptimiseSection:
    """[optimise]: pump, fidelity and search."""

    pump: Annotated[str, Text.NAME]  # a built-in pump, or a pump file beside the case
    fidelity: Fidelity = Fidelity.LUMPED
    table: Annotated[str, Text.NAME] | None = None  # of the fidelity table: its file beside the case
    method: Method | None = None  # left out: by objectives and fidelity
    designs: Annotated[int, Limits(least=8, most=10_000)] | None = None  # of a generation; in all by trust region; 40
    generations: Annotated[int, Limits(least=1, most=10_000)] | None = None  # or steps along the gradient; 40
    seed: Annotated[int, Limits(least=0, most=2**31 - 1)] = SEED  # the same seed tries the same designs
    choose: Annotated[str, Text.WORDS] = KNEE  # the objective whose best design is chosen, or a row of pareto.csv


@dataclass(frozen=True)
class Search:
    """Search of an optimisation: method with its reason, designs of a generation (by trust region of all), generations,
    seed, choice."""

    method: Method
    why: str
    designs: int
    generations: int
    seed: int
    choose: str

    def trials(self, problem: Problem) -> int:
        """Return the number of designs that it tries, about."""
        match self.method:
            case Method.GRADIENT:
                return gradient_designs(problem, self.generations)
            case Method.TRUST_REGION:
                return self.designs
        return self.designs * self.generations


@dataclass(frozen=True)
class OptimiseCase:
    """An optimisation: name, the varied pump, the problem and the search."""

    name: str
    varied: VariedCase
    problem: Problem
    search: Search


def load_optimisation(path: Path, values: Mapping[str, object], options: argparse.Namespace) -> OptimiseCase:
    """Return the optimisation of a file with other `values` of dotted keys; raise InputFaults with every fault.

    options: of the command line: those of floating gaps, --choose and --resume.
    """
    text, tables = read_set(path, values)
    top = Table("", tables, [])
    found = _read(path, text, top, options)
    top.close()
    if top.faults or found is None:
        raise InputFaults(str(path), top.faults, _lines(text, top.faults))
    return found


def _read(path: Path, text: str, top: Table, options: argparse.Namespace) -> OptimiseCase | None:
    """Return the optimisation of a file's tables; None with its faults listed."""
    if fault := version_fault("format", top.get("format"), FORMAT, "optimisation"):
        top.faults.append(fault)
    table = top.table("optimise", needed="with pump")
    pump = read_case_pump(top, table, path.parent) if table else None
    section = _section(table) if table else None
    fidelity: Fidelity = getattr(section, "fidelity", Fidelity.LUMPED)
    if pump is None or section is None:
        for name in TABLES:
            top.get(name)
        return None
    plan, cycle = points_plan(top, pump.pump, path.parent)
    beside = None if section.table is None else path.parent / section.table
    by_table = fidelity is Fidelity.TABLE and not top.faults
    response = table_of(plan, beside) if by_table and plan is not None else None
    known = variable_keys(pump.pump, response)
    space = varied_of(top, pump.pump, known)
    top.faults += [Fault(f"vary.{one.name}", *found) for one in space if (found := beyond_box(response, one))]
    measures = known_measures(fidelity)
    problem = Problem(space, objectives_of(top, measures, fidelity), constraints_of(top, measures, fidelity), measures)
    top.faults += [*alike_faults(pump.pump), *floating_faults(options, pump.pump, fidelity.value, "fidelity")]
    top.faults += _table_faults(section)
    if top.faults or plan is None:
        return None
    search = _search(section, problem, options)
    top.faults += [*_problem_faults(pump.pump, problem, plan.points), *_search_faults(section, search, problem)]
    if top.faults:
        return None
    work = VariedWork(pump.pump, varied_solver(fidelity, floating_options(options, pump.pump), response),
                      varied_sites(plan, cycle), whole=True)  # fmt: skip
    fixed = tuple(key for key in pump_keys(pump.pump) if key not in known)
    keys = {one.name: one.key for one in space}
    varied = VariedCase(work, keys, fixed, fidelity, plan, text, cycle, options.resume, pump.assumptions)
    return OptimiseCase(path.stem, varied, problem, search)


def _section(table: Table) -> OptimiseSection:
    """Return the section of the table; with faults, a section of the valid values only."""
    reading = Reading(special={"optimise.pump": lambda raw, *_: {"pump": raw}}, faults=table.faults)
    reading.faulty.add("optimise.pump")
    return read_section("optimise", OptimiseSection, table.values, reading)


def _search(section: OptimiseSection, problem: Problem, options: argparse.Namespace) -> Search:
    usual, why = usual_method(problem, costly=costly(section.fidelity))
    method = section.method or usual
    return Search(
        method, why if method is usual else "as the case states", section.designs or DESIGNS,
        section.generations or GENERATIONS, section.seed, options.choose or section.choose,
    )  # fmt: skip


def _table_faults(section: OptimiseSection) -> list[Fault]:
    """Return the fault of a table's file beside another fidelity."""
    if section.table is None or section.fidelity is Fidelity.TABLE:
        return []
    return [Fault("optimise.table", f"beside fidelity {section.fidelity.value}", 'fidelity = "table"')]


def _problem_faults(pump: PumpDescription, problem: Problem, points: Sequence[OperatingPoint]) -> list[Fault]:
    """Return the faults of bounds and constraints that no pump can meet, at their keys."""
    found = [Fault(f"vary.{one.name}", fault.found, fault.expected, fault.nearest)
             for one, fault in bound_faults(pump, problem)]  # fmt: skip
    found += [Fault(f"constraints.{one.measure.name}", fault.found, fault.expected, fault.nearest)
              for one, fault in constraint_faults(pump, points, problem)]  # fmt: skip
    return found


def _search_faults(section: OptimiseSection, search: Search, problem: Problem) -> list[Fault]:
    """Return the faults of a search: of one objective beside several, its numbers, an invalid choice."""
    count = len(problem.objectives)
    if search.method is not Method.EVOLUTION and count > 1:
        found = f"'{search.method.value}' beside {count} objectives"
        return [Fault("optimise.method", found, "one objective, or 'evolution'", "evolution")]
    return [*_number_faults(section, search, problem), *_choice_faults(search, problem)]


def _number_faults(section: OptimiseSection, search: Search, problem: Problem) -> Iterator[Fault]:
    """Yield the faults of `designs` and `generations`: too few, lacking for costly designs, or of another search."""
    needed = NUMBERS[search.method]
    for key in ("designs", "generations"):
        stated = getattr(section, key)
        if key not in needed and stated is not None:
            found = f"{stated} beside method {search.method.value}"
            yield Fault(f"optimise.{key}", found, f"{' and '.join(needed)} alone", "leave it out")
        if key in needed and stated is None and section.fidelity is Fidelity.FLOATING:
            found = f"missing: the usual {search.trials(problem)} designs with floating films would take days"
            yield Fault(f"optimise.{key}", found, "a number that your time allows", f"{key} = 8")
    fewest = fewest_designs(len(problem.space))
    if search.method is Method.TRUST_REGION and search.designs < fewest:
        expected = f"at least {fewest}: a model of {len(problem.space)} dimensions, and a step"
        yield Fault("optimise.designs", str(search.designs), expected, str(fewest))


def _choice_faults(search: Search, problem: Problem) -> list[Fault]:
    """Return the fault of a choice that is neither the knee, an objective nor a number."""
    known = [KNEE, *(one.measure.name for one in problem.objectives)]
    if search.choose in known or (search.choose.isdecimal() and int(search.choose) > 0):
        return []
    expected = f"{', '.join(known)}, or a row of pareto.csv, from 1"
    return [Fault("optimise.choose", repr(search.choose), expected, nearest_choice(search.choose, known))]


def _lines(text: str, faults: list[Fault]) -> dict[str, int]:
    """Return the line of each fault; a quoted key has that of its entry."""
    lines = fault_lines(text, faults)
    for fault in faults:
        quoted = f'"{fault.path.partition(".")[2]}"'
        for number, line in enumerate(text.splitlines(), start=1):
            if line.lstrip().startswith(quoted):
                lines[fault.path] = number
    return lines
