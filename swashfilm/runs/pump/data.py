"""Labelled arrays of a pump's operating point: results.nc, and the tables derived from it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from gaps.standing.gap_film import GapFilm
from swashfilm.output.data.files import RESULTS, add_group, columns_of, write_columns
from swashfilm.output.data.gap_names import kind_folder
from system.films.oil_state import UNITS, oil_state
from system.points.films import FilmsPoint
from system.pump.assembly import PumpPoint
from system.pump.laws.friction_pairs import Pair

if TYPE_CHECKING:
    import xarray

GAPS = ("piston", "slipper", "valve_plate")
PARTS = ("piston", "slipper")
"""The gaps that each kind of chambers has for itself."""
PICTURED_TURN = 0.75
"""Fraction of the turn at which gaps are drawn: the middle of delivery, largest piston speed."""
_GAP_SERIES = {
    "film_thickness_min": ("m", lambda film: film.loads.film_thickness_min),
    "film_thickness_mean": ("m", lambda film: film.film_thickness_mean),
    "pressure_max": ("Pa", lambda film: film.loads.pressure_max),
    "chamber_flow": ("m3/s", lambda film: film.chamber_flow),
    "leakage_flow": ("m3/s", lambda film: film.leakage_flow),
    "friction_power": ("W", lambda film: film.friction_power),
    "required_load": ("N", lambda film: film.required_load),
    "carried_load": ("N", lambda film: film.carried_load),
    "cavitated_area_fraction": ("1", lambda film: film.loads.cavitated_area_fraction),
}


def named_films(films: FilmsPoint) -> Iterator[tuple[str, str, tuple[GapFilm, ...]]]:
    """Yield a gap's name in words, its own name, and its films: of the most common kind, then of the others."""
    for number, kind in enumerate(films.kinds):
        place = [kind_folder(kind.chambers)] if number else []
        for gap in PARTS if number else GAPS:
            yield " ".join([*place, gap]).replace("_", " "), gap, getattr(kind.gaps, gap)


def point_dataset(point: PumpPoint, name: str) -> xarray.Dataset:
    """Return chamber, ports, flows and pair losses over `shaft_angle` (rad), SI units in the attributes.

    Chamber quantities belong to one chamber, pair losses to one piston, slipper or socket; port pressures, flows
    of the lines, torque and the other pairs to the whole pump. pump_delivery_flow is the volume flow through the
    delivery port at chamber pressure; line flows leave and enter the pump at port pressure.
    """
    import xarray

    cycle, pairs = point.cycle, [point.pairs.loss(pair) for pair in Pair]
    chamber = {
        "chamber_pressure": (cycle.pressure, "Pa"),
        "chamber_volume": (cycle.volume, "m3"),
        "delivery_area": (point.delivery_area, "m2"),
        "suction_area": (point.suction_area, "m2"),
        "delivery_flow": (cycle.flow.delivery, "m3/s"),
        "suction_flow": (cycle.flow.suction, "m3/s"),
        "piston_leakage": (cycle.flow.piston, "m3/s"),
        "slipper_leakage": (cycle.flow.slipper, "m3/s"),
        "valve_plate_leakage": (cycle.flow.valve_plate, "m3/s"),
        "pump_delivery_flow": (point.delivery_flow_ripple, "m3/s"),
        "delivery_pressure": (point.delivery.pressure, "Pa"),
        "inlet_pressure": (point.suction.pressure, "Pa"),
        "delivery_line_flow": (point.delivery.line_flow, "m3/s"),
        "inlet_line_flow": (-point.suction.line_flow, "m3/s"),
        "shaft_torque": (point.shaft_torque, "N m"),
    }
    return xarray.Dataset(
        {
            **{key: ("shaft_angle", values, {"units": unit}) for key, (values, unit) in chamber.items()},
            "loss_coulomb": (("pair", "shaft_angle"), [loss.coulomb for loss in pairs], {"units": "W"}),
            "loss_viscous": (("pair", "shaft_angle"), [loss.viscous for loss in pairs], {"units": "W"}),
        },
        coords={
            "shaft_angle": ("shaft_angle", cycle.shaft_angle, {"units": "rad"}),
            "pair": [pair.value for pair in Pair],
        },
        attrs={"name": name, "kind": "pump", "pressures": "gauge", "pitch_deg": 360.0 / point.pistons},
    )


