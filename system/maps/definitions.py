"""Rows of efficiencies by definition: those that agree share a row, named by the first of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from system.pump.efficiency import EfficiencyDefinition

HEADLINE = EfficiencyDefinition.ISO_SWEPT
"""Definition of the efficiency that a page shows first."""
_SHORT = {
    EfficiencyDefinition.PAPER: "paper",
    HEADLINE: "ISO 4409",
    EfficiencyDefinition.ISO_TOET: "by Toet",
    EfficiencyDefinition.ENERGY_RETURNED: "energy with compression",
    EfficiencyDefinition.ENERGY_NOT_RETURNED: "energy",
}
BY_NAME = {one.value: one for one in EfficiencyDefinition}
"""Definitions by their name in files."""


def definition_words(alike: Sequence[EfficiencyDefinition]) -> str:
    """Return the name of definitions whose overall efficiencies agree: that of HEADLINE or the first, short ones of the
    others."""
    first, *others = sorted(alike, key=lambda one: one is not HEADLINE)
    same = f"; the same: {', '.join(_SHORT[one] for one in others)}" if others else ""
    return f"overall efficiency ({_SHORT[first]}){same}"


def agreeing(
    values: Mapping[EfficiencyDefinition, tuple[str, ...]],
) -> list[tuple[tuple[EfficiencyDefinition, ...], tuple[str, ...]]]:
    """Return the definitions that have the same cells, with these; those with HEADLINE first."""
    found: dict[tuple[str, ...], list[EfficiencyDefinition]] = {}
    for one, cells in values.items():
        found.setdefault(cells, []).append(one)
    return sorted(((tuple(alike), cells) for cells, alike in found.items()), key=lambda row: HEADLINE not in row[0])
