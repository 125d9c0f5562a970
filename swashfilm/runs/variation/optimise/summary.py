"""Summary of an optimisation's run."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from swashfilm.formats.versions import headed
from swashfilm.runs.variation.optimise.case import KNEE, NUMBERS, OptimiseCase
from swashfilm.runs.variation.words import where
from system.maps.plan import point_words
from system.pump.operating import OperatingPoint
from system.variation.measures import measured
from system.variation.optimisation.ending import Ending
from system.variation.optimisation.method import Method
from system.variation.optimisation.optimum import Optimisation
from system.variation.optimisation.problem import MET, Constraint, Design, Problem, Varied
from system.work.tasks import PartStatus

HOLDS = 0.01
"""Margin of a constraint, of its value, and of a bound, of the distance of both, below which it counts as active."""
GROWS = 0.01
"""Share of the hypervolume added in the last quarter of the generations, from which a run warns."""
MANY_REFUSED = 0.5
"""Share of designs that the geometry refuses, from which a run warns."""


def optimise_summary(case: OptimiseCase, found: Optimisation, chosen: int | None) -> dict[str, Any]:
    """Return the summary: start, chosen design (without any the one that misses the constraints by least), SI."""
    shown = chosen if chosen is not None else found.obstacles.at if found.obstacles else None
    design = found.start if shown is None else found.designs[shown]
    problem, search = found.problem, case.search
    return {
        **headed("optimisation"),
        "name": case.name,
        "pump": case.varied.pump.name,
        **where(case.varied),
        "method": {
            "name": search.method.value, "why": search.why, "designs": search.designs,
            "generations": search.generations, "seed": search.seed,
        },
        "counts": _counts(found),
        "chosen": {
            "feasible": chosen is not None,
            "design": None if shown is None else shown + 1,
            "row": None if chosen is None else found.pareto.members.index(chosen) + 1,
            "why": _why(search.choose, problem, chosen),
        },
        "dimensions": [_dimension(found, one, at, design) for at, one in enumerate(problem.space)],
        "objectives": [{"name": one.measure.name, "aim": one.aim.value} for one in problem.objectives],
        "constraints": [_constraint(found, one, design) for one in problem.constraints],
        "measures": {
            one.name: {"words": one.words, "unit": one.unit, "start": _number(start), "chosen": _number(value)}
            for one, start, value in zip(problem.measures, found.start.numbers, design.numbers, strict=True)
        },
        "at_points": _at_points(case, found, design),
        "convergence": {"growth": found.pareto.growth.tolist(), "late_growth": found.pareto.late_growth},
        "obstacles": _obstacles(found),
        "warnings": list(_warnings(case, found, design)),
        "internal_error": found.internal,
        "cost": {"processor_s": found.seconds},
    }  # fmt: skip


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _why(choose: str, problem: Problem, chosen: int | None) -> str:
    if chosen is None:
        return "no design is feasible: the one that misses the constraints by the least"
    if choose == KNEE and len(problem.objectives) == 1:
        (only,) = problem.objectives
        return f"the {only.aim.value} {only.measure.words} of all feasible designs"
    if choose == KNEE:
        return "the knee: nearest to the ideal point, objectives scaled by their ranges over the Pareto set"
    return f"row {choose} of pareto.csv" if choose.isdecimal() else f"the best {choose} of the Pareto set"


def _counts(found: Optimisation) -> dict[str, int]:
    return {
        "tried": len(found.designs),
        "solved": found.count(PartStatus.SOLVED),
        "refused": found.count(PartStatus.FAULTY),
        "not_converged": found.count(PartStatus.NOT_CONVERGED),
        "feasible": int(np.sum(found.problem.feasible(found.designs))),
        "pareto": len(found.pareto.members),
    }


def _dimension(found: Optimisation, one: Varied, at: int, design: Design) -> dict[str, Any]:
    place = float(design.place[at])
    value = one.key.value if design is found.start else dict(found.problem.variant(design.place))[one.name]
    return {
        "name": one.name, "tied": list(one.paths[1:]), "unit": one.key.dimension.si_unit if one.key.dimension else "1",
        "low": one.low, "high": one.high, "start": one.key.value, "chosen": value,
        "low_text": one.key.shown(one.low), "high_text": one.key.shown(one.high), "start_text": one.key.text,
        "chosen_text": one.key.shown(value),
        "at_bound": "low" if place < HOLDS else "high" if place > 1.0 - HOLDS else "",
    }  # fmt: skip


def _constraint(found: Optimisation, one: Constraint, design: Design) -> dict[str, Any]:
    start, value = (float(found.problem.column([own], one.measure)[0]) for own in (found.start, design))
    violation = float(one.violation(np.array(value)))
    return {
        "text": one.text, "words": one.words, "measure": one.measure.name, "bound": one.bound.value,
        "value": one.value, "start": start, "chosen": value, "violation": violation,
        "met": violation <= MET, "holds": -HOLDS < violation <= MET,
    }  # fmt: skip


def _at_points(case: OptimiseCase, found: Optimisation, design: Design) -> list[dict[str, Any]]:
    """Return the measures of objectives and constraints of start and design at each operating point."""
    names, rows = found.problem.asked, []
    for at, point in enumerate(case.varied.work.sites.points):
        start, value = (measured(own.at_sites[[at]], np.ones(1), names) for own in (found.start, design))
        numbers = {
            one.name: {"start": float(a), "chosen": float(b)} for one, a, b in zip(names, start, value, strict=True)
        }
        rows.append({"point": _point_words(case, point), "measures": numbers})
    return rows


def _point_words(case: OptimiseCase, point: OperatingPoint) -> str:
    """Return the inputs of a point that differ among the points; of a single one all."""
    varying = [axis.input for axis in case.varied.plan.axes if len(axis.values) > 1]
    return ", ".join(f"{one.words} {one.text(getattr(point, one.value))}" for one in varying) or point_words(point)


def _obstacles(found: Optimisation) -> list[dict[str, Any]]:
    if found.obstacles is None:
        return []
    return [
        {
            "text": one.constraint.text, "words": one.constraint.words, "measure": one.constraint.measure.name,
            "value": one.constraint.value, "met": one.met, "best": one.best, "nearest": one.nearest,
            "violation": one.violation,
        }
        for one in found.obstacles.rows
    ]  # fmt: skip


def _warnings(case: OptimiseCase, found: Optimisation, design: Design) -> Iterator[str]:
    """Yield warnings, `name: text; remedy` each."""
    yield from case.varied.input_warnings
    counts = _counts(found)
    if not counts["feasible"]:
        yield _nothing_feasible(found)
    late = found.pareto.late_growth
    if case.search.method is Method.EVOLUTION and counts["feasible"] and late > GROWS:
        more = 2 * case.search.generations
        yield (
            f"pareto_still_grows: the last quarter of the generations has added {late:.1%} of the set's hypervolume "
            f"(limit {GROWS:.0%}); raise [optimise] generations to {more} with --resume of this folder"
        )
    if counts["feasible"] and found.ending is not None and not found.ending.settled:
        yield _not_settled(case, found.ending)
    if counts["refused"] > MANY_REFUSED * counts["tried"]:
        reason = next(one.reason for one in found.designs if one.status is PartStatus.FAULTY)
        yield (
            f"designs_refused: the geometry refuses {counts['refused']} of {counts['tried']} designs, such as by "
            f"{reason}; narrow the bounds"
        )
    if failed := [one for one in found.designs if one.status not in (PartStatus.SOLVED, PartStatus.FAULTY)]:
        yield f"points_failed: {len(failed)} of {counts['tried']} designs have no result: {failed[0].reason}"
    if not found.problem.holds_start:
        yield "start_outside_bounds: the bounds do not hold the pump as stated; it is compared with, but no candidate"
    for name in design.warnings:
        yield (
            f"{name}: at the chosen design; swashfilm run chosen.toml at each operating point tells number and place"
            if counts["feasible"]
            else f"{name}: at the design that misses the constraints by the least; find a feasible one first"
        )


def _not_settled(case: OptimiseCase, ending: Ending) -> str:
    if not ending.out_of_steps:
        return (
            f"search_not_settled: the search ended before its objective settled ({ending.why}): better designs are "
            "likely; begin at the chosen design, or set [optimise] method = 'evolution'"
        )
    search = case.search
    (key,) = NUMBERS[search.method]
    limit: int = getattr(search, key)
    return (
        f"search_not_settled: the search used up its {limit} {key} before its objective settled: better designs are "
        f"likely; raise [optimise] {key} to {2 * limit} with --resume of this folder"
    )


def _nothing_feasible(found: Optimisation) -> str:
    if found.obstacles is None:
        reason = found.designs[0].reason if found.designs else "none was tried"
        return f"nothing_feasible: no design has a result: {reason}; narrow the bounds"
    first = found.obstacles.rows[0]
    measure = first.constraint.measure
    missed = measure.change(abs(first.nearest - first.constraint.value)).lstrip("+-")
    return (
        f"nothing_feasible: no design meets all constraints; {first.constraint.words} is in the way: the design that "
        f"misses all by the least has {measure.text(first.nearest)}, {missed} beside it, and the best of "
        f"{found.obstacles.solved} designs {measure.text(first.best)} ({first.met} meet it); widen the bounds, vary "
        f"another dimension, or ease this limit"
    )
