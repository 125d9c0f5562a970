"""Pictures of a gap over the turn, drawn from results.nc."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from gaps.films.reports import Active
from swashfilm.output.figures import figure_of, legend_below, legend_beside
from swashfilm.output.scenes.field_maps import draw_map
from swashfilm.runs.film.revolution.data import PISTON_END, PLACES, POSITIONS
from system.description.gap import Gap
from system.inputs.shown import Shown, shown_in, title_in, titled

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

WHOLE = 359.0  # deg; shorter spans are a pitch
THINNEST = 0.01  # um; a thinner film has no figures in its label
MAPS = 4  # kept films shown as maps
TEMPERATURE = "film_temperature"
MAPPED = {
    "film_pressure": ("pressure", "viridis"), "film_thickness": ("film", "cividis"),
    TEMPERATURE: ("temperature", "inferno"),
}  # fmt: skip
"""Fields of the maps, their titles and colours."""
LEAST_SHOWN = {"contact_load": 1.0, "cavitated_area_fraction": 0.01, "film_pressure_max": 1e5}
"""Least upper ends of axes, SI, so that negligible values look negligible."""
INK, FILM, SECOND, THIRD = "#1c2328", "#3c7a8c", "#b8862b", "#8c5a3c"
PLACED = {
    Gap.PISTON: "from the guide's inner end", Gap.SLIPPER: "from the middle", Gap.VALVE_PLATE: "from the shaft's axis",
}  # fmt: skip
"""Meaning of the second coordinate of a place."""
BANDS = {
    Active.CONTACT: "#b33a3a", Active.CAVITATION: "#7fb2d6", Active.RETAINER: "#b8862b", Active.LIFT: "#5b9a5b",
}  # fmt: skip
MEANING = {
    Active.CONTACT: "contact", Active.CAVITATION: "cavitation", Active.RETAINER: "retainer force",
    Active.LIFT: "full film",
}  # fmt: skip


def revolution_plots(data: xarray.Dataset) -> dict[str, Figure]:
    """Return the pictures by name: film, path, losses, contact, maps; temperature where it is solved."""
    warm = {"temperature": _temperature(data)} if TEMPERATURE in data else {}
    return warm | {
        "film": film_plot(data),
        "path": path_plot(data),
        "losses": _losses(data),
        "contact": _contact(data),
        "maps": _maps(data),
    }


def film_text(thickness: float) -> str:
    """Return a film thickness (um) in words."""
    return f"{thickness:.3g} um" if thickness >= THINNEST else f"under {THINNEST:g} um"


def place_text(data: xarray.Dataset, k: int) -> str:
    """Return the place of the least film at the k-th reported angle in words."""
    around, along = (float(unit_of(data, name).of(data[name].values[k])) for name in PLACES[Gap(data.attrs["gap"])])
    return f"{around:.0f} deg around, {along:.1f} mm {PLACED[Gap(data.attrs['gap'])]}"


def film_plot(data: xarray.Dataset) -> Figure:
    """Draw least and mean film (um), largest and chamber pressure (MPa), and the limits of the film over the angle.

    The least film of the turn is marked with its angle and its place.
    """
    figure = figure_of(9.0, 6.2)
    axes, pressures, bands = figure.subplots(3, 1, sharex=True, height_ratios=(5, 3, 1))
    angle = degrees(data)
    least, mean = (shown(data, name) for name in ("film_thickness_min", "film_thickness_mean"))
    axes.fill_between(angle, least, mean, color=FILM, alpha=0.2, linewidth=0.0)
    axes.plot(angle, mean, color=FILM, label="mean film")
    axes.plot(angle, least, color=INK, label="least film")
    at = int(np.argmin(least[1:])) + 1  # the first is the last
    axes.plot(angle[at], least[at], "v", color=INK)
    marked = f"{film_text(least[at])} at {angle[at]:.0f} deg of the shaft; {place_text(data, at - 1)}"
    axes.set_title(f"least film (triangle): {marked}", loc="left", fontsize=9)
    axes.set(ylabel="film [um]", ylim=(0.0, None))
    chamber, name = shown(data, "chamber_pressure"), "chamber pressure"
    if span(data) < WHOLE:
        chamber[0], name = np.nan, "pressure of chamber 1"  # after a pitch another one is in its place
    pressures.plot(angle, shown(data, "film_pressure_max"), color=THIRD, label="largest film pressure")
    pressures.plot(angle, chamber, color=SECOND, linestyle="--", label=name)
    pressures.set(ylabel=title_in("pressure, gauge", "Pa"), ylim=(min(0.0, float(np.nanmin(chamber))), None))
    figure.legend(loc="outside upper right", fontsize=8, ncols=2)
    draw_bands(bands, data)
    bands.set(xlabel="shaft angle from inner dead centre [deg]", xlim=(0.0, span(data)))
    return figure


def draw_bands(axes: Any, data: xarray.Dataset) -> None:
    """Draw a row for each limit that is active at some angle, coloured where it is active."""
    ends = degrees(data)[1:]
    steps = np.diff(degrees(data))
    kinds = [kind for kind in BANDS if data[f"active_{kind.value}"].values.any()]
    for row, kind in enumerate(kinds):
        on = data[f"active_{kind.value}"].values.astype(bool)
        bars = list(zip(ends[on] - steps[on], steps[on], strict=True))
        axes.broken_barh(bars, (row - 0.4, 0.8), color=BANDS[kind])
    axes.set_yticks(range(len(kinds)), [MEANING[kind] for kind in kinds], fontsize=8)
    axes.set_ylim(len(kinds) - 0.4, -0.6)


def path_plot(data: xarray.Dataset) -> Figure:
    """Draw the piston's two ends in the clearance circle (um), or the tilt of slipper or block as rises (um)."""
    figure = figure_of(9.0, 4.4)
    gap, angle = Gap(data.attrs["gap"]), degrees(data)
    names = POSITIONS[gap]
    if gap is Gap.PISTON:
        clearance = data.attrs["clearance_m"] * 1e6
        circle = np.linspace(0.0, 2.0 * np.pi, 181)
        ends = zip(("at the film's inner end", "at the bore's case edge"), (PISTON_END, names[2:]), strict=True)
        for axes, (title, pair) in zip(figure.subplots(1, 2), ends, strict=True):
            axes.plot(clearance * np.cos(circle), clearance * np.sin(circle), color="#9aa4ab", linewidth=1.0)
            _orbit(axes, shown(data, pair[0]), shown(data, pair[1]), angle)
            axes.set(title=title, xlabel="eccentricity, to inner dead centre [um]", ylabel="across [um]")
        return figure
    orbit, course = figure.subplots(1, 2)
    _orbit(orbit, shown(data, "rise_x"), shown(data, "rise_y"), angle)
    orbit.set(title="tilt", xlabel="rise along x over the rim's radius [um]", ylabel="rise along y [um]")
    for name, colour in zip(names, (INK, FILM, SECOND), strict=True):
        course.plot(angle, shown(data, name), color=colour, label=name.replace("_", " "))
    course.set(xlabel="shaft angle [deg]", ylabel="coordinate [um]", xlim=(0.0, span(data)))
    legend_below(course, 3)
    return figure


