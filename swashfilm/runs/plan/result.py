"""Result of a plan."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.result import Result, plotted, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.plan import rows
from swashfilm.runs.plan.files import POINTS
from swashfilm.runs.plan.plots import apart_plot, points_plot

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

MOST = 12
"""Rows of a table on the terminal."""


class PlanRun(Result):
    """A planned test: the separated suspects, the points to drive, further meters."""

    kinds: ClassVar[tuple[str, ...]] = ("plan",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", POINTS)

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return the points to drive."""
        return read_table(folder / POINTS)

    def tables(self) -> list[Table]:
        """Return counts, added points, further meters, and pairs never separated."""
        summary = self.summary
        added = [row for row, one in zip(rows.point_rows(summary), summary["points"], strict=True) if one["for"]]
        tables: list[Table] = [(f"Plan of a test of {self.name}", list(rows.count_rows(summary)))]
        if added:
            tables.append(("Points to add", [rows.point_head(), *added[:MOST]]))
        if summary["further"]:
            tables.append(("Further meters", [rows.FURTHER_HEAD[:2], *(one[:2] for one in rows.further_rows(summary))]))
        if never := list(rows.never_rows(summary)):
            tables.append(("Never told apart", [rows.NEVER_HEAD, *never[:MOST]]))
        return tables

    def plot_apart(self) -> list[Axes]:
        """Draw the distance of every two suspects."""
        return plotted(lambda: apart_plot(self.summary))

    def plot_points(self) -> list[Axes]:
        """Draw the points over speed and pressure."""
        return plotted(lambda: points_plot(self.summary))
