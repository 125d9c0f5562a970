"""The page of a diagnosis: report.html made from the run folder's own files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from diagnosis.finding import NO_NEXT_POINT
from diagnosis.procedure.compared import WITH, WITHOUT
from diagnosis.procedure.pump_comparison import HYDRAULIC, SHAFT
from diagnosis.report.format import chance
from diagnosis.report.json_file import read_diagnosis
from reynolds.numerics.arrays import Array
from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.output.tables import parted
from swashfilm.runs.diagnose import plots as diagnose_plots
from swashfilm.runs.diagnose.fields import film_pictures
from swashfilm.runs.diagnose.files import TRACES, head_of, read_rows
from swashfilm.runs.diagnose.trace_plots import trace_residuals
from system.inputs.units import Dimension, in_unit, reading_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FILES = (
    "summary.json", "diagnosis.json", "residuals.csv", "hypotheses.csv", "parameters.csv", "next_points.csv",
    "changes.csv", "films.csv",
)  # fmt: skip
TABLES = ("residuals", "hypotheses", "parameters", "next_points", "changes", "films")
MOST_POINTS = 8
AXES = ("p_out", "speed", "displacement_ratio", "T_case")
FAINT = 0.3  # sigma, rms: smaller additions to a channel are not drawn
MOST_COURSES = 2


def write_diagnose_page(folder: Path) -> Path:
    """Write report.html of a diagnosis; raises InputFaults where one of its files is not there."""
    summary = read_summary(folder, FILES, "a diagnosis's run folder")
    found = read_diagnosis(folder / "diagnosis.json")
    tables = {name: read_rows(folder / f"{name}.csv") for name in TABLES}
    kinds = film_kinds(tables["films"])
    if (folder / TRACES).is_file():
        tables["traces"] = read_rows(folder / TRACES)
    return write_page(
        folder,
        "diagnose",
        summary=summary,
        found=found,
        channels=list(channel_rows(found)),
        channel_head=CHANNEL_HEAD,
        place=list(place_rows(found)),
        claims=list(claim_rows(found)),
        parameters=list(parameter_rows(tables["parameters"])),
        next_points=[tuple(row.values()) for row in tables["next_points"][:MOST_POINTS]],
        next_head=tuple(next(iter(tables["next_points"]), {})),
        changes=list(change_rows(tables["changes"])),
        films=list(film_rows(tables["films"])),
        film_head=("all gaps of a kind", *(f"{FILM_HEADS[kind]}, without -> with" for kind in kinds)),
        floating=kinds == ["films"],
        film_pictures={name: inlined(png) for name, png in film_pictures(folder, (WITHOUT, WITH), found).items()},
        remarks=remarks(found, summary),
        next_point=next_point_words(found),
        pictures={name: inlined(png) for name, png in _pictures(found, tables).items()},
    )


def channel_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """(channel, chi2 per reading, share, held-out rms before, after, noise) of each channel."""
    for name, misfit in found["mismatch"]["channels"].items():
        fit = found["fit"]["heldout"].get(name, {})
        shown = (f"{fit[key]:.3g} {fit['unit']}" if fit.get(key) is not None else "" for key in _HELD_OUT)
        yield name, f"{misfit['chi2_per_dof']:.3g}", f"{100 * misfit['share']:.0f} %", *shown


_HELD_OUT = ("before", "after", "noise")
CHANNEL_HEAD = ("channel", "chi2 per reading", "share", "held out, before", "after", "noise")


def place_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """(property, value) of the place of the mismatch, or of a local mismatch without a claim."""
    where, steady = found["where"], set(found["where"]["channels"]) - {"p_chamber"}
    if where["channels"]:
        yield "channels", ", ".join(where["channels"])
    if steady:  # a region is of the map, on which traces have no place
        yield "region of the map", where["region"] or "everywhere"
    if where["components"] and steady:
        yield "component", " or ".join(where["components"]).replace("_", " ")
    if where["pair"]:
        yield "pair", where["pair"].replace("_", " ")
    if where["shaft_angle_deg"]:
        yield "shaft angle", " to ".join(f"{angle:.3g}" for angle in where["shaft_angle_deg"]) + " deg"
    if time := where["time"]:
        yield time["kind"], time["channel"] + (f" from point {time['point']} on" if time["point"] else "")


def claim_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """(effect, pair, probability, ids and gaps that cannot be separated from it with their shares, parameters)."""
    for claim in found["effects"]:
        sizes = (
            f"{one['name'].replace('_', ' ')} {_quantity(one['unit'], one['value'], one['sigma'])}"
            for one in claim["parameters"]
        )
        yield (
            claim["id"],
            (claim["pair"] or "").replace("_", " "),
            chance(claim["probability"]),
            ", ".join([*claim["equivalent"], *_other_gaps(claim)]),
            "; ".join(sizes),
        )


def _other_gaps(claim: Mapping[str, Any]) -> Iterator[str]:
    for gap, share in claim["other_pairs"].items():
        yield f"at the {gap.replace('_', ' ')} ({share:.2f})"


def parameter_rows(rows: Sequence[Mapping[str, str]]) -> Iterator[tuple[str, ...]]:
    """(parameter, stated, before, after, pulls): free parameters first, then by pull."""
    ranked = sorted(rows, key=lambda row: -abs(float(row["pull_after"] or "inf")))
    for row in ranked:
        unit, pull = row["unit"], f"{float(row['pull_after']):.2f}" if row["pull_after"] else "free"
        yield (
            row["name"],
            _quantity(unit, float(row["prior"]), float(row["prior_sigma"])),
            _quantity(unit, float(row["before"])) if row["before"] else "not in the fit",
            _quantity(unit, float(row["after"]), float(row["sigma"])),
            f"{float(row['pull_before']):.2f} -> {pull}" if row["pull_before"] else f"- -> {pull}",
        )


def change_rows(rows: Sequence[Mapping[str, str]]) -> Iterator[tuple[str, ...]]:
    """(quantity, without, with, change, share of the shaft power of both) of a point run without and with it."""
    shaft = shaft_power(rows)
    for row in rows:
        both = (f"{_plain(float(row[key]), 4)} {row['unit']}" for key in (WITHOUT, WITH))
        moved = f"{_plain(float(row['change']), 3)} {'points' if row['unit'] == '%' else row['unit']}"
        shares = (f"{100.0 * float(row[key]) / whole:.2f} %" for key, whole in shaft.items() if row["unit"] == "W")
        yield row["quantity"], *both, moved, " -> ".join(shares)


FILM_HEADS = {"lumped": "closed-form laws", "films": "films"}
"""Source of a gap's quantities, by the first part of their columns."""


