"""Pumps of a series that the geometry admits: their share, and what keeps the others out."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from system.description.pump import PumpDescription
from system.inputs.faults import InputFaults
from system.pump_file.file import Variant, varied

TRIED = 1000
"""Pumps whose geometry is tried before any is solved: the share of those refused follows within 2 %."""
MOST_REFUSED = 0.1
"""Share of refused pumps beyond which the others are no sample of the series."""


@dataclass(frozen=True)
class Trial:
    """Pumps whose geometry was tried; refused: what keeps some out, as `commonest` has it."""

    tried: int
    refused: dict[str, int]

    @property
    def share(self) -> float:
        """Share of the pumps that the geometry refuses."""
        return sum(self.refused.values()) / self.tried


def trial(pump: PumpDescription, variants: Sequence[Variant]) -> Trial:
    """Return what the geometry says of the first TRIED variants of a pump."""
    own = variants[:TRIED]
    reasons = (_refusal(pump, variant) for variant in own)
    return Trial(len(own), commonest(one for one in reasons if one))


def commonest(reasons: Iterable[str]) -> dict[str, int]:
    """Return reasons with how many pumps have each, the commonest first; of one subject they stand under the first."""
    first: dict[str, str] = {}
    count = Counter(first.setdefault(_subject(reason), reason) for reason in reasons)
    return dict(count.most_common())


def _refusal(pump: PumpDescription, variant: Variant) -> str:
    """Return the first fault of a variant, with its key; empty for a pump."""
    try:
        varied(pump, variant)
    except InputFaults as reason:
        return reason.faults[0].line
    return ""


def _subject(reason: str) -> str:
    """Return what a reason is about: the key of its first fault, or its words up to a number."""
    key, colon, _ = reason.partition(":")
    return key if colon and " " not in key else re.split(r"\d", reason, maxsplit=1)[0]
