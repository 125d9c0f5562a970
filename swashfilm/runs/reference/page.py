"""Page of `swashfilm reference`: report.html from the files of the run folder."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.runs.reference.plots import coefficient_plot

HEAD = (
    "passage", "Re", "extra length / h", "loss factor", "flow coefficient", "drop / drop by film equation",
    "mesh error",
)  # fmt: skip


def write_reference_page(folder: Path) -> Path:
    """Write report.html of a run folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, ("summary.json", "input.toml"), "a reference's run folder")
    flows = [inlined(path.read_bytes()) for path in sorted(folder.glob("flow_*.png"))]
    return write_page(
        folder,
        "reference",
        summary=summary,
        head=HEAD,
        rows=list(reference_rows(summary)),
        coefficients=(folder / summary["table"]).read_text("utf-8"),
        pictures=[inlined(coefficient_plot(summary)), *flows],
        given=(folder / "input.toml").read_text("utf-8"),
    )


def reference_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of HEAD as text."""
    for passage in summary["passages"]:
        for row in passage["rows"]:
            over, coefficient = row["pressure_drop_over_film_equation"], row["flow_coefficient"]
            yield (
                passage["words"],
                f"{row['reynolds']:g}",
                f"{passage['extra_length']:.4g}",
                f"{row['loss_factor']:.3g}",
                "-" if coefficient is None else f"{coefficient:.4f}",
                "-" if over is None else f"{over:.3f}",
                f"{100.0 * row['mesh_error']:.2g} %",
            )
