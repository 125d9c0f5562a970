"""Result of a tolerance."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.result import Result, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.tolerance import rows
from swashfilm.runs.tolerance.files import DATA
from swashfilm.runs.tolerance.plots import scatter_plot, share_plot
from system.variation.measures import EFFICIENCY, MEASURES

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


class ToleranceRun(Result):
    """Scatter of a series of pumps by the tolerances of their drawing."""

    kinds: ClassVar[tuple[str, ...]] = ("tolerance",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", DATA)

    def tables(self) -> list[Table]:
        """Return counts, scatter, shares in the efficiency, limits."""
        summary = self.summary
        words = MEASURES[EFFICIENCY].words
        tables: list[Table] = [
            (f"Tolerances of {self.name}, {summary['at']}", list(rows.count_rows(summary))),
            ("Scatter of the series", [rows.SCATTER_HEAD, *rows.scatter_rows(summary)]),
            (f"Shares in the {words}", [rows.SHARE_HEAD, *rows.share_rows(summary, EFFICIENCY)]),
        ]
        if summary["limits"]:
            tables.append(("Limits", [rows.LIMIT_HEAD, *rows.limit_rows(summary)]))
        return tables

    def to_pandas(self) -> pandas.DataFrame:
        """Return one row per pump: its dimensions and its numbers, SI."""
        data = self.to_xarray()
        return data["dimension"].to_pandas().join(data["value"].to_pandas())

    def plot_scatter(self) -> list[Axes]:
        """Draw histograms of efficiency, case drain and loss."""
        return plotted(lambda: scatter_plot(self.summary, self.to_xarray()))

    def plot_shares(self) -> list[Axes]:
        """Draw the shares of the dimensions."""
        return plotted(lambda: share_plot(self.summary))
