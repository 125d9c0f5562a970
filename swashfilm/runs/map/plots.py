"""Pictures of an operating map: efficiency by definition, loss, and its parts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.output.touch.fields import GridField, keep_field
from swashfilm.runs.map.files import PARTS
from system.maps.data import MapData
from system.maps.interpolation import weights
from system.maps.plan import MapInput, reading_levels
from system.pump.efficiency import EfficiencyDefinition

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LINES = 12
DOWNWARDS = (1, 1, 1, 1, 2, 2, 5, 5, 10, 10, 20)
"""Steps between contours of an efficiency from the best down, in units; the last step repeats."""
UNITS = tuple(digit * 10.0**power for power in (-3, -2, -1, 0) for digit in (1, 2, 5))
"""Units of these steps, percent; the first that needs at most LINES and two contours is used."""
FINE = 61
"""Number of points along an axis for drawing contours."""
SHOWN_SHARES = 6
"""Number of the largest losses, which have separate panels."""
COLOURS = (
    "#3c7a8c", "#8c5a3c", "#5b9a5b", "#b8862b", "#7a5a8c", "#a9bcc4", "#d0a98f", "#55616a", "#c8d7a0", "#d98b8b",
    "#6fa8b8", "#b59a74", "#8fb58f", "#e0c27a",
)  # fmt: skip


@dataclass(frozen=True)
class Slice:
    """Two axes of a map by their index, and the constant level of each other axis."""

    across: int
    up: int
    held: tuple[int, ...]

    def of(self, values: Array) -> Array:
        """Return the values on the slice, (levels up, levels across)."""
        index: list[Any] = list(self.held)
        index[self.across] = index[self.up] = slice(None)
        found = np.asarray(values[tuple(index)])
        return found if self.up < self.across else found.T


def map_plots(data: MapData) -> dict[str, Figure]:
    """Return the pictures of a map by caption, as far as it has enough levels."""
    found = {}
    for across, up in ((MapInput.PRESSURE, MapInput.RATIO), (MapInput.PRESSURE, MapInput.SPEED)):
        piece = slice_of(data, across, up)
        if piece is not None:
            where = held_words(data, piece)
            for words, parts in (("Overall", PARTS[:1]), ("Volumetric and hydromechanical", PARTS[1:])):
                png = efficiency_plot(data, piece, parts)
                if png is not None:
                    found[f"{words} efficiency in % by definition {where}; dots: solved points, star: the best"] = png
            found[f"Loss, and the shares of its largest parts {where}"] = loss_plot(data, piece)
    pressure = _place(data, MapInput.PRESSURE)
    if data.shape[pressure] > 1:
        held = _held(data)
        words = held_words(data, Slice(pressure, pressure, held))
        below = [name for name, loss in data.losses.items() if np.any(loss[_over_pressure(held, pressure)] < 0.0)]
        left = f"; negative somewhere, and left out there: {', '.join(below)}" if below else ""
        found[f"Losses by kind over pressure {words}{left}"] = share_plot(data)
    return found


def slice_of(data: MapData, across: MapInput, up: MapInput) -> Slice | None:
    """Return the slice over two inputs, others at the last level, temperature and inlet pressure at the first.

    None where one of the two has a single level.
    """
    places = _place(data, across), _place(data, up)
    if min(data.shape[place] for place in places) < 2:
        return None
    return Slice(*places, _held(data))


def held_words(data: MapData, piece: Slice) -> str:
    """Return the constant inputs of a slice, `at shaft speed 2100 rpm, ..`."""
    levels = [
        f"{axis.input.words} {axis.input.text(axis.values[level])}"
        for k, (axis, level) in enumerate(zip(data.axes, piece.held, strict=True))
        if k not in (piece.across, piece.up)
    ]
    return f"at {', '.join(levels)}"


def _held(data: MapData) -> tuple[int, ...]:
    last = (MapInput.SPEED, MapInput.PRESSURE, MapInput.RATIO)
    return tuple(len(axis.values) - 1 if axis.input in last else 0 for axis in data.axes)


def _place(data: MapData, given: MapInput) -> int:
    return [axis.input for axis in data.axes].index(given)


def efficiency_plot(
    data: MapData,
    piece: Slice,
    parts: Sequence[str],
    chosen: Sequence[EfficiencyDefinition] = tuple(EfficiencyDefinition),
) -> Figure | None:
    """Draw a row for each part with its own scale, a panel for each definition; equal ones share a panel."""
    found = {part: fields for part in parts if (fields := _by_definition(data, piece, part, chosen))}
    if not found:
        return None
    figure = figure_of(11.0, 3.6 * len(found))
    rows = figure.subfigures(len(found), 1, squeeze=False)[:, 0]
    for row, (part, fields) in zip(rows, found.items(), strict=True):
        levels = efficiency_levels(*(shown(data, piece, 100.0 * field) for field in fields.values()))
        panels = row.subplots(1, len(fields), squeeze=False)[0]
        for axes, (words, field) in zip(panels, fields.items(), strict=True):
            contours(axes, data, piece, 100.0 * field, levels)
            x, y = _grids(data, piece)
            best = np.unravel_index(int(np.nanargmax(field)), field.shape)
            mark(axes, x[best], y[best], "*", "#b55a00", 12.0)
            axes.set_title(f"{part} / %: {words}\n{100.0 * field[best]:.1f} % at best", fontsize=8)
    return figure


def _by_definition(data: MapData, piece: Slice, part: str, chosen: Sequence[EfficiencyDefinition]) -> dict[str, Array]:
    """Return a part of the efficiency on a slice by definition; equal ones share an entry."""
    fields: list[tuple[str, Array]] = []
    for one in chosen:
        field = piece.of(getattr(data.efficiency(one), part))
        alike = next((k for k, (_, known) in enumerate(fields) if _same(known, field)), None)
        if alike is not None:
            fields[alike] = (f"{fields[alike][0]}\n{one.label}", fields[alike][1])
        elif np.isfinite(field).any():
            fields.append((one.label, field))
    return dict(fields)


def _same(one: Array, other: Array) -> bool:
    return bool(np.allclose(one, other, rtol=1e-9, equal_nan=True))


def loss_plot(data: MapData, piece: Slice) -> Figure:
    """Draw the loss in kW and the share of each of its largest parts."""
    whole = piece.of(data.loss)
    sinks = {words: piece.of(loss) for words, loss in data.losses.items()}
    largest = sorted(sinks, key=lambda words: -float(np.nansum(sinks[words])))[: SHOWN_SHARES - 1]
    figure = figure_of(11.0, 6.4)
    panels = _panels(figure, len(largest) + 1)
    axes = next(panels)
    contours(axes, data, piece, whole * 1e-3, levels_of(shown(data, piece, whole * 1e-3)))
    axes.set_title("loss (shaft power minus p Q) / kW", fontsize=9)
    for axes, words in zip(panels, largest, strict=True):
        share = 100.0 * sinks[words] / whole
        contours(axes, data, piece, share, levels_of(shown(data, piece, share)))
        axes.set_title(f"{words}: share / %", fontsize=9)
    return figure


def share_plot(data: MapData) -> Figure:
    """Draw losses stacked over the pressure: in kW, and as shares of the sum."""
    place = _place(data, MapInput.PRESSURE)
    index = _over_pressure(_held(data), place)
    losses = {words: np.maximum(loss[index], 0.0) for words, loss in data.losses.items()}
    levels, unit = reading_levels(data.axes[place])
    figure = figure_of(11.0, 4.6)
    left, right = figure.subplots(1, 2)
    rows, total = np.array(list(losses.values())), sum(losses.values())
    colours = [COLOURS[k % len(COLOURS)] for k in range(len(losses))]
    left.stackplot(levels, rows * 1e-3, labels=list(losses), colors=colours)
    right.stackplot(levels, 100.0 * rows / total, colors=colours)
    for axes, label in ((left, "loss / kW"), (right, "share / %")):
        axes.set(xlabel=f"delivery pressure / {unit}", ylabel=label, xlim=(levels[0], levels[-1]))
    right.set_ylim(0.0, 100.0)
    figure.legend(*(side[::-1] for side in left.get_legend_handles_labels()), loc="outside right upper", fontsize=8)
    return figure


def _over_pressure(held: tuple[int, ...], place: int) -> tuple[Any, ...]:
    return (*held[:place], slice(None), *held[place + 1 :])


def _panels(figure: Any, count: int) -> Iterator[Any]:
    """Yield axes in rows of three, none left empty."""
    rows = -(-count // 3)
    for k in range(count):
        yield figure.add_subplot(rows, min(3, count), k + 1)


def contours(
    axes: Any, data: MapData, piece: Slice, field: Array, levels: Array, colours: str = "viridis", ink: str = "white"
) -> None:
    """Draw a field of a slice with the map's interpolation: solved points, lines in `ink`, a colour bar."""
    from matplotlib.colors import BoundaryNorm

    x, y = _grids(data, piece)
    between = shown(data, piece, field)
    places = [x, y]
    if np.all(np.isfinite(field)):
        places = [*np.meshgrid(*(np.linspace(ends.min(), ends.max(), FINE) for ends in (x, y)))]
    painted = axes.contourf(*places, between, levels=levels, cmap=colours, norm=BoundaryNorm(levels, 256))
    keep_field(painted, GridField(places[0][0], places[1][:, 0], between, levels))
    lines = axes.contour(*places, between, levels=levels, colors=ink, linewidths=0.5)
    axes.clabel(lines, fontsize=7)
    axes.figure.colorbar(painted, ax=axes, ticks=levels).ax.tick_params(labelsize=7)
    good = np.isfinite(field)
    mark(axes, x[good], y[good], ".", "#1c2328", 2.5)
    mark(axes, x[~good], y[~good], "x", "#b55a00", 6.0)
    axes.set(xlabel=_label(data, piece.across), ylabel=_label(data, piece.up))
    axes.tick_params(labelsize=8)


