"""Page of `swashfilm reference`: report.html from the files of the run folder."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swashfilm.output.answer import Answer
from swashfilm.output.page import inlined, kept_text, read_summary, write_page
from swashfilm.runs.reference.answer import reference_tiles, reference_words
from swashfilm.runs.reference.plots import coefficient_plot

HEAD = (
    "passage", "Re", "extra length / h", "loss factor", "flow coefficient", "drop / drop by film equation",
    "mesh error",
)  # fmt: skip
NONE = "-"
FLOW, COURSE = "Speed and stream lines at the last Reynolds number", "Coefficients over the Reynolds number"


def write_reference_page(folder: Path) -> Path:
    """Write report.html of a run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, ("summary.json", "input.toml"), "a reference's run folder")
    flows = [inlined(path.read_bytes()) for path in sorted(folder.glob("flow_*.png"))]
    picture = flows[0] if flows else inlined(coefficient_plot(summary))
    rows = list(reference_rows(summary))
    told = [k for k in range(len(HEAD)) if any(row[k] != NONE for row in rows)]
    return write_page(
        folder,
        "reference",
        answer=Answer(tuple(reference_tiles(summary)), reference_words(summary), picture, FLOW if flows else COURSE),
        summary=summary,
        head=[HEAD[k] for k in told],
        rows=[[row[k] for k in told] for row in rows],
        coefficients=kept_text(folder, summary["table"]),
        pictures=[(inlined(coefficient_plot(summary)), COURSE), *((flow, FLOW) for flow in flows[1:])],
        given=kept_text(folder, "input.toml"),
    )


def reference_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of HEAD as text; the passage stands in its first row."""
    for passage in summary["passages"]:
        for k, row in enumerate(passage["rows"]):
            over, coefficient = row["pressure_drop_over_film_equation"], row["flow_coefficient"]
            yield (
                "" if k else passage["words"],
                f"{row['reynolds']:g}",
                f"{passage['extra_length']:.4g}",
                f"{row['loss_factor']:.3g}",
                NONE if coefficient is None else f"{coefficient:.4f}",
                NONE if over is None else f"{over:.3f}",
                f"{100.0 * row['mesh_error']:.2g} %",
            )
