"""Page of a gap over the turn: report.html from the files of the run folder."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swashfilm.case.gap.physics import PHYSICS_HEAD, effect_rows
from swashfilm.output.answer import Answer
from swashfilm.output.data.files import read_netcdf
from swashfilm.output.data.gap_names import TITLES
from swashfilm.output.page import inlined, kept_text, read_summary, write_page
from swashfilm.output.refinement import refinement_head, refinement_rows
from swashfilm.output.tables import read_csv
from swashfilm.runs.film.page import summary_rows
from swashfilm.runs.film.revolution.answer import revolution_tiles, revolution_words
from swashfilm.runs.film.revolution.explorer import revolution_explorer
from swashfilm.runs.film.revolution.plots import revolution_plots
from swashfilm.runs.film.revolution.validity import LARGEST_STEP_ERROR
from system.description.gap import Gap

ANIMATION = "animation.gif"
CAPTION = (
    "Film and pressure over the shaft angle, the least film with its place, and the limits of the film: where it is "
    "full, cavitates or touches"
)
FILES = ("summary.json", "resolved.toml", "results.nc", "convergence.csv")
_LISTS = ("assumptions", "physics_left_out", "physics_seconds", "gap")


def write_revolution_page(folder: Path) -> Path:
    """Write report.html from summary.json, resolved.toml, results.nc and convergence.csv of a run folder.

    The page is self-contained. Raises InputFaults where one of the four files is missing.
    """
    summary = read_summary(folder, FILES, "a film's run folder")
    data = read_netcdf(folder / "results.nc")
    figures, explorers = revolution_plots(data), {"maps": revolution_explorer(data)}
    refinement = summary.get("refinement")
    return write_page(
        folder,
        "revolution",
        answer=Answer(
            tuple(revolution_tiles(summary)), revolution_words(summary), inlined(figures.pop("film")), CAPTION
        ),
        animation=inlined(moving.read_bytes()) if (moving := folder / ANIMATION).is_file() else "",
        step_limit=LARGEST_STEP_ERROR,
        summary=summary,
        gap=TITLES[Gap(summary["gap"]).value],
        pictures={name: inlined(figure, explorers.get(name)) for name, figure in figures.items()},
        rows=list(revolution_rows(summary)),
        physics=[PHYSICS_HEAD, *effect_rows(summary["physics_left_out"], summary["physics_seconds"])],
        refinement=[refinement_head(refinement), *refinement_rows(refinement)] if refinement else [],
        convergence=read_csv(folder / "convergence.csv"),
        case=kept_text(folder, "resolved.toml"),
    )


def revolution_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (name, value with its unit) of every number of a turn's summary."""
    return summary_rows({key: value for key, value in summary.items() if key not in _LISTS})
