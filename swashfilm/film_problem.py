"""From what a film case states to the film problem: fields sampled on the mesh."""

from __future__ import annotations

from reynolds.errors import FilmInputError
from reynolds.film import Film, FilmProblem, Held
from reynolds.mesh import Array
from reynolds.space import FilmSpace, film_space
from swashfilm.field_reader import field_fault
from swashfilm.fields import Field
from swashfilm.film_statement import FilmStatement


def film_problem(stated: FilmStatement, space: FilmSpace | None = None) -> FilmProblem:
    """The problem that a case states, on its mesh (`space`, where it is there already).

    Raises FilmInputError for a field without a value somewhere and for a thickness or viscosity not above zero.
    """
    space = space or film_space(stated.mesh.film_mesh, degree=stated.order)
    u, v = (_sampled("film.velocity", part, space) for part in stated.velocity)
    u_fixed, v_fixed = (_sampled("film.velocity_fixed", part, space) for part in stated.velocity_fixed)
    film = Film(
        thickness=_sampled("film.thickness", stated.thickness, space, positive=True),
        viscosity=_sampled("film.viscosity", stated.viscosity, space, positive=True),
        velocity_moving=(u, v),
        velocity_fixed=(u_fixed, v_fixed),
        squeeze=_sampled("film.squeeze", stated.squeeze, space),
        thickness_at_vertices=stated.thickness.at_vertices(space),
    )
    return FilmProblem(
        space=space,
        film=film,
        boundary={name: Held(entry.pressure, entry.film_fraction) for name, entry in stated.boundary.items()},
        cavitation=stated.cavitation,
        cavitation_pressure=stated.cavitation_pressure,
    )


def _sampled(where: str, field: Field, space: FilmSpace, *, positive: bool = False) -> Array:
    """A field at the quadrature points, found possible there."""
    if fault := field_fault(field, space, positive=positive):
        raise FilmInputError(where, *fault)
    return field.sample(space)
