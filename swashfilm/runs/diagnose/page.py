"""The page of a diagnosis: report.html made from the run folder's own files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from diagnosis.procedure.compared import WITH, WITHOUT
from diagnosis.procedure.pump_comparison import HYDRAULIC, SHAFT
from diagnosis.report.json_file import read_diagnosis
from reynolds.numerics.arrays import Array
from swashfilm.output.answer import Answer
from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.output.tables import parted
from swashfilm.output.touch.picture import Picture
from swashfilm.runs.diagnose import plots as diagnose_plots
from swashfilm.runs.diagnose.fields import film_pictures
from swashfilm.runs.diagnose.files import HIDDEN, TRACES, head_of, read_rows
from swashfilm.runs.diagnose.rows import (
    AGREED_HEAD,
    AGREED_PARAMETER_HEAD,
    CHANNEL_HEAD,
    FILM_HEADS,
    HELD_OUT,
    PARAMETER_HEAD,
    change_rows,
    channel_rows,
    claim_rows,
    film_kinds,
    film_rows,
    hidden_head,
    hidden_rows,
    measured_words,
    misfit_rows,
    moved_words,
    parameter_rows,
    place_rows,
    shaft_power,
    tiles,
    unlimited_words,
)
from swashfilm.runs.diagnose.trace_plots import trace_residuals
from system.inputs.channels import ChannelName

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


WORDS = ("headline", "finding", "cost", "doubt", "course")
"""First part of the page in the answer in plain words."""
COURSE_CAPTION = (
    "Crosses: what the finding adds to the readings. Circles: measured minus simulated without the finding, with the "
    "scatter of the meter. Where crosses lie on circles, the finding explains the difference."
)
MAP_CAPTION = (
    "Measured minus simulated, in multiples of the meter's scatter, over pressure and speed or temperature{both}. "
    "White: agreement; red: more is measured; blue: less. Points of other case temperatures stand side by side."
)
TRACE_CAPTION = (
    "Recorded chamber pressures that differ most, and measured minus simulated on one scale: for the pump within "
    "its tolerances, fitted to the traces alone{fits}. All samples are in trace_residuals.csv."
)


def write_diagnose_page(folder: Path) -> Path:
    """Write report.html of a diagnosis; raises InputFaults where one of its files is missing."""
    summary = read_summary(folder, FILES, "a diagnosis's run folder")
    found = read_diagnosis(folder / "diagnosis.json")
    tables = {name: read_rows(folder / f"{name}.csv") for name in TABLES}
    for name, file in (("traces", TRACES), ("hidden", HIDDEN)):
        if (folder / file).is_file():
            tables[name] = read_rows(folder / file)
    hidden = tables.get("hidden", [])
    kinds, claimed = film_kinds(tables["films"]), bool(found["effects"])
    pictures = {name: inlined(figure) for name, figure in _pictures(found, tables).items()}
    answer, below = _answer(found, summary, tables, pictures)
    return write_page(
        folder,
        "diagnose",
        answer=answer,
        summary=summary,
        found=found,
        told=found["answer"],
        channels=list(channel_rows(found)),
        channel_head=CHANNEL_HEAD if claimed else AGREED_HEAD,
        misfits=list(misfit_rows(found)),
        place=list(place_rows(found)),
        claims=list(claim_rows(found)),
        moved=moved_words(tables["parameters"]) if claimed else "",
        parameters=list(parameter_rows(tables["parameters"], claimed)),
        parameter_head=PARAMETER_HEAD if claimed else AGREED_PARAMETER_HEAD,
        next_points=[tuple(row.values()) for row in tables["next_points"][:MOST_POINTS]],
        next_head=tuple(next(iter(tables["next_points"]), {})),
        hidden=list(hidden_rows(hidden)),
        hidden_head=hidden_head(hidden),
        unlimited=unlimited_words(hidden),
        changes=list(change_rows(tables["changes"])),
        films=list(film_rows(tables["films"])),
        film_head=("all gaps of a kind", *(f"{FILM_HEADS[kind]}, without -> with" for kind in kinds)),
        floating=kinds == ["films"],
        film_pictures={name: inlined(one) for name, one in film_pictures(folder, (WITHOUT, WITH), found).items()},
        remarks=remarks(found, summary),
        measured=measured_words(summary),
        in_traces=ChannelName.P_CHAMBER.value in found["where"]["channels"],
        pictures=below,
        map_caption=_map_caption(claimed),
        trace_caption=TRACE_CAPTION.format(
            fits=", for its fit without the finding, which may shift stated values, and for the fit with it"
            if claimed
            else " and for its fit"
        ),
    )


def _answer(
    found: Mapping[str, Any],
    summary: Mapping[str, Any],
    tables: Mapping[str, Sequence[Mapping[str, str]]],
    pictures: Mapping[str, Picture],
) -> tuple[Answer, dict[str, Picture]]:
    """First part of the page, and the remaining pictures for its sections."""
    told, first = found["answer"], "course" if "course" in pictures else "maps"
    caption = COURSE_CAPTION if first == "course" else _map_caption(bool(found["effects"]))
    words = " ".join(text for text in (told[key] for key in WORDS) if text)
    answer = Answer(tiles(found, summary, tables["changes"]), words, pictures[first], caption)
    return answer, {name: picture for name, picture in pictures.items() if name != first}


def _map_caption(claimed: bool) -> str:
    both = "; without the finding and with it" if claimed else ""
    return MAP_CAPTION.format(both=both)


def remarks(found: Mapping[str, Any], summary: Mapping[str, Any]) -> list[str]:
    """Notes of the verdict that are not on the data."""
    known = (*summary["data_notes"], *summary["warnings"])
    return [note for note in found["notes"] if not any(line.endswith(note) for line in known)]


def _pictures(found: Mapping[str, Any], tables: Mapping[str, Sequence[Mapping[str, str]]]) -> dict[str, Figure]:
    """Pictures by name. Without a claim one fit is drawn, not the same one twice."""
    residuals, claimed = tables["residuals"], bool(found["effects"])
    held_out = {name: row for name, row in found["fit"]["heldout"].items() if all(row[key] for key in HELD_OUT)}
    shown = {row["channel"] for row in residuals} & set(found["where"]["channels"] if claimed else [])
    mine, others = ([row for row in residuals if (row["channel"] in shown) is side] for side in (True, False))
    pictures = {"maps": diagnose_plots.residual_maps(mine or others, claimed)}
    if mine and others:
        pictures["others"] = diagnose_plots.residual_maps(others, claimed)
    if courses := strongest_courses(residuals) if claimed else []:
        pictures["course"] = diagnose_plots.effect_courses(residuals, courses)
    if held_out and claimed:
        pictures["held_out"] = diagnose_plots.held_out_bars(held_out)
    if tables["hypotheses"]:
        pictures["hypotheses"] = diagnose_plots.hypothesis_bars(tables["hypotheses"])
    if tables.get("traces"):
        window, settings = found["where"]["shaft_angle_deg"], _settings(residuals)
        pictures["traces"] = trace_residuals(tables["traces"], window, settings, claimed)
    if whole := shaft_power(tables["changes"]):
        losses = [row for row in tables["changes"] if row["unit"] == "W" and row["quantity"] not in (SHAFT, HYDRAULIC)]
        pictures["losses"] = diagnose_plots.loss_bars(losses, whole)
    if claimed:
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


_SET = (("speed", "{:.0f} r/min"), ("p_out", "{:.3g} {}"), ("displacement_ratio", "stroke {:.0%}"))


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
