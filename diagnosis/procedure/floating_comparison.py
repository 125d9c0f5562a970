"""Floating films of a pump without and with a finding, at one operating point."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from diagnosis.procedure.compared import WITH, WITHOUT, FilmChange, FilmComparison
from reynolds.errors import InputError, NotConverged
from system.description.pump import PumpDescription
from system.effects.friction import OF_GAP
from system.inputs.units import LPM
from system.points.floating import FloatingPoint, floating_point
from system.points.table.film_physics import NOTHING, FilmModel, FilmTask, Parts
from system.points.table.means import SolvedPoint
from system.points.table.sources import solved_means
from system.pump.operating import operating_point
from system.work.progress import Report

MICRO, PERCENT = 1e6, 100.0
OWN = ("name", "operating", "tolerance")
"""Of a pump file with an effect in the films: its own tables that are no effect."""


def compare_floating(
    films: FilmModel, pumps: Mapping[str, PumpDescription], parts: Parts, report: Report
) -> FilmComparison:
    """The floating films of both pumps at their own operating points: the simulation's, and with the found parts.

    The text gives the films' settings and the error of their tables, or the reason why films have no solution.
    """
    solved = {}
    try:
        for name, own in ((WITHOUT, NOTHING), (WITH, parts)):
            solved[name] = floating_point(
                pumps[name], operating_point(pumps[name]), films.task.options_with(own), side_by_side=True,
                report=_of(report, name),
            )  # fmt: skip
    except (InputError, NotConverged) as reason:
        return FilmComparison(text=f"The films could not be solved: {reason}")
    return FilmComparison(floating=solved, changes=tuple(_changes(solved)), text=_text(films, parts))


def varied_pump(pump: PumpDescription, task: FilmTask, parts: Parts) -> PumpDescription:
    """The pump with the tables of its file that differ in a variant among the parts."""
    other = task.pump_with(parts)
    stated = {name: own for name, own in vars(other).items() if name not in OWN}
    return replace(pump, **{name: own for name, own in stated.items() if own != getattr(task.pump, name)})


def _changes(solved: Mapping[str, FloatingPoint]) -> Iterator[FilmChange]:
    """Leakage, friction, thickness and temperature of each gap."""
    found = {name: list(_numbers(solved_means(one))) for name, one in solved.items()}
    for without, with_it in zip(found[WITHOUT], found[WITH], strict=True):
        quantity, unit, value = without
        yield FilmChange(quantity, unit, {}, {WITHOUT: value, WITH: with_it[2]})


def _numbers(point: SolvedPoint) -> Iterator[tuple[str, str, float]]:
    """(quantity, unit, value) of the gaps of a point."""
    for gap, pair in OF_GAP.items():
        name, words = gap.value, gap.value.replace("_", " ")
        yield f"leakage, {words}", "L/min", LPM * getattr(point.pump_point.leakage_flow, name)
        yield f"friction, {words}", "W", point.pump_point.pairs.loss(pair).mean
        yield f"mean film, {words}", "um", MICRO * getattr(point.film_mean, name)
        yield f"least film, {words}", "um", MICRO * getattr(point.film_least, name)
        yield f"hottest oil above the case, {words}", "K", getattr(point.film_rise, name)


def _text(films: FilmModel, parts: Parts) -> str:
    names = [one.value for one in sorted(parts, key=lambda one: one.value)]
    more = f"with {' and '.join(names)}" if names else "as without: the finding does not act on them"
    stated = films.law.base.origin.stated
    leaks, rubs = (
        max(error for output, error in films.error.items() if output.endswith(name))
        for name in (".leakage", ".friction")
    )
    return (
        f"Floating films of the simulation ({stated['physics']}), and {more}; {stated['mesh']}. The tables behind the "
        f"fit err by {PERCENT * leaks:.2g} % of a gap's leakage and {PERCENT * rubs:.2g} % of its friction at most, "
        f"rms over points held out; this error is part of the noise."
    )


def _of(report: Report, name: str) -> Report:
    return lambda done, total, what: report(done, total, f"{what} {name} the finding")
