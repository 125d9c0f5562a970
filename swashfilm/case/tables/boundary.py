"""Boundary table of a film case: conditions at the named edges of the film."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from reynolds.problem import Cavitation
from swashfilm.case.fields.field import CellData, InTime, MeshData, PointData, Uniform, read_field
from swashfilm.case.fields.reader import FieldReader
from system.inputs.faults import nearest_choice
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, QuantityError, format_quantity


@dataclass(frozen=True)
class BoundaryStatement:
    """Conditions at one boundary: pressure (Pa), film fraction and temperature (K) of entering oil.

    The temperature is None where the inlet temperature of [thermal] holds.
    """

    pressure: InTime
    film_fraction: float = 1.0
    temperature: float | None = None


Boundaries = Mapping[str, BoundaryStatement]


def read_boundaries(top: Table, reader: FieldReader, level: float | None) -> Boundaries:
    """Return the conditions at the boundaries, by name; list their faults. `level`: cavitation pressure, Pa."""
    mesh = reader.mesh
    table = top.table("boundary")
    names = mesh.film_mesh.boundary_names if mesh else ()
    found = {}
    for name in table.values if table else ():
        assert table is not None
        entry = table.table(name)
        if mesh and name not in names:
            sewn = {side for pair in mesh.film_mesh.seams for side in pair}
            what = "a side of the periodic seam" if name in sewn else "not a boundary of this mesh"
            table.fault(name, what, f"one of {', '.join(names)}", nearest_choice(name, names))
        if entry and (stated := _entry(entry, reader, level)) is not None:
            found[name] = stated
    if mesh and not (table and table.values):
        top.fault("boundary", "no pressure at any boundary", f"a pressure at one of {', '.join(names)} at least")
    return found


def _entry(entry: Table, reader: FieldReader, level: float | None) -> BoundaryStatement | None:
    fraction = entry.number("film_fraction", 1.0)
    if fraction is not None and not 0.0 < fraction <= 1.0:
        entry.fault("film_fraction", repr(fraction), "above 0 (dry), at most 1 (flooded)")
        fraction = None
    starved = fraction is None or fraction < 1.0
    pressure = _pressure(entry, reader, level if starved else None)
    temperature = entry.positive("temperature", Dimension.TEMPERATURE) if entry.get("temperature") else None
    entry.close()
    return None if pressure is None or fraction is None else BoundaryStatement(pressure, fraction, temperature)


def _pressure(entry: Table, reader: FieldReader, default: float | None) -> InTime | None:
    """Return a pressure, or a formula of constants (in a transient of t too); None with its fault listed."""
    in_time = tuple(name for name in reader.variables if name == "t")
    if (in_time or reader.constants) and isinstance(entry.get("pressure"), str):
        try:
            field = read_field(entry.get("pressure"), Dimension.PRESSURE, MeshData(), in_time, reader.constants)
        except QuantityError as reason:
            entry.fault("pressure", reason.found, reason.expected, reason.nearest)
            return None
        assert not isinstance(field, (PointData, CellData))
        return field
    pressure = entry.quantity("pressure", Dimension.PRESSURE, default)
    return None if pressure is None else Uniform(pressure, Dimension.PRESSURE)


def check_boundaries(
    top: Table, reader: FieldReader, boundary: Boundaries, cavitation: Cavitation | None, level: float | None
) -> None:
    """List faults of boundaries that contradict each other or the cavitation pressure (Pa)."""
    _check_shared_edges(top, reader, boundary)
    if cavitation is None or level is None:
        return
    for name, stated in boundary.items():
        if stated.film_fraction < 1.0:
            _check_starved(top, name, stated, cavitation, level)
        elif cavitation is not Cavitation.NONE and stated.pressure.at_time(0.0) < level:
            top.fault(
                f"boundary.{name}.pressure",
                str(stated.pressure),
                f"at least the cavitation pressure, {format_quantity(level, Dimension.PRESSURE)}",
                "lower film.cavitation_pressure, or cavitation = 'none'",
            )


def _check_starved(top: Table, name: str, stated: BoundaryStatement, cavitation: Cavitation, level: float) -> None:
    fraction = f"{stated.film_fraction:g}"
    if cavitation is not Cavitation.JFO:
        found = f"{fraction} with cavitation = '{cavitation.value}'"
        top.fault(f"boundary.{name}.film_fraction", found, "1, or cavitation = 'jfo', which transports it")
    elif stated.pressure.at_time(0.0) != level:
        top.fault(
            f"boundary.{name}.pressure",
            f"{stated.pressure} with film_fraction = {fraction}",
            f"the cavitation pressure, {format_quantity(level, Dimension.PRESSURE)}: more needs a full film",
        )


def _check_shared_edges(top: Table, reader: FieldReader, boundary: Boundaries) -> None:
    """List a fault for an edge with two pressures; a mesh file may name an edge twice (left and outer)."""
    facets = reader.mesh.film_mesh.mesh.boundaries if reader.mesh else {}
    for (one, at), (other, at_other) in combinations(boundary.items(), 2):
        if at != at_other and one in facets and other in facets and np.intersect1d(facets[one], facets[other]).size:
            top.fault(f"boundary.{other}", f"shares edges with {one} at another pressure", "one pressure per edge")
