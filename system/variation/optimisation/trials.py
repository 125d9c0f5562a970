"""Trials of an optimisation: designs solved side by side, each once, all kept by their content."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump_file.file import Variant
from system.variation.measures import Measure, measured
from system.variation.optimisation.problem import Design, Problem
from system.variation.solving import VariedWork, numbers_in, solved_variants
from system.work.kept_results import KeptPoints
from system.work.progress import Report
from system.work.tasks import Executor, PartOutcome, PartStatus


@dataclass
class Trials:
    """All designs that an optimisation has tried, in their order; each variant is solved once.

    folder: where results are kept; earlier: those of a run that was begun. expected: designs in all, for progress.
    """

    work: VariedWork
    problem: Problem
    folder: Path
    executor: Executor
    report: Report
    expected: int
    earlier: KeptPoints | None = None
    designs: list[Design] = field(default_factory=list)
    generation: int = 0
    seconds: float = 0.0
    _known: dict[Variant, Design] = field(default_factory=dict)

    def tried(self, places: Array) -> list[Design]:
        """Return the designs at places (N, k) of the unit cube; those that are new count as one generation."""
        variants = [self.problem.changes(place) for place in places]
        new = {variant: place for variant, place in zip(variants, places, strict=True) if variant not in self._known}
        self.generation += bool(new)
        for (variant, place), outcome in zip(new.items(), self._solved(list(new)), strict=True):
            made = self._design(place, outcome)
            self._known[variant] = made
            self.designs.append(made)
        return [self._known[variant] for variant in variants]

    def _solved(self, variants: Sequence[Variant]) -> Sequence[PartOutcome]:
        if not variants:
            return ()
        told, report = len(self.designs), self.report

        def counted(done: int, _: int, what: str) -> None:
            report(told + done, max(self.expected, told + len(variants)), f"generation {self.generation}: {what}")

        found = solved_variants(self.work, variants, self.folder, self.executor, counted, self.earlier)
        self.seconds += sum(one.seconds for one in found)
        return found

    def _design(self, place: Array, outcome: PartOutcome) -> Design:
        return design_of(outcome, place, self.generation, self.work.sites.weights, self.problem.measures)


def design_of(
    outcome: PartOutcome, place: Array, generation: int, weights: Array, measures: tuple[Measure, ...]
) -> Design:
    """Return the design of an outcome."""
    if outcome.status is not PartStatus.SOLVED:
        return Design(place, generation, outcome.status, np.empty(0), np.empty(0), (), outcome.reason)
    sites = numbers_in(outcome)
    warnings, of_map = tuple(outcome.record["warnings"]), tuple((*one,) for one in outcome.record.get("map", ()))
    return Design(place, generation, outcome.status, measured(sites, weights, measures), sites, warnings, "", of_map)
