"""Pictures of a diagnosis, drawn from the tables of its run folder."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from diagnosis.report.format import CHANNELS
from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.output.tables import parted
from swashfilm.runs.diagnose.files import head_of
from system.inputs.channels import ChannelName
from system.inputs.shown import titled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Row = Mapping[str, str]
FITS = {"pull_before": "without the finding", "pull_after": "with it"}
BEFORE, AFTER, NOISE = "#b55a00", "#3c7a8c", "#9aa4ab"
WIDTH = 10.0  # inches, of every picture that is as wide as the page
LEAST_SPREAD = 0.05  # of an axis, by its largest value: a smaller one is that of one level
MOST_BARS = 12
MOST_LEVELS = 4
LEAST_LOSS = 0.05  # % of the shaft power, below which a loss is not drawn
RATIO_STEP = 0.1
"""Points whose displacement ratios differ by less are drawn together."""


def residual_maps(rows: Sequence[Row], claimed: bool = True) -> Figure:
    """Pulls over speed and pressure by channel and displacement, without the claim beside with it on one scale.

    For more than two displacements, without is above with, so that each panel stays legible. Without a claim there is
    one fit.
    """
    channels = list(dict.fromkeys(row["channel"] for row in rows))
    levels = _levels(_column(rows, "displacement_ratio [1]"))
    both = ("pull_before", "pull_after") if claimed else ("pull_before",)
    kinds = [both] if len(levels) < 3 else [(key,) for key in both]
    lines = [(channel, keys) for channel in channels for keys in kinds]
    columns = len(levels) * len(kinds[0])
    height = max(3.0, 0.6 + (2.1 if len(levels) < 3 else 1.5) * len(lines))
    figure = figure_of(max(WIDTH, 1.5 + 2.3 * columns), height)
    grid = figure.subplots(len(lines), columns, squeeze=False, sharex=True, sharey=True)
    most = max(3.0, float(np.nanpercentile(np.abs(_column(rows, "pull_before")), 98)))
    drawn: Any = None
    at = _across(rows), head_of(rows[0], "p_out")
    for line, (channel, keys) in zip(grid, lines, strict=True):
        places = [(level, key) for level in levels for key in keys]
        for axes, (level, key) in zip(line, places, strict=True):
            own = [row for row in rows if row["channel"] == channel and _of_level(row, level)]
            drawn = _map(axes, own, at, key, most)
            axes.set_title(", ".join(filter(None, (FITS[key] if claimed else "", _title(level)))), fontsize=8, pad=3)
        line[0].set_ylabel(f"{channel_title(channel)}\n{axis_title(at[1])}", fontsize=8)
    for axes in grid[-1]:
        axes.set_xlabel(axis_title(at[0]), fontsize=8)
    bar = figure.colorbar(drawn, ax=grid.ravel().tolist(), shrink=min(0.8, 6.0 / (1.5 * len(lines))), extend="both")
    bar.set_label("measured - simulated,\nin scatters of the meter", fontsize=8)
    return figure


def held_out_bars(held_out: Mapping[str, Mapping[str, Any]]) -> Figure:
    """RMS of held-out residuals before and after, in units of each channel's noise."""
    sizes = {
        words: [one[key] / one["noise"] for one in held_out.values()]
        for key, words in (("before", "without the finding"), ("after", "with it"))
    }
    figure = figure_of(WIDTH, 1.2 + 0.5 * len(held_out))
    axes = figure.subplots()
    axes.axvline(1.0, color=NOISE, linestyle="--", label="scatter of the meter")
    _paired_bars(
        axes,
        list(map(channel_title, held_out)),
        sizes,
        "rms difference at points not used in the fit / scatter of the meter",
    )
    return figure


