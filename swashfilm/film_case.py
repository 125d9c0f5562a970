"""A film case file: TOML to a validated film problem, and back to TOML with every default filled in."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from reynolds.errors import FilmInputError
from reynolds.film import Cavitation, Film, FilmProblem, Held
from reynolds.mesh import Array
from reynolds.solve import check_pressures
from reynolds.space import FilmSpace, film_space
from swashfilm.case_table import Table, fault_lines, read_toml
from swashfilm.fields import Field, MeshData, may_be_data, read_field
from swashfilm.gap_case import FORMAT, GapCase, read_gap_case
from swashfilm.mesh_case import CaseMesh, read_mesh
from swashfilm.oil_case import read_oil
from system.faults import InputFaults, nearest_choice
from system.units import Dimension, QuantityError, format_quantity


@dataclass(frozen=True)
class FilmCase:
    """A film case, validated: its name, the file's text, the same resolved, and the problem to be solved (SI)."""

    name: str
    text: str
    resolved: str
    problem: FilmProblem


@dataclass(frozen=True)
class _Film:
    """What a [film] table and its boundaries say, SI; None where a fault was told."""

    mesh: CaseMesh | None
    order: int | None
    thickness: Field | None
    velocity: tuple[Field | None, Field | None]
    squeeze: Field | None
    viscosity: Field | None
    cavitation: Cavitation | None
    cavitation_pressure: float | None
    boundary: dict[str, float]


def load_case(path: Path) -> FilmCase | GapCase:
    """The case of a file, ready to be solved: a free film, or a pump gap where it names one.

    Raises InputFaults with everything that is wrong: form, units, formulas, names of boundaries and data, a
    film thickness or viscosity that is not positive somewhere, and physics that this version does not have.
    """
    text, tables = read_toml(path)
    top = Table("", tables, [])
    _check_format(top)
    film = top if "gap" in tables else top.table("film", needed="that describes the film")
    if film and "gap" in film.values:
        case: FilmCase | GapCase | None = read_gap_case(path.stem, text, top, film, path.parent)
    else:
        case = _free_film(path, text, top, film) if film else None
    top.close()
    if top.faults or case is None:
        raise InputFaults(str(path), top.faults, fault_lines(text, top.faults))
    return case


def _free_film(path: Path, text: str, top: Table, film: Table) -> FilmCase | None:
    read = _read(top, film, path.parent)
    problem = _problem(film, read)
    if problem and not top.faults:
        try:
            check_pressures(problem)
        except FilmInputError as reason:
            top.fault(reason.where, reason.found, reason.expected)
    return None if top.faults or problem is None else FilmCase(path.stem, text, _resolved(read), problem)


def _check_format(top: Table) -> None:
    """Fault a case file that is not of this version's format, and the parts that it does not have yet."""
    stated = top.get("format")
    if type(stated) is not int or stated != FORMAT:
        found = "no such key" if stated is None else repr(stated)
        top.fault("format", found, f"format = {FORMAT}, the case format of this version")
    for later, what in (("time", "transient films"), ("study", "series of cases")):
        if top.get(later) is not None:
            top.fault(later, f"a table [{later}]", f"no such table: this version has no {what}")


def _read(top: Table, film: Table, folder: Path) -> _Film:
    mesh = read_mesh(film, folder)
    read = _Film(
        mesh=mesh,
        order=_order(film),
        thickness=_field(film, "thickness", Dimension.LENGTH, mesh),
        velocity=_velocity(film, mesh),
        squeeze=_field(film, "squeeze", Dimension.VELOCITY, mesh, "0 m/s"),
        viscosity=_viscosity(top, film, mesh),
        cavitation=_cavitation(film),
        cavitation_pressure=film.quantity("cavitation_pressure", Dimension.PRESSURE, 0.0),
        boundary=_boundary(top, mesh),
    )
    film.close()
    _check_together(top, film, read)
    return read


def _order(film: Table) -> int | None:
    raw = film.get("order")
    if raw is None:
        return 1
    if type(raw) is int and raw in (1, 2):
        return raw
    film.fault("order", repr(raw), "1 (linear pressure in a cell) or 2 (quadratic, full films only)")
    return None


