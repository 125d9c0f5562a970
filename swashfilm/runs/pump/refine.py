"""Convergence of a floating point: the same point on meshes, angles and time steps each twice finer."""

from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

from gaps.revolution.march import GapRevolution
from reynolds.numerics.convergence import convergence
from swashfilm.case.gap.revolution import refined_options
from swashfilm.output.headline import sizes
from swashfilm.output.refinement import Refinement
from system.points.floating import FloatingPoint
from system.points.floating_gaps import FloatingOptions
from system.points.table.means import GAP_PAIRS
from system.pump.bench import paper_efficiency
from system.work.progress import Report

EXPECTED = (1.0, 2.0)
"""Orders: two of smooth films and of steps in time; one where cavities' fronts move by whole cells, and of heat."""


def refine_point(
    first: FloatingPoint, levels: int, solve: Callable[[FloatingOptions, FloatingPoint | None, Report], FloatingPoint],
    report: Report,
) -> Refinement:  # fmt: skip
    """Return the numbers of a point on `levels` levels, `first` being the coarsest.

    `solve` solves it with other options, without a start, since the meshes differ.

    Raises as `floating_point`.
    """
    found = [first]
    for number in range(2, levels + 1):
        options = refined_options(found[-1].options)
        found.append(solve(options, None, of_level(report, number, levels)))
    rows = [point_numbers(one) for one in found]
    size = sizes(rows[-1], {})
    numbers = {key: convergence([row[key] for row in rows], EXPECTED, size[key]) for key in rows[0]}
    return Refinement(tuple(map(_unknowns, found)), EXPECTED, numbers)


def of_level(report: Report, number: int, levels: int) -> Report:
    """Return the progress of a level; the total is known at the last, which takes longer than all before."""
    if levels == 1:
        return report
    last = number == levels
    return lambda done, total, what: report(done, total if last else 0, f"level {number} of {levels}, {what}")


def _unknowns(found: FloatingPoint) -> int:
    """Return the number of unknown pressures of all gaps of the most common chamber and the block."""
    gaps = found.kinds[0].gaps
    return _size(gaps.piston) + _size(gaps.slipper) + _size(gaps.block)


def _size(gap: GapRevolution[Any]) -> int:
    """Return the unknowns of a gap's film: by a kept film, or by its oil without kept films."""
    kept = [film.problem.space.size for film in gap.turn.films.values()]
    return kept[0] if kept else int(gap.turn.oil[0].size)


def point_numbers(found: FloatingPoint) -> Mapping[str, float]:
    """Return the headline numbers of a point by key, SI with the unit in the key."""
    point, gaps = found.pump_point, found.kinds[0].gaps
    turns: dict[str, GapRevolution[Any]] = {"piston": gaps.piston, "slipper": gaps.slipper, "valve_plate": gaps.block}
    numbers = {
        "shaft_torque_Nm": point.bench.shaft_torque,
        "delivery_flow_m3_per_s": point.bench.delivery_flow,
        "drain_flow_m3_per_s": point.bench.drain_flow,
        "overall_efficiency": paper_efficiency(point.bench).overall,
        "chamber_pressure_peak_Pa": max(float(own.pressure.max()) for own in point.chambers),
    }
    numbers |= {f"leakage_flow_m3_per_s.{gap}": flow for gap, flow in asdict(point.leakage_flow).items()}
    for gap, pair in GAP_PAIRS.items():
        numbers[f"loss_W.{gap}"] = point.pairs.loss(pair).mean
        numbers[f"contact_loss_W.{gap}"] = point.pairs.loss(pair).mean_coulomb
        numbers[f"film_mean_m.{gap}"] = turns[gap].mean_film
        numbers[f"film_least_m.{gap}"] = turns[gap].least_film.film_thickness_min
        if (warmth := turns[gap].warmth) is not None:
            numbers[f"hottest_oil_K.{gap}"] = float(warmth.hottest.max())
    return numbers
