"""Answer of a transient: travel and speed of the swash plate, and extreme pressures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from swashfilm.output.answer import Tile
from swashfilm.runs.transient.stops import contact_words
from system.inputs.shown import pressure_text
from system.inputs.units import LPM


def transient_tiles(summary: Mapping[str, Any]) -> Iterator[Tile]:
    """Yield the headline numbers of a transient from its summary."""
    start, end = (100.0 * summary[f"displacement_ratio_{when}"] for when in ("start", "end"))
    yield Tile(f"{end:.1f} %", "displacement at the end", f"from {start:.1f} %")
    travel = summary["travel_10_to_90_s"]
    if travel is not None:
        yield Tile(f"{travel * 1e3:.0f} ms", "from 10 to 90 % of the way")
    angle = summary["swash_angle"]
    yield Tile(f"{np.degrees(angle['fastest_rad_per_s']):.0f} deg/s", "fastest motion of the swash plate")
    first, last = (summary[f"{turn}_turn"] for turn in ("first", "last"))
    for part in ("chamber", "actuator"):
        yield Tile(pressure_text(summary[f"{part}_pressure_largest_Pa"]), f"largest {part} pressure", "gauge")
    before, after = (turn["delivery_flow_m3_per_s"] * LPM for turn in (first, last))
    yield Tile(f"{after:.1f} L/min", "delivery flow of the last turn", f"from {before:.1f} L/min")


def transient_words(summary: Mapping[str, Any]) -> str:
    """Return a paragraph on a transient from its summary."""
    angle, travel = summary["swash_angle"], summary["travel_10_to_90_s"]
    start, end = (float(np.degrees(angle[f"{when}_rad"])) for when in ("start", "end"))
    if travel is None:
        words = [f"The swash plate of {summary['pump']} stays at {start:.2f} deg."]
    else:
        words = [
            f"The swash plate of {summary['pump']} moves from {start:.2f} to {end + 0.0:.2f} deg; it passes from 10 "
            f"to 90 % of the way in {travel * 1e3:.0f} ms."
        ]
    torque = [summary[f"{turn}_turn"]["shaft_torque_Nm"] for turn in ("first", "last")]
    words.append(f"The mean drive torque changes from {torque[0]:.0f} to {torque[1]:.0f} N m.")
    return " ".join([*words, *contact_words(summary["stops"])])
