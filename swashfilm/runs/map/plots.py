"""Pictures of an operating map: efficiency by level and by definition, loss and its parts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.runs.map.contour_levels import efficiency_levels, steps_words
from swashfilm.runs.map.files import PARTS
from swashfilm.runs.map.panels import LARGE, Panel, even_panel, panel_figure
from swashfilm.runs.map.slices import (
    Slice,
    further_slices,
    held_levels,
    held_words,
    main_slice,
    place_words,
    shown,
    varied,
)
from system.inputs.shown import titled
from system.maps.data import MapData
from system.maps.definitions import HEADLINE
from system.maps.plan import MapInput, reading_levels
from system.pump.efficiency import EfficiencyDefinition

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ALIKE = 5e-4
"""Difference of efficiencies below which two definitions are drawn once: a twentieth of a percentage point."""
SHOWN_SHARES = 5
"""Number of the largest losses, which have separate panels."""
COLOURS = (
    "#3c7a8c", "#8c5a3c", "#5b9a5b", "#b8862b", "#7a5a8c", "#a9bcc4", "#d0a98f", "#55616a", "#c8d7a0", "#d98b8b",
    "#6fa8b8", "#b59a74", "#8fb58f", "#e0c27a",
)  # fmt: skip


@dataclass(frozen=True)
class Shared:
    """A field and the definitions of efficiency that have it."""

    definitions: tuple[EfficiencyDefinition, ...]
    field: Array

    @property
    def words(self) -> str:
        """Names of the definitions."""
        return "; ".join(one.label for one in self.definitions)


def main_picture(data: MapData) -> tuple[str, Figure] | None:
    """Return caption and picture of the overall efficiency over the main slice, or over the one axis; None without."""
    piece = main_slice(data)
    if piece is not None:
        field = _overall(data, piece)
        panel = Panel("overall efficiency [%]", piece, field, _common_levels(data, piece), best=True)
        caption = (
            f"Overall efficiency in % by ISO 4409{_comma(held_words(data, piece))}. Dashed: constant shaft power; "
            f"dots: solved points; star: the best; a step of colour: {steps_words(panel.levels)}"
        )
        return caption, panel_figure(data, panel, LARGE, powers=True)
    if wide := varied(data):
        return f"Efficiency in % over {wide[0].words}, by {HEADLINE.label}", efficiency_course(data, wide[0])
    return None


def further_pictures(data: MapData) -> dict[str, Figure]:
    """Return the overall efficiency at the other levels of a third axis, by caption."""
    piece = main_slice(data)
    if piece is None:
        return {}
    levels = _common_levels(data, piece)
    found = {}
    for one in further_slices(data, piece):
        panel = Panel("overall efficiency [%]", one, _overall(data, one), levels, best=True)
        found[f"Overall efficiency {held_words(data, one)}"] = panel_figure(data, panel, powers=True)
    return found


def _overall(data: MapData, piece: Slice) -> Array:
    return 100.0 * piece.of(data.efficiency(HEADLINE).overall)


def _common_levels(data: MapData, piece: Slice) -> Array:
    """Return the contour levels of the overall efficiency for the slice and those at the other levels."""
    pieces = (piece, *further_slices(data, piece))
    return efficiency_levels(*(shown(data, one, _overall(data, one)) for one in pieces))


def definition_pictures(data: MapData) -> dict[str, Figure]:
    """Return volumetric, hydromechanical and overall efficiency on the main slice, each distinct one once."""
    piece = main_slice(data)
    found = {}
    for part in PARTS[1:] + PARTS[:1]:
        for panel, words in efficiency_panels(data, piece, part) if piece else ():
            found[f"{part.capitalize()} efficiency in %: {words}"] = panel_figure(data, panel)
    return found


def efficiency_panels(
    data: MapData, piece: Slice, part: str, chosen: Sequence[EfficiencyDefinition] = tuple(EfficiencyDefinition)
) -> list[tuple[Panel, str]]:
    """Return a panel for each distinct efficiency on a slice, with the definitions that share it in words."""
    groups = shared_fields({one: piece.of(getattr(data.efficiency(one), part)) for one in chosen})
    levels = efficiency_levels(*(shown(data, piece, 100.0 * one.field) for one in groups)) if groups else np.array([])
    return [(Panel(f"{part} [%]", piece, 100.0 * one.field, levels, best=True), one.words) for one in groups]


def shared_fields(fields: Mapping[EfficiencyDefinition, Array]) -> list[Shared]:
    """Return each distinct field once with its definitions; fields that differ by less than ALIKE are one."""
    groups: list[Shared] = []
    for one, field in fields.items():
        if not np.isfinite(field).any():
            continue
        k = next((k for k, known in enumerate(groups) if _alike(known.field, field)), None)
        if k is None:
            groups.append(Shared((one,), field))
        else:
            groups[k] = Shared((*groups[k].definitions, one), groups[k].field)
    return groups


def _alike(one: Array, other: Array) -> bool:
    return bool(np.allclose(one, other, rtol=0.0, atol=ALIKE, equal_nan=True))


def loss_pictures(data: MapData) -> dict[str, Figure]:
    """Return the losses over the pressure, then the loss and its largest parts on the main slice, by caption."""
    given, found = stacked_over(data), {}
    if given is not None:
        for held in dict.fromkeys((held_levels(data), _least_displacement(data))):
            for share in (False, True):
                figure = figure_of(6.4, 3.8)
                draw_stack(figure.subplots(), data, given, held, share)
                figure.legend(*_legend(figure), loc="outside right upper", fontsize=9)
                found[_stack_caption(data, given, held, share)] = figure
    piece = main_slice(data)
    for panel in loss_panels(data, piece) if piece else ():
        caption = f"{panel.title}{_comma(held_words(data, panel.piece))}"
        found[caption[0].upper() + caption[1:]] = panel_figure(data, panel)
    return found


def stacked_over(data: MapData) -> MapInput | None:
    """Return the input over which losses are stacked: the pressure, else the first with several levels."""
    wide = varied(data)
    return MapInput.PRESSURE if MapInput.PRESSURE in wide else next(iter(wide), None)


def _least_displacement(data: MapData) -> tuple[int, ...]:
    return tuple(
        0 if axis.input is MapInput.RATIO else level for axis, level in zip(data.axes, held_levels(data), strict=True)
    )


def _stack_caption(data: MapData, given: MapInput, held: tuple[int, ...], share: bool) -> str:
    levels = {
        axis.input: axis.values[level]
        for axis, level in zip(data.axes, held, strict=True)
        if axis.input is not given and len(axis.values) > 1
    }
    index = _along(data, given, held)
    below = [name for name, loss in data.losses.items() if np.any(loss[index] < 0.0)]
    left = f"; negative somewhere, and left out there: {', '.join(below)}" if below else ""
    where = f" at {place_words(levels)}" if levels else ""
    return f"{'Shares of the losses' if share else 'Losses'} over {given.words}{where}{left}"


def loss_panels(data: MapData, piece: Slice) -> Iterator[Panel]:
    """Yield the loss in kW and the share of each of its largest parts."""
    whole = piece.of(data.loss)
    sinks = {words: piece.of(loss) for words, loss in data.losses.items()}
    largest = sorted(sinks, key=lambda words: -float(np.nansum(sinks[words])))[:SHOWN_SHARES]
    yield even_panel(data, "loss [kW]", piece, whole * 1e-3)
    for words in largest:
        yield even_panel(data, f"{words}, share of the loss [%]", piece, 100.0 * sinks[words] / whole)


def share_plot(data: MapData, given: MapInput) -> Figure:
    """Draw losses stacked over an input side by side: in kW, and as shares of the sum."""
    figure = figure_of(11.0, 4.6)
    for axes, share in zip(figure.subplots(1, 2), (False, True), strict=True):
        draw_stack(axes, data, given, held_levels(data), share)
    figure.legend(*_legend(figure), loc="outside right upper", fontsize=8)
    return figure


def draw_stack(axes: Any, data: MapData, given: MapInput, held: tuple[int, ...], share: bool) -> None:
    """Draw losses stacked over an input, in kW or as shares of their sum; negative ones are left out."""
    index = _along(data, given, held)
    rows = np.array([np.maximum(loss[index], 0.0) for loss in data.losses.values()])
    shown_rows = 100.0 * rows / rows.sum(axis=0) if share else 1e-3 * rows
    levels = reading_levels(next(axis for axis in data.axes if axis.input is given))
    colours = [COLOURS[k % len(COLOURS)] for k in range(len(rows))]
    axes.stackplot(levels, shown_rows, labels=[*data.losses], colors=colours)
    label = "share of the losses [%]" if share else "loss [kW]"
    axes.set(xlabel=titled(given.words, given.shown.unit), ylabel=label, xlim=(levels[0], levels[-1]))
    if share:
        axes.set_ylim(0.0, 100.0)


def _legend(figure: Any) -> tuple[list[Any], list[str]]:
    """Return the legend of stacked losses from the uppermost down."""
    handles, labels = figure.axes[0].get_legend_handles_labels()
    return handles[::-1], labels[::-1]


def efficiency_course(data: MapData, given: MapInput) -> Figure:
    """Draw the three efficiencies of the headline's definition over one input."""
    index = _along(data, given, held_levels(data))
    levels = reading_levels(next(axis for axis in data.axes if axis.input is given))
    figure = figure_of(*LARGE)
    axes = figure.subplots()
    found = data.efficiency(HEADLINE)
    for part, colour in zip(PARTS, COLOURS, strict=False):
        axes.plot(levels, 100.0 * getattr(found, part)[index], "o-", color=colour, label=part)
    axes.set(xlabel=titled(given.words, given.shown.unit), ylabel="efficiency [%]")
    axes.grid(visible=True, alpha=0.3)
    axes.legend()
    return figure


def _along(data: MapData, given: MapInput, held: tuple[int, ...]) -> tuple[Any, ...]:
    """Return the index of a line of the map along an input."""
    return tuple(slice(None) if axis.input is given else level for axis, level in zip(data.axes, held, strict=True))


def _comma(words: str) -> str:
    return f", {words}" if words else ""
