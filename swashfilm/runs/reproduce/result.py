"""A reproduction of the paper as a result."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from swashfilm.output.result import Result, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.reproduce.files import CLAIMS
from swashfilm.runs.reproduce.page import FILES, verdict_rows

if TYPE_CHECKING:
    import xarray

HEAD = ("statement", "reading", "the paper", "here", "verdict")


class Reproduction(Result):
    """The paper's statements beside the same numbers here, with a judgement on each."""

    kinds: ClassVar[tuple[str, ...]] = ("reproduction",)
    files: ClassVar[tuple[str, ...]] = FILES
    claims: list[dict[str, Any]]

    @classmethod
    def opened(cls, folder: Path) -> Reproduction:
        """The reproduction of a run folder; raises InputFaults where one of its files is missing."""
        found = super().opened(folder)
        found.claims = json.loads((folder / CLAIMS).read_text("utf-8"))["claims"]
        return found

    @property
    def name(self) -> str:
        """Name of the run."""
        return "reproduce"

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """claims.csv of a run folder."""
        return read_table(folder / "claims.csv")

    def tables(self) -> list[Table]:
        """Every statement with its reading, the paper's range, the number here and the judgement."""
        title = f"The paper by {self.summary['pump']}, {self.summary['fidelity']}"
        return [(title, [HEAD, *verdict_rows(self.claims)])]
