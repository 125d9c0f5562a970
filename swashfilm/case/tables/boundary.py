"""Boundary table of a film case: conditions at the named edges of the film."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Annotated, Any

import numpy as np

from reynolds.problem import Cavitation
from swashfilm.case.fields.field import InTime, Uniform
from swashfilm.case.fields.mesh import CaseMesh
from swashfilm.case.tables.oil import ONLY_HEATED
from system.inputs.faults import nearest_choice
from system.inputs.sections.fields import FormulaOf, Limits, Temperature, field_type, fields_of
from system.inputs.sections.reader import Reading, read_entry
from system.inputs.sections.values import wanted
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity


@dataclass(frozen=True, kw_only=True)
class BoundarySection:
    """Conditions at one boundary, of entering oil."""

    pressure: Annotated[InTime, FormulaOf(Dimension.PRESSURE, place=False)] | None = None
    film_fraction: Annotated[float, Limits(above=0.0, most=1.0)] = 1.0
    temperature: Temperature | None = None  # left out: the inlet temperature of [thermal]


Boundaries = Mapping[str, BoundarySection]
BoundaryTables = field_type(Mapping[str, BoundarySection])


def read_boundaries(top: Table, reading: Reading, mesh: CaseMesh | None, level: float) -> Boundaries:
    """Return the conditions at the boundaries, by name, without those at fault; faults are listed.

    A starved boundary that states no pressure has the cavitation pressure, `level` (Pa).
    """
    raw = top.get("boundary")
    stated: Any = read_entry("boundary", BoundaryTables, {} if raw is None else raw, reading) or {}
    names, found = mesh.film_mesh.boundary_names if mesh else (), {}
    for name, entry in stated.items():
        path = f"boundary.{name}"
        if top.get("thermal") is None and getattr(entry, "temperature", None) is not None:
            reading.fault(f"{path}.temperature", "a temperature without a table [thermal]", ONLY_HEATED)
        if mesh and name not in names:
            sewn = {side for pair in mesh.film_mesh.seams for side in pair}
            what = "a side of the periodic seam" if name in sewn else "not a boundary of this mesh"
            reading.fault(path, what, f"one of {', '.join(names)}", nearest_choice(name, names))
        elif path in reading.faulty:
            continue
        elif entry.pressure is None and entry.film_fraction == 1.0:
            reading.fault(f"{path}.pressure", "missing", wanted(fields_of(BoundarySection)["pressure"]))
        else:
            found[name] = replace(entry, pressure=entry.pressure or Uniform(level, Dimension.PRESSURE))
    if mesh and not stated and "boundary" not in reading.faulty:
        top.fault("boundary", "no pressure at any boundary", f"a pressure at one of {', '.join(names)} at least")
    return found


def check_boundaries(
    top: Table, mesh: CaseMesh, boundary: Boundaries, cavitation: Cavitation, level: float, times: Sequence[float]
) -> None:
    """List faults of boundaries that contradict each other or, at some of the times (s), the cavitation pressure (Pa).

    A fault names the first such time.
    """
    _check_shared_edges(top, mesh, boundary)
    for name, stated in boundary.items():
        if stated.film_fraction < 1.0:
            _check_starved(top, name, stated, cavitation, level, times)
        elif cavitation is not Cavitation.NONE and (below := _first(stated, times, lambda value: value < level)):
            top.fault(
                f"boundary.{name}.pressure",
                below,
                f"at least the cavitation pressure, {format_quantity(level, Dimension.PRESSURE)}",
                "lower film.cavitation_pressure, or cavitation = 'none'",
            )


def _first(stated: BoundarySection, times: Sequence[float], wrong: Callable[[float], bool]) -> str:
    """Return the first wrong pressure of a boundary over times (s) in words, empty where none is wrong."""
    assert stated.pressure is not None
    for time in times:
        if wrong(value := stated.pressure.at_time(time)):
            if isinstance(stated.pressure, Uniform):
                return str(stated.pressure)
            return f"{stated.pressure}, {format_quantity(value, Dimension.PRESSURE, digits=5)} at {time:.4g} s"
    return ""


def _check_starved(
    top: Table, name: str, stated: BoundarySection, cavitation: Cavitation, level: float, times: Sequence[float]
) -> None:
    fraction = f"{stated.film_fraction:g}"
    if cavitation is not Cavitation.JFO:
        found = f"{fraction} with cavitation = '{cavitation.value}'"
        top.fault(f"boundary.{name}.film_fraction", found, "1, or cavitation = 'jfo', which transports it")
    elif other := _first(stated, times, lambda value: value != level):
        top.fault(
            f"boundary.{name}.pressure",
            f"{other} with film_fraction = {fraction}",
            f"the cavitation pressure, {format_quantity(level, Dimension.PRESSURE)}: more needs a full film",
        )


def _check_shared_edges(top: Table, mesh: CaseMesh, boundary: Boundaries) -> None:
    """List a fault for an edge with two pressures; a mesh file may name an edge twice (left and outer)."""
    facets = mesh.film_mesh.mesh.boundaries
    for (one, at), (other, at_other) in combinations(boundary.items(), 2):
        if at != at_other and one in facets and other in facets and np.intersect1d(facets[one], facets[other]).size:
            top.fault(f"boundary.{other}", f"shares edges with {one} at another pressure", "one pressure per edge")
