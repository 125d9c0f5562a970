"""Answer of a calibration: fitted values, deviations of the readings, undetermined parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from diagnosis.report.format import CHANNELS, listed
from swashfilm.output.answer import Answer, Tile
from swashfilm.output.touch.picture import Picture
from swashfilm.runs.calibrate.words import (
    AS_ASSUMED,
    AT_END,
    DETERMINED,
    FAR,
    assumed_text,
    fitted_parts,
    how_far,
    is_at_end,
    is_sensor,
    parameter_words,
    sigmas_off,
)
from system.inputs.channels import ChannelName

Row = Mapping[str, str]
MOST_LEARNT = 3
"""Number of the best determined values that have a tile."""
MOST_MISFITS = 2
"""Number of channels, those of the largest deviation, that have a tile."""
MOST_NAMED = 6
"""Number of parameters that the words name."""
WITHIN = 1.2
"""Deviation in multiples of the scatter up to which readings agree within it."""
CAPTION = "Measured less fitted, each reading, over the reading. Band: scatter of the meter, one sigma"


def calibrate_answer(
    summary: Mapping[str, Any], parameters: Sequence[Row], residuals: Sequence[Row], picture: Picture | None = None
) -> Answer:
    """Return the answer of a calibration's page: tiles, words, the picture of fit and readings."""
    own = sorted((row for row in parameters if not is_sensor(row)), key=lambda row: float(row["sigma_over_prior [1]"]))
    learnt = [row for row in own if how_far(row) == DETERMINED]
    held = [row for row in own if is_at_end(row)]
    tiles = [_tile(row) for row in [*(row for row in own if row not in held), *held][:MOST_LEARNT]]
    tiles.append(Tile(f"{len(learnt)} of {len(own)}", "values of the pump determined", "error halved at least"))
    worst = sorted(_misfits(residuals), key=lambda one: -one[3])[:MOST_MISFITS]
    tiles += [
        Tile(f"{rms:.2g} {unit}", f"{words}, error of the fit", f"rms; {_scatter_words(unit, rms, pull)}")
        for words, unit, rms, pull in worst
    ]
    words = (
        *_fit_words(summary, residuals),
        *_learnt_words(own, learnt),
        *_law_words(summary),
        *_far_words(parameters),
    )
    return Answer(tuple(tiles), " ".join(words), picture, CAPTION if picture else "")


def _tile(row: Row) -> Tile:
    value, sigma = fitted_parts(row)
    known = AT_END if is_at_end(row) else f"+- {sigma}"
    return Tile(value, parameter_words(row["name"]), f"{known}; assumed {assumed_text(row)}")


def _misfits(residuals: Sequence[Row]) -> Iterator[tuple[str, str, float, float]]:
    """Yield (channel, unit, rms of measured less fitted, rms of that in multiples of the meter's scatter)."""
    for channel in dict.fromkeys(row["channel"] for row in residuals):
        own = [row for row in residuals if row["channel"] == channel]
        off = np.array([float(row["measured"]) - float(row["fitted"]) for row in own])
        rms, pull = (float(np.sqrt(np.mean(one**2))) for one in (off, np.array([float(row["pull"]) for row in own])))
        yield CHANNELS.get(ChannelName.named(channel), channel), own[0]["unit"], rms, pull


def _scatter_words(unit: str, rms: float, pull: float) -> str:
    """Return the meter's scatter, of which `rms` is `pull` times; readings that are met exactly do not tell it."""
    return f"scatter of the meter {rms / pull:.2g} {unit}" if pull > 0.0 else "every reading is met exactly"


def _fit_words(summary: Mapping[str, Any], residuals: Sequence[Row]) -> Iterator[str]:
    misfits = list(_misfits(residuals))
    met = listed(f"{words} to {rms:.2g} {unit}" for words, unit, rms, _ in misfits)
    yield f"The fitted pump meets {summary['readings']} readings at {summary['points']} points: {met} (rms)."
    beyond = [f"{words} ({pull:.1f} times)" for words, _, _, pull in misfits if pull > WITHIN]
    if beyond:
        told = f"Beyond the scatter of its meter is {listed(beyond)}"
        yield f"{told}: the model lacks something there, or that scatter is stated too small."
    else:
        yield "That is within the scatter of the meters."


def _learnt_words(own: Sequence[Row], learnt: Sequence[Row]) -> Iterator[str]:
    if learnt:
        yield f"The recording determines: {listed(_named(learnt))}."
    else:
        yield "The recording determines no value of the pump better than half of what was assumed."
    if left := [row for row in own if how_far(row) == AS_ASSUMED]:
        yield f"These stay as assumed: {listed(_named(left))}."
    if ends := [row for row in own if is_at_end(row)]:
        yield f"These lie at the end of their range, so that no sigma of them holds: {listed(_named(ends))}."


def _far_words(parameters: Sequence[Row]) -> Iterator[str]:
    """Yield a warning of each parameter, of pump or meter, whose value contradicts the assumed one."""
    for row in sorted(parameters, key=lambda row: -abs(sigmas_off(row))):
        if abs(sigmas_off(row)) >= FAR:
            what = f"{parameter_words(row['name'])} {fitted_parts(row)[0]}"
            yield (
                f"Warning: {what} is {abs(sigmas_off(row)):.1f} sigma from what was assumed ({assumed_text(row)}): "
                "that, the recording or the model is wrong."
            )


def _named(rows: Sequence[Row]) -> list[str]:
    names = [parameter_words(row["name"]).replace(", ", " of ", 1) for row in rows[:MOST_NAMED]]
    more = len(rows) - MOST_NAMED
    return [*names, f"{more} more"] if more > 0 else names


def _law_words(summary: Mapping[str, Any]) -> Iterator[str]:
    if (law := summary["hersey"]) is not None:
        words = "Friction changes" if law["supported"] else "Nothing shows that friction changes"
        yield f"{words} with speed, viscosity and load (Hersey number)."