def film_kinds(rows: Sequence[Mapping[str, str]]) -> list[str]:
    """Sources of the quantities in films.csv; floating films have no closed-form laws beside them."""
    return [kind for kind in FILM_HEADS if rows and f"{kind}_{WITHOUT}" in rows[0]]


def film_rows(rows: Sequence[Mapping[str, str]]) -> Iterator[tuple[str, ...]]:
    """(quantity, by closed-form laws where films.csv has them, by films): without -> with the finding, the factor."""
    for row in rows:
        films = []
        for kind in film_kinds(rows):
            one, other = (float(row[f"{kind}_{name}"]) for name in (WITHOUT, WITH))
            times = f" (x {other / one:.3g})" if one else ""
            films.append(f"{_plain(one, 4)} -> {_plain(other, 4)} {row['unit']}{times}")
        yield row["quantity"], *films


def shaft_power(rows: Sequence[Mapping[str, str]]) -> dict[str, float]:
    """Shaft power in W without and with the finding; empty where nothing was run."""
    return {key: float(row[key]) for row in rows if row["quantity"] == SHAFT for key in (WITHOUT, WITH)}


def remarks(found: Mapping[str, Any], summary: Mapping[str, Any]) -> list[str]:
    """Notes of the verdict that are not on the data."""
    return [note for note in found["notes"] if not any(line.endswith(note) for line in summary["data_notes"])]


def next_point_words(found: Mapping[str, Any]) -> str:
    """The next point to record, or the reason for none; empty without a claim."""
    if found["next_test"]:
        return str(found["details"][-1])
    if not found["effects"]:
        return ""
    failed = (note for note in found["notes"] if note.startswith(NO_NEXT_POINT))
    reason = next(failed, "no fitted rival remains that a point would have to separate")
    return f"{reason[0].upper()}{reason[1:].rstrip('.')}."


