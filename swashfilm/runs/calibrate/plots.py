"""Pictures of a calibration, drawn from the tables of its run folder."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from diagnosis.report.format import CHANNELS
from swashfilm.output.figures import figure_of
from system.bench.calibration.held_out import PHYSICS
from system.inputs.channels import ChannelName

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Row = Mapping[str, str]
COLOURS = ("#b55a00", "#3c7a8c", "#6d5a9c", "#4f7a3a")
LEAST = 0.2  # noise: where the bars of models begin
TICKS = tuple(float(f"{digit}e{power}") for power in range(-1, 9) for digit in (1, 2, 5))
OWN, OTHERS, NOISE = "#b55a00", "#3c7a8c", "#9aa4ab"


def coefficients_over_displacement(rows: Sequence[Row]) -> Figure:
    """Eq. (21)'s coefficients over displacement with one sigma, the whole map's and the prior as bands.

    A panel for each pair; a coefficient without influence on the readings has the prior's width.
    """
    names = list(dict.fromkeys(row["coefficient"] for row in rows))
    columns = 4
    figure = figure_of(3.1 * columns, 2.7 * -(-len(names) // columns))
    grid = figure.subplots(-(-len(names) // columns), columns, squeeze=False)
    for axes in grid.ravel()[len(names) :]:
        axes.set_axis_off()
    for axes, name in zip(grid.ravel(), names, strict=False):
        own = [row for row in rows if row["coefficient"] == name]
        cells = [row for row in own if row["displacement_ratio [1]"]]
        whole = next(row for row in own if not row["displacement_ratio [1]"])
        mean, sigma = float(whole["mean [1]"]), float(whole["sigma [1]"])
        axes.axhline(float(whole["prior [1]"]), color=NOISE, linestyle="--", label="prior")
        axes.axhspan(mean - sigma, mean + sigma, color=OTHERS, alpha=0.3, label="whole map")
        place = [float(row["displacement_ratio [1]"]) for row in cells]
        axes.errorbar(
            place, [float(row["mean [1]"]) for row in cells], [float(row["sigma [1]"]) for row in cells],
            fmt="o", color=OWN, capsize=3, label="one displacement",
        )  # fmt: skip
        axes.set_title(name.replace("_", " "), fontsize=9)
        axes.set_xlabel("displacement ratio", fontsize=8)
        axes.set_ylabel("coefficient", fontsize=8)
        axes.set_ylim(bottom=0.0)
        axes.tick_params(labelsize=7)
        axes.grid(visible=True, alpha=0.3)
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="lower right", fontsize=9)
    return figure


def fit_and_readings(rows: Sequence[Row]) -> Figure:
    """Draw measured less fitted over the reading, a panel for each channel, with the meter's scatter as a band."""
    channels = list(dict.fromkeys(row["channel"] for row in rows))
    lines = -(-len(channels) // 2)
    figure = figure_of(7.0, 2.6 * lines)
    panels = figure.subplots(lines, min(2, len(channels)), squeeze=False).ravel()
    for axes in panels[len(channels) :]:
        axes.set_axis_off()
    for axes, channel in zip(panels, channels, strict=False):
        own = sorted((row for row in rows if row["channel"] == channel), key=lambda row: float(row["measured"]))
        measured, fitted, pull = (np.array([float(row[key]) for row in own]) for key in ("measured", "fitted", "pull"))
        off = measured - fitted
        sigma = np.divide(off, pull, out=np.zeros_like(off), where=pull != 0.0)
        axes.fill_between(measured, -sigma, sigma, color=NOISE, alpha=0.35, linewidth=0.0)
        axes.axhline(0.0, color=NOISE, linewidth=0.8)
        axes.plot(measured, off, ".", color=OTHERS, markersize=5)
        words = CHANNELS.get(ChannelName.named(channel), channel)
        axes.set(xlabel=f"{words} / {own[0]['unit']}", ylabel=f"measured - fitted / {own[0]['unit']}")
        axes.grid(visible=True, alpha=0.3)
    return figure


def friction_curves(rows: Sequence[Row]) -> Figure:
    """Coefficient of each film over its Hersey numbers under load, one sigma as a band."""
    figure = figure_of(7.5, 4.0)
    axes = figure.subplots()
    for colour, gap in zip(COLOURS, dict.fromkeys(row["gap"] for row in rows), strict=False):
        own = [row for row in rows if row["gap"] == gap]
        number, friction, sigma = (
            np.array([float(row[key]) for row in own]) for key in ("hersey_number [1]", "friction [1]", "sigma [1]")
        )
        axes.semilogx(number, friction, color=colour, label=gap.replace("_", " "))
        axes.fill_between(number, np.maximum(friction - sigma, 0.0), friction + sigma, color=colour, alpha=0.2)
    axes.set_xlabel("Hersey number mu v w/N")
    axes.set_ylabel("friction coefficient")
    axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=8)
    axes.grid(visible=True, alpha=0.3, which="both")
    return figure


def held_out_models(rows: Sequence[Row]) -> Figure:
    """RMS in units of the noise by model and split, a panel for each channel, on a logarithmic scale."""
    from matplotlib.ticker import FormatStrFormatter, NullFormatter

    channels = list(dict.fromkeys(row["channel"] for row in rows))
    models = list(dict.fromkeys(row["model"] for row in rows))
    splits = list(dict.fromkeys(row["left_out"] for row in rows))
    figure = figure_of(5.2 * len(channels), 1.2 + 0.62 * len(models))
    grid = figure.subplots(1, len(channels), squeeze=False, sharey=True)
    shades = ("#c9d0d4", *COLOURS[:3])
    for axes, channel in zip(grid[0], channels, strict=True):
        for shift, (split, shade) in enumerate(zip(splits, shades, strict=False)):
            own = {row["model"]: row for row in rows if (row["channel"], row["left_out"]) == (channel, split)}
            sizes = [float(own[model]["rms"]) / float(own[model]["noise"]) for model in models]
            places = np.arange(len(models)) + 0.2 * (shift - (len(splits) - 1) / 2)
            label = "fitted to all" if split == "none" else f"{split} levels held out"
            axes.barh(places, sizes, 0.18, color=shade, label=label)
        axes.axvline(1.0, color=NOISE, linestyle="--")
        axes.set_xscale("log")
        axes.set_xlim(left=LEAST)
        ends = axes.get_xlim()
        axes.set_xticks([tick for tick in TICKS if ends[0] <= tick <= ends[1]])
        axes.xaxis.set_major_formatter(FormatStrFormatter("%g"))
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.set_title(channel, fontsize=10)
        axes.set_xlabel("rms / noise")
        axes.grid(visible=True, axis="x", alpha=0.3, which="both")
    labels = [f"{model.replace('_', ' ')}{' (this pump)' if model == PHYSICS else ''}" for model in models]
    grid[0, 0].set_yticks(np.arange(len(models)), labels)
    grid[0, 0].invert_yaxis()
    grid[0, -1].legend(fontsize=8)
    return figure