def _field(
    film: Table, key: str, dimension: Dimension, mesh: CaseMesh | None, default: str | None = None
) -> Field | None:
    raw = film.get(key)
    return _as_field(film, key, default if raw is None else raw, dimension, mesh)


def _as_field(film: Table, key: str, raw: object, dimension: Dimension, mesh: CaseMesh | None) -> Field | None:
    if raw is None:
        film.fault(key, "no such key", f"{dimension.noun}, such as '{dimension.example}', or a formula of x and y")
        return None
    if mesh is None and may_be_data(raw):
        return None  # of a mesh whose own fault is told
    try:
        return read_field(raw, dimension, mesh.data if mesh else MeshData())
    except QuantityError as reason:
        film.fault(key, reason.found, reason.expected, reason.nearest)
        return None


def _velocity(film: Table, mesh: CaseMesh | None) -> tuple[Field | None, Field | None]:
    """Velocity of the moving wall in x and y; at rest where the case says nothing."""
    raw = film.get("velocity")
    parts = ["0 m/s", "0 m/s"] if raw is None else raw
    if not isinstance(parts, list) or len(parts) != 2:
        film.fault("velocity", repr(raw), 'two velocities, in x and y, such as ["1 m/s", "0 m/s"]')
        return None, None
    x, y = (
        _as_field(film, f"velocity[{index}]", part, Dimension.VELOCITY, mesh) for index, part in enumerate(parts)
    )
    return x, y


def _viscosity(top: Table, film: Table, mesh: CaseMesh | None) -> Field | None:
    oil = top.table("oil")
    raw = film.get("viscosity")
    if raw is not None and top.get("oil") is not None:
        film.fault("viscosity", "a viscosity beside a table [oil]", "one of the two")
    if raw is not None:
        return _as_field(film, "viscosity", raw, Dimension.DYNAMIC_VISCOSITY, mesh)
    if oil is not None:
        return read_oil(oil)
    if top.get("oil") is None:
        film.fault("viscosity", "no such key", "a viscosity, such as '30 mPa s', or a table [oil]")
    return None


def _cavitation(film: Table) -> Cavitation | None:
    if film.get("cavitation") == "jfo":
        film.fault("cavitation", "'jfo', which this version does not have", "'reynolds' or 'none'", "'reynolds'")
        return None
    return film.choice("cavitation", Cavitation, Cavitation.REYNOLDS)


def _boundary(top: Table, mesh: CaseMesh | None) -> dict[str, float]:
    """Pressures (Pa) of the named boundaries, their faults told."""
    table = top.table("boundary")
    names = mesh.film_mesh.boundary_names if mesh else ()
    found = {}
    for name in table.values if table else ():
        assert table is not None
        entry = table.table(name)
        if mesh and name not in names:
            sewn = {side for pair in mesh.film_mesh.seams for side in pair}
            what = "a side of the periodic seam" if name in sewn else "no boundary of this mesh"
            table.fault(name, what, f"one of {', '.join(names)}", nearest_choice(name, names))
        if entry is None:
            continue
        pressure = entry.quantity("pressure", Dimension.PRESSURE)
        if (fraction := entry.get("film_fraction")) is not None and fraction != 1.0:
            entry.fault("film_fraction", repr(fraction), "1.0 (this version supplies full films only)")
        entry.close()
        if pressure is not None:
            found[name] = pressure
    if mesh and not (table and table.values):
        top.fault("boundary", "no pressure given anywhere", f"a pressure at one of {', '.join(names)} at least")
    return found


def _check_together(top: Table, film: Table, read: _Film) -> None:
    """Faults of values that are right alone but not together."""
    if read.cavitation is Cavitation.REYNOLDS and read.order == 2:
        film.fault(
            "order",
            "2 with cavitation 'reynolds'" + ("" if "cavitation" in film.values else " (the default)"),
            "order = 1, or cavitation = 'none' (quadratic pressure is for full films only)",
        )
    _check_shared_edges(top, read)
    level = read.cavitation_pressure
    if read.cavitation is not Cavitation.REYNOLDS or level is None:
        return
    for name, pressure in read.boundary.items():
        if pressure < level:
            top.fault(
                f"boundary.{name}.pressure",
                format_quantity(pressure, Dimension.PRESSURE),
                f"at least the cavitation pressure, {format_quantity(level, Dimension.PRESSURE)}",
                "lower film.cavitation_pressure, or cavitation = 'none'",
            )