def _orbit(axes: Any, x: np.ndarray, y: np.ndarray, angle: np.ndarray) -> None:
    """Draw a closed path with its angle as colour and four angles as labels."""
    axes.plot(x, y, color="#c9d0d5", linewidth=0.8)
    dots = axes.scatter(x, y, c=angle, cmap="twilight_shifted", s=9, vmin=0.0, vmax=angle[-1])
    for at in angle[-1] * np.array([0.25, 0.5, 0.75, 1.0]):
        k = int(np.argmin(np.abs(angle - at)))
        axes.annotate(f"{angle[k]:.0f}", (x[k], y[k]), (4, 4), fontsize=7, textcoords="offset points")
    axes.axhline(0.0, color="#e3e7ea", linewidth=0.8, zorder=0)
    axes.axvline(0.0, color="#e3e7ea", linewidth=0.8, zorder=0)
    axes.set_aspect("equal", adjustable="datalim")
    axes.figure.colorbar(dots, ax=axes, label="shaft angle [deg]", shrink=0.8)


def _losses(data: xarray.Dataset) -> Figure:
    """Draw tilt (mrad), leakage (L/min) and friction power (W) over the shaft angle."""
    figure = figure_of(9.0, 5.6)
    tilt, leakage, friction = figure.subplots(3, 1, sharex=True)
    angle = degrees(data)
    tilt.plot(angle, shown(data, "tilt"), color=INK)
    tilt.set_ylabel("tilt [mrad]")
    leakage.plot(angle, shown(data, "leakage_flow"), color=FILM, label="into the case")
    leakage.plot(angle, shown(data, "chamber_flow"), color=SECOND, linewidth=0.9, label="out of the chambers")
    leakage.set_ylabel("flow [L/min]")
    legend_beside(leakage)
    friction.plot(angle, shown(data, "friction_power"), color=THIRD, label="friction power")
    friction.plot(angle, shown(data, "rubbing"), color="#b33a3a", linewidth=0.9, label="of which contact")
    friction.set_ylabel("friction power [W]")
    legend_beside(friction)
    friction.set(xlabel="shaft angle [deg]", xlim=(0.0, span(data)))
    return figure


