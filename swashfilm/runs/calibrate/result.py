"""A calibration as a result: sentences, tables, plots."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.result import Result, plotted, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.calibrate import plots
from swashfilm.runs.calibrate.page import FILES, headline, held_out_tables, pair_table
from swashfilm.runs.diagnose.files import read_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray
    from matplotlib.axes import Axes


class CalibrationRun(Result):
    """Coefficients of a pump by a recording: values with sigmas, friction over the Hersey number, models."""

    kinds: ClassVar[tuple[str, ...]] = ("calibration",)
    files: ClassVar[tuple[str, ...]] = FILES
    paragraphs: tuple[str, ...]
    _tables: list[Table]
    _hersey: Sequence[dict[str, str]]

    @classmethod
    def opened(cls, folder: Path) -> CalibrationRun:
        """The calibration of a run folder; raises InputFaults where one of its files is missing."""
        found = super().opened(folder)
        found.paragraphs = headline(folder)
        found._hersey = read_rows(folder / "hersey.csv")
        found._tables = [("Friction coefficients", pair_table(folder)), *held_out_tables(folder)]
        return found

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """parameters.csv of a run folder."""
        return read_table(folder / "parameters.csv")

    def tables(self) -> list[Table]:
        """Friction coefficients, and errors of models at held-out levels."""
        return self._tables

    def __repr__(self) -> str:
        return "\n".join([*self.paragraphs, super().__repr__()])

    def plot_friction(self) -> list[Axes]:
        """Friction coefficients over the Hersey number."""
        return plotted(lambda: plots.friction_curves(self._hersey))
