"""Parameters of a film's shape: growth of the film with each, for derivatives by the chain rule."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING

import numpy as np

from reynolds.equation.rough_overlap import film_between
from reynolds.errors import InputError
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, FilmProblem
from swashfilm.case.fields.field import Formula
from swashfilm.case.file import FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.tables.film import Geometry
from swashfilm.runs.film.solve.gap import case_gap
from system.description.gap import Gap
from system.films.parts import FloatingParts

if TYPE_CHECKING:
    from gaps.shapes.profiles import Profile

STEP = 1e-4  # of a parameter: differences of the shape alone, exact where it is linear in the parameter
SMALLEST = 1e-9  # of a step, in the parameter's SI unit
CONSTANT = "constants."
"""Beginning of the key of a constant of the case, which has no unit in its name."""
_IN_NAME = re.compile("(?<=[a-z])(?=[A-Z])")
POSITIONS = {
    Gap.PISTON: ("eccentricity_inner_x_m", "eccentricity_inner_y_m", "eccentricity_case_x_m", "eccentricity_case_y_m"),
    Gap.SLIPPER: ("film_thickness_m", "rise_x_m", "rise_y_m"),
    Gap.VALVE_PLATE: ("film_thickness_m", "rise_x_m", "rise_y_m"),
}


@dataclass(frozen=True)
class Growth:
    """Growth of the film with a parameter: its key with its SI unit, and its value (None: zero by definition).

    m of film per unit at the points (cells | 1, points | 1) and at the vertices (vertices,); squeeze (cells | 1, points
    | 1): m/s of squeeze velocity per unit, of a shape that moves along the film.
    """

    key: str
    value: float | None
    at_points: Array
    at_vertices: Array
    squeeze: Array = field(default_factory=lambda: ZERO)


@dataclass(frozen=True)
class Growths:
    """Growth of the film with each parameter of its shape; why a parameter has none, by its key."""

    found: Sequence[Growth]
    left_out: Mapping[str, str]


def uniform_growth(problem: FilmProblem) -> Growth:
    """A uniform growth of the film."""
    return Growth("film_thickness_m", None, np.ones((1, 1)), np.ones(len(problem.space.vertices)))


def tilts(problem: FilmProblem) -> list[Growth]:
    """A film that grows along x and along y, from the origin."""
    space = problem.space
    return [
        Growth(f"slope_{axis}_rad", None, space.points[number], space.vertices[:, number])
        for number, axis in enumerate("xy")
    ]


def case_growth(case: FilmCase) -> Growths:
    """Uniform film, the tilts that it can have, and each constant of [constants] that the thickness depends on."""
    left_out = _closed(case)
    found = [uniform_growth(case.problem), *(one for one in tilts(case.problem) if one.key not in left_out)]
    thickness, space = case.stated.film.thickness, case.problem.space
    if not isinstance(thickness, Formula):
        return Growths(found, left_out)
    formula = thickness.expression
    for name, value in formula.constants.items():

        def shape(to: float, name: str = name) -> tuple[Array, Array]:
            changed = replace(formula, constants={**formula.constants, name: to})
            return Formula(changed).sample(space), changed(*space.vertices.T)

        points, vertices = _differences(shape, value)
        if not np.isfinite(points).all():
            left_out[f"{CONSTANT}{name}"] = "the thickness beside its value is no number"
        elif np.any(points != 0.0):
            found.append(Growth(f"{CONSTANT}{name}", value, points, vertices))
    return Growths(found, left_out)


def _closed(case: FilmCase) -> dict[str, str]:
    """Why a film has no tilt along an axis, by the tilt's key: it closes on itself there, and a tilt would jump."""
    sewn = {name for pair in case.problem.space.film_mesh.seams for name in pair}
    closed = {"x": "left" in sewn or case.geometry is Geometry.CYLINDER, "y": "bottom" in sewn}
    return {f"slope_{axis}_rad": f"the film closes on itself along {axis}" for axis in "xy" if closed[axis]}


