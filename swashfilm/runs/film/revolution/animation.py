"""Animation of the films over the turn: maps of the kept films above the film over the shaft angle."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.field_maps import draw_map, paint
from swashfilm.runs.film.revolution.plots import FILM, INK, degrees, shown, span, unit_of
from system.inputs.shown import titled
from system.work.progress import Report

if TYPE_CHECKING:
    import xarray

FRAMES_PER_SECOND = 10
FIELDS = {"film_pressure": ("pressure", "viridis"), "film_thickness": ("film", "cividis")}


def write_animation(folder: Path, data: xarray.Dataset, report: Report) -> None:
    """Write animation.gif, one frame per kept film, and animation.mp4 where ffmpeg exists.

    The colour scales are those of the whole turn.
    """
    from matplotlib.animation import FFMpegWriter, PillowWriter

    _write(folder / "animation.gif", PillowWriter(FRAMES_PER_SECOND), data, report)
    if FFMpegWriter.isAvailable():
        _write(folder / "animation.mp4", FFMpegWriter(FRAMES_PER_SECOND), data, report)


def _write(path: Path, writer: Any, data: xarray.Dataset, report: Report) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.4, 5.6), layout="constrained")
    with writer.saving(figure, str(path), dpi=90):
        painted, marker, course = _first(figure, data)
        count = data.sizes["film_angle"]
        for k, angle in enumerate(np.degrees(data["film_angle"].values)):
            report(k, count, f"drawing {path.name}")
            for name, artist in painted.items():
                axes = artist.axes
                artist.remove()
                painted[name] = paint(axes, *_film(data, k, name), FIELDS[name][1], artist.get_clim())
            marker.set_xdata([angle, angle])
            course.set_title(f"{angle:.0f} deg", fontsize=9)
            writer.grab_frame()
            figure.set_layout_engine("none")  # all frames have the layout of the first


def _first(figure: Any, data: xarray.Dataset) -> tuple[dict[str, Any], Any, Any]:
    """Draw maps of the first film and the film over the angle; return the artists that the frames change."""
    mosaic = figure.subplot_mosaic([list(FIELDS), ["course", "course"]], height_ratios=(3, 1))
    painted = {}
    for name, (title, colours) in FIELDS.items():
        how = unit_of(data, name)
        whole, axes = how.of(data[name].values), mosaic[name]
        limits = float(whole.min()), float(whole.max())
        painted[name] = draw_map(axes, *_film(data, 0, name), titled(title, how.unit), colours=colours, limits=limits)
        axes.set(xlim=_ends(data["x"].values), ylim=_ends(data["y"].values))
    course = mosaic["course"]
    for name, colour in (("film_thickness_min", INK), ("film_thickness_mean", FILM)):
        course.plot(degrees(data), shown(data, name), color=colour)
    course.set(xlabel="shaft angle [deg]", ylabel="film [um]", ylim=(0.0, None), xlim=(0.0, span(data)))
    course.set_title("0 deg", fontsize=9)
    course.legend(["least", "mean"], fontsize=7, loc="upper right")
    return painted, course.axvline(0.0, color="#b33a3a"), course


def _film(data: xarray.Dataset, k: int, name: str) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray, np.ndarray]:
    """Return vertices (mm), cells and values, in the unit of the picture, of the k-th kept film."""
    place = data["x"].values[k] * 1e3, data["y"].values[k] * 1e3
    return place, data["cells"].values, unit_of(data, name).of(data[name].values[k])


def _ends(places: np.ndarray) -> tuple[float, float]:
    """Return the limits (mm) of the mesh over the turn."""
    return float(places.min()) * 1e3, float(places.max()) * 1e3
