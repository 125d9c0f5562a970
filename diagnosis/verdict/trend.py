"""Trend of an explanation over speed, pressure, displacement and viscosity, against that of the readings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.stats import norm

from diagnosis.explain.explained import explained_mismatch
from diagnosis.explain.ranked import Explanation
from diagnosis.explain.scaling import moves
from diagnosis.study.map_axes import AXES
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.estimation.evidence import score
from system.estimation.posterior import settled
from system.inputs.channels import ChannelName


@dataclass(frozen=True)
class PowerError:
    """Missing power of a coordinate in the growth of an explanation, with one sigma."""

    coordinate: str
    power: float
    sigma: float

    @property
    def text(self) -> str:
        """ "it would have to grow with speed by a power more of 1.3 +- 0.5"."""
        more = "more" if self.power > 0 else "less"
        size = f"{abs(self.power):.2g} +- {self.sigma:.1g}"
        return f"it would have to grow with {self.coordinate} by a power {more} of {size}"


def coordinates(study: Study, viscosity: Array) -> Mapping[str, Array]:
    """Speed, pressure, displacement, viscosity (N,) in SI: those that are known at all points."""
    values, order = study.recording.steady.values, list(ChannelName)
    speed, pressure, stroke = (values[:, order.index(axis)] for axis in AXES[:3])
    found = {"speed": speed, "pressure": pressure, "displacement": stroke, "viscosity": viscosity}
    return {name: x for name, x in found.items() if np.all(np.isfinite(x))}


def power_errors(
    study: Study, explanation: Explanation, along: Mapping[str, Array], thresholds: Thresholds
) -> tuple[PowerError, ...]:
    """Powers by which the growth of a refitted explanation differs from that of the readings; usually none.

    Its addition to the readings, d, becomes d x^b: to first order b d ln x, whose score (Rao 1948) is computed about
    the refit, one coordinate x at a time. At most one in twenty explanations of the right form is reported (rate of
    false flags; Holm 1979), and no power below `flat`. One direction at a time finds errors that a free multiplier,
    with its prior cost in all directions, does not. Empty without a refit.
    """
    posterior, form = explanation.posterior, thresholds.form
    logs = {name: np.log(x / np.median(x)) for name, x in along.items() if x.min() > 0 and moves(x, form.least_range)}
    if posterior is None or not logs:
        return ()
    try:
        added = explained_mismatch(study, explanation, thresholds).added
    except NotConverged:
        return ()
    fit = settled(posterior)
    scores = {name: score(fit, fit.whitening.whiten(added * x[:, None])) for name, x in logs.items()}
    least = float(norm.isf(0.5 * thresholds.mismatch.flag_rate / len(logs)))
    flagged = [(name, found) for name, found in scores.items() if abs(found.z) > least and abs(found.size) > form.flat]
    return tuple(
        PowerError(name, found.size, found.sigma) for name, found in sorted(flagged, key=lambda one: -abs(one[1].z))
    )