def hypothesis_bars(rows: Sequence[Row]) -> Figure:
    """The most probable hypotheses: probability, and difference of log evidence to the best."""
    ranked = sorted(rows, key=lambda row: -float(row["probability"]))[:MOST_BARS]
    figure = figure_of(WIDTH, 1.0 + 0.34 * len(ranked))
    axes, places = figure.subplots(), np.arange(len(ranked))
    axes.barh(places, [float(row["probability"]) for row in ranked], 0.6, color=AFTER)
    for place, row in enumerate(ranked):
        size = f", z {float(row['z']):.3g}" if float(row["z"] or 0.0) else ""  # the unknown has no single size
        text = f"{float(row['behind [nats]']):.3g} nats below the best{size}"
        axes.text(float(row["probability"]) + 0.01, place, text, va="center", fontsize=8)
    axes.set_yticks(places, [row["hypothesis"].replace("_", " ") for row in ranked], fontsize=8)
    axes.set(xlim=(0.0, 1.35), xlabel="probability", xticks=np.linspace(0, 1, 6))
    axes.invert_yaxis()
    return figure


def pull_changes(rows: Sequence[Row]) -> Figure:
    """Largest pulls of the parameters that both fits have, from before to after."""
    common = [row for row in rows if row["pull_before"] and row["pull_after"]]
    ranked = sorted(common, key=lambda row: -max(abs(float(row[key])) for key in ("pull_before", "pull_after")))
    ranked = ranked[:MOST_BARS]
    figure = figure_of(WIDTH, 1.0 + 0.3 * len(ranked))
    axes, places = figure.subplots(), np.arange(len(ranked))
    ends = [np.array([float(row[key]) for row in ranked]) for key in ("pull_before", "pull_after")]
    axes.axvspan(-2, 2, color=NOISE, alpha=0.2)
    axes.hlines(places, ends[0], ends[1], color=NOISE)
    for values, colour, label in zip(ends, (BEFORE, AFTER), FITS.values(), strict=True):
        axes.plot(values, places, "o", color=colour, label=label)
    axes.set_yticks(places, [row["name"] for row in ranked], fontsize=8)
    axes.set_xlabel("pull; grey: within two, as for most values that are stated correctly")
    axes.invert_yaxis()
    _legend_above(axes)
    return figure


def effect_courses(rows: Sequence[Row], courses: Sequence[tuple[str, str]]) -> Figure:
    """Additions of the claim to channels, each over an axis, beside the residual without it."""
    figure = figure_of(WIDTH, 4.0)
    for axes, (channel, axis) in zip(figure.subplots(1, len(courses), squeeze=False)[0], courses, strict=True):
        own = [row for row in rows if row["channel"] == channel and row[axis]]
        place, added = _column(own, axis), _column(own, "added")
        left = _column(own, "measured") - (_column(own, "after") - added)
        axes.errorbar(place, left, _column(own, "sigma"), fmt="none", ecolor=NOISE, alpha=0.8)
        label = "difference without it"
        axes.plot(place, left, "o", color=BEFORE, markersize=4, markerfacecolor="none", label=label, alpha=0.8)
        axes.plot(place, added, "x", color=AFTER, markeredgewidth=1.8, label="what the finding adds", zorder=3)
        axes.axhline(0.0, color="#1c2328", linewidth=0.8)
        axes.set_xlabel(axis_title(axis))
        axes.set_ylabel(titled(f"difference in {channel_title(channel)}", own[0]["unit"].replace("degC", "K")))
        axes.grid(visible=True, alpha=0.3)
    _legend_above(axes)
    return figure


def loss_bars(rows: Sequence[Row], whole: Mapping[str, float]) -> Figure:
    """Parts of the shaft power, without and with the finding, in % of each one's shaft power; `whole` in W."""
    runs = tuple(whole)
    shares = {row["quantity"]: [100.0 * float(row[run]) / whole[run] for run in runs] for row in rows}
    shown = {name: both for name, both in shares.items() if max(map(abs, both)) >= LEAST_LOSS}
    figure = figure_of(WIDTH, 1.0 + 0.36 * len(shown))
    sizes = {run: [both[at] for both in shown.values()] for at, run in enumerate(runs)}
    _paired_bars(figure.subplots(), list(shown), sizes, "share of the shaft power [%]")
    return figure


def _paired_bars(axes: Axes, names: Sequence[str], sizes: Mapping[str, Sequence[float]], label: str) -> None:
    """Draw two bars for each name, those before and those after, by the text of their legend."""
    places = np.arange(len(names))
    for at, ((text, own), colour) in enumerate(zip(sizes.items(), (BEFORE, AFTER), strict=True)):
        axes.barh(places + 0.38 * at - 0.19, own, 0.36, color=colour, label=text)
    axes.set_yticks(places, names, fontsize=8)
    axes.set_xlabel(label)
    axes.invert_yaxis()
    _legend_above(axes)
    axes.grid(visible=True, axis="x", alpha=0.3)


