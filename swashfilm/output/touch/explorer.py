"""Figures with choices: the content of the figure by choice, for `script/choices.js`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from swashfilm.output.touch.packing import packed_json

if TYPE_CHECKING:
    import plotly.graph_objects as go

Row = int | Sequence[int]


@dataclass(frozen=True)
class Control:
    """A choice of the reader: its options in words, the first one shown; `slider` for options in an order."""

    name: str
    options: Sequence[str]
    first: int = 0
    slider: bool = False


@dataclass(frozen=True)
class Pick:
    """Place in the figure (keys from `data` or `layout` on) of a row of a table.

    by: numbers of the controls that choose. rows: the row for every combination of their options, the last control's
    fastest; several rows are joined.
    """

    path: Sequence[str | int]
    table: str
    by: Sequence[int]
    rows: Sequence[Row]


@dataclass(frozen=True)
class Move:
    """A mesh of rigid bodies: points (n, 3) of one of them, moved by rows [R | t] (3, 4) of a table, and joined."""

    trace: int
    points: Any
    table: str
    by: Sequence[int]
    rows: Sequence[Sequence[int]]


@dataclass(frozen=True)
class Copies:
    """A mesh whose triangles repeat for `count` bodies of so many points each."""

    trace: int
    count: int
    points: int


@dataclass(frozen=True)
class Explorer:
    """A figure with choices. grid: numbers over several axes, of which the first two traces show a slice."""

    figure: go.Figure
    controls: Sequence[Control] = ()
    picks: Sequence[Pick] = ()
    moves: Sequence[Move] = ()
    copies: Sequence[Copies] = ()
    tables: Mapping[str, Any] = field(default_factory=dict)
    grid: Mapping[str, Any] | None = None

    def packed(self) -> str:
        """Return the figure with its choices as a page holds it."""
        told: dict[str, Any] = {"figure": self.figure.to_plotly_json()}
        for name in ("controls", "picks", "moves", "copies"):
            if parts := getattr(self, name):
                told[name] = [asdict(one) for one in parts]
        if self.tables:
            told["tables"] = dict(self.tables)
        if self.grid is not None:
            told["grid"] = dict(self.grid)
        return packed_json(told)
