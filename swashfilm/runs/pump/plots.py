"""Pictures of an operating point, drawn from results.nc and summary.json."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.data.gap_names import TITLES
from swashfilm.output.figures import figure_of, legend_below
from swashfilm.output.scenes.field_maps import MapField, draw_map
from swashfilm.runs.pump.data import GAPS, PICTURED_TURN
from system.inputs.shown import shown_in, significant, title_in
from system.inputs.units import LPM
from system.pump.laws.friction_pairs import Pair

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DEAD = "#77828a"
STEADY = 100.0
"""Pa, peak to peak, below which a port pressure is constant."""
GAP_FIELDS = (
    MapField("film_pressure", "film pressure", "Pa"),
    MapField("film_thickness", "film thickness", "m", colours="cividis"),
    MapField("film_viscosity", "viscosity of the oil", "Pa s", colours="YlGnBu"),
    MapField("film_temperature", "film temperature, mean across", "K", colours="inferno"),
)
"""Fields of a gap on a page, where results.nc has them."""


def loss_bar(summary: Mapping[str, Any]) -> Figure:
    """Draw losses of the seven pairs (W), stacked Coulomb and viscous parts, with the share of each pair."""
    figure = figure_of(8.4, 3.4)
    axes = figure.subplots()
    names = [pair.words for pair in Pair]
    losses = [summary["pair_loss"][pair.value] for pair in Pair]
    coulomb, viscous = ([loss[part] for loss in losses] for part in ("coulomb_W", "viscous_W"))
    axes.barh(names, coulomb, color="#8c5a3c", label="Coulomb")
    axes.barh(names, viscous, left=coulomb, color="#3c7a8c", label="viscous")
    for row, loss in enumerate(losses):
        words, end = f"{loss['total_W']:.0f} W, {loss['share']:.1%}", (loss["total_W"], row)
        axes.annotate(words, end, xytext=(4.0, 0.0), textcoords="offset points", va="center")
    axes.invert_yaxis()
    axes.set(xlabel="loss [W]", xlim=(0.0, 1.25 * max(loss["total_W"] for loss in losses)))
    legend_below(axes)
    return figure


def chamber_plot(data: xarray.Dataset, summary: Mapping[str, Any]) -> Figure:
    """Draw chamber pressure and port openings (mm2) over the shaft angle, dead-centre regions enlarged."""
    figure = figure_of(10.0, 5.6)
    wide, near = figure.subplots(2, 1)
    angle = np.degrees(data["shaft_angle"].values)
    pressure = shown_in("Pa").of(data["chamber_pressure"].values)
    openings = [data[name].values * 1e6 for name in ("suction_area", "delivery_area")]
    for axes in (wide, near):
        areas = axes.twinx()
        for opening, colour, name in zip(openings, ("#5b9a5b", "#b8862b"), ("suction", "delivery"), strict=True):
            areas.fill_between(angle, opening, color=colour, alpha=0.22, label=f"{name} opening", step=None)
        axes.plot(angle, pressure, color="#1c2328", label="chamber pressure")
        axes.set(ylabel=title_in("pressure, gauge", "Pa"), xlim=(0, 360))
        areas.set(ylabel="opening [mm2]", ylim=(0, None))
        axes.set_zorder(areas.get_zorder() + 1)
        axes.patch.set_visible(False)
    handles = [*wide.get_legend_handles_labels()[0], *areas.get_legend_handles_labels()[0]]
    figure.legend(handles=handles, loc="outside upper center", ncols=3, frameon=False)
    near.set(xlabel="shaft angle from inner dead centre [deg]", xlim=(160, 220))
    lowest = min(-0.5e6, summary["operating_point"]["inlet_pressure_Pa"] - 3e6)
    near.set_ylim(shown_in("Pa").of(lowest), 1.08 * pressure.max())
    _mark_dead_centres(wide)
    _mark_dead_centres(near)
    return figure


def _mark_dead_centres(axes: Axes) -> None:
    """Mark the dead centres by lines, their names above the axes."""
    low, high = axes.get_xlim()
    marks = (0.0, "inner dead centre", "left"), (180.0, "outer dead centre", "center"), (360.0, "inner", "right")
    for at, name, side in marks:
        if low <= at <= high:
            axes.axvline(at, color=DEAD, linewidth=1.0, linestyle=":")
            axes.text(at, 1.01, name, transform=axes.get_xaxis_transform(), ha=side, fontsize=8, color=DEAD)


def flow_plot(data: xarray.Dataset) -> Figure:
    """Draw delivery flow of the pump and leakage of one chamber's gaps (L/min) over the shaft angle."""
    figure = figure_of(10.0, 3.4)
    left, right = figure.subplots(1, 2)
    angle = np.degrees(data["shaft_angle"].values)
    left.plot(angle, data["pump_delivery_flow"].values * LPM, color="#1c2328")
    left.set(xlabel="shaft angle [deg]", ylabel="delivery flow [L/min]", xlim=(0, 360), title="pump, at its port")
    for gap in GAPS:
        right.plot(angle, data[f"{gap}_leakage"].values * LPM, label=TITLES[gap])
    right.set(xlabel="shaft angle [deg]", ylabel="flow out of one chamber [L/min]", xlim=(0, 360), title="gaps")
    legend_below(right, 3)
    return figure