def _differences(shape: Callable[[float], tuple[Array, ...]], value: float) -> list[Array]:
    """Slopes of a shape's fields at a value of a parameter, by central differences of the shape alone."""
    step = max(STEP * abs(value), SMALLEST)
    return [(more - less) / (2.0 * step) for more, less in zip(shape(value + step), shape(value - step), strict=True)]


def gap_growth(case: GapCase, stage: FloatingStage) -> Growths:
    """Uniform film (clearance), each coordinate of the position, and each number of the shapes of the faces."""
    problem, modes = stage.balanced.problem, stage.instant.modes
    widening = _widening(stage)
    corners = np.ones(len(problem.space.vertices))
    uniform = Growth("film_thickness_m", None, widening, corners)
    found = [
        Growth(key, float(value), widening * modes.at_points[:, :, number], modes.at_vertices[:, number])
        for number, (key, value) in enumerate(zip(POSITIONS[case.gap], stage.q, strict=True))
    ]
    faces = [uniform, *found] if case.gap is Gap.PISTON else found
    of_shapes = _of_shapes(case, stage, widening)
    return replace(of_shapes, found=[*faces, *of_shapes.found])


def _widening(stage: FloatingStage) -> Array:
    """Growth of the film with the gap: below one where rough rigid walls overlap."""
    shape = stage.instant.shape
    return np.ones((1, 1)) if shape.walls is not None else np.asarray(film_between(shape, stage.gap).slope)


def _of_shapes(case: GapCase, stage: FloatingStage, widening: Array) -> Growths:
    space, found, left_out = stage.instant.shape.space, list[Growth](), dict[str, str]()

    def shape(parts: FloatingParts) -> tuple[Array, Array, Array]:
        gap = case_gap(replace(case, parts=parts))
        film = gap.floating.shape_at(gap.time(case.shaft_angle)).film
        points, corners = np.broadcast_to(film.thickness, space.area.shape), film.thickness_at_vertices
        return points, space.to_vertices(points) if corners is None else corners, film.squeeze

    for key, value, with_value in _numbers(case):
        try:
            points, vertices, squeeze = _differences(lambda to, made=with_value: shape(made(to)), value)  # type: ignore[misc]
        except InputError as reason:
            left_out[key] = f"its value is at an end of its range: {reason}"
            continue
        if np.any(points != 0.0):
            found.append(Growth(key, value, widening * points, vertices, squeeze))
    return Growths(found, left_out)


def _numbers(case: GapCase) -> Iterator[tuple[str, float, Callable[[float], FloatingParts]]]:
    """Key and value of each number of the shapes of the gap's faces, and the parts with another value."""
    for face, profile, with_profile in _faces(case.gap, case.parts):
        for place, shape in enumerate(profile.shapes):
            for one in fields(shape):  # type: ignore[arg-type]
                value = getattr(shape, one.name)
                if not isinstance(value, float) or not np.isfinite(value):
                    continue

                def changed(
                    to: float, place: int = place, name: str = one.name, old: Profile = profile,
                    remade: Callable[[Profile], FloatingParts] = with_profile,
                ) -> FloatingParts:  # fmt: skip
                    shapes = list(old.shapes)
                    shapes[place] = replace(shapes[place], **{name: to})  # type: ignore[type-var]
                    return remade(replace(old, shapes=tuple(shapes)))

                unit = "rad" if one.name == "crest" else "m"
                yield f"{face}_{_IN_NAME.sub('_', type(shape).__name__).lower()}_{one.name}_{unit}", value, changed


def _faces(gap: Gap, parts: FloatingParts) -> list[tuple[str, Profile, Callable[[Profile], FloatingParts]]]:
    """Name and shapes of each face of a gap, and the parts with other shapes."""
    match gap:
        case Gap.PISTON:
            own = parts.piston
            return [
                ("piston", own.piston, lambda new: replace(parts, piston=replace(own, piston=new))),
                ("bore", own.bore, lambda new: replace(parts, piston=replace(own, bore=new))),
            ]
        case Gap.SLIPPER:
            slipper = parts.slipper
            return [("face", slipper.face, lambda new: replace(parts, slipper=replace(slipper, face=new)))]
        case Gap.VALVE_PLATE:
            block = parts.block
            return [("faces", block.faces, lambda new: replace(parts, block=replace(block, faces=new)))]
