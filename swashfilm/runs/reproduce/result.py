"""Result of a reproduction of the paper."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from swashfilm.output.page import read_kept
from swashfilm.output.result import Result, plotted
from swashfilm.output.tables import Table
from swashfilm.runs.reproduce.files import CLAIMS
from swashfilm.runs.reproduce.page import FILES, verdict_counts, verdict_rows
from swashfilm.runs.reproduce.plots import verdict_bars

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

HEAD = ("statement", "reading", "the paper", "computed", "verdict")


class Reproduction(Result):
    """The paper's statements beside computed numbers, with a verdict on each."""

    kinds: ClassVar[tuple[str, ...]] = ("reproduction",)
    files: ClassVar[tuple[str, ...]] = FILES
    claims: list[dict[str, Any]]

    @classmethod
    def opened(cls, folder: Path) -> Reproduction:
        """Return the reproduction of a run folder; raise InputFaults where one of its files is missing."""
        found = super().opened(folder)
        found.claims = read_kept(folder, CLAIMS)["claims"]
        return found

    @property
    def name(self) -> str:
        """Name of the run."""
        return "reproduce"

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return the rows of claims.json of a run folder, SI, over `row`."""
        import pandas

        rows = read_kept(folder, CLAIMS)["claims"]
        return pandas.DataFrame([_plain(row) for row in rows]).rename_axis("row").to_xarray()

    def plot_verdicts(self) -> list[Axes]:
        """Draw the number of statements of each figure by verdict."""
        return plotted(lambda: verdict_bars(verdict_counts(self.summary, self.claims)))

    def tables(self) -> list[Table]:
        """Return every statement with its reading, the paper's range, the computed number and the verdict."""
        title = f"The paper by {self.summary['pump']}, {self.summary['fidelity']}"
        return [(title, [HEAD, *verdict_rows(self.claims)])]


def _plain(row: Mapping[str, Any]) -> dict[str, Any]:
    """Return a row with the ends of its ranges as numbers, nan if absent, and the impossibility in words."""
    ends = {
        f"{name}_{side}": np.nan if end is None else end
        for name in ("expected", "found")
        for side, end in zip(("low", "high"), row[name], strict=True)
    }
    impossible = row["impossible"]["text"] if row["impossible"] else ""
    kept = {key: value for key, value in row.items() if key not in ("expected", "found", "impossible")}
    return kept | ends | {"impossible": impossible}
