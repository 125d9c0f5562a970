"""Result of a transient of displacement: numbers, tables, plots."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.result import Result, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.transient import plots
from swashfilm.runs.transient.page import FILES, transient_rows, turn_rows

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class TransientRun(Result):
    """Displacement in time: swash angle, moments, chamber pressures, flows; SI."""

    kinds: ClassVar[tuple[str, ...]] = ("transient",)
    files: ClassVar[tuple[str, ...]] = FILES

    def tables(self) -> list[Table]:
        """Return the plate's motion, means over the first and the last turn, assumptions."""
        tables: list[Table] = [
            (f"Transient {self.name}", transient_rows(self.summary)),
            ("Means over a turn", [("", "the first", "the last"), *turn_rows(self.summary)]),
        ]
        if assumed := self.summary["assumptions"]:
            tables.append(("Assumed", [(one,) for one in assumed]))
        return tables

    def plot_plate(self) -> list[Axes]:
        """Draw swash angle and control pressure over time."""
        return plotted(lambda: plots.plate_plot(self.to_xarray()))

    def plot_moments(self) -> list[Axes]:
        """Draw moments on the swash plate by cause over time."""
        return plotted(lambda: plots.moment_plot(self.to_xarray()))

    def plot_pump(self) -> list[Axes]:
        """Draw flow and drive torque over time."""
        return plotted(lambda: plots.pump_plot(self.to_xarray()))
