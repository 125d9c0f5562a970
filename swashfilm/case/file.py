"""Film case file: TOML to a validated film problem, and back to TOML with every default filled in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from reynolds.errors import InputError
from reynolds.fem.space import film_space
from reynolds.problem import Cavitation, FilmProblem
from reynolds.solve.boundary import check_pressures
from swashfilm.case.fields.expressions import IN_TIME, PLACE
from swashfilm.case.fields.field import Field, Uniform
from swashfilm.case.fields.mesh import read_mesh
from swashfilm.case.fields.reader import FieldReader
from swashfilm.case.gap.instant import FORMAT, GapCase, read_gap_case
from swashfilm.case.gap.revolution import RevolutionCase, read_revolution_case
from swashfilm.case.problem import film_problem
from swashfilm.case.resolved import resolved_text
from swashfilm.case.statement import FilmStatement
from swashfilm.case.tables.boundary import check_boundaries, read_boundaries
from swashfilm.case.tables.constants import read_constants
from swashfilm.case.tables.elastic import read_elastic
from swashfilm.case.tables.load import read_load
from swashfilm.case.tables.oil import OilSection, oil_viscosity, read_oil
from swashfilm.case.tables.roughness import read_roughness
from swashfilm.case.tables.thermal import read_thermal
from swashfilm.case.tables.time_steps import initial_film_fraction, read_time
from system.inputs.faults import InputFaults
from system.inputs.toml_table import Table, fault_lines, read_toml
from system.inputs.units import Dimension


@dataclass(frozen=True)
class FilmCase:
    """A validated film case: name, text of the file, resolved text, statement, and problem (SI)."""

    name: str
    text: str
    resolved: str
    stated: FilmStatement
    problem: FilmProblem

    def refined(self) -> FilmCase:
        """Return the case on a mesh twice finer; raise InputError where a field has no valid value there."""
        stated = self.stated.refined()
        return replace(self, stated=stated, problem=film_problem(stated), resolved=resolved_text(stated))


Case = FilmCase | GapCase | RevolutionCase


def load_case(path: Path) -> Case:
    """Return the case of a file, ready to be solved: a free film, or a pump gap where the case names one.

    Raises InputFaults with every fault: form, units, formulas, names of boundaries and data, a film thickness or
    viscosity that is not positive somewhere, and physics that this version does not model.
    """
    text, tables = read_toml(path)
    return read_case(path, text, tables)


def read_case(path: Path, text: str, tables: Mapping[str, Any]) -> Case:
    """Return the case of a file's tables; `text` and `path` serve its name, its faults and relative paths."""
    top = Table("", tables, [])
    _check_format(top)
    film = top if "gap" in tables else top.table("film", needed="that describes the film")
    if film and "gap" in film.values:
        over_turn = film.values.get("revolution", False) is not False
        read_gap = read_revolution_case if over_turn else read_gap_case
        case: Case | None = read_gap(path.stem, text, top, film, path.parent)
    else:
        case = _free_film(path, text, top, film) if film else None
    top.close()
    if top.faults or case is None:
        raise InputFaults(str(path), top.faults, fault_lines(text, top.faults))
    return case


def _check_format(top: Table) -> None:
    """List faults of a case file of another format, and of parts that a single case does not have."""
    stated = top.get("format")
    if type(stated) is not int or stated != FORMAT:
        found = "missing" if stated is None else repr(stated)
        top.fault("format", found, f"format = {FORMAT}, the case format of this version")
    if top.get("study") is not None:
        top.fault("study", "a table [study]", "a single case; `swashfilm film` runs studies")


def _free_film(path: Path, text: str, top: Table, film: Table) -> FilmCase | None:
    mesh, order = read_mesh(film, path.parent), _order(film)
    space = film_space(mesh.film_mesh, degree=order) if mesh and order else None
    variables = PLACE if top.get("time") is None else IN_TIME
    reader = FieldReader(mesh, space, variables, read_constants(top))
    stated = _stated(top, film, reader, order, path.parent)
    if stated is None or top.faults:
        return None
    try:
        problem = film_problem(stated, space)
        check_pressures(problem)
    except InputError as reason:
        top.fault(reason.where, reason.found, reason.expected)
        return None
    return FilmCase(path.stem, text, resolved_text(stated), stated, problem)


