"""A pump with floating films for a diagnosis: the simulation's films, and the film physics that it may lack.

Every part that is left out is a hypothesis, solved by films: response tables of the pump's floating films without it,
with it, and with every two of them, built once and kept.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import combinations
from pathlib import Path

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
from system.points.table.sources import FloatingSolver, PointSolver, films_alone
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
"""Effects that enter the films by another description of the pump."""
IN_FILMS = (*SOLVED, *BALANCED, EffectId.SQUEEZE_PUMPING)
"""Effects that floating films have by themselves: their closed-form laws are no hypotheses beside them."""
SIZE = 1.0, 1.5
"""Spread and upper limit of a share: 1 is the physics by drawing, material and oil."""
LEARNT_MORE = 2
"""Points for each input beyond twice the corners of the box: each needs minutes."""
SMALL = 1e-3
"""Of the lumped law: a smaller flow or loss is no scale of an error."""

Parts = frozenset[EffectId]
"""The parts of the film physics that a table has beyond the simulation."""
NOTHING: Parts = frozenset()


@dataclass(frozen=True)
class FilmTask:
    """The films to solve for a diagnosis.

    options: of the simulation's films, with the physics that they leave out; axes: the box of operating points; learnt,
    held_out: points of each table; variants: the pump with an effect of VARIANTS; solver: of a table's points, by the
    options of its films.
    """

    pump: PumpDescription
    options: FloatingOptions
    axes: tuple[Axis, ...]
    learnt: int
    held_out: int
    variants: Mapping[EffectId, PumpDescription] = field(default_factory=dict)
    solver: Callable[[FloatingOptions], PointSolver] = FloatingSolver

    @property
    def switched(self) -> dict[EffectId, Effect]:
        """The parts that a switch of the physics leaves out."""
        return {NAMED[effect]: effect for effect in self.options.physics.left_out}

    @property
    def sets(self) -> list[Parts]:
        """The parts that each table has: none, one, or two that are switched."""
        single = [frozenset({one}) for one in (*self.switched, *self.variants)]
        return [NOTHING, *single, *map(frozenset, combinations(self.switched, 2))]

    def options_with(self, parts: Parts) -> FloatingOptions:
        """The options of films that have these parts too."""
        on = [effect for part, effect in self.switched.items() if part in parts]
        return replace(self.options, physics=self.options.physics.including(*on))

    def pump_with(self, parts: Parts) -> PumpDescription:
        """The pump of films that have these parts: the variant among them."""
        return next((own for part, own in self.variants.items() if part in parts), self.pump)

    def case(self, parts: Parts) -> TableCase:
        """The table of films that have these parts."""
        solver = self.solver(self.options_with(parts))
        return TableCase(self.pump_with(parts), solver, self.axes, self.learnt, self.held_out)


@dataclass(frozen=True)
class FilmModel:
    """Films of a pump in a diagnosis.

    law: leakage and friction of the simulation's films, and by their shares the parts that it left out; entries: these
    parts as hypotheses; error: by output, the largest rms error of the tables at held-out points, in the output's
    measure; task: the inputs of the tables.
    """

    law: SolvedFilms
    entries: tuple[Entry, ...]
    error: Mapping[str, float]
    task: FilmTask

    def own_laws(self, pump: PumpDescription) -> tuple[tuple[Law, Values], ...]:
        """The laws of a bench with these films: theirs, and those of [physics] that no film solves."""
        return ((self.law, {}), *stated_laws(closed_laws(pump, floating=True)))

    @property
    def catalogue(self) -> tuple[Entry, ...]:
        """The hypotheses of a diagnosis: the parts left out of the films, and all outside the films."""
        solved = {entry.id for entry in self.entries}
        thins = () if EffectId.SHEAR_THINNING in solved else (EffectId.SHEAR_THINNING,)
        outside = (entry for entry in CATALOGUE if entry.id in thins or entry.id not in IN_FILMS)
        return (*self.entries, *outside)


def film_model(
    task: FilmTask, *, executor: Executor = HERE, report: Report = silent, folder: Path | None = None
) -> FilmModel:
    """The model from its tables, built if not kept; raises as `build_table`."""
    each = task.learnt + task.held_out
    tables: dict[Parts, ResponseTable] = {}
    for parts in task.sets:
        told = _of_whole(report, len(tables) * each, len(task.sets) * each, _text(parts))
        tables[parts] = build_table(task.case(parts), executor=executor, report=told, folder=folder)
    single = {next(iter(parts)): table for parts, table in tables.items() if len(parts) == 1}
    pairs = {parts: table for parts, table in tables.items() if len(parts) == 2}
    law = SolvedFilms(films_alone(task.pump), tables[NOTHING], single, pairs)
    return FilmModel(law, tuple(map(film_entry, single)), _errors(law.base, tables.values()), task)


def film_counts(inputs: int) -> tuple[int, int]:
    """Default numbers of learnt and held-out points of tables of floating films: 22 and 5 for three inputs."""
    learnt = 2 ** (inputs + 1) + LEARNT_MORE * inputs
    return learnt, max(2, learnt // 4)


def _errors(base: ResponseTable, tables: Iterable[ResponseTable]) -> dict[str, float]:
    """By output, the largest rms error of the tables at their held-out points, in the base table's measure."""
    relative = np.array([output.measure is Measure.RELATIVE for output in base.response.outputs])
    largest = np.zeros(len(relative))
    for table in tables:
        held_out = table.response.held_out
        off = table.response.at(held_out.points) - held_out.values
        scale = np.where(relative, np.maximum(np.abs(held_out.values), SMALL), 1.0)
        largest = np.maximum(largest, np.sqrt(np.mean((off / scale) ** 2, axis=0)))
    return {output.name: float(error) for output, error in zip(base.response.outputs, largest, strict=True)}


def film_entry(part: EffectId) -> Entry:
    """The hypothesis of a part: its share, which acts in the films' own law."""
    source = "1: as drawing, material and oil make it; films solved"
    own = Extension(part, None, _in_the_films, (half(share_name(part), *SIZE, None, source),), of_films=True)
    return replace(entry_of(part), extensions=(own,))


def _in_the_films(values: Values, courses: Mapping[Gap, GapCourse], state: BenchState) -> Effects:
    """No change of its own: the films' law has the share."""
    return unchanged(courses)


def _of_whole(report: Report, begun: int, whole: int, what: str) -> Report:
    return lambda done, total, text: report(begun + done, whole, f"{what}: {text}")


def _text(parts: Parts) -> str:
    return " and ".join(["films", *sorted(part.value for part in parts)]).replace(" and ", " with ", 1)
