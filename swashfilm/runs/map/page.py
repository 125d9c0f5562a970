"""Page of an operating map: report.html from the files of the run folder."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swashfilm.output.page import keep_pictures, read_summary, write_page
from swashfilm.runs.map.explorer import map_explorer
from swashfilm.runs.map.files import MAP, read_map
from swashfilm.runs.map.film_plots import film_plots
from swashfilm.runs.map.plots import map_plots

FILES = ("summary.json", "resolved.toml", MAP)
CM3 = 1e6
BEST_HEAD = ("definition", "overall efficiency", "at", "overall, volumetric")
DISPLACEMENT_HEAD = ("displacement ratio", "geometric", "swept", "by Toet (ISO 8426-1)")
ERROR_HEAD = ("number", "rms", "largest", "relative to the map's largest")
_SHOWN = {"W": (1e-3, "kW"), "Nm": (1.0, "N m"), "m3_per_s": (6e4, "L/min")}


def write_map_page(folder: Path) -> Path:
    """Write report.html and plots/ of a map's folder; raise InputFaults where one of its files is missing."""
    summary = read_summary(folder, FILES, "a map's run folder")
    data = read_map(folder / MAP)[0]
    pictures = map_plots(data) | film_plots(data) if summary["solved"] else {}
    explorer = map_explorer(data) if pictures else None
    explorers = {} if explorer is None else {next(iter(pictures)): explorer}
    return write_page(
        folder,
        "map",
        summary=summary,
        axes=list(axis_rows(summary)),
        best=list(best_rows(summary)),
        best_head=BEST_HEAD,
        displacement=list(displacement_rows(summary)),
        displacement_head=DISPLACEMENT_HEAD,
        errors=list(error_rows(summary)),
        error_head=ERROR_HEAD,
        table_errors=[(name, f"{100.0 * error:.3g} %") for name, error in (summary["table_error"] or {}).items()],
        failed=list(failed_rows(summary)),
        pictures=keep_pictures(folder, "map", pictures, explorers),
        resolved=(folder / "resolved.toml").read_text("utf-8"),
    )


def axis_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (name, value): axes, numbers of solved, kept and failed points, and computing time."""
    for axis in summary["axes"]:
        yield axis["words"], axis["levels"]
    failed = len(summary["failed"])
    counts = f"{summary['solved']} of {summary['points']} solved" + (f", {failed} failed" if failed else "")
    yield "points", counts + (f", {summary['kept']} of them kept from before" if summary["kept"] else "")
    if summary["loss"]:
        loss = summary["loss"]
        yield "loss (shaft power minus p Q)", f"{loss['least_W'] * 1e-3:.3g} .. {loss['largest_W'] * 1e-3:.4g} kW"
    yield "largest energy balance error", f"{100.0 * summary['energy_balance_error_max']:.2g} % of the shaft power"
    if summary["seconds_a_point"] is not None:
        one = f"{summary['seconds_a_point']:.2g} s of processor time per point"
        yield "computing time", f"{one}, {summary['wall_s']:.3g} s in total with {summary['workers']} at a time"


def best_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (definition, efficiency, point, formula) of each best point."""
    for best in summary["best"]:
        yield best["label"], f"{100.0 * best['overall']:.2f} %", best["at"], best["formula"]


def displacement_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (setting, geometric, swept, by Toet) in cm3 per revolution."""
    for row in summary["displacement"]:
        toet, sigma = row["toet_m3_per_rev"], row["toet_sigma_m3_per_rev"]
        by_toet = "void" if toet is None else f"{toet * CM3:.3f}" + (f" +- {sigma * CM3:.2g}" if sigma else "")
        yield (
            row["at"],
            *(f"{row[name] * CM3:.3f} cm3/rev" for name in ("geometric_m3_per_rev", "swept_m3_per_rev")),
            f"{by_toet} cm3/rev" if toet is not None else by_toet,
        )


def error_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (number, rms, largest, relative to the map's largest) of the error between levels."""
    found = summary["interpolation"]
    for key, row in (found["numbers"] if found else {}).items():
        name, unit = next((key.removesuffix(f"_{end}"), end) for end in _SHOWN if key.endswith(f"_{end}"))
        scale, shown = _SHOWN[unit]
        errors = (f"{row[kind] * scale:.3g} {shown}" for kind in ("rms", "largest"))
        yield name.replace("_", " "), *errors, f"{100.0 * row['largest'] / row['of']:.2g} %"


def failed_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (point, state, reason) of every point without a result."""
    for point in summary["failed"]:
        yield point["at"], point["status"], point["reason"]
