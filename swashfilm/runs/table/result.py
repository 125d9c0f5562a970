"""Result of a response table."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from swashfilm.output.result import Result, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.table.page import FILES, error_rows, held_rows, number_rows

if TYPE_CHECKING:
    import xarray


class TableRun(Result):
    """A response table of a pump's gaps, or of one gap: its box, and its error at held-out points."""

    kinds: ClassVar[tuple[str, ...]] = ("response_table", "gap_table")
    files: ClassVar[tuple[str, ...]] = (*FILES, "points.csv")

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return points.csv of a run folder."""
        return read_table(folder / "points.csv")

    def tables(self) -> list[Table]:
        """Return the box, errors of runs by the table, errors of its outputs."""
        tables: list[Table] = [(f"Table of {self.name}", list(held_rows(self.summary)))]
        if numbers := [*number_rows(self.summary)]:
            head = ("number", "rms", "largest", "at")
            tables.append(("Error of runs by the table at held-out points", [head, *numbers]))
        head = ("output", "rms", "largest", "at")
        return [*tables, ("Error of held-out points", [head, *error_rows(self.summary)])]
