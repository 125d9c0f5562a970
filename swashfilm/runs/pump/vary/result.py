"""Result of a pump over ranges of its keys: numbers, tables, plots; its run folder."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from swashfilm.output.headline import named, shown_of
from swashfilm.output.tables import Table
from swashfilm.runs.film.series.answer import PUMP_STUDY
from swashfilm.runs.film.series.page import failed_rows, write_study
from swashfilm.runs.film.series.plots import value_text
from swashfilm.runs.film.series.points import StudyWork, run_points
from swashfilm.runs.film.series.result import StudyRun
from swashfilm.runs.pump.vary.points import PumpStudy, pump_digest, solved_point
from system.inputs.shown import significant, titled
from system.pump.bench import EFFICIENCIES
from system.work.progress import Report

if TYPE_CHECKING:
    import xarray

SHOWN = ("delivery_flow_m3_per_s", "drain_flow_m3_per_s", "shaft_torque_Nm", "loss_W")
LEAST = "film_thickness_min_m."
MOST_ROWS = 60


class VariedRun(StudyRun):
    """A pump over ranges of keys of its file: every headline number of every point, SI."""

    kinds: ClassVar[tuple[str, ...]] = (PUMP_STUDY,)

    def tables(self) -> list[Table]:
        """Return the headline numbers of the points, the first ones of many, and points without a result."""
        summary, data = self.summary, self.to_xarray()
        rows = list(point_rows(data, list(summary["axes"])))
        title = f"{self.name}: {summary['solved']} of {summary['points']} points"
        if len(rows) > MOST_ROWS + 1:
            title += f", the first {MOST_ROWS}"
        title += "; efficiencies by ISO 4409"
        tables: list[Table] = [(title, rows[: MOST_ROWS + 1])]
        if summary["failed"]:
            tables.append(("Points without a result", list(failed_rows(summary))))
        return tables


def point_rows(data: xarray.Dataset, axes: list[dict[str, Any]]) -> Iterator[tuple[str, ...]]:
    """Yield the head, then the values of the keys and the headline numbers of each point."""
    keys = [axis["key"] for axis in axes]
    least = [str(name) for name in data.data_vars if str(name).startswith(LEAST)]
    numbers = [key for key in SHOWN if key in data]
    parts = [part for part in EFFICIENCIES if f"{part}_efficiency" in data]
    film = ("least film [um]",) if least else ()
    heads = (titled(named(key)[0], shown_of(key).unit) for key in numbers)
    yield (*keys, *heads, *(f"{part} efficiency [%]" for part in parts), *film)
    for index in np.ndindex(*(data.sizes[key] for key in keys)):
        at = dict(zip(keys, index, strict=True))
        one = data.isel(at)
        places = (value_text(data, key, k) for key, k in at.items())
        values = (shown_of(key).of(float(one[key])) for key in numbers)
        efficiencies = (100.0 * float(one[f"{part}_efficiency"]) for part in parts)
        thinnest = (1e6 * min(float(one[name]) for name in least),) if least else ()
        yield (*places, *(_text(value) for value in (*values, *efficiencies, *thinnest)))


def _text(value: float) -> str:
    return significant(value) if np.isfinite(value) else "-"


def run_varied(
    study: PumpStudy, folder: Path, report: Report, *, resumed: Path | None = None, workers: int = 1
) -> dict[str, Any]:
    """Solve a pump over its keys and write input.toml, points/, study.csv, study.nc, summary.json, report.html.

    Returns the summary. Raises InputFaults as `run_points`; the tables list points that fail.
    """
    work = StudyWork(study, pump_digest, solved_point)
    return write_study(study, run_points(work, folder, report, resumed=resumed, workers=workers), folder, PUMP_STUDY)
