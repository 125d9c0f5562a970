"""A pump with floating films for a diagnosis: the simulation's films, and the film physics that it may have left out.

Every part that is left out is a hypothesis, solved by films: response tables of the pump's floating films without it,
with it, and with every two of them, built once and kept.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from gaps.films.physics import Effect
from gaps.response import Axis, Measure
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.catalogue.entries import CATALOGUE, entry_of
from system.effects.effect import BenchState, EffectId, Effects, GapCourse
from system.effects.extension import Entry, Extension, Law, Values
from system.effects.priors import half
from system.effects.state import unchanged
from system.effects.switched import stated_laws
from system.points.film_effects import BALANCED, SOLVED, closed_laws
from system.points.floating_gaps import FloatingOptions
from system.points.table.build import TableCase, build_table
from system.points.table.film_law import SolvedFilms, share_name
from system.points.table.response_table import ResponseTable
from system.points.table.sources import FloatingSolver, films_alone
from system.work.processes import HERE
from system.work.progress import Report, silent
from system.work.tasks import Executor

NAMED = {
    Effect.CAVITATION: EffectId.FILM_RUPTURE,
    Effect.PRESSURE_VISCOSITY: EffectId.VISCOSITY_PRESSURE,
    Effect.ROUGHNESS: EffectId.MIXED_FRICTION,
    Effect.ELASTIC_WALLS: EffectId.ELASTIC_OPENING,
    Effect.HEAT: EffectId.FILM_HEATING,
}
"""The effect that a switch of the films' physics leaves out."""
VARIANTS = (EffectId.WORN_PROFILE, EffectId.SHEAR_THINNING)
"""Effects that another description of the pump brings into its films."""
IN_FILMS = (*SOLVED, *BALANCED, EffectId.SQUEEZE_PUMPING)
"""Effects that floating films have by themselves: their closed-form laws are no hypotheses beside them."""
SIZE = 1.0, 1.5
"""Spread and upper limit of a share: 1 is the physics as drawing, material and oil make it."""
LEARNT_MORE = 2
"""Points for each input beyond twice the corners of the box: each takes minutes."""
SMALL = 1e-3
"""Of the lumped law: a smaller flow or loss is no scale of an error."""

Parts = frozenset[EffectId]
"""The parts of the film physics that a table has beyond the simulation."""
NOTHING: Parts = frozenset()


@dataclass(frozen=True)
class FilmModel:
    """Films of a pump in a diagnosis.

    law: what the simulation's films leak and rub, and by their shares the parts that it left out; entries: these parts
    as hypotheses; error: by output, the largest rms error of the tables at held-out points, as the output's measure is;
    cases: what the tables were built from.
    """

    law: SolvedFilms
    entries: tuple[Entry, ...]
    error: Mapping[str, float]
    cases: Mapping[Parts, TableCase]

    def own_laws(self, pump: PumpDescription) -> tuple[tuple[Law, Values], ...]:
        """The laws of a bench with these films: theirs, and those of [physics] that no film solves."""
        return ((self.law, {}), *stated_laws(closed_laws(pump, floating=True)))

    @property
    def catalogue(self) -> tuple[Entry, ...]:
        """The hypotheses of a diagnosis: the parts left out of the films, and all that lies outside the films."""
        solved = {entry.id for entry in self.entries}
        thins = () if EffectId.SHEAR_THINNING in solved else (EffectId.SHEAR_THINNING,)
        outside = (entry for entry in CATALOGUE if entry.id in thins or entry.id not in IN_FILMS)
        return (*self.entries, *outside)


def film_cases(
    pump: PumpDescription,
    options: FloatingOptions,
    axes: tuple[Axis, ...],
    counts: tuple[int, int],
    variants: Mapping[EffectId, PumpDescription],
) -> dict[Parts, TableCase]:
    """The tables of a diagnosis by the parts that they have beyond the simulation: none, one or two.

    options: of the simulation, with what it leaves out; variants: the pump with an effect of VARIANTS; counts: of
    learnt and held-out points.
    """
    switched = {NAMED[effect]: effect for effect in options.physics.left_out}
    sets: list[tuple[EffectId, ...]] = [(), *((one,) for one in (*switched, *variants)), *combinations(switched, 2)]

    def case(parts: Sequence[EffectId]) -> TableCase:
        physics = options.physics.including(*(switched[one] for one in parts if one in switched))
        own = next((variants[one] for one in parts if one in variants), pump)
        return TableCase(own, FloatingSolver(replace(options, physics=physics)), axes, *counts)

    return {frozenset(parts): case(parts) for parts in sets}


def film_model(cases: Mapping[Parts, TableCase], executor: Executor = HERE, report: Report = silent) -> FilmModel:
    """The model from its tables, built where they are not kept; raises as `build_table`."""
    whole = sum(case.learnt + case.held_out for case in cases.values())
    tables: dict[Parts, ResponseTable] = {}
    done = 0
    for parts, case in cases.items():
        what = "films with " + " and ".join(part.value for part in sorted(parts, key=_name)) if parts else "films"
        tables[parts] = build_table(case, executor=executor, report=_of_whole(report, done, whole, what))
        done += case.learnt + case.held_out
    single = {next(iter(parts)): table for parts, table in tables.items() if len(parts) == 1}
    pairs = {parts: table for parts, table in tables.items() if len(parts) == 2}
    law = SolvedFilms(films_alone(cases[NOTHING].pump), tables[NOTHING], single, pairs)
    return FilmModel(law, tuple(map(_entry, single)), _errors(law.base, tables.values()), cases)


def film_counts(inputs: int) -> tuple[int, int]:
    """Default numbers of learnt and held-out points of tables of floating films: 22 and 5 for three inputs."""
    learnt = 2 ** (inputs + 1) + LEARNT_MORE * inputs
    return learnt, max(2, learnt // 4)


def _errors(base: ResponseTable, tables: Iterable[ResponseTable]) -> dict[str, float]:
    """By output, the largest rms error of the tables at their held-out points, as the base table measures it."""
    relative = np.array([output.measure is Measure.RELATIVE for output in base.response.outputs])
    largest = np.zeros(len(relative))
    for table in tables:
        held_out = table.response.held_out
        off = table.response.at(held_out.points) - held_out.values
        scale = np.where(relative, np.maximum(np.abs(held_out.values), SMALL), 1.0)
        largest = np.maximum(largest, np.sqrt(np.mean((off / scale) ** 2, axis=0)))
    return {output.name: float(error) for output, error in zip(base.response.outputs, largest, strict=True)}


def _entry(part: EffectId) -> Entry:
    """The hypothesis of a part: its share, which acts in the films' own law."""
    source = "1: as drawing, material and oil make it; films solved"
    own = Extension(part, None, _in_the_films, (half(share_name(part), *SIZE, None, source),), of_films=True)
    return replace(entry_of(part), extensions=(own,))


def _in_the_films(values: Values, courses: Mapping[Gap, GapCourse], state: BenchState) -> Effects:
    """No change of its own: the films' law has the share."""
    return unchanged(courses)


def _of_whole(report: Report, begun: int, whole: int, what: str) -> Report:
    return lambda done, total, text: report(begun + done, whole, f"{what}: {text}")


def _name(part: EffectId) -> str:
    return part.value
