"""Film problem of a film case: its fields sampled on the mesh."""

from __future__ import annotations

from reynolds.errors import InputError
from reynolds.fem.space import FilmSpace, film_space
from reynolds.laws.fluid import CONSTANT, Fluid
from reynolds.numerics.arrays import Array
from reynolds.problem import Film, FilmProblem, Held
from swashfilm.case.fields.field import Field
from swashfilm.case.fields.reader import field_fault
from swashfilm.case.statement import FilmStatement
from swashfilm.case.tables.film import AT_REST


def film_problem(stated: FilmStatement, space: FilmSpace | None = None, t: float = 0.0) -> FilmProblem:
    """Return the problem of a case at a time (s); `space`: the space on its mesh, where it exists already.

    Raises InputError for a field without a value somewhere, for a thickness or viscosity not above zero, and
    for an elastic body that does not lie under the film.
    """
    own, rough, contact = stated.film, stated.roughness, stated.contact
    space = space or film_space(own.mesh.film_mesh, degree=own.order)
    u, v = (_sampled("film.velocity", part, space, t) for part in own.velocity)
    u_fixed, v_fixed = (_sampled("film.velocity_fixed", part, space, t) for part in own.velocity_fixed)
    film = Film(
        thickness=_sampled("film.thickness", own.thickness, space, t, positive=own.load is None),
        viscosity=_sampled("film.viscosity", stated.viscosity, space, t, positive=True),
        velocity_moving=(u, v),
        velocity_fixed=(u_fixed, v_fixed),
        squeeze=_sampled("film.squeeze", own.squeeze or AT_REST[0], space, t),
        thickness_at_vertices=own.thickness.at_vertices(space, t),
    )
    return FilmProblem(
        space=space,
        film=film,
        boundary=held(stated, t),
        cavitation=own.cavitation,
        cavitation_pressure=own.cavitation_pressure,
        fluid=_fluid(stated),
        walls=stated.elastic.walls(space) if stated.elastic else None,
        surface=rough.surface if rough else None,
        asperities=contact.asperities(rough.surface) if rough and contact else None,
    )


def held(stated: FilmStatement, t: float) -> dict[str, Held]:
    """Return the boundary values at a time (s)."""
    return {
        name: Held(entry.pressure.at_time(t), entry.film_fraction)
        for name, entry in stated.boundary.items()
        if entry.pressure is not None
    }


def _fluid(stated: FilmStatement) -> Fluid:
    """Return the oil's laws over pressure; with temperature solved, the thermal solution sets the viscosity."""
    if stated.oil is None:
        return CONSTANT
    fluid = Fluid(density=stated.oil.density_over_pressure) if stated.thermal else stated.oil.fluid
    return CONSTANT if fluid == CONSTANT else fluid


def _sampled(where: str, field: Field, space: FilmSpace, t: float, *, positive: bool = False) -> Array:
    """Return a field at the quadrature points; raise InputError where its value is invalid."""
    if fault := field_fault(field, space, t, positive=positive):
        raise InputError(where, *fault)
    return field.sample(space, t)
