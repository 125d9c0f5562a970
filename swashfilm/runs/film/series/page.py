"""Run folder of a study: its run, tables, plots and page."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from reynolds.numerics.files import write_whole
from swashfilm.case.axis import place_words
from swashfilm.case.study import Study, StudyCase
from swashfilm.output.answer import Answer
from swashfilm.output.data.files import read_netcdf, write_netcdf
from swashfilm.output.figures import png_of
from swashfilm.output.headline import named, number_text, summary_scales
from swashfilm.output.page import PLOTS, inlined, kept_text, read_summary, write_page
from swashfilm.output.run_folder import write_json
from swashfilm.runs.film.series.answer import axes_of, main_spans, study_tiles, study_words
from swashfilm.runs.film.series.courses import course_plots
from swashfilm.runs.film.series.data import FILM_STUDY, study_dataset, study_summary, write_study_table
from swashfilm.runs.film.series.films import solved_summary, study_digest
from swashfilm.runs.film.series.plots import COURSES, study_plots
from swashfilm.runs.film.series.points import StudyOutcome, StudyWork, run_points
from system.work.progress import Report


def run_study(
    study: StudyCase, folder: Path, report: Report, *, resumed: Path | None = None, workers: int = 1
) -> dict[str, Any]:
    """Run a study and write input.toml, points/, study.csv, study.nc, summary.json, plots/ and report.html.

    Returns the summary. Raises InputFaults as `run_points`; the tables list points that fail.
    """
    work = StudyWork(study, study_digest, solved_summary)
    outcomes = run_points(work, folder, report, resumed=resumed, workers=workers)
    return write_study(study, outcomes, folder, FILM_STUDY)


def write_study(study: Study[Any], outcomes: Sequence[StudyOutcome], folder: Path, kind: str) -> dict[str, Any]:
    """Write the files of a study of this kind, without points/, from its points; return the summary."""
    (folder / "input.toml").write_text(study.text, encoding="utf-8")
    write_study_table(folder / "study.csv", study, outcomes)
    write_netcdf(study_dataset(study, outcomes, kind), folder / "study.nc", kind)
    summary = study_summary(study, outcomes, kind)
    write_json(folder / "summary.json", summary)
    write_study_page(folder)
    return summary


def write_study_page(folder: Path) -> Path:
    """Write report.html and plots/ of a study's run folder from its summary.json, study.nc and input.toml."""
    summary = read_summary(folder, ("summary.json", "study.nc", "input.toml"), "a study's run folder")
    data = read_netcdf(folder / "study.nc")
    figures = study_plots(data) | course_plots(data)
    (folder / PLOTS).mkdir(exist_ok=True)
    for key, figure in figures.items():
        write_whole(folder / PLOTS / f"{key}.png", png_of(figure))
    first = first_picture(summary, figures)
    picture = inlined(figures[first]) if first else None
    return write_page(
        folder,
        "study",
        answer=Answer(tuple(study_tiles(summary)), study_words(summary), picture, caption(first) if first else ""),
        name=summary["name"],
        warnings=summary["warnings"],
        pictures={caption(key): inlined(figure) for key, figure in figures.items() if key != first},
        rows=list(span_rows(summary)),
        failed=list(failed_rows(summary)),
        case=kept_text(folder, "input.toml"),
        summary=summary,
    )


def first_picture(summary: Mapping[str, Any], keys: Iterable[str]) -> str | None:
    """Return the key of the answer's picture: the Stribeck curve, or the first main number that varies."""
    known = list(keys)
    wanted = ["stribeck", *(key for key, _ in main_spans(summary)), *known]
    return next((key for key in wanted if key in known), None)


def caption(key: str) -> str:
    """Return the name of a picture in words."""
    if key == "stribeck":
        return "Stribeck curve: friction coefficient over the Hersey number"
    words = named(key.removeprefix(COURSES))[0]
    return f"{words} over the revolution" if key.startswith(COURSES) else words


def span_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (number, least with its unit, point, largest, point) of every number of a study."""
    largest = {key: max(abs(span["min"]), abs(span["max"])) for key, span in summary["numbers"].items()}
    scales, axes = summary_scales(largest), axes_of(summary)
    for key, span in summary["numbers"].items():
        yield (
            named(key)[0],
            *(
                text
                for end in ("min", "max")
                for text in (number_text(key, span[end], scales), place_words(axes, span[f"{end}_at"]))
            ),
        )


def failed_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (point, state, reason) of every point without a result."""
    axes = axes_of(summary)
    for point in summary["failed"]:
        yield place_words(axes, point["values"]), point["status"], point["reason"]