def ripple_plot(data: xarray.Dataset) -> Figure:
    """Draw line flows (L/min) and shaft torque (N m) over two pitches, and port pressures that pulse.

    Pressures are drawn less their means; constant ones are left out.
    """
    figure = figure_of(10.0, 3.4)
    pulses = any(np.ptp(data[f"{name}_pressure"].values) > STEADY for name in ("delivery", "inlet"))
    *lefts, middle, right = figure.subplots(1, 2 + pulses)
    angle = np.degrees(data["shaft_angle"].values)
    for name, colour in (("delivery", "#b8862b"), ("inlet", "#5b9a5b")):
        pressure = shown_in("Pa").of(data[f"{name}_pressure"].values)
        label = f"{name}, {significant(pressure.mean())} {shown_in('Pa').unit}"
        for left in lefts:
            left.plot(angle, pressure - pressure.mean(), color=colour, label=label)
        middle.plot(angle, data[f"{name}_line_flow"].values * LPM, color=colour, label=name)
    right.plot(angle, data["shaft_torque"].values, color="#1c2328")
    for left in lefts:
        left.set(ylabel=title_in("port pressure less its mean", "Pa"), title="ports")
    middle.set(ylabel="flow [L/min]", title="lines, at port pressure")
    right.set(ylabel="torque [N m]", title="shaft")
    for axes in (*lefts, middle, right):
        axes.set(xlabel="shaft angle [deg]", xlim=(0, 2.0 * data.attrs["pitch_deg"]))
    for axes in (*lefts, middle):
        legend_below(axes)
    return figure


def gap_maps(data: xarray.Dataset) -> dict[str, Figure]:
    """Draw film pressure, film thickness and state of the oil of each gap at the pictured angle, by gap."""
    return {gap: gap_map(data, gap, pictured(data, gap)) for gap in GAPS if f"{gap}_film_pressure" in data}


def film_series(data: xarray.Dataset) -> Figure:
    """Draw film, largest pressure, load ratio and friction power of one piston and one slipper over the turn.

    The least film of the turn is marked; the legend states its angle and its place in the gap's map.
    """
    figure = figure_of(10.0, 6.6)
    (films, pressures), (ratio, power) = figure.subplots(2, 2)
    for gap, colour in (("piston", "#3c7a8c"), ("slipper", "#b8862b")):
        angle = np.degrees(data[f"{gap}_angle"].values)
        least, mean = (data[f"{gap}_film_thickness_{name}"].values * 1e6 for name in ("min", "mean"))
        k = int(np.argmin(least))
        films.plot(angle, mean, color=colour, linestyle=":")
        films.plot(angle, least, color=colour, label=f"{gap}, least {least[k]:.3g} um at {angle[k]:.0f} deg: "
                   f"{_thinnest(data, gap, k)}")  # fmt: skip
        films.plot(angle[k], least[k], "v", color=colour)
        pressures.plot(
            angle, shown_in("Pa").of(data[f"{gap}_pressure_max"].values), color=colour, label=f"{gap} film, largest"
        )
        required = data[f"{gap}_required_load"].values
        supported = np.full_like(required, np.nan)
        np.divide(data[f"{gap}_carried_load"].values, required, out=supported, where=required > 0.0)
        ratio.plot(angle, np.clip(100.0 * supported, 0.0, 200.0), color=colour, label=gap)
        power.plot(angle, data[f"{gap}_friction_power"].values, color=colour, label=gap)
    shaft = np.degrees(data["shaft_angle"].values)
    pressures.plot(shaft, shown_in("Pa").of(data["chamber_pressure"].values), "--", color="#1c2328", label="chamber")
    films.set(ylabel="film [um]", title="least film, mean film (dotted), given position", ylim=(0, None))
    pressures.set(ylabel=title_in("pressure, gauge", "Pa"), title="pressure")
    ratio.set(ylabel="supported over required load [%]", title="shown up to 200 %")
    power.set(ylabel="friction power [W]", title="one piston, one slipper")
    for axes in (films, pressures, ratio, power):
        axes.set(xlabel="shaft angle [deg]", xlim=(0, 360))
        legend_below(axes, 1 if axes is films else 3)
    return figure


def _thinnest(data: xarray.Dataset, gap: str, k: int) -> str:
    """Return the place of the least film at the k-th angle in words."""
    at = int(np.argmin(data[f"{gap}_film_thickness"].values[k]))
    (x, y), _ = gap_place(data, gap, k)
    return f"{x[at]:.0f} deg around, {y[at]:.1f} mm along" if gap == "piston" else f"x {x[at]:.1f} mm, y {y[at]:.1f} mm"


def pictured(data: xarray.Dataset, gap: str) -> int:
    """Return the index of a gap's film at PICTURED_TURN; angles of the valve plate cover one pitch and repeat."""
    return round(PICTURED_TURN * data.sizes["piston_angle"]) % data.sizes[f"{gap}_angle"]


def gap_place(data: xarray.Dataset, gap: str, k: int) -> tuple[tuple[Array, Array], tuple[str, str]]:
    """Return the vertices of a gap's k-th film in its picture, and the titles of its axes."""
    x, y = (data[f"{gap}_{axis}"].values[k] * 1e3 for axis in ("x", "y"))
    if gap != "piston":
        return (x, y), ("x [mm]", "y [mm]")
    # Unrolled by the angle: otherwise cells across the seam cover the whole film.
    named = ("angle from the inner dead centre's side [deg]", "from the guide's inner end [mm]")
    return (360.0 * x / x.max(), y), named


def gap_map(data: xarray.Dataset, gap: str, k: int) -> Figure:
    """Draw maps of a gap's k-th film: pressure, thickness, and the state of the oil where it varies."""
    place, labels = gap_place(data, gap, k)
    cells = data[f"{gap}_cells"].values
    known = [field for field in GAP_FIELDS if f"{gap}_{field.name}" in data]
    rows = (len(known) + 1) // 2
    figure = figure_of(10.0, 3.9 * rows)
    for number, field in enumerate(known, start=1):
        axes = figure.add_subplot(rows, 2, number)
        values = field.in_unit(data[f"{gap}_{field.name}"].values[k])
        draw_map(axes, place, cells, values, field.title, labels, field.colours)
    return figure