def _check_shared_edges(top: Table, read: _Film) -> None:
    """Fault an edge that two names hold at two pressures; a mesh file may name an edge twice (left and outer)."""
    facets = read.mesh.film_mesh.mesh.boundaries if read.mesh else {}
    for (one, at), (other, at_other) in combinations(read.boundary.items(), 2):
        if (
            at != at_other
            and one in facets
            and other in facets
            and np.intersect1d(facets[one], facets[other]).size
        ):
            top.fault(f"boundary.{other}", f"shares edges with {one} at another pressure", "one pressure an edge")


def _problem(film: Table, read: _Film) -> FilmProblem | None:
    """The problem of what was read; None where something is missing or a field is not as it must be."""
    if read.mesh is None or read.order is None:
        return None
    space = film_space(read.mesh.film_mesh, degree=read.order)
    thickness = _sampled(film, "thickness", read.thickness, space, positive=True)
    viscosity = _sampled(film, "viscosity", read.viscosity, space, positive=True)
    squeeze = _sampled(film, "squeeze", read.squeeze, space)
    u = _sampled(film, "velocity[0]", read.velocity[0], space)
    v = _sampled(film, "velocity[1]", read.velocity[1], space)
    if thickness is None or viscosity is None or squeeze is None or u is None or v is None:
        return None
    if read.cavitation is None or read.cavitation_pressure is None:
        return None
    still = np.zeros((1, 1))
    corners = read.thickness.at_vertices(space) if read.thickness else None
    return FilmProblem(
        space=space,
        film=Film(thickness, viscosity, (u, v), (still, still), squeeze, corners),
        boundary={name: Held(pressure) for name, pressure in read.boundary.items()},
        cavitation=read.cavitation,
        cavitation_pressure=read.cavitation_pressure,
    )


def _sampled(
    film: Table, key: str, field: Field | None, space: FilmSpace, *, positive: bool = False
) -> Array | None:
    """A field at the quadrature points; None, with the place told, where it has no value or is not positive."""
    if field is None:
        return None
    values = field.sample(space)
    x, y = (np.broadcast_to(part, space.area.shape) for part in space.points)
    full = np.broadcast_to(values, space.area.shape)
    if (corners := field.at_vertices(space)) is not None:  # a film may end at zero right at the edge
        x, y = (np.append(part, space.vertices[:, axis]) for axis, part in enumerate((x, y)))
        full = np.append(full, corners)
    bad = ~np.isfinite(full) | ((full <= 0.0) if positive else np.zeros(full.shape, dtype=bool))
    if not bad.any():
        return values
    worst = int(np.argmin(np.where(bad, np.nan_to_num(full, nan=-np.inf, posinf=-np.inf), np.inf)))
    at = f"x = {x.flat[worst]:.4g} m, y = {y.flat[worst]:.4g} m"
    film.fault(
        key,
        f"'{field}' is {full.flat[worst]:.4g} at {at}",
        "a value above zero everywhere" if positive else "a value everywhere",
    )
    return None


def _resolved(read: _Film) -> str:
    """A case file that gives this very case: every key, defaults filled in, units named."""
    rows: list[str] = [f"format = {FORMAT}", "", "[film]"]
    entries: dict[str, Any] = {
        "mesh": read.mesh.text if read.mesh else "",
        "order": read.order,
        "thickness": f'"{read.thickness}"  # m',
        "velocity": f'["{read.velocity[0]}", "{read.velocity[1]}"]  # m/s',
        "squeeze": f'"{read.squeeze}"  # m/s',
        "viscosity": f'"{read.viscosity}"  # Pa s',
        "cavitation": f'"{read.cavitation.value}"' if read.cavitation else "",
        "cavitation_pressure": f'"{format_quantity(read.cavitation_pressure or 0.0, Dimension.PRESSURE)}"',
    }
    rows += [f"{key} = {value}" for key, value in entries.items()]
    rows += ["", "[boundary]  # what is not named is closed"]
    rows += [
        f'"{name}" = {{ pressure = "{format_quantity(pressure, Dimension.PRESSURE)}" }}'
        for name, pressure in read.boundary.items()
    ]
    return "\n".join(rows) + "\n"
