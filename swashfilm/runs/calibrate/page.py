"""The page of a calibration: report.html made from the run folder's own files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.runs.calibrate import plots as calibrate_plots
from swashfilm.runs.diagnose.files import read_rows
from system.bench.calibration.held_out import PHYSICS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TABLES = ("parameters", "undetermined", "equation_21", "hersey", "heldout", "residuals")
FILES = ("summary.json", *(f"{name}.csv" for name in TABLES))
Row = Mapping[str, str]


def write_calibrate_page(folder: Path) -> Path:
    """Write report.html of a calibration; raises InputFaults where one of its files is not there."""
    summary = read_summary(folder, FILES, "a calibration's run folder")
    tables = {name: read_rows(folder / f"{name}.csv") for name in TABLES}
    pictures = {name: inlined(png) for name, png in _pictures(tables).items()}
    return write_page(
        folder,
        "calibrate",
        summary=summary,
        sentences=headline(folder),
        pairs=pair_table(folder),
        undetermined=[tuple(row.values()) for row in tables["undetermined"]],
        equation=equation_table(tables["equation_21"]),
        held_out=held_out_table(folder),
        parameters=[_parameter(row) for row in tables["parameters"]],
        pictures=pictures,
    )


def headline(folder: Path) -> tuple[str, ...]:
    """The result in sentences."""
    own = read_summary(folder)
    sentences = [
        f"{own['parameters']} parameters fitted to {own['readings']} readings at {own['points']} points: "
        f"chi-square per reading {own['chi2_per_reading']:.3f}.",
        f"combinations of parameters that the data do not determine: {own['undetermined']} (undetermined.csv).",
    ]
    law = own["hersey"]
    if law is not None:
        odds = f"{law['evidence_nats']:+.1f} nats in favour"
        words = "the data support" if law["supported"] else "the data do not support"
        sentences.append(f"{words} a friction that depends on the Hersey number: {odds}.")
        if law["supported"]:
            constant = f"{own['chi2_constant_friction']:.3f}"
            sentences.append(f"with constant coefficients chi-square per reading is {constant}.")
    for row in read_rows(folder / "parameters.csv"):
        if row["at_bound"] == "yes" and float(row["mean"]) != 0.0:  # what may only add is often 0
            sentences.append(
                f"parameter {row['name']} is at its bound, {row['mean']} {row['unit']}".removesuffix(" 1") + "."
            )
    return tuple(text[0].upper() + text[1:] for text in sentences)


def pair_table(folder: Path) -> list[tuple[str, ...]]:
    """(pair, prior, fitted, sigma / prior sigma) of the friction coefficients, with a head."""
    rows = [row for row in read_rows(folder / "parameters.csv") if row["name"].startswith("friction.")]
    return [
        ("pair", "prior", "one sigma of the prior", "fitted", "sigma / prior sigma"),
        *(
            (
                row["name"].removeprefix("friction.").replace("_", " "),
                f"{float(row['prior']):.4g}",
                f"{float(row['prior_low']):.3g} to {float(row['prior_high']):.3g}",
                f"{float(row['mean']):.4g} +- {float(row['sigma']):.2g}",
                f"{float(row['sigma_over_prior [1]']):.2f}",
            )
            for row in rows
        ),
    ]


def equation_table(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    """(place, points, rank, known, chi-square, as printed) of each fit of Eq. (21), with a head."""
    head = ("where", "points", "rank", "known", "chi-square per point", "as printed: condition", "from, to")
    found: list[tuple[str, ...]] = [head]
    for place in dict.fromkeys((row["speed [rpm]"], row["displacement_ratio [1]"]) for row in rows):
        own = [row for row in rows if (row["speed [rpm]"], row["displacement_ratio [1]"]) == place]
        printed = [float(row["as_printed [1]"]) for row in own]
        where = f"{float(place[0]):.0f} rpm, displacement {float(place[1]):.3g}" if place[0] else "the whole map"
        ends = f"{min(printed):.3g} to {max(printed):.3g}"
        chi2 = f"{float(own[0]['chi2_per_point [1]']):.2f}"
        rank = f"{own[0]['rank']} of {len(own)}"
        found.append((where, own[0]["points"], rank, own[0]["known"], chi2, own[0]["condition [1]"], ends))
    return found


def held_out_table(folder: Path) -> list[tuple[str, ...]]:
    """RMS by model, a column for each channel and split, with a head that names units and noise."""
    rows = read_rows(folder / "heldout.csv")
    cells = list(dict.fromkeys((row["channel"], row["left_out"]) for row in rows))
    head = ["model", "coefficients"]
    for channel, split in cells:
        one = next(row for row in rows if (row["channel"], row["left_out"]) == (channel, split))
        how = "fitted" if split == "none" else f"{split} held out"
        head.append(f"{channel} [{one['unit']}], {how}")
    found = [tuple(head)]
    for model in dict.fromkeys(row["model"] for row in rows):
        own = {(row["channel"], row["left_out"]): row for row in rows if row["model"] == model}
        counts = dict.fromkeys(row["coefficients"] for row in own.values())
        counted = "" if model == PHYSICS else " + ".join(counts)
        found.append((model.replace("_", " "), counted, *(f"{float(own[cell]['rms']):.3g}" for cell in cells)))
    return found


def _parameter(row: Row) -> tuple[str, ...]:
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return (
        row["name"],
        f"{row['prior_low']} to {row['prior_high']}{unit}",
        f"{row['mean']} +- {float(row['sigma']):.2g}{unit}",
        f"{float(row['sigma_over_prior [1]']):.2f}",
        row["source"],
    )


def _pictures(tables: Mapping[str, Sequence[Row]]) -> dict[str, Figure]:
    """PNGs by name."""
    pictures = {"hersey": calibrate_plots.friction_curves(tables["hersey"])}
    if tables["equation_21"]:
        pictures["coefficients"] = calibrate_plots.coefficients_over_displacement(tables["equation_21"])
    if tables["heldout"]:
        pictures["held_out"] = calibrate_plots.held_out_models(tables["heldout"])
    return pictures
