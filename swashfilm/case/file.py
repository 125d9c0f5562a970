"""Film case file: TOML to a validated film problem, and back to TOML with every default filled in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from reynolds.errors import InputError
from reynolds.fem.space import FilmSpace, film_space
from reynolds.problem import FilmProblem
from reynolds.solve.boundary import check_pressures
from swashfilm.case.fields.expressions import parse_expression
from swashfilm.case.fields.field import Field, Formula, Uniform
from swashfilm.case.fields.mesh import CaseMesh
from swashfilm.case.fields.reader import FieldReader
from swashfilm.case.gap.instant import FORMAT, GapCase, read_gap_case
from swashfilm.case.gap.revolution import RevolutionCase, read_revolution_case
from swashfilm.case.problem import film_problem
from swashfilm.case.resolved import resolved_text
from swashfilm.case.statement import FilmStatement
from swashfilm.case.tables.boundary import check_boundaries, read_boundaries
from swashfilm.case.tables.constants import read_constants
from swashfilm.case.tables.elastic import read_elastic
from swashfilm.case.tables.film import FilmSection, Geometry, check_film
from swashfilm.case.tables.oil import FilmOilSection, read_oil
from swashfilm.case.tables.roughness import read_roughness
from swashfilm.case.tables.thermal import read_thermal
from swashfilm.case.tables.time_steps import TimeStepsSection, read_time
from system.inputs.faults import InputFaults
from system.inputs.sections.fields import fields_of
from system.inputs.sections.reader import Reading, read_entry, read_section
from system.inputs.toml_table import Table, fault_lines, read_toml
from system.inputs.units import Dimension
from system.inputs.versions import version_fault


@dataclass(frozen=True)
class FilmCase:
    """A validated film case: name, text of the file, resolved text, statement, and problem (SI)."""

    name: str
    text: str
    resolved: str
    stated: FilmStatement
    problem: FilmProblem

    @property
    def geometry(self) -> Geometry:
        """Shape of the faces."""
        return self.stated.film.geometry

    def refined(self) -> FilmCase:
        """Return the case on a mesh twice finer, with half its time step and more levels across a warm film.

        Raises InputError where a field has no valid value there.
        """
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
    if fault := version_fault("format", top.get("format"), FORMAT, "case"):
        top.faults.append(fault)
    if top.get("study") is not None:
        top.fault("study", "a table [study]", "a single case; `swashfilm film` runs studies")


def _free_film(path: Path, text: str, top: Table, film: Table) -> FilmCase | None:
    stated, space = _stated(top, film, path.parent)
    if stated is None or top.faults:
        return None
    try:
        problem = film_problem(stated, space)
        check_pressures(problem)
    except InputError as reason:
        top.fault(reason.where, reason.found, reason.expected)
        return None
    return FilmCase(path.stem, text, resolved_text(stated), stated, problem)


def _stated(top: Table, film: Table, folder: Path) -> tuple[FilmStatement | None, FilmSpace | None]:
    """Return the statement of the case, None with its faults listed, and the space on its mesh."""
    faults, constants = len(top.faults), read_constants(top)
    reading = Reading(folder, faults=top.faults)
    mesh = _mesh(film, reading)
    reading.formula = FieldReader(mesh.data if mesh else None, top.get("time") is not None, constants)
    reading.special = {"film.mesh": lambda *_: {"mesh": mesh}}
    section = read_section("film", FilmSection, film.values, reading)
    space = film_space(mesh.film_mesh, degree=section.order) if mesh else None
    check_film(top, film, section, space, reading)
    boundary = read_boundaries(top, reading, mesh, section.cavitation_pressure)
    time, oil, (roughness, contact) = read_time(top), _oil(top, film), read_roughness(top)
    if mesh and not reading.faulty & {"film.cavitation", "film.cavitation_pressure"}:
        times = time.output_times if time else [0.0]
        check_boundaries(top, mesh, boundary, section.cavitation, section.cavitation_pressure, times)
    elastic = read_elastic(top, mesh.film_mesh if mesh else None, folder)
    is_sound = elastic is not None or top.get("elastic") is None
    thermal = read_thermal(top, (elastic.bodies if elastic else {}) if is_sound else None)
    if top.get("thermal") is not None:
        _check_heat(top, film, oil, getattr(section, "viscosity", None))
    if len(top.faults) > faults:
        return None, None
    filled = _filled(section, time)
    return FilmStatement(filled, boundary, oil, thermal, elastic, roughness, contact, time, constants), space


def _mesh(film: Table, reading: Reading) -> CaseMesh | None:
    """Return the mesh of a [film] table; None with its faults listed, and without a mesh."""
    raw = film.get("mesh")
    found = None if raw is None else read_entry("film.mesh", fields_of(FilmSection)["mesh"], raw, reading)
    return found if isinstance(found, CaseMesh) and "film.mesh" not in reading.faulty else None


def _filled(section: FilmSection, time: TimeStepsSection | None) -> FilmSection:
    """Return the table with its defaults: at rest and full of oil."""
    if time is None:
        return replace(section, squeeze=section.squeeze or Uniform(0.0, Dimension.VELOCITY))
    return replace(section, initial_film_fraction=section.initial_film_fraction or Formula(parse_expression("1.0")))


def _oil(top: Table, film: Table) -> FilmOilSection | None:
    """Return the [oil] table; None if it is absent, or with its faults listed."""
    given = "viscosity" in film.values
    if top.get("oil") is None and not given:
        film.fault("viscosity", "missing", "a viscosity, such as '30 mPa s', or a table [oil]")
    table = top.table("oil")
    return read_oil(table, with_viscosity=given, with_heat=top.get("thermal") is not None) if table else None


def _check_heat(top: Table, film: Table, oil: FilmOilSection | None, viscosity: Field | None) -> None:
    """List faults of the data for a solved temperature."""
    if top.get("oil") is None:
        top.fault("thermal", "no table [oil]", "its density, temperature, specific heat and thermal conductivity")
    if oil is None or oil.kinematic is not None:
        return
    if oil.temperature_coefficient is None:
        expected = "the decrease of viscosity with temperature ('0.03 1/K'), or a grade in place of film.viscosity"
        top.fault("oil.temperature_coefficient", "missing", expected)
    if viscosity is not None and not isinstance(viscosity, Uniform):
        film.fault("viscosity", f"'{viscosity}' with a table [thermal]", "one viscosity, at the oil's temperature")
