"""Statements of the paper's text on its figures, one by one, from statements.toml."""

import tomllib
from collections.abc import Mapping
from importlib.resources import files
from math import inf

from system.paper.figure import Figure, Unit
from system.paper.judge import PaperClaim, Range


def _claims() -> dict[str, PaperClaim]:
    tables = tomllib.loads(files("system.paper").joinpath("statements.toml").read_text("utf-8"))
    return {
        name: PaperClaim(
            name,
            Figure.named(name.partition(".")[0]),
            row["words"],
            row["quantity"],
            Unit[row["unit"]],
            Range(row.get("low", -inf), row.get("high", inf)),
            row.get("taken", ""),
        )
        for name, row in tables.items()
    }


CLAIMS: Mapping[str, PaperClaim] = _claims()
"""All statements by id."""