def _quantity(unit: str, value: float, sigma: float | None = None) -> str:
    """A value in SI, with its sigma, in its reading unit; temperatures are differences."""
    dimension = next((one for one in Dimension if one.si_unit == unit), None)
    if dimension is not None and dimension is not Dimension.TEMPERATURE:
        unit = reading_unit(value or sigma or 0.0, dimension)
        value, sigma = in_unit(value, unit, dimension), sigma and in_unit(sigma, unit, dimension)
    shown = _plain(value, 4) if sigma is None else f"{_plain(value, 4)} +- {_plain(sigma, 2)}"
    return shown if unit == "1" else f"{shown} {unit}"


def _plain(value: float, digits: int) -> str:
    """A number of `digits` significant digits, or all digits before the decimal point where these are more."""
    return f"{value:.{digits}g}" if abs(value) < 10.0**digits else f"{value:.0f}"


def _pictures(found: Mapping[str, Any], tables: Mapping[str, Sequence[Mapping[str, str]]]) -> dict[str, Figure]:
    """Captions and PNGs."""
    residuals = tables["residuals"]
    held_out = {name: row for name, row in found["fit"]["heldout"].items() if all(row[key] for key in _HELD_OUT)}
    pictures = {"maps": diagnose_plots.residual_maps(residuals)}
    if courses := strongest_courses(residuals) if found["effects"] else []:
        pictures["course"] = diagnose_plots.effect_courses(residuals, courses)
    if held_out:
        pictures["held_out"] = diagnose_plots.held_out_bars(held_out)
    if tables["hypotheses"]:
        pictures["hypotheses"] = diagnose_plots.hypothesis_bars(tables["hypotheses"])
    if tables.get("traces"):
        pictures["traces"] = trace_residuals(tables["traces"], found["where"]["shaft_angle_deg"], _settings(residuals))
    if whole := shaft_power(tables["changes"]):
        losses = [row for row in tables["changes"] if row["unit"] == "W" and row["quantity"] not in (SHAFT, HYDRAULIC)]
        pictures["losses"] = diagnose_plots.loss_bars(losses, whole)
    pictures["pulls"] = diagnose_plots.pull_changes(tables["parameters"])
    return pictures


def _settings(residuals: Sequence[Mapping[str, str]]) -> dict[str, str]:
    """Each point with its settings: "point 7: 1000 rpm, 374 bar, displacement ratio 0.28"."""
    texts = {}
    for row in residuals:
        known = [(row[head_of(row, name)], parted(head_of(row, name))[1], words) for name, words in _SET]
        values = ", ".join(words.format(float(value), unit) for value, unit, words in known if value)
        texts[row["point"]] = f"point {row['point']}: {values}"
    return texts


_SET = (("speed", "{:.0f} {}"), ("p_out", "{:.3g} {}"), ("displacement_ratio", "displacement {:.2g}"))


def strongest_courses(residuals: Sequence[Mapping[str, str]]) -> list[tuple[str, str]]:
    """Channels with the largest additions of the claim in sigma, each with the axis of largest correlation.

    Of axes that all of a channel's points have; empty for a claim in the chamber's traces alone.
    """
    strength, courses = {}, {}
    for channel in dict.fromkeys(row["channel"] for row in residuals):
        own = [row for row in residuals if row["channel"] == channel]
        known = [head for axis in AXES if all(row[head := head_of(own[0], axis)] for row in own)]
        if not known:
            continue
        added = np.array([float(row["added"]) for row in own])
        strength[channel] = float(np.sqrt(np.mean((added / [float(row["sigma"]) for row in own]) ** 2)))
        alike = {axis: _alike(own, axis, added) for axis in known}
        courses[channel] = max(alike, key=lambda axis: alike[axis])
    ranked = sorted((name for name, size in strength.items() if size > FAINT), key=lambda name: -strength[name])
    return [(channel, courses[channel]) for channel in ranked[:MOST_COURSES]]


def _alike(rows: Sequence[Mapping[str, str]], axis: str, added: Array) -> float:
    """Absolute correlation of the addition with an axis; 0 if either does not vary."""
    place = np.array([float(row[axis]) for row in rows])
    if np.ptp(place) == 0.0 or np.ptp(added) == 0.0:
        return 0.0
    return abs(float(np.corrcoef(place, added)[0, 1]))
