"""The page of a calibration: report.html made from the run folder's own files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.output.tables import Table
from swashfilm.runs.calibrate import plots as calibrate_plots
from swashfilm.runs.calibrate.answer import calibrate_answer
from swashfilm.runs.calibrate.words import (
    AS_ASSUMED,
    FRICTION,
    assumed_text,
    degree_text,
    fitted_text,
    how_far,
    is_sensor,
    parameter_words,
)
from swashfilm.runs.diagnose.files import read_rows
from system.bench.calibration.held_out import PHYSICS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TABLES = ("parameters", "undetermined", "equation_21", "hersey", "heldout", "residuals")
FILES = ("summary.json", *(f"{name}.csv" for name in TABLES))
PARAMETER_HEAD = ("parameter", "assumed before", "assumed by", "fitted", "by the recording")
STATISTICS_HEAD = ("parameter", "name in the tables", "sigma / prior sigma")
Row = Mapping[str, str]


def write_calibrate_page(folder: Path) -> Path:
    """Write report.html of a calibration; raises InputFaults where one of its files is missing."""
    summary = read_summary(folder, FILES, "a calibration's run folder")
    tables = {name: read_rows(folder / f"{name}.csv") for name in TABLES}
    pictures = {name: inlined(figure) for name, figure in _pictures(tables).items()}
    parameters = tables["parameters"]
    return write_page(
        folder,
        "calibrate",
        answer=calibrate_answer(summary, parameters, tables["residuals"], pictures.get("fit")),
        summary=summary,
        parameter_head=PARAMETER_HEAD,
        pump=[*parameter_rows(row for row in parameters if not is_sensor(row))],
        sensors=[*parameter_rows(row for row in parameters if is_sensor(row))],
        unknown=[parameter_words(row["name"]) for row in parameters if how_far(row) == AS_ASSUMED],
        undetermined=[(combination_words(row["combination"]),) for row in tables["undetermined"]],
        equation=equation_table(tables["equation_21"]),
        held_out=held_out_tables(folder),
        statistics=[*statistics(summary)],
        statistics_head=STATISTICS_HEAD,
        details=[
            (parameter_words(row["name"]), row["name"], f"{float(row['sigma_over_prior [1]']):.2f}")
            for row in parameters
        ],
        pictures=pictures,
    )


def headline(folder: Path) -> tuple[str, ...]:
    """The result in sentences: the answer, then the statistics."""
    own, parameters = read_summary(folder), read_rows(folder / "parameters.csv")
    answer = calibrate_answer(own, parameters, read_rows(folder / "residuals.csv"))
    return answer.words, *statistics(own)


def statistics(own: Mapping[str, Any]) -> Iterator[str]:
    """Yield sentences on the fit: readings, chi-square, the law of friction."""
    yield (
        f"{own['parameters']} parameters fitted to {own['readings']} readings at {own['points']} points: chi-square "
        f"per reading {own['chi2_per_reading']:.3f}."
    )
    yield f"Combinations of parameters that the data do not determine: {own['undetermined']} (undetermined.csv)."
    if (law := own["hersey"]) is not None:
        words = "support" if law["supported"] else "do not support"
        odds = f"{law['evidence_nats']:+.1f} nats in favour"
        yield f"The data {words} a friction that depends on the Hersey number: {odds}."
        if law["supported"]:
            yield f"With constant coefficients chi-square per reading is {own['chi2_constant_friction']:.3f}."


def parameter_rows(rows: Iterable[Row]) -> Iterator[tuple[str, ...]]:
    """Yield (parameter, assumed before, source of that, fitted, degree of determination), the best determined first."""
    for row in sorted(rows, key=lambda row: float(row["sigma_over_prior [1]"])):
        yield parameter_words(row["name"]), assumed_text(row), row["source"], fitted_text(row), degree_text(row)


def pair_table(folder: Path) -> list[tuple[str, ...]]:
    """The same of the friction coefficients, with a head."""
    rows = [row for row in read_rows(folder / "parameters.csv") if row["name"].startswith(FRICTION)]
    return [PARAMETER_HEAD, *parameter_rows(rows)]


def combination_words(combination: str) -> str:
    """Return a combination of parameters in words: "+0.96 x dead volume; +0.23 x bulk modulus"."""
    cells = combination.split()
    parts = [f"{weight} x {parameter_words(name)}" for weight, name in zip(cells[::2], cells[1::2], strict=True)]
    return "; ".join(parts)


def equation_table(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    """(place, points, rank, known, chi-square, ends of plain least squares) of each fit of Eq. (21), with a head."""
    head = ("where", "points", "separable", "known", "misfit", "plain least squares gives")
    found: list[tuple[str, ...]] = [head]
    for place in dict.fromkeys((row["speed [rpm]"], row["displacement_ratio [1]"]) for row in rows):
        own = [row for row in rows if (row["speed [rpm]"], row["displacement_ratio [1]"]) == place]
        printed = [float(row["as_printed [1]"]) for row in own]
        where = f"{float(place[0]):.0f} rpm, displacement {float(place[1]):.3g}" if place[0] else "the whole map"
        ends = f"{min(printed):.3g} to {max(printed):.3g}"
        misfit = f"{float(own[0]['chi2_per_point [1]']):.2f}"
        found.append((where, own[0]["points"], f"{own[0]['rank']} of {len(own)}", own[0]["known"], misfit, ends))
    return found


def held_out_tables(folder: Path) -> list[Table]:
    """RMS errors by model, a table for each channel with a column for each split; unit and noise in its title."""
    rows = read_rows(folder / "heldout.csv")
    found: list[Table] = []
    for channel in dict.fromkeys(row["channel"] for row in rows):
        own = [row for row in rows if row["channel"] == channel]
        splits = list(dict.fromkeys(row["left_out"] for row in own))
        head = ("model", "coefficients", *("fitted to all" if one == "none" else f"{one}s left out" for one in splits))
        lines = [head]
        for model in dict.fromkeys(row["model"] for row in own):
            cells = {row["left_out"]: row for row in own if row["model"] == model}
            count = next(iter(cells.values()))["coefficients"]
            name = "this pump" if model == PHYSICS else model.replace("_", " ")
            lines.append((name, count, *(f"{float(cells[one]['rms']):.3g}" for one in splits)))
        words = f"{channel} [{own[0]['unit']}]; scatter of the meter {float(own[0]['noise']):.2g}"
        found.append((f"Error of models, rms, {words}", lines))
    return found


def _pictures(tables: Mapping[str, Sequence[Row]]) -> dict[str, Figure]:
    """Figures by name."""
    pictures = {"fit": calibrate_plots.fit_and_readings(tables["residuals"])} if tables["residuals"] else {}
    pictures["hersey"] = calibrate_plots.friction_curves(tables["hersey"])
    if tables["equation_21"]:
        pictures["coefficients"] = calibrate_plots.coefficients_over_displacement(tables["equation_21"])
    if tables["heldout"]:
        pictures["held_out"] = calibrate_plots.held_out_models(tables["heldout"])
    return pictures
