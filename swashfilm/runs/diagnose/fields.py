"""Film fields of the pump without and with a finding, as files and as pictures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from diagnosis.procedure.pump_comparison import OF_FILMS
from swashfilm.output.data.files import write_netcdf
from swashfilm.output.figures import figure_of
from swashfilm.output.scenes.field_maps import MapField, draw_map
from swashfilm.runs.diagnose.floating_fields import floating_pictures
from swashfilm.runs.pump.data import GAPS, films_dataset
from swashfilm.runs.pump.plots import GAP_FIELDS, gap_place, pictured
from swashfilm.runs.pump.scene.given_films import write_fields
from system.effects.effect import EffectId
from system.points.films import FilmsPoint

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

FIELDS_FILE = "films.nc"
_FIELD_OF = {
    EffectId.FILM_HEATING: "film_temperature",
    EffectId.VISCOSITY_PRESSURE: "film_viscosity",
    EffectId.VISCOSITY_GRADE: "film_viscosity",
}
"""The field that an effect changes; thickness for effects without an entry."""


def write_film_fields(folder: Path, films: FilmsPoint) -> None:
    """Write films.nc, fields/ and the series for ParaView into the run folder of a pump."""
    write_fields(folder, films)
    data = films_dataset(films)
    data.attrs |= {"temperature": films.rotor.point.temperature, "viscosity": films.rotor.point.viscosity}
    write_netcdf(data, folder / FIELDS_FILE, "diagnosis")


def film_pictures(folder: Path, names: tuple[str, str], found: Mapping[str, Any]) -> dict[str, Figure]:
    """Fields of the gaps of a finding, without beside with it on one scale, by caption."""
    import xarray

    if not all((folder / name / FIELDS_FILE).is_file() for name in names):
        return floating_pictures([folder / name for name in names], names)
    effects = [EffectId(one["id"]) for one in found["effects"] if EffectId(one["id"]) in OF_FILMS]
    pairs = [one["pair"] for one in found["effects"] if EffectId(one["id"]) in OF_FILMS]
    fields = dict.fromkeys(["film_pressure", *(_FIELD_OF.get(effect, "film_thickness") for effect in effects)])
    gaps = [gap for gap in GAPS if None in pairs or gap in pairs]
    data = [xarray.load_dataset(folder / name / FIELDS_FILE, engine="h5netcdf") for name in names]
    shown = [field for field in GAP_FIELDS if field.name in fields]
    return {_caption(data[0], gap): _beside(data, names, gap, shown) for gap in gaps}


def _caption(data: xarray.Dataset, gap: str) -> str:
    angle = np.degrees(data[f"{gap}_angle"].values[pictured(data, gap)])
    return f"Film of the {gap.replace('_', ' ')} at {angle:.0f} deg of the shaft, without and with the finding"


def _beside(data: list[xarray.Dataset], names: tuple[str, str], gap: str, shown: list[MapField]) -> Figure:
    figure = figure_of(10.0, 3.7 * len(shown))
    for line, field in zip(figure.subplots(len(shown), 2, squeeze=False), shown, strict=True):
        values = [field.in_unit(_field(one, gap, field.name)) for one in data]
        limits = min(float(one.min()) for one in values), max(float(one.max()) for one in values)
        for axes, one, own, name in zip(line, data, values, names, strict=True):
            place, labels = gap_place(one, gap, pictured(one, gap))
            cells = one[f"{gap}_cells"].values
            draw_map(axes, place, cells, own, f"{field.title}, {name}", labels, field.colours, limits)
    return figure


def _field(data: xarray.Dataset, gap: str, name: str) -> np.ndarray:
    """A field of the gap's pictured film; without heating, the case's temperature and viscosity."""
    if f"{gap}_{name}" in data:
        return np.asarray(data[f"{gap}_{name}"].values[pictured(data, gap)])
    return np.full(data.sizes[f"{gap}_vertex"], data.attrs[name.removeprefix("film_")])