def films_dataset(films: FilmsPoint, number: int = 0) -> xarray.Dataset:
    """Return series and fields of a kind's gaps over their film angles; vertices in the film plane (m).

    The most common kind, 0, has all three gaps; another its piston and its slipper.
    """
    import xarray

    data: dict[str, tuple[object, ...]] = {}
    coords: dict[str, tuple[object, ...]] = {}
    kind = films.kinds[number]
    for gap in PARTS if number else GAPS:
        angle, series = f"{gap}_angle", getattr(kind.gaps, gap)
        coords[angle] = (angle, kind.gaps.shaft_angle[: len(series)], {"units": "rad"})
        for name, (unit, value) in _GAP_SERIES.items():
            data[f"{gap}_{name}"] = (angle, np.array([value(film) for film in series]), {"units": unit})
        data |= _fields(gap, angle, series) | _oil_fields(gap, angle, films, series)
    return xarray.Dataset(data, coords=coords)


def _fields(gap: str, angle: str, series: Sequence[GapFilm]) -> dict[str, tuple[object, ...]]:
    spaces = [film.solution.problem.space for film in series]
    nodes = (angle, f"{gap}_vertex")
    pressure = [film.solution.pressure[space.vertex_dofs] for film, space in zip(series, spaces, strict=True)]
    thickness = [space.to_vertices(film.solution.film.thickness) for film, space in zip(series, spaces, strict=True)]
    return {
        f"{gap}_x": (nodes, np.array([space.vertices[:, 0] for space in spaces]), {"units": "m"}),
        f"{gap}_y": (nodes, np.array([space.vertices[:, 1] for space in spaces]), {"units": "m"}),
        f"{gap}_film_pressure": (nodes, np.array(pressure), {"units": "Pa"}),
        f"{gap}_film_thickness": (nodes, np.array(thickness), {"units": "m"}),
        f"{gap}_cells": ((f"{gap}_cell", f"{gap}_corner"), spaces[0].cells),
    }


def _oil_fields(gap: str, angle: str, films: FilmsPoint, series: Sequence[GapFilm]) -> dict[str, tuple[object, ...]]:
    physics, at = getattr(films.physics, gap), films.rotor
    states = [oil_state(at.pump, physics, film.solution, at.point.viscosity) for film in series]
    nodes = (angle, f"{gap}_vertex")
    fields = {name: np.array([state[name] for state in states]) for name in states[0]}
    return {f"{gap}_{name}": (nodes, values, {"units": UNITS[name]}) for name, values in fields.items()}


def write_tables(folder: Path, data: xarray.Dataset) -> None:
    """Write revolution.csv and, for solved films, `write_gap_tables`."""
    write_columns(folder / "revolution.csv", columns_of(data, "shaft_angle"))
    write_gap_tables(folder, data)


def write_gap_tables(folder: Path, data: xarray.Dataset) -> None:
    """Write one table per gap of the data, with units in the heads."""
    for gap in GAPS:
        if f"{gap}_angle" in data.dims:
            write_columns(folder / f"{gap}.csv", columns_of(data, f"{gap}_angle"))


def write_unlike(folder: Path, films: FilmsPoint) -> None:
    """Write chamber_N/ of the less common kinds: tables of piston and slipper, and a group of results.nc."""
    for number, kind in enumerate(films.kinds[1:], start=1):
        place, data = kind_folder(kind.chambers), films_dataset(films, number)
        (folder / place).mkdir()
        write_gap_tables(folder / place, data)
        add_group(data, folder / RESULTS, place)