def mark(axes: Any, x: Array, y: Array, sign: str, colour: str, size: float) -> None:
    """Draw marks unclipped, also on the frame, without changing the limits."""
    (drawn,) = axes.plot(x, y, sign, color=colour, markersize=size, clip_on=False)
    drawn.set_in_layout(False)


def _grids(data: MapData, piece: Slice) -> tuple[Array, Array]:
    across, up = (reading_levels(data.axes[place])[0] for place in (piece.across, piece.up))
    x, y = np.meshgrid(across, up)
    return x, y


def shown(data: MapData, piece: Slice, field: Array) -> Array:
    """Return a field of a slice at FINE points along each axis; at its own levels where a result is missing."""
    if not np.all(np.isfinite(field)):
        return np.ma.masked_invalid(field)
    across, up = (
        weights(axis, np.linspace(axis.values[0], axis.values[-1], FINE))
        for axis in (data.axes[place] for place in (piece.across, piece.up))
    )
    return np.asarray(up @ field @ across.T)


def _label(data: MapData, place: int) -> str:
    axis = data.axes[place]
    unit = reading_levels(axis)[1]
    return f"{axis.input.words} / {unit}" if unit else axis.input.words


def efficiency_levels(*fields: Array) -> Array:
    """Return round contour levels of efficiencies in percent, dense near the best and sparser below."""
    least, most = _ends(*fields)
    for unit in UNITS:
        levels = _downwards(least / unit, most / unit)
        if len(levels) <= LINES + 2:
            break
    return unit * np.array(levels[::-1], float)


def _downwards(least: float, most: float) -> list[int]:
    """Return whole numbers from above the largest down to below the least, multiples of growing steps."""
    found = [math.ceil(most)]
    while found[-1] > least or len(found) == 1:
        step = DOWNWARDS[min(len(found), len(DOWNWARDS)) - 1]
        found.append((found[-1] - 1) // step * step)
    return found


def levels_of(*fields: Array) -> Array:
    """Return equidistant round contour levels from below the least of all fields to above their largest."""
    least, most = _ends(*fields)
    return _even(least, most)


def difference_levels(field: Array) -> Array:
    """Return equidistant round contour levels, symmetric about zero."""
    most = max(map(abs, _ends(field)))
    return _even(-most, most)


def _even(least: float, most: float) -> Array:
    from matplotlib.ticker import MaxNLocator

    return np.asarray(MaxNLocator(LINES).tick_values(least, max(most, least + 1e-6)))


def _ends(*fields: Array) -> tuple[float, float]:
    finite = np.concatenate([np.ma.compressed(np.ma.masked_invalid(field)) for field in fields])
    return (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
