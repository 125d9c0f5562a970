"""Result of a Navier-Stokes reference."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.page import read_summary
from swashfilm.output.result import Result, plotted, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.reference.page import HEAD, reference_rows
from swashfilm.runs.reference.plots import coefficient_plot

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes


class ReferenceRun(Result):
    """Coefficients of bores, slots, steps or grooves from the Navier-Stokes equations on the section."""

    kinds: ClassVar[tuple[str, ...]] = ("reference",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", "input.toml")

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return the table of coefficients of a run folder."""
        return read_table(folder / read_summary(folder)["table"])

    def tables(self) -> list[Table]:
        """Return coefficients by Reynolds number."""
        title = f"Reference {self.name}: {self.summary['holds_for']}"
        return [(title, [HEAD, *reference_rows(self.summary)])]

    def plot_coefficients(self) -> list[Axes]:
        """Draw flow coefficient or loss factor over the Reynolds number."""
        return plotted(lambda: coefficient_plot(self.summary))
