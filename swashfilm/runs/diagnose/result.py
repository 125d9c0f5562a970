"""A diagnosis as a result: verdict in sentences, tables, plots."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from diagnosis.report.json_file import read_diagnosis
from swashfilm.output.result import Result, plotted, read_table
from swashfilm.output.tables import Table
from swashfilm.runs.diagnose import plots
from swashfilm.runs.diagnose.files import HIDDEN, read_rows
from swashfilm.runs.diagnose.page import FILES, remarks, strongest_courses
from swashfilm.runs.diagnose.rows import AGREED_HEAD, CHANNEL_HEAD, channel_rows, hidden_head, hidden_rows

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray
    from matplotlib.axes import Axes


class DiagnosisRun(Result):
    """A recording against the simulation of its pump: verdict, place, missing physics with probabilities."""

    kinds: ClassVar[tuple[str, ...]] = ("diagnosis",)
    files: ClassVar[tuple[str, ...]] = FILES
    record: Mapping[str, Any]
    _rows: dict[str, list[dict[str, str]]]

    @classmethod
    def opened(cls, folder: Path) -> DiagnosisRun:
        """The diagnosis of a run folder; raises InputFaults where one of its files is missing."""
        found = super().opened(folder)
        found.record = read_diagnosis(folder / "diagnosis.json")
        found._rows = {name: read_rows(folder / f"{name}.csv") for name in ("residuals", "hypotheses", "parameters")}
        if (folder / HIDDEN).is_file():  # runs of earlier programs have none
            found._rows["hidden"] = read_rows(folder / HIDDEN)
        return found

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """residuals.csv of a run folder."""
        return read_table(folder / "residuals.csv")

    @property
    def statement(self) -> str:
        """The verdict in sentences."""
        return str(self.record["statement"])

    @property
    def paragraphs(self) -> tuple[str, ...]:
        """The verdict, points not used in the fit, rivals, and the next measurement."""
        return (self.statement, *self.record["details"])

    @property
    def answer(self) -> Mapping[str, Any]:
        """The answer in plain words by part: finding, cost, certainty, inspection, next measurement."""
        found: Mapping[str, Any] = self.record["answer"]
        return found

    @property
    def effects(self) -> list[dict[str, Any]]:
        """The claimed effects: id, pair, probability, parameters with sigmas in SI."""
        return list(self.record["effects"])

    @cached_property
    def notes(self) -> list[str]:
        """Notes on the verdict."""
        return remarks(self.record, self.summary)

    def tables(self) -> list[Table]:
        """The channels with their residuals, and effects that are not claimed at the largest size allowed."""
        head = CHANNEL_HEAD if self.effects else AGREED_HEAD
        found: list[Table] = [("Channels", [head, *channel_rows(self.record)])]
        hidden = self._rows.get("hidden", [])
        limited = list(hidden_rows(hidden))
        return [*found, ("Effects that may hide", [hidden_head(hidden), *limited])] if limited else found

    def __repr__(self) -> str:
        return "\n".join([*self.paragraphs, super().__repr__()])

    def _repr_html_(self) -> str:
        from html import escape

        return "".join(f"<p>{escape(text)}</p>" for text in self.paragraphs) + super()._repr_html_()

    def plot_residuals(self) -> list[Axes]:
        """Maps of the residuals in multiples of their sigma, without and with the finding."""
        return plotted(lambda: plots.residual_maps(self._rows["residuals"], bool(self.effects)))

    def plot_evidence(self) -> list[Axes]:
        """Probabilities of the hypotheses."""
        return plotted(lambda: plots.hypothesis_bars(self._rows["hypotheses"]) if self._rows["hypotheses"] else None)

    def plot_effect(self) -> list[Axes]:
        """Contribution of the finding beside the residuals without it; empty without a claim."""
        rows = self._rows["residuals"]
        courses = strongest_courses(rows) if self.effects else []
        return plotted(lambda: plots.effect_courses(rows, courses) if courses else None)
