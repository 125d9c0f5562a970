"""Page of one film: report.html with picture and numbers, from the files of the run folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swashfilm.output.answer import Answer
from swashfilm.output.data.files import read_columns, read_netcdf
from swashfilm.output.figures import figure_of
from swashfilm.output.headline import named, number_text, numbers_text, shown_of, summary_scales, titled_key
from swashfilm.output.page import inlined, kept_text, read_summary, write_page
from swashfilm.output.refinement import refinement_head, refinement_rows
from swashfilm.runs.film.answer import film_tiles, film_words
from swashfilm.runs.film.fields.history import last_of
from swashfilm.runs.film.fields.maps import film_figure, film_relief, surface_figure
from swashfilm.runs.film.fields.sections import section_figure, section_words, sections
from swashfilm.runs.film.sensitivity import sensitivity_figure, sensitivity_rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CAPTION = "Maps of the film over its plane; pressures are gauge"
HISTORY = ("bearing_load_N", "load_N", "pressure_max_Pa", "film_thickness_min_m", "temperature_max_K")


def write_film_page(folder: Path) -> Path:
    """Write report.html of a film's run folder from its summary.json, resolved.toml and results.nc.

    The page is self-contained. Raises InputFaults where one of the three files is missing.
    """
    summary = read_summary(folder, ("summary.json", "resolved.toml", "results.nc"), "a film's run folder")
    fields = last_of(read_netcdf(folder / "results.nc"))
    picture, costs, cuts = inlined(film_figure(fields)), sensitivity_figure(fields), sections(fields)
    return write_page(
        folder,
        "film",
        answer=Answer(tuple(film_tiles(summary)), film_words(summary), picture, CAPTION),
        name=summary["name"],
        surface=inlined(surface_figure(fields), film_relief(fields)),
        sections=inlined(section_figure(cuts)),
        cuts=section_words(cuts),
        of_gap="required_load_N" in summary,
        sensitivity=sensitivity_rows(summary),
        kept=summary.get("sensitivity", {}).get("kept", ""),
        costs=None if costs is None else inlined(costs),
        history=inlined(history_picture(history)) if (history := folder / "history.csv").is_file() else None,
        rows=list(summary_rows(summary)),
        warnings=summary["warnings"],
        assumptions=summary.get("assumptions", []),
        refinement=[refinement_head(found), *refinement_rows(found)] if (found := summary.get("refinement")) else [],
        in_time="time_steps" in summary,
        case=kept_text(folder, "resolved.toml"),
    )


def summary_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (name, value with its unit) of every number of a film's summary, in its order."""
    scales = summary_scales(summary)
    for key, value in summary.items():
        if key in ("format", "kind", "name", "warnings", "refinement", "assumptions", "scale", "sensitivity"):
            continue
        words = named(key)[0]
        if value is None:
            yield words, "none"
        elif isinstance(value, dict):
            for part, number in value.items():
                yield f"{words}, {part}", number_text(key, number, scales)
        elif isinstance(value, list):
            yield words, numbers_text(key, value, scales)
        elif isinstance(value, float):
            yield words, number_text(key, value, scales)
        else:
            yield words, f"{value} {named(key)[1]}".strip()


def history_picture(history: Path) -> Figure:
    """Draw load, largest pressure, least film and temperature (if any) over time, from history.csv."""
    steps = read_columns(history)
    shown = [key for key in HISTORY if named(key)[0] in steps]
    if "bearing_load_N" in shown and "load_N" in shown:  # of an earlier version: the integral of the unrolled plane
        shown.remove("load_N")
    figure = figure_of(8.0, 2.2 * len(shown))
    for axes, key in zip(figure.subplots(len(shown), 1, sharex=True), shown, strict=True):
        axes.plot(steps["time"], shown_of(key).of(steps[named(key)[0]]))
        axes.set_ylabel(titled_key(key))
        axes.grid(visible=True, alpha=0.3)
    axes.set_xlabel("time [s]")
    return figure
