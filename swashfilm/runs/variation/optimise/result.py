"""Result of an optimisation."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from swashfilm.output.result import Result, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.variation.optimise import rows
from swashfilm.runs.variation.optimise.files import DATA
from swashfilm.runs.variation.optimise.plots import dimension_plot, growth_plot, pareto_plot

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


class OptimiseRun(Result):
    """Designs of a pump between bounds: the Pareto set, and one of it."""

    kinds: ClassVar[tuple[str, ...]] = ("optimisation",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", DATA)

    def tables(self) -> list[Table]:
        """Return counts, dimensions, objectives and constraints; without a feasible design the obstacles."""
        summary = self.summary
        head = rows.compared_head
        tables: list[Table] = [
            (f"Optimisation of {summary['pump']}, {summary['at']}", list(rows.count_rows(summary))),
            ("Dimensions", [head(rows.DIMENSION_HEAD, summary), *rows.dimension_rows(summary)]),
            ("Objectives and constraints", [head(rows.MEASURE_HEAD, summary), *rows.measure_rows(summary, asked=True)]),
        ]
        if summary["constraints"]:
            tables.append(("Constraints", [head(rows.CONSTRAINT_HEAD, summary), *rows.constraint_rows(summary)]))
        if not summary["chosen"]["feasible"] and summary["obstacles"]:
            tables.append(("What is in the way", [rows.OBSTACLE_HEAD, *rows.obstacle_rows(summary)]))
        return tables

    def to_pandas(self) -> pandas.DataFrame:
        """Return one row per design: its dimensions and its measures, SI, and whether it is feasible."""
        data = self.to_xarray()
        joined = data["dimension"].to_pandas().join(data["value"].to_pandas())
        return joined.assign(feasible=data["feasible"].values == 1, pareto=data["pareto"].values == 1)

    def pareto(self) -> pandas.DataFrame:
        """Return the designs of the Pareto set as `to_pandas`, in the order of pareto.csv."""
        found, first = self.to_pandas(), self.summary["objectives"][0]
        own = found[found["pareto"]]
        return own.iloc[np.argsort(own[first["name"]].values * (1 if first["aim"] == "least" else -1), kind="stable")]

    def plot_pareto(self) -> list[Axes]:
        """Draw all designs over the objectives, with the Pareto set, the start and the chosen design."""
        return plotted(lambda: pareto_plot(self.summary, self.to_xarray()))

    def plot_growth(self) -> list[Axes]:
        """Draw the hypervolume over the generations."""
        return plotted(lambda: growth_plot(self.summary))

    def plot_dimensions(self) -> list[Axes]:
        """Draw the dimensions along the Pareto set."""
        return plotted(lambda: dimension_plot(self.summary, self.to_xarray()))
