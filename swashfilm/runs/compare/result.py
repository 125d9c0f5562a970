"""Result of a comparison of two maps."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.result import Result, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.compare.page import (
    DIFFERENCE_HEAD,
    DUTY_HEAD,
    EFFICIENCY_HEAD,
    SPECIFIC,
    difference_rows,
    duty_rows,
    efficiency_rows,
    specific_rows,
)

if TYPE_CHECKING:
    import xarray


class CompareRun(Result):
    """Two maps side by side: means and largest differences."""

    kinds: ClassVar[tuple[str, ...]] = ("comparison",)
    files: ClassVar[tuple[str, ...]] = ("summary.json", "differences.csv")

    @property
    def name(self) -> str:
        """Names of both pumps."""
        return f"compare-{'-'.join(self.summary['pumps'])}"

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return differences.csv of a run folder."""
        return read_table(folder / "differences.csv")

    def tables(self) -> list[Table]:
        """Return differences by number, and over the cycle, if any."""
        summary = self.summary
        sides = f"A: {summary['names'][0]}; B: {summary['names'][1]}"
        tables: list[Table] = [(f"{sides}; means over the common levels", [DIFFERENCE_HEAD, *difference_rows(summary)])]
        if efficiencies := efficiency_rows(summary):
            tables.insert(0, ("Differences in percentage points", [EFFICIENCY_HEAD, *efficiencies]))
        if summary["specific"]:
            tables.append((SPECIFIC, [DIFFERENCE_HEAD, *specific_rows(summary)]))
        if summary["duty"]:
            tables.append(("Over the cycle", [DUTY_HEAD, *duty_rows(summary)]))
        return tables
