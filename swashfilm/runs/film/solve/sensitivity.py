"""Derivatives of a solved case's outputs by the film thickness at every place and by parameters of its shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from gaps.films.physics import Effect
from reynolds.adjoint.gradient import FilmGradient, film_gradients, held_gradient, weakly_active
from reynolds.adjoint.outputs import Axis, ContactLoadOutput, LoadOutput, MomentOutput, Output, output_names
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem, FilmSolution
from reynolds.solve.solver import FilmSolver
from swashfilm.case.file import FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.tables.film import Geometry
from swashfilm.runs.film.solve.gap import GapStudy, case_gap
from swashfilm.runs.film.solve.growth import Growth, Growths, case_growth, gap_growth, tilts, uniform_growth
from system.description.gap import Gap
from system.inputs.faults import Fault, InputFaults, nearest_choice

OPTION = "--sensitivity"


@dataclass(frozen=True)
class Sensitivities:
    """Gradients by the outputs' names, growth of the film with the parameters of its shape and why others have none,
    what is kept in the derivatives, and unknowns at which the cavity may open or close with the slightest change."""

    gradients: Mapping[str, FilmGradient]
    growth: Sequence[Growth]
    left_out: Mapping[str, str]
    kept: str
    weak: int


def check_sensitivity(case: FilmCase | GapCase, names: Sequence[str]) -> None:
    """Raise InputFaults, all at once, for outputs that the case does not have and films without an adjoint."""
    faults = [] if isinstance(case, GapCase) else _unfit(case)
    if not faults:
        known = _known(case)
        closed = _closed(case)
        for name in names:
            if name in closed:
                found = f"{name}, through a closed boundary: zero"
                faults.append(Fault(OPTION, found, f"a boundary with a pressure in [boundary]: {', '.join(known)}"))
            elif name not in known:
                near = nearest_choice(name, known)
                faults.append(Fault(OPTION, repr(name), f"outputs of this film: {', '.join(known)}", near))
    if faults:
        raise InputFaults("command line", faults)


def _unfit(case: FilmCase) -> list[Fault]:
    stated, shear = case.stated, case.stated.oil.shear_thinning if case.stated.oil else None
    reasons = (
        (stated.time, "a film in time, table [time]", "a steady film: state squeeze for one instant"),
        (stated.thermal, "a film with temperature, table [thermal]", "a film without it, at one oil temperature"),
        (shear, "oil that shear thins, a key of [oil]", "oil without it"),
    )
    return [Fault(OPTION, found, expected) for given, found, expected in reasons if given]


def _known(case: FilmCase | GapCase) -> list[str]:
    known = list(_outputs(case, _posed(case)))
    if isinstance(case, GapCase):
        # Between rigid walls the gap alone determines contact, which is no part of their film.
        return known if case.physics.elastic_walls else [name for name in known if name != "contact_load"]
    if case.stated.film.load:  # the film keeps them
        load = case.stated.film.rigid_load
        assert load is not None
        kept = {"load": True, "moment_x": load.moment_x is not None, "moment_y": load.moment_y is not None}
        known = [name for name in known if not kept.get(name, False)]
    return known


def _outputs(case: FilmCase | GapCase, problem: FilmProblem) -> dict[str, Output]:
    return output_names(problem, around_cylinder=case.geometry is Geometry.CYLINDER)


def _posed(case: FilmCase | GapCase) -> FilmProblem:
    """The film before it is solved, of a gap between rigid walls."""
    if isinstance(case, FilmCase):
        return case.problem
    gap = case_gap(replace(case, physics=case.physics.without(Effect.ELASTIC_WALLS)))
    return gap.floating.shape_at(gap.time(case.shaft_angle))


def _closed(case: FilmCase | GapCase) -> set[str]:
    problem = _posed(case)
    return {f"flow.{name}" for name in problem.space.edge_dofs if name not in problem.boundary}


def sensitivities(
    case: FilmCase | GapCase, solution: FilmSolution, gap_study: GapStudy | None, names: Sequence[str]
) -> Sensitivities:
    """The derivatives of a solved case, its film and, of a pump's gap, the part in it.

    The position of a gap's part is held. A free film under a given load keeps the load, and its position changes.
    Raises FilmNotConverged where the balance is singular.
    """
    if isinstance(case, GapCase):
        assert gap_study is not None
        gap = case_gap(case)
        stage = gap.held_at(case.shaft_angle, gap_study.film.position)
        weight = gap.film.is_film(stage.balanced.problem.space) if case.gap is Gap.VALVE_PLATE else None
        wanted = _wanted(case, stage.balanced, names)
        return _found(stage.balanced, gap.solver, wanted, gap_growth(case, stage), weight)
    wanted = _wanted(case, solution, names)
    found = _found(solution, FilmSolver(case.problem.space), wanted, case_growth(case), None)
    return _at_held_load(case, solution, found) if case.stated.film.load else found


def _wanted(case: FilmCase | GapCase, solution: FilmSolution, names: Sequence[str]) -> dict[str, Output]:
    known = _outputs(case, solution.problem)
    return {name: known[name] for name in names}


def _found(
    solution: FilmSolution, solver: FilmSolver, wanted: Mapping[str, Output], growth: Growths, weight: Array | None
) -> Sensitivities:
    gradients = film_gradients(solver, solution, list(wanted.values()), weight)
    weak = int(weakly_active(solution).sum())
    by_name = dict(zip(wanted, gradients, strict=True))
    return Sensitivities(by_name, growth.found, growth.left_out, "position", weak)


def _at_held_load(case: FilmCase, solution: FilmSolution, found: Sensitivities) -> Sensitivities:
    """The same while separation and free tilts follow, so that film and contact bear the load of the case."""
    load = case.stated.film.rigid_load
    assert load is not None
    along_x, along_y = tilts(case.problem)
    growth, moments = [uniform_growth(case.problem)], list[Output]()
    if load.moment_x is not None:
        growth, moments = [*growth, along_y], [*moments, MomentOutput(Axis.X)]
    if load.moment_y is not None:
        growth, moments = [*growth, along_x], [*moments, MomentOutput(Axis.Y)]
    solver = FilmSolver(case.problem.space)
    supported = film_gradients(solver, solution, [LoadOutput(), *moments])
    if solution.problem.asperities is not None:
        (contact,) = film_gradients(solver, solution, [ContactLoadOutput()])
        supported[0] = replace(
            supported[0],
            value=supported[0].value + contact.value,
            at_points=supported[0].at_points + contact.at_points,
            at_vertices=supported[0].at_vertices + contact.at_vertices,
            by_squeeze=supported[0].by_squeeze + contact.by_squeeze,
        )
    modes = [one.at_points for one in growth]
    held = {name: held_gradient(one, supported, modes) for name, one in found.gradients.items()}
    free = {one.key for one in growth}
    return replace(found, gradients=held, growth=[one for one in found.growth if one.key not in free], kept="load")
