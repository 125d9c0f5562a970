"""Result of a sensitivity."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.result import Result, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.variation.sensitivity import rows
from swashfilm.runs.variation.sensitivity.files import DATA
from swashfilm.runs.variation.sensitivity.plots import cost_plot, tolerance_plot

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


class SensitivityRun(Result):
    """Derivatives of a pump's numbers by every dimension."""

    kinds: ClassVar[tuple[str, ...]] = ("sensitivity",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", DATA)

    def tables(self) -> list[Table]:
        """Return the pump as stated, the costliest dimensions, and those without a number."""
        summary = self.summary
        costs = rows.first_rows(list(rows.cost_rows(summary)))
        tables: list[Table] = [
            (f"Sensitivity of {self.name}, {summary['at']}", list(rows.middle_rows(summary))),
            ("Cost of each dimension, the dearest first", [rows.COST_HEAD, *costs]),
        ]
        for title, found in (
            ("Not smooth here: no derivative", list(rows.rough_rows(summary))),
            ("Differences on one side, by the geometry", list(rows.side_rows(summary))),
            ("Without a derivative", list(rows.refused_rows(summary))),
        ):
            if found:
                tables.append((title, found))
        return tables

    def to_pandas(self) -> pandas.DataFrame:
        """Return one row per dimension, the derivatives of the measures as columns, SI per SI."""
        return self.to_xarray()["derivative"].to_pandas()

    def plot_costs(self) -> list[Axes]:
        """Draw the cost of one um, one deg and one per cent."""
        return plotted(lambda: cost_plot(self.summary))

    def plot_tolerances(self) -> list[Axes]:
        """Draw the cost of one standard deviation of each stated tolerance."""
        return plotted(lambda: tolerance_plot(self.summary))
