"""Answer of an operating map: best point, range of the loss and its parts, and accuracy of the map."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from swashfilm.output.answer import Answer, Tile
from swashfilm.output.touch.picture import Picture
from swashfilm.runs.map.slices import held_levels, place_of
from system.maps.data import MapData
from system.maps.definitions import HEADLINE
from system.maps.interpolation import MapError

FLOW = 6e4
"""L/min in a m3/s."""
LEAST_TOLD = 1e-3
"""Error in N m or L/min below which the words name no number."""


def map_answer(
    data: MapData, error: MapError | None, summary: Mapping[str, Any], picture: Picture | None = None, caption: str = ""
) -> Answer:
    """Return the answer of a map's page: tiles, words, and the picture with its caption."""
    tiles = (*_efficiency_tiles(data, error), *_loss_tiles(data), *_point_tiles(summary))
    words = " ".join((*_efficiency_words(data), *_loss_words(data), *_error_words(data, error, summary)))
    return Answer(tiles, words, picture, caption)


def efficiency_error(data: MapData, error: MapError, index: tuple[int, ...]) -> float:
    """Return the error of an overall efficiency P_h/P between levels next to a point: (dP_h + dP)/P."""
    power = float(data.values["shaft_power"][index])
    return (error.largest["shaft_power"] + error.largest["hydraulic_power"]) / power


def points_text(share: float) -> str:
    """Return a difference of efficiencies in percentage points."""
    return f"{100.0 * share:.2g} percentage points"


def overall_formula(formula: str) -> str:
    """Return the formula of the overall efficiency alone, without that of the volumetric one."""
    return formula.partition(", ")[0]


def percent(share: float) -> str:
    """Return an efficiency or a share in percent."""
    return f"{100.0 * share:.1f} %"


def _efficiency_tiles(data: MapData, error: MapError | None) -> Iterator[Tile]:
    overall = data.efficiency(HEADLINE).overall
    if not np.isfinite(overall).any():
        return
    best, least, corner = _best(overall), _best(-overall), held_levels(data)
    yield Tile(percent(overall[best]), "best overall efficiency (ISO 4409)", f"at {place_of(data, best)}")
    if corner not in (best, least) and np.isfinite(overall[corner]):
        yield Tile(percent(overall[corner]), "at full load", place_of(data, corner))
    if least != best:
        yield Tile(percent(overall[least]), "lowest overall efficiency", f"at {place_of(data, least)}")
    if error is not None:
        off = f"+- {100.0 * efficiency_error(data, error, best):.1g} points"
        yield Tile(off, "error between levels", f"of the best efficiency; {error.count} {error.shown_by}")


def _loss_tiles(data: MapData) -> Iterator[Tile]:
    loss, flow = 1e-3 * data.loss, FLOW * data.values["delivery_flow"]
    if np.isfinite(loss).any():
        yield Tile(f"{np.nanmax(loss):.3g} kW", "largest loss", f"least {np.nanmin(loss):.3g} kW")
        yield Tile(f"{np.nanmax(flow):.3g} L/min", "largest delivery flow", f"least {np.nanmin(flow):.3g} L/min")


def _point_tiles(summary: Mapping[str, Any]) -> Iterator[Tile]:
    if failed := len(summary["failed"]):
        yield Tile(f"{failed} of {summary['points']}", "points without a result")


def _efficiency_words(data: MapData) -> Iterator[str]:
    overall = data.efficiency(HEADLINE).overall
    if not np.isfinite(overall).any():
        yield "The pump has no efficiency at any point of this map."
        return
    best, least = _best(overall), _best(-overall)
    yield f"The overall efficiency by ISO 4409 is {percent(overall[best])} at best, at {place_of(data, best)}."
    if least != best:
        yield f"It falls to {percent(overall[least])} at {place_of(data, least)}."


def _loss_words(data: MapData) -> Iterator[str]:
    loss = data.loss
    if not np.isfinite(loss).any():
        return
    whole = float(np.nansum(loss))
    shares = {words: float(np.nansum(own)) / whole for words, own in data.losses.items()}
    largest = sorted(shares, key=lambda words: -shares[words])[:3]
    named = [f"{words} ({100.0 * shares[words]:.0f} %)" for words in largest]
    mean = "In the mean of all points most of it is" if loss.size > 1 else "Most of it is"
    yield f"The pump loses {_span(1e-3 * loss, 'kW')}. {mean} {', '.join(named[:-1])} and {named[-1]}."


def _error_words(data: MapData, error: MapError | None, summary: Mapping[str, Any]) -> Iterator[str]:
    if error is not None:
        torque, flow = error.largest["shaft_torque"], FLOW * error.largest["delivery_flow"]
        yield (
            f"Between its levels the map is exact to {_small(torque)} N m and {_small(flow)} L/min, the largest errors "
            f"at {error.count} {error.shown_by}."
        )
    elif data.solved.size > 1:
        yield "The error between its levels is not known; fresh points measure it (--check N)."
    if summary["table_error"]:
        worst = max(summary["table_error"].values())
        yield f"Its points come from a response table, which misses solved points by up to {percent(worst)}."
    yield "The error of the pump's model itself comes on top."


def _small(error: float) -> str:
    return f"{error:.1g}" if error >= LEAST_TOLD else f"less than {LEAST_TOLD:g}"


def _best(values: np.ndarray) -> tuple[int, ...]:
    return tuple(int(k) for k in np.unravel_index(int(np.nanargmax(values)), values.shape))


def _span(values: np.ndarray, unit: str) -> str:
    least, most = (f"{end:.3g}" for end in (float(np.nanmin(values)), float(np.nanmax(values))))
    return f"{least} to {most} {unit}" if least != most else f"{most} {unit}"
