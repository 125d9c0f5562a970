"""How well a hypothesis stands: scores of columns."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from system.estimation.observations import Array


class Sign(Enum):
    """Which sign the size of an effect may have."""

    POSITIVE = "positive"
    NEGATIVE = "negative"
    EITHER = "either"


@dataclass(frozen=True)
class Score:
    """A column against a residual, nuisances projected out.

    z: size over sigma; size, sigma in spreads of the column's parameter; projected: the whitened column (n,) less
    what the fitted parameters can take up of it.
    """

    z: float
    size: float
    sigma: float
    projected: Array
