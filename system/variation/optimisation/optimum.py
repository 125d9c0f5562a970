"""Optimisation of a pump: the start, all designs that a search tries, the best of them, and the obstacles."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from reynolds.errors import NotConverged
from system.inputs.faults import Fault, InputFaults
from system.variation.optimisation.checks import constraint_faults
from system.variation.optimisation.ending import Ending
from system.variation.optimisation.obstacles import Obstacles, obstacles
from system.variation.optimisation.pareto import ParetoSet, pareto_set
from system.variation.optimisation.problem import Design, Problem
from system.variation.optimisation.trials import Trials, design_of
from system.variation.solving import VariedWork, solved_variants
from system.work.kept_results import KeptPoints
from system.work.progress import Report
from system.work.tasks import Executor, PartStatus

Search = Callable[[Trials], Ending | None]
"""Tries designs until it ends; None where its number of designs alone ends it."""


@dataclass(frozen=True)
class Optimisation:
    """Result of a search; problem: with the values of constraints that the start gives.

    start: the pump as stated; designs: all that were tried, in their order. obstacles: None where no design has a
    result; ending: of the search, None where its number of designs alone ended it; internal: the reason of an error of
    the program at a design, else ""; seconds of processor time.
    """

    problem: Problem
    start: Design
    designs: tuple[Design, ...]
    pareto: ParetoSet
    obstacles: Obstacles | None
    ending: Ending | None
    internal: str
    seconds: float

    def count(self, status: PartStatus) -> int:
        """Return the number of designs with this outcome."""
        return sum(one.status is status for one in self.designs)


def optimise(
    work: VariedWork,
    problem: Problem,
    search: Search,
    expected: int,
    folder: Path,
    executor: Executor,
    report: Report,
    earlier: KeptPoints | None = None,
) -> Optimisation:
    """Return the optimum of a problem: solve the start, then all that the search tries, each kept in a folder.

    expected: designs in all, for progress. Raises NotConverged where the pump as stated has no result, which leaves no
    reference for comparison, InputFaults for limits by the start that no pump meets.
    """

    def of_start(done: int, total: int, what: str) -> None:
        report(0, expected, what)

    (outcome,) = solved_variants(work, [()], folder, executor, of_start, earlier)
    if outcome.status is not PartStatus.SOLVED:
        raise NotConverged(f"the pump as stated: {outcome.reason}")
    start = design_of(outcome, problem.start, 0, work.sites.weights, problem.measures)
    asked = tuple(one.at_start(float(problem.column([start], one.measure)[0])) for one in problem.constraints)
    problem = replace(problem, constraints=asked)
    if faults := list(_start_faults(work, problem)):
        raise InputFaults("optimisation", faults)
    trials = Trials(work, problem, folder, executor, report, expected, earlier)
    ending = search(trials)
    designs = tuple(trials.designs)
    internal = next((one.reason for one in designs if one.status is PartStatus.INTERNAL), "")
    best, blocked = pareto_set(problem, designs), obstacles(problem, designs)
    return Optimisation(problem, start, designs, best, blocked, ending, internal, trials.seconds + outcome.seconds)


def _start_faults(work: VariedWork, problem: Problem) -> Iterator[Fault]:
    """Yield the faults of limits by the start, whose values are now known, that no design can meet."""
    told = [
        replace(one, of_start=None, text=f"{one.text}, {one.measure.text(one.value)}")
        for one in problem.constraints
        if one.of_start is not None
    ]
    if told:
        for _, fault in constraint_faults(work.pump, work.sites.points, replace(problem, constraints=tuple(told))):
            yield replace(fault, path=f"constraints.{fault.path}")