def _contact(data: xarray.Dataset) -> Figure:
    """Draw contact load (N), cavitated share of the area and largest film pressure (MPa) over the shaft angle."""
    figure = figure_of(9.0, 5.0)
    rows = {
        "contact_load": ("contact [N]", "#b33a3a"),
        "cavitated_area_fraction": ("cavitated share", "#4d8bb8"),
        "film_pressure_max": (title_in("highest pressure", "Pa"), INK),
    }
    for axes, (name, (title, colour)) in zip(figure.subplots(3, 1, sharex=True), rows.items(), strict=True):
        axes.fill_between(degrees(data), shown(data, name), color=colour, alpha=0.25, linewidth=0.0)
        axes.plot(degrees(data), shown(data, name), color=colour)
        most = max(1.05 * float(shown(data, name).max()), float(unit_of(data, name).of(LEAST_SHOWN[name])))
        axes.set(ylabel=title, ylim=(0.0, most), xlim=(0.0, span(data)))
    axes.set_xlabel("shaft angle [deg]")
    return figure


def _maps(data: xarray.Dataset) -> Figure:
    """Draw film pressure (MPa), thickness (um) and, where solved, temperature (degC) at some kept angles."""
    count = data.sizes["film_angle"]
    chosen = np.unique(np.linspace(0, count - 1, min(MAPS, count)).round().astype(int))
    fields = [name for name in MAPPED if name in data]
    figure = figure_of(3.3 * len(chosen), 2.8 * len(fields))
    rows = figure.subplots(len(fields), len(chosen), squeeze=False)
    for column, k in enumerate(chosen):
        for row, name in enumerate(fields):
            draw_film(rows[row, column], data, int(k), name)
    return figure


def _temperature(data: xarray.Dataset) -> Figure:
    """Draw mean and highest temperature of the film (degC) over the shaft angle, and constant ones of walls."""
    figure = figure_of(9.0, 3.4)
    axes, angle = figure.subplots(), degrees(data)
    axes.plot(angle, shown(data, "film_temperature_max"), color=BANDS[Active.CONTACT], label="maximum of the film")
    axes.plot(angle, shown(data, "film_temperature_mean"), color=FILM, label="mean of the film")
    for wall, style in (("fixed", "--"), ("moving", ":")):
        at = float(shown_in("K").of(data.attrs[f"{wall}_wall_temperature_K"]))
        axes.axhline(at, color=INK, linestyle=style, linewidth=0.9, label=f"{wall} wall")
    axes.set(xlabel="shaft angle [deg]", ylabel="temperature [degC]", xlim=(0.0, span(data)))
    figure.legend(loc="outside upper right", fontsize=8, ncols=2)
    axes.grid(visible=True, alpha=0.3)
    return figure


def draw_film(axes: Any, data: xarray.Dataset, k: int, name: str) -> None:
    """Draw the map of a field of the k-th kept film."""
    place = data["x"].values[k] * 1e3, data["y"].values[k] * 1e3
    how, (words, colours) = unit_of(data, name), MAPPED[name]
    title = f"{titled(words, how.unit)}, {np.degrees(data['film_angle'].values[k]):.0f} deg"
    draw_map(axes, place, data["cells"].values, how.of(data[name].values[k]), title, colours=colours)


def unit_of(data: xarray.Dataset, name: str) -> Shown:
    """Return the unit in which a series or a field is shown."""
    return shown_in(data[name].attrs["units"], name)


def shown(data: xarray.Dataset, name: str) -> np.ndarray:
    """Return a series in its customary unit, from angle 0 to the end of the turn (both ends are equal)."""
    values = unit_of(data, name).of(data[name].values)
    return np.append(values[-1], values)


def degrees(data: xarray.Dataset) -> np.ndarray:
    """Return the shaft angles of `shown`, deg: 0 and the reported ones."""
    return np.append(0.0, np.degrees(data["shaft_angle"].values))


def span(data: xarray.Dataset) -> float:
    """Return the period in shaft angle, deg."""
    return float(degrees(data)[-1])
