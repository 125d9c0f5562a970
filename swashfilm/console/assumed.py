"""Assumptions of a scaled pump, printed before a command runs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from pathlib import Path
from textwrap import wrap

from swashfilm.console.terminal import show
from system.description.assumptions import Assumption
from system.inputs.toml_table import read_toml
from system.pump_file.file import builtin_pumps, load_known_pump

WIDTH = 120


def scaled_warning(assumptions: Sequence[Assumption]) -> list[str]:
    """Return the warning of a run whose pump file leaves most values out; None for a pump stated in full."""
    count = len(assumptions)
    if not count:
        return []
    told = f"{count} values of the pump are not stated: they are those of ref90, scaled"
    return [f"values_scaled: {told}; state those that you know"]


def show_assumed(pump: str | Path) -> None:
    """Print every value assumed from ref90, by its reason; nothing for a pump stated in full."""
    if str(pump) in builtin_pumps() or Path(pump).suffix != ".toml":
        return
    show_assumptions(pump, load_known_pump(pump).assumptions)


def show_assumptions(pump: str | Path, assumptions: Sequence[Assumption]) -> None:
    """Print the assumptions for values that a pump file leaves out, if any."""
    if assumptions:
        show(f"{pump} leaves {len(assumptions)} values out, which are assumed:")
        show("\n".join(_rows(assumptions)))


def show_assumed_in(case: Path) -> None:
    """As `show_assumed`, for the pump of a film case, transient or optimisation, if it has one."""
    _, tables = read_toml(case)
    of_kind = (table for kind in ("film", "transient", "optimise") if isinstance(table := tables.get(kind), dict))
    named = next((table["pump"] for table in (*of_kind, tables) if "pump" in table), None)
    if isinstance(named, str) and named not in builtin_pumps():
        show_assumed(case.parent / named)


def _rows(assumptions: Iterable[Assumption]) -> Iterator[str]:
    """Yield lines with the assumptions of each reason together."""

    def reason(one: Assumption) -> str:
        return one.reason

    for name, alike in groupby(sorted(assumptions, key=reason), reason):
        yield f"  {name}:"
        listed = ", ".join(f"{one.path} {one.value}" for one in alike)
        yield from wrap(listed, WIDTH, initial_indent="    ", subsequent_indent="    ", break_long_words=False)