def _stated(top: Table, film: Table, reader: FieldReader, order: int | None, folder: Path) -> FilmStatement | None:
    """Return the statement of the case; None with its faults listed."""
    faults = len(top.faults)
    time, load = read_time(top), read_load(top, film)
    is_shape = film.get("load") is not None
    viscosity, oil = _viscosity(top, film, reader)
    parts: dict[str, Any] = {
        "mesh": reader.mesh,
        "order": order,
        "thickness": reader.field(film, "thickness", Dimension.LENGTH, positive=not is_shape),
        "velocity": reader.vector(film, "velocity", Dimension.VELOCITY, "0 m/s"),
        "velocity_fixed": reader.vector(film, "velocity_fixed", Dimension.VELOCITY, "0 m/s"),
        "squeeze": reader.field(film, "squeeze", Dimension.VELOCITY, "0 m/s"),
        "viscosity": viscosity,
        "cavitation": film.choice("cavitation", Cavitation, Cavitation.JFO),
        "cavitation_pressure": film.quantity("cavitation_pressure", Dimension.PRESSURE, 0.0),
        "initial_film_fraction": initial_film_fraction(top, film, reader),
    }
    parts["boundary"] = read_boundaries(top, reader, parts["cavitation_pressure"])
    elastic = read_elastic(top, reader.mesh.film_mesh if reader.mesh else None, folder)
    is_sound = elastic is not None or top.get("elastic") is None
    thermal = read_thermal(top, (elastic.bodies if elastic else {}) if is_sound else None)
    rough = read_roughness(top)
    film.close()
    _check_order(film, parts, with_heat=top.get("thermal") is not None)
    check_boundaries(top, reader, parts["boundary"], parts["cavitation"], parts["cavitation_pressure"])
    _check_tables(top, film, oil, viscosity)
    if None in parts.values() or len(top.faults) > faults:
        return None
    return FilmStatement(
        **parts, oil=oil, thermal=thermal, elastic=elastic, rough=rough, time=time, load=load,
        constants=reader.constants,
    )  # fmt: skip


def _order(film: Table) -> int | None:
    raw = film.get("order")
    if raw is None:
        return 1
    if type(raw) is int and raw in (1, 2):
        return raw
    film.fault("order", repr(raw), "1 (linear pressure in a cell) or 2 (quadratic, full films only)")
    return None


def _viscosity(top: Table, film: Table, reader: FieldReader) -> tuple[Field | None, OilSection | None]:
    """Return viscosity at zero pressure and the oil's temperature, and the oil; None with the faults listed."""
    table = top.table("oil")
    given = film.get("viscosity") is not None
    with_heat = top.get("thermal") is not None
    oil = read_oil(table, with_viscosity=given, with_heat=with_heat) if table else None
    if given:
        return reader.field(film, "viscosity", Dimension.DYNAMIC_VISCOSITY, positive=True), oil
    if table and oil:
        viscosity = oil_viscosity(table, oil)
        return None if viscosity is None else Uniform(viscosity, Dimension.DYNAMIC_VISCOSITY), oil
    if top.get("oil") is None:
        film.fault("viscosity", "missing", "a viscosity, such as '30 mPa s', or a table [oil]")
    return None, None


def _check_tables(top: Table, film: Table, oil: OilSection | None, viscosity: Field | None) -> None:
    """List faults of tables that exclude or need each other."""
    if top.get("thermal") is None:
        return
    if top.get("oil") is None:
        top.fault("thermal", "no table [oil]", "its density, temperature, specific heat and thermal conductivity")
    if oil is None or oil.kinematic is not None:
        return
    table = top.get("oil")
    if "temperature_coefficient" not in table:
        expected = "the decrease of viscosity with temperature ('0.03 1/K'), or a grade in place of film.viscosity"
        top.fault("oil.temperature_coefficient", "missing", expected)
    if viscosity is not None and not isinstance(viscosity, Uniform):
        film.fault("viscosity", f"'{viscosity}' with a table [thermal]", "one viscosity, at the oil's temperature")


def _check_order(film: Table, parts: Mapping[str, Any], *, with_heat: bool) -> None:
    cavitation = parts["cavitation"]
    if parts["order"] == 2 and cavitation not in (None, Cavitation.NONE):
        film.fault(
            "order",
            f"2 with cavitation '{cavitation.value}'" + ("" if "cavitation" in film.values else " (the default)"),
            "order = 1, or cavitation = 'none' (quadratic pressure is for full films only)",
        )
    elif parts["order"] == 2 and with_heat:
        film.fault("order", "2 with a table [thermal]", "order = 1: heat is transported by linear pressure only")
