"""Data of a gap over the turn: series over the shaft angle and kept films for results.nc, and tables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gaps.films.reports import Active
from gaps.revolution.course import GapInstant
from reynolds.equation.rough_overlap import vertex_thickness
from reynolds.numerics.arrays import Array
from reynolds.solve.export import write_pvd, write_vtu
from swashfilm.output.data.files import Column, columns_of, write_columns
from swashfilm.output.gap_names import FIELDS, vtu_name
from swashfilm.runs.film.revolution.solve import RevolutionStudy, friction_power, tilt
from system.description.gap import Gap
from system.films.places import place_of
from system.films.rotor import engaged_share

if TYPE_CHECKING:
    import xarray

POSITIONS = {
    Gap.PISTON: ("eccentricity_x_inner", "eccentricity_y_inner", "eccentricity_x_case", "eccentricity_y_case"),
    Gap.SLIPPER: ("film_thickness_under_ball", "rise_x", "rise_y"),
    Gap.VALVE_PLATE: ("film_thickness_on_axis", "rise_x", "rise_y"),
}
"""Names of a gap's coordinates, m; rises at the outer radius of the last land."""
PLACES = {
    Gap.PISTON: ("least_film_around", "least_film_along"),
    Gap.SLIPPER: ("least_film_around", "least_film_radius"),
    Gap.VALVE_PLATE: ("least_film_around", "least_film_radius"),
}
"""Names of the place where a gap's film is thinnest: angle around, rad, and along the bore or from the middle, m.

Around: of a piston from the inner dead centre's side, of a slipper from the plate's steepest line, of the block
from the inner dead centre; along: from the guide's inner end.
"""
PISTON_END = ("eccentricity_x_end", "eccentricity_y_end")
"""Eccentricity of the piston's axis at the inner end of its film, m."""


Instant = GapInstant[Any]


@dataclass(frozen=True)
class Series:
    """A number over the shaft angle: its SI unit and its function of an instant."""

    unit: str
    value: Callable[[Instant], float]


SERIES = {
    "film_thickness_min": Series("m", lambda at: at.film_thickness_min),
    "film_thickness_mean": Series("m", lambda at: at.mean_film),
    "least_gap": Series("m", lambda at: at.least_gap),
    "leakage_flow": Series("m3/s", lambda at: at.report.leakage),
    "chamber_flow": Series("m3/s", lambda at: float(at.report.flow.sum())),
    "contact_load": Series("N", lambda at: at.report.contact_load),
    "cavitated_area_fraction": Series("1", lambda at: at.cavitated_area_fraction),
    "film_pressure_max": Series("Pa", lambda at: at.pressure_max),
    "heat": Series("W", lambda at: at.report.heat.total),
    "rubbing": Series("W", lambda at: at.report.heat.rubbing),
}


def revolution_dataset(study: RevolutionStudy) -> xarray.Dataset:
    """Return series over `shaft_angle` (rad), a variable of 0 or 1 per `Active`, and films over `film_angle`."""
    import xarray

    found, instants = study.revolution, study.revolution.turn.instants
    positions = zip(POSITIONS[study.case.gap], found.positions.T, strict=True)
    numbers: dict[str, tuple[Any, str]] = {name: (values, "m") for name, values in positions}
    numbers |= {name: ([one.value(at) for at in instants], one.unit) for name, one in SERIES.items()}
    if study.case.gap is Gap.PISTON:
        numbers |= {name: (values, "m") for name, values in zip(PISTON_END, piston_end(study), strict=True)}
    where = zip(PLACES[study.case.gap], thinnest(study), ("rad", "m"), strict=True)
    numbers |= {name: (values, unit) for name, values, unit in where}
    numbers |= {
        "tilt": (tilt(study), "rad"),
        "friction_power": ([friction_power(study, at.report) for at in instants], "W"),
        "chamber_pressure": (study.chamber_pressure, "Pa"),
    }  # fmt: skip
    if (warmth := found.warmth) is not None:
        numbers |= {
            "film_temperature_mean": (warmth.mean_at(found.angles), "K"),
            "film_temperature_max": (warmth.hottest_at(found.angles), "K"),
        }
    active = {kind: [float(kind in at.report.active) for at in instants] for kind in Active}
    numbers |= {f"active_{kind.value}": (values, "1") for kind, values in active.items()}
    return xarray.Dataset(
        {name: ("shaft_angle", np.array(values), {"units": unit}) for name, (values, unit) in numbers.items()}
        | _films(study),
        coords={"shaft_angle": ("shaft_angle", found.angles, {"units": "rad"})},
        attrs={
            "name": study.case.name,
            "kind": "film_revolution",
            "gap": study.case.gap.value,
            "pressures": "gauge",
            "clearance_m": study.case.rotor.pump.piston.radial_clearance,
            **_walls(study),
        },
    )


