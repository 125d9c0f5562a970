"""Film table of a free film: mesh, fields, cavitation and load."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Annotated

import numpy as np

from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation
from reynolds.solve.load_search import RigidLoad
from swashfilm.case.fields.field import Field, Uniform
from swashfilm.case.fields.mesh import AnnulusSection, MeshForm
from swashfilm.case.fields.reader import field_fault
from system.inputs.sections.fields import FormulaOf, Limits, Positive, Pressure, Several, fields_of
from system.inputs.sections.reader import Reading
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity

Velocity = Annotated[tuple[Field, Field], Several(2), FormulaOf(Dimension.VELOCITY)]
AT_REST = (Uniform(0.0, Dimension.VELOCITY), Uniform(0.0, Dimension.VELOCITY))
Moment = Annotated[float, Dimension.TORQUE]


class Geometry(Enum):
    """Shape of the faces: plane, or a full turn of a cylinder unrolled along x, whose load is a vector."""

    PLANE = "plane"
    CYLINDER = "cylinder"


@dataclass(frozen=True, kw_only=True)
class FilmSection:
    """[film]: a free film; viscosity is that without pressure at the oil's temperature."""

    mesh: MeshForm
    order: Annotated[int, Limits(least=1, most=2, why="linear or quadratic pressure")] = 1  # 2: full films only
    thickness: Annotated[Field, FormulaOf(Dimension.LENGTH)]  # with a load the shape, to which a separation is added
    velocity: Velocity = AT_REST  # of the moving wall along x and y
    velocity_fixed: Velocity = AT_REST  # of the fixed wall along x and y
    squeeze: Annotated[Field, FormulaOf(Dimension.VELOCITY)] | None = None  # dh/dt, not beside [time]
    viscosity: Annotated[Field, FormulaOf(Dimension.DYNAMIC_VISCOSITY)] | None = None  # left out: by the oil's grade
    cavitation: Cavitation = Cavitation.JFO
    cavitation_pressure: Pressure = 0.0
    initial_film_fraction: Annotated[Field, FormulaOf(None, time=False)] | None = None  # at the start of [time]
    load: Annotated[float, Dimension.FORCE, Positive] | None = None  # that film and contact are to bear
    moment_x: Moment | None = None  # integral of p y; frees the tilt along y
    moment_y: Moment | None = None  # integral of -p x; frees the tilt along x
    geometry: Geometry = Geometry.PLANE

    @property
    def rigid_load(self) -> RigidLoad | None:
        """The load, SI; None with a given thickness."""
        return None if self.load is None else RigidLoad(self.load, self.moment_x, self.moment_y)

    @property
    def every_field(self) -> Iterator[tuple[str, Field]]:
        """Each field with its key."""
        for key, own in fields_of(FilmSection).items():
            value = getattr(self, key, None) if own.formula else None
            yield from ((key, one) for one in (value if isinstance(value, tuple) else (value,)) if one is not None)


def check_film(top: Table, film: Table, stated: FilmSection, space: FilmSpace | None, reading: Reading) -> None:
    """List faults of keys that exclude or need each other, and of fields without a valid value on the space."""
    in_time, has_load = top.get("time") is not None, "load" in film.values
    if top.get("load") is not None:
        top.fault("load", "a table [load] of a free film", "keys of [film]", 'load = "1 kN" in [film]')
    if not has_load and (moments := [key for key in ("moment_x", "moment_y") if key in film.values]):
        film.fault(moments[0], "a moment without a load", 'a load besides, such as load = "1 kN"')
    if has_load and in_time:
        film.fault("load", "a load beside a table [time]", "one of the two: a transient states its thickness")
    if film.values.get("geometry") == Geometry.CYLINDER.value:
        _check_cylinder(film, stated)
    if "initial_film_fraction" in film.values and not in_time:
        film.fault("initial_film_fraction", "a start without a table [time]", "a steady film without this key")
    if "squeeze" in film.values and in_time:
        film.fault("squeeze", "dh/dt beside a table [time]", "a transient without this key: dh/dt follows from t")
    for key, field in stated.every_field if space else ():
        assert space is not None
        positive = key in ("viscosity", "initial_film_fraction") or (key == "thickness" and not has_load)
        if fault := field_fault(field, space, positive=positive):
            film.fault(key, *fault)
        elif key == "thickness" and not has_load and (ratio := _thickness_ratio(field, space)) >= 1.0:
            extent = format_quantity(extent_of(space), Dimension.LENGTH, digits=4)
            found = f"'{field}', in the mean {ratio:.3g} times the film's extent of {extent}"
            film.fault(key, found, "a film much thinner than its extent, both in m", "is it in um? times 1e-6")
        elif key == "initial_film_fraction" and (most := field.sample(space).max()) > 1.0:
            film.fault(key, f"{most:.4g}", "a number above 0 and at most 1, or a formula of x and y (text in quotes)")
    if not reading.faulty & {"film.order", "film.cavitation"}:
        _check_order(film, stated, with_heat=top.get("thermal") is not None)


def mean_over(space: FilmSpace, field: Array) -> float:
    """Return the mean of a field (cells | 1, points | 1) over the film."""
    return float(np.sum(field * space.area)) / float(space.area.sum())


def extent_of(space: FilmSpace) -> float:
    """Return the square root of the film's area, m."""
    return float(np.sqrt(space.area.sum()))


def _thickness_ratio(field: Field, space: FilmSpace) -> float:
    return mean_over(space, field.sample(space)) / extent_of(space)


def _check_cylinder(film: Table, stated: FilmSection) -> None:
    """List faults of a film that is no full turn of a cylinder, or whose load is required in its plane."""
    if isinstance(getattr(stated, "mesh", None), AnnulusSection):
        film.fault("geometry", "'cylinder' with an annulus", "a mesh whose x runs once around the cylinder")
    if "load" in film.values:
        film.fault("load", "a load with geometry = 'cylinder'", "a thickness, such as c*(1 + e*cos(x/radius))")


def _check_order(film: Table, stated: FilmSection, *, with_heat: bool) -> None:
    if stated.order == 2 and stated.cavitation is not Cavitation.NONE:
        film.fault(
            "order",
            f"2 with cavitation '{stated.cavitation.value}'"
            + ("" if "cavitation" in film.values else " (the default)"),
            "order = 1, or cavitation = 'none' (quadratic pressure is for full films only)",
        )
    elif stated.order == 2 and with_heat:
        film.fault("order", "2 with a table [thermal]", "order = 1: heat is transported by linear pressure only")
