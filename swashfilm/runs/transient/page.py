"""Page of a transient: report.html from the files of the run folder."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.output.answer import Answer
from swashfilm.output.data.files import read_netcdf
from swashfilm.output.page import inlined, kept_text, read_summary, write_page
from swashfilm.runs.transient import plots as transient_plots
from swashfilm.runs.transient.answer import transient_tiles, transient_words
from swashfilm.runs.transient.stops import contact_rows
from system.inputs.shown import shown_in
from system.inputs.units import LPM

FILES = ("summary.json", "resolved.toml", "results.nc")


def write_transient_page(folder: Path) -> Path:
    """Write report.html of a transient's run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, FILES, "a transient's run folder")
    data = read_netcdf(folder / "results.nc")
    figures = {
        "Swash angle, control pressure and actuator pressure": transient_plots.plate_plot(data),
        "Moments on the swash plate by cause; positive: increase the angle; thick: means over a piston pitch":
            transient_plots.moment_plot(data),
        "Flows and drive torque of the pump; thick: means over a piston pitch": transient_plots.pump_plot(data),
        "Pressure of the chambers": transient_plots.chamber_plot(data),
    }  # fmt: skip
    shown = {text: inlined(figure) for text, figure in figures.items()}
    caption, first = next(iter(shown.items()))
    return write_page(
        folder,
        "transient",
        answer=Answer(tuple(transient_tiles(summary)), transient_words(summary), first, caption),
        summary=summary,
        rows=transient_rows(summary),
        turns=turn_rows(summary),
        checks=check_rows(summary),
        pictures={text: picture for text, picture in shown.items() if text != caption},
        resolved=kept_text(folder, "resolved.toml"),
    )


def transient_rows(summary: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return (name, value with its unit) of the motion of the swash plate."""
    angle, travel = summary["swash_angle"], summary["travel_10_to_90_s"]
    return [
        ("swash angle at the start", f"{np.degrees(angle['start_rad']):.3f} deg"),
        ("swash angle at the end", f"{np.degrees(angle['end_rad']):.3f} deg"),
        ("least, largest", f"{np.degrees(angle['least_rad']):.3f}, {np.degrees(angle['largest_rad']):.3f} deg"),
        ("displacement ratio, start", f"{summary['displacement_ratio_start']:.4f}"),
        ("displacement ratio, end", f"{summary['displacement_ratio_end']:.4f}"),
        ("time from 10 to 90 % of the way", "no motion" if travel is None else f"{travel * 1e3:.1f} ms"),
        ("largest speed of the swash angle", f"{np.degrees(angle['fastest_rad_per_s']):.1f} deg/s"),
        ("largest chamber pressure (gauge)", shown_in("Pa").text(summary["chamber_pressure_largest_Pa"])),
        ("largest actuator pressure (gauge)", shown_in("Pa").text(summary["actuator_pressure_largest_Pa"])),
        *contact_rows(summary["stops"]),
        ("natural frequency of the plate on its oil", f"{summary['plate_frequency_Hz']:.0f} Hz"),
    ]


def turn_rows(summary: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Return (name, mean over the first turn, over the last)."""
    first, last = summary["first_turn"], summary["last_turn"]
    shown = (
        ("delivery flow", "delivery_flow_m3_per_s", LPM, "L/min"),
        ("drive torque", "shaft_torque_Nm", 1.0, "N m"),
        ("moment of the pressure towards a larger swash angle", "pressure_moment_Nm", 1.0, "N m"),
    )
    return [(name, *(f"{scale * turn[key]:.2f} {unit}" for turn in (first, last))) for name, key, scale, unit in shown]


def check_rows(summary: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return (check, value)."""
    rows = [(name.replace("_", " "), f"{value:.2g}") for name, value in summary["checks"].items()]
    return [*rows, ("steps", f"{summary['steps']} of {summary['step_s'] * 1e6:.2f} us")]