def _walls(study: RevolutionStudy) -> dict[str, float]:
    """Return temperatures (K) of the walls of a gap with solved temperature."""
    warmth = study.revolution.warmth
    if warmth is None:
        return {}
    return {f"{wall}_wall_temperature_K": float(at) for wall, at in zip(("fixed", "moving"), warmth.walls, strict=True)}


def thinnest(study: RevolutionStudy) -> tuple[Array, Array]:
    """Return the places (n,) rad and (n,) m of the least film, see `PLACES`."""
    x, y = np.array([instant.thinnest for instant in study.revolution.turn.instants]).T
    if study.case.gap is Gap.PISTON:
        return 2.0 * x / study.case.rotor.pump.pump.piston_diameter, y
    if study.case.gap is Gap.VALVE_PLATE:
        x, y, _ = study.case.rotor.pump.valve_plate.sphere.place(x, y)
    return np.arctan2(y, x) % (2.0 * np.pi), np.hypot(x, y)


def piston_end(study: RevolutionStudy) -> Array:
    """Return the eccentricity (2, n) m of the piston's axis at the film's inner end: of piston or guide."""
    guide = study.parts.piston.guide_length
    share = engaged_share(study.case.rotor, guide, study.revolution.angles)
    inner, case = study.revolution.positions.T[:2], study.revolution.positions.T[2:]
    return np.asarray(case + (inner - case) * share)


def _films(study: RevolutionStudy) -> dict[str, tuple[Any, ...]]:
    """Return pressure and thickness of the kept films at the vertices (m), which may move with the angle.

    With solved temperature also its mean over the thickness.
    """
    films, warm = list(study.revolution.turn.films.values()), film_temperatures(study)
    spaces = [film.problem.space for film in films]
    nodes = ("film_angle", "vertex")
    pressure = np.array([film.pressure[film.problem.space.vertex_dofs] for film in films])
    return {
        "film_angle": ("film_angle", np.array(list(study.revolution.turn.films)), {"units": "rad"}),
        "x": (nodes, np.array([space.vertices[:, 0] for space in spaces]), {"units": "m"}),
        "y": (nodes, np.array([space.vertices[:, 1] for space in spaces]), {"units": "m"}),
        "film_pressure": (nodes, pressure, {"units": "Pa"}),
        "film_thickness": (nodes, np.array([vertex_thickness(film) for film in films]), {"units": "m"}),
        "cells": (("cell", "corner"), spaces[0].cells),
    } | ({} if warm is None else {"film_temperature": (nodes, warm, {"units": "K"})})


def film_temperatures(study: RevolutionStudy) -> Array | None:
    """Return the temperature (k, vertices) K of the kept films, mean over the thickness; None where not solved."""
    warmth, films = study.revolution.warmth, study.revolution.turn.films
    if warmth is None:
        return None
    return np.array([warmth.film_at(angle)[film.problem.space.vertex_dofs] for angle, film in films.items()])


def write_series(path: Path, data: xarray.Dataset) -> None:
    """Write a CSV of the series: one line per shaft angle, units in the heads; `active` names the limits."""
    columns = columns_of(data, "shaft_angle")
    limits = {kind.value: data[f"active_{kind.value}"].values for kind in Active}
    active = ["+".join(name for name, on in limits.items() if on[k]) for k in range(data.sizes["shaft_angle"])]
    numbers = [column for column in columns if not column.name.startswith("active_")]
    write_columns(path, [*numbers, Column("active", active)])


def write_convergence(path: Path, study: RevolutionStudy) -> None:
    """Write a CSV of the turns: change of position in each, and the multipliers of the last one."""
    closing = study.revolution.closing
    sizes = sorted(np.abs(closing.multipliers), reverse=True)
    turns = np.arange(1, closing.turns + 1)
    last = [
        Column(f"multiplier_{k}", np.where(turns == closing.turns, size, np.nan), "1")
        for k, size in enumerate(sizes, 1)
    ]
    write_columns(path, [Column("turn", turns), Column("change", closing.changes, "m"), *last])


def write_revolution_fields(folder: Path, study: RevolutionStudy) -> None:
    """Write fields/<gap>_NNN.vtu of every kept film and, over them, <gap>.pvd (time = shaft angle in degrees).

    With solved temperature the files hold `film_temperature` (K), its mean over the thickness.
    """
    (folder / FIELDS).mkdir(exist_ok=True)
    gap, entries, warm = study.case.gap.value, [], film_temperatures(study)
    for k, (angle, film) in enumerate(study.revolution.turn.films.items()):
        name = f"{FIELDS}/{vtu_name(gap, k)}"
        place = place_of(study.case.gap, study.case.rotor, study.parts, angle)
        write_vtu(folder / name, film, place, None if warm is None else {"film_temperature": (warm[k], "K")})
        entries.append((float(np.degrees(angle)), 0, name))
    write_pvd(folder / f"{gap}.pvd", entries)
