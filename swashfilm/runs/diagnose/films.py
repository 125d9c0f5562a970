"""A finding in the film fields: the films of the three gaps without it and with it, at one operating point."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from diagnosis.report.tables import Row
from reynolds.errors import FilmInputError, FilmNotConverged
from swashfilm.output.field_maps import MapField, draw_map
from swashfilm.output.figures import figure_of, png_of
from swashfilm.runs.pump.data import GAPS, films_dataset
from swashfilm.runs.pump.fields import write_fields
from swashfilm.runs.pump.plots import GAP_FIELDS, gap_place, pictured
from system.description.pump import PumpDescription
from system.effects.effect import EffectId
from system.effects.friction import OF_GAP
from system.inputs.errors import NotConverged
from system.inputs.units import LPM
from system.points.film_effects import SOLVED
from system.points.films import FilmsPoint, films_point
from system.pump.chamber_kinds import kinds
from system.pump.operating import operating_point
from system.work.progress import Report

if TYPE_CHECKING:
    import xarray

OF_FILMS = (*SOLVED, EffectId.FILM_THICKNESS, EffectId.VISCOSITY_GRADE)
"""Findings that change the films themselves."""
FIELDS_FILE = "films.nc"
POSITIONS, FINER, AGREED = 2, 0.5, 0.05
"""Film angles a piston pitch, times the usual cells, part of the pressure difference to which chambers agree.

To look at fields: of closer agreement leakage moves by a thousandth."""
_TELLS = {
    EffectId.FILM_HEATING: "film_temperature",
    EffectId.VISCOSITY_PRESSURE: "film_viscosity",
    EffectId.VISCOSITY_GRADE: "film_viscosity",
}
"""The field in which an effect is seen; of all others the thickness."""


@dataclass(frozen=True)
class FilmsTold:
    """Rows of films.csv, and in words how the films were solved, or why there are none."""

    rows: tuple[Row, ...]
    text: str


def films_of_both(
    folder: Path,
    pumps: Mapping[str, PumpDescription],
    lumped: Mapping[str, Mapping[str, Any]],
    found: Collection[EffectId],
    report: Report,
) -> FilmsTold:
    """Fill the run folders of both pumps with film fields: films.nc, fields/ and series for ParaView.

    pumps, and the summaries of their lumped runs, by folder name. Nothing is solved for a finding that leaves the
    films as they are; where films have no solution the reason is told.
    """
    if not any(effect in OF_FILMS for effect in found):
        return FilmsTold((), "What is found acts beside the films: their fields stay as they are.")
    if not kinds(next(iter(pumps.values()))).alike:
        return FilmsTold((), "Chambers differ: films at given positions are solved for alike ones alone.")
    solved = {}
    try:
        for name, pump in pumps.items():
            point, told = operating_point(pump), _of(report, name)
            solved[name] = films_point(
                pump, point, positions_per_pitch=POSITIONS, finer=FINER, tolerance=AGREED, report=told
            )
    except (FilmInputError, FilmNotConverged, NotConverged) as reason:
        return FilmsTold((), f"The films could not be solved: {reason}")
    for name, films in solved.items():
        write_fields(folder / name, films)
        data = films_dataset(films)
        data.attrs |= {"temperature": films.rotor.point.temperature, "viscosity": films.rotor.point.viscosity}
        data.to_netcdf(folder / name / FIELDS_FILE, engine="h5netcdf")
    return FilmsTold(tuple(_rows(lumped, solved)), _words(solved))


def _of(report: Report, name: str) -> Report:
    return lambda done, total, what: report(done, total, f"{what} {name} the finding")


def _words(solved: Mapping[str, FilmsPoint]) -> str:
    films = list(solved.values())
    angles, change = len(films[0].gaps.shaft_angle), max(one.pressure_change for one in films)
    sampled = max(one.sampling_error for one in films)
    return (
        f"Films solved where the pump file puts the parts, on {FINER:g} of the usual cells each way, at {angles} "
        f"shaft angles; chamber pressure changes by {change * 1e-6:.2g} MPa in a further round, leakage by "
        f"{100.0 * sampled:.2g} % with half the angles."
    )


def _rows(lumped: Mapping[str, Mapping[str, Any]], solved: Mapping[str, FilmsPoint]) -> Iterator[Row]:
    """Rows of quantity, unit, lumped_NAME and films_NAME: what closed laws say, and what films do."""
    for gap, pair in OF_GAP.items():
        leaks, shear = {}, {}
        for name, one in lumped.items():
            leaks[f"lumped_{name}"] = LPM * one["leakage"][f"{gap.value}_m3_per_s"]
            shear[f"lumped_{name}"] = one["pair_loss"][pair.value]["viscous_W"]
        for name, films in solved.items():
            leaks[f"films_{name}"] = LPM * getattr(films.pump_point.leakage_flow, gap.value)
            shear[f"films_{name}"] = films.pump_point.pairs.loss(pair).mean_viscous
        for what, unit, values in (("leakage", "L/min", leaks), ("shear", "W", shear)):
            shown = f"{what}, {gap.value.replace('_', ' ')}"
            yield {"quantity": shown, "unit": unit} | {key: f"{value:.6g}" for key, value in values.items()}


def film_pictures(folder: Path, names: tuple[str, str], found: Mapping[str, Any]) -> dict[str, bytes]:
    """Fields of the gaps that a finding is about, without beside with it on one scale, by caption."""
    import xarray

    if not all((folder / name / FIELDS_FILE).is_file() for name in names):
        return {}
    effects = [EffectId(one["id"]) for one in found["effects"] if EffectId(one["id"]) in OF_FILMS]
    pairs = [one["pair"] for one in found["effects"] if EffectId(one["id"]) in OF_FILMS]
    fields = dict.fromkeys(["film_pressure", *(_TELLS.get(effect, "film_thickness") for effect in effects)])
    gaps = [gap for gap in GAPS if None in pairs or gap in pairs]
    data = [xarray.load_dataset(folder / name / FIELDS_FILE, engine="h5netcdf") for name in names]
    shown = [field for field in GAP_FIELDS if field.name in fields]
    return {_caption(data[0], gap): _beside(data, names, gap, shown) for gap in gaps}


def _caption(data: xarray.Dataset, gap: str) -> str:
    angle = np.degrees(data[f"{gap}_angle"].values[pictured(data, gap)])
    return f"Film of the {gap.replace('_', ' ')} at {angle:.0f} deg of the shaft, without and with the finding"


def _beside(data: list[xarray.Dataset], names: tuple[str, str], gap: str, shown: list[MapField]) -> bytes:
    figure = figure_of(10.0, 3.7 * len(shown))
    for line, field in zip(figure.subplots(len(shown), 2, squeeze=False), shown, strict=True):
        values = [field.shown(_field(one, gap, field.name)) for one in data]
        limits = min(float(one.min()) for one in values), max(float(one.max()) for one in values)
        for axes, one, own, name in zip(line, data, values, names, strict=True):
            place, labels = gap_place(one, gap, pictured(one, gap))
            cells = one[f"{gap}_cells"].values
            draw_map(axes, place, cells, own, f"{field.title}, {name}", labels, field.colours, limits)
    return png_of(figure)


def _field(data: xarray.Dataset, gap: str, name: str) -> np.ndarray:
    """A field of the gap's pictured film; oil that is as in the case has its temperature and viscosity."""
    if f"{gap}_{name}" in data:
        return np.asarray(data[f"{gap}_{name}"].values[pictured(data, gap)])
    return np.full(data.sizes[f"{gap}_vertex"], data.attrs[name.removeprefix("film_")])