def _legend_above(axes: Axes) -> None:
    """The legend in a row above the axes."""
    axes.legend(fontsize=8, ncols=3, loc="lower right", bbox_to_anchor=(1.0, 1.0), frameon=False)


def channel_title(name: str) -> str:
    """A channel's name in words."""
    return CHANNELS[ChannelName.named(name)]


def axis_title(head: str) -> str:
    """The title of an axis by the head of its column, in words."""
    name, unit = parted(head)
    return titled(channel_title(name), unit.replace("rpm", "r/min").removesuffix("1"))


def _across(rows: Sequence[Row]) -> str:
    """The axis of maps beside pressure: the speed; the case temperature where it varies and the speed does not."""
    spread = {}
    for axis in (head_of(rows[0], "speed"), head_of(rows[0], "T_case")):
        known = _column(rows, axis)[np.isfinite(_column(rows, axis))]
        spread[axis] = float(np.ptp(known) / np.abs(known).max()) if np.any(known) else 0.0
    speed, warm = spread
    return warm if spread[speed] < LEAST_SPREAD < spread[warm] else speed


def _map(axes: Axes, rows: Sequence[Row], at: tuple[str, str], key: str, most: float) -> Any:
    """One map of pulls over speed, or temperature, and pressure, `at`; points at one place are side by side."""
    speed, pressure = (_place(axes, rows, head, height) for head, height in zip(at, (0.02, 0.1), strict=True))
    warm = _column(rows, "T_case [degC]")
    spread = np.ptp(warm[np.isfinite(warm)]) if np.any(np.isfinite(warm)) else 0.0
    shift = np.nan_to_num((warm - np.nanmean(warm)) / spread) if spread > 0 and parted(at[0])[0] == "speed" else 0.0
    width = 0.1 * (float(np.ptp(pressure)) if pressure.size else 0.0) or 1.0
    axes.tick_params(labelsize=7)
    return axes.scatter(
        speed, pressure + width * shift, c=_column(rows, key), cmap="RdBu_r", vmin=-most, vmax=most,
        s=float(np.clip(1200.0 / max(len(rows), 1), 14.0, 45.0)),
        edgecolors="#6b747a", linewidths=0.3,
    )  # fmt: skip


def _place(axes: Axes, rows: Sequence[Row], key: str, height: float) -> Array:
    """Places of points along an axis; all at one labelled place for an axis that was not recorded."""
    place = _column(rows, key)
    if place.size and not np.any(np.isfinite(place)):
        text = f"{key.partition(' ')[0]} not recorded"
        axes.text(0.5, height, text, transform=axes.transAxes, fontsize=7, ha="center")
        return np.zeros_like(place)
    return place


def _levels(ratios: Array) -> list[tuple[float, float]]:
    """Groups of displacement ratios: ends of each; one group of all points where there are too many."""
    known = np.unique(ratios[np.isfinite(ratios)])
    if known.size == 0:
        return [(-np.inf, np.inf)]
    groups = np.split(known, np.flatnonzero(np.diff(known) > RATIO_STEP) + 1)
    ends = [(float(group[0]), float(group[-1])) for group in groups]
    return ends if len(ends) <= MOST_LEVELS else [(float(known[0]), float(known[-1]))]


def _of_level(row: Row, level: tuple[float, float]) -> bool:
    lower, upper = level
    text = row["displacement_ratio [1]"]
    return not text or lower <= float(text) <= upper


def _title(level: tuple[float, float]) -> str:
    """Strokes of the points, none if all."""
    if not np.all(np.isfinite(level)):
        return ""
    lower, upper = level
    middle = (lower + upper) / 2
    one = f"{middle:.0%}" if upper - lower < RATIO_STEP / 2 else f"{lower:.0%} to {upper:.0%}"
    return f"stroke {one}"


def _column(rows: Sequence[Row], key: str) -> Array:
    return np.array([float(row[key]) if row[key] else np.nan for row in rows])
