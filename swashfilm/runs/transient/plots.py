"""Pictures of a transient, drawn from results.nc."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of, legend_below, legend_beside
from system.inputs.shown import shown_in, title_in
from system.inputs.units import LPM

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

NAMES = {
    "pressure_moment": "pressure",
    "inertia_moment": "inertia",
    "piston_friction_moment": "piston friction",
    "actuator_moment": "actuator",
    "spring_moment": "spring",
    "drag_moment": "damping, trunnion",
    "stop_moment": "stop",
}
PALE = 0.25


def over_a_pitch(data: xarray.Dataset, values: Array) -> Array:
    """Return running means over a piston pitch; nan within half a pitch of the ends."""
    pitch = 2.0 * np.pi / data.sizes["chamber"]
    count = max(1, round(pitch / float(data["shaft_angle"][1] - data["shaft_angle"][0])))
    mean = np.full(values.shape, np.nan)
    if values.size > count:
        sums = np.cumsum(np.concatenate([[0.0], values]))
        begins = count // 2
        mean[begins : begins + values.size - count + 1] = (sums[count:] - sums[:-count]) / count
    return mean


def plate_plot(data: xarray.Dataset) -> Figure:
    """Draw swash angle (deg) and displacement ratio, control and actuator pressure, over time (ms)."""
    figure = figure_of(10.0, 3.4)
    left, right = figure.subplots(1, 2)
    time = data["time"].values * 1e3
    left.plot(time, np.degrees(data["swash_angle"].values), color="#1c2328")
    left.set(ylabel="swash angle [deg]", title="plate")
    right.plot(time, shown_in("Pa").of(data["actuator_pressure"].values), color="#b8862b", alpha=PALE)
    mean = over_a_pitch(data, data["actuator_pressure"].values)
    right.plot(time, shown_in("Pa").of(mean), color="#b8862b", label="actuator")
    right.plot(time, shown_in("Pa").of(data["control_pressure"].values), color="#1c2328", label="control")
    right.set(ylabel=title_in("pressure, gauge", "Pa"), title="actuator")
    legend_below(right)
    for axes in (left, right):
        axes.set(xlabel="time [ms]", xlim=(time[0], time[-1]))
    return figure


def moment_plot(data: xarray.Dataset) -> Figure:
    """Draw moments on the swash plate by cause (N m) over time (ms), without those that are always zero."""
    figure = figure_of(10.0, 3.8)
    axes = figure.subplots()
    time = data["time"].values * 1e3
    for name, label in NAMES.items():
        values = data[name].values
        if np.any(values):
            (line,) = axes.plot(time, values, alpha=PALE)
            axes.plot(time, over_a_pitch(data, values), color=line.get_color(), label=label)
    axes.set(xlabel="time [ms]", ylabel="moment on the plate [N m]", xlim=(time[0], time[-1]))
    legend_beside(axes)
    return figure


def pump_plot(data: xarray.Dataset) -> Figure:
    """Draw flows at the ports (L/min) and drive torque (N m) over time (ms)."""
    figure = figure_of(10.0, 3.4)
    left, right = figure.subplots(1, 2)
    time = data["time"].values * 1e3
    for axes, name, scale, colour, label in (
        (left, "delivery_flow", LPM, "#b8862b", "delivery"),
        (left, "inlet_flow", LPM, "#5b9a5b", "inlet"),
        (right, "shaft_torque", 1.0, "#1c2328", None),
    ):
        values = scale * data[name].values
        axes.plot(time[1:], values[1:], color=colour, alpha=PALE)
        axes.plot(time, over_a_pitch(data, values), color=colour, label=label)
    left.set(ylabel="flow at its port [L/min]", title="ports")
    legend_below(left)
    right.set(ylabel="torque [N m]", title="shaft")
    for axes in (left, right):
        axes.set(xlabel="time [ms]", xlim=(time[0], time[-1]))
    return figure


def chamber_plot(data: xarray.Dataset) -> Figure:
    """Draw the pressure of chamber 1 and the range of all chambers over time (ms)."""
    figure = figure_of(10.0, 3.0)
    axes = figure.subplots()
    time, pressure = data["time"].values * 1e3, shown_in("Pa").of(data["chamber_pressure"].values)
    axes.fill_between(time, pressure.min(axis=1), pressure.max(axis=1), color="#b8862b", alpha=PALE, label="all")
    axes.plot(time, pressure[:, 0], color="#1c2328", linewidth=0.7, label="chamber 1")
    axes.set(xlabel="time [ms]", ylabel=title_in("pressure, gauge", "Pa"), xlim=(time[0], time[-1]))
    legend_beside(axes)
    return figure
