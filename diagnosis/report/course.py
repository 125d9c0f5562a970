"""Mismatch in words: distance of the readings from the simulation, and the input along which it changes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.stats import spearmanr

from diagnosis.explain.explained import explained_mismatch
from diagnosis.explain.scaling import Scaling
from diagnosis.recording.units import difference, difference_unit
from diagnosis.report.format import level_text, listed
from diagnosis.study.map_axes import axis_values
from diagnosis.study.model import Study
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.effects.effect import Kind
from system.inputs.channels import ChannelName

ENDS = 0.15
"""Of an axis: the parts at its ends whose difference is stated."""
NOTHING = 0.005
"""Of the largest difference: a smaller one is round-off."""
DRIFTS = {
    ChannelName.Q_OUT: "delivery flow meter", ChannelName.Q_IN: "inlet flow meter", ChannelName.TORQUE: "torque meter",
}  # fmt: skip
"""Meters that may drift without a hypothesis that says so."""
IN_ORDER = 0.9
"""Rank correlation with the order of the points from which an addition may be a drift."""
HIDDEN = 3.0
"""Times the misfit without the finding that the difference is at least, where the fit hides it."""
SIDES = {
    ChannelName.Q_OUT: ("The pump delivers more oil than simulated", "The pump delivers less oil than simulated"),
    ChannelName.Q_IN: ("The pump takes in more oil than simulated", "The pump takes in less oil than simulated"),
    ChannelName.Q_CASE: ("The case drains more oil than simulated", "The case drains less oil than simulated"),
    ChannelName.Q_PISTON: ("The pistons leak more oil than simulated", "The pistons leak less oil than simulated"),
    ChannelName.Q_SLIPPER: ("The slippers leak more oil than simulated", "The slippers leak less oil than simulated"),
    ChannelName.Q_VALVE_PLATE: (
        "The valve plate leaks more oil than simulated",
        "The valve plate leaks less oil than simulated",
    ),
    ChannelName.TORQUE_UNCOUPLED: (
        "The torque meter reads more than nothing uncoupled",
        "The torque meter reads less than nothing uncoupled",
    ),
    ChannelName.TORQUE: ("The shaft takes more torque than simulated", "The shaft takes less torque than simulated"),
    ChannelName.T_OUT: ("The oil leaves warmer than simulated", "The oil leaves cooler than simulated"),
    ChannelName.ELECTRIC_POWER: ("The motor takes more power than simulated", "The motor takes less than simulated"),
}
"""A channel that reads more, and less, than simulated."""
BEHIND = {ChannelName.DISPLACEMENT_RATIO: " stroke", ChannelName.T_CASE: " in the case"}
"""Words behind a level of an axis whose unit alone is ambiguous."""
SAME = {"speed": "speed", "pressure": "pressure", "displacement": "stroke", "viscosity": "oil viscosity"}


def course_words(study: Study, diagnosis: Diagnosis) -> str:
    """Distance of the first channel's readings from the simulation at both ends of the most important input.

    By the explanation's addition, which has no noise. Empty without an explanation, and for traces alone.
    """
    channel = _channel(study, diagnosis)
    found = None if channel is None else _added(study, diagnosis, channel)
    if channel is None or found is None:
        return ""
    own, measured = found
    more, less = SIDES[channel]
    ends = _ends(channel, own[measured], {name: x[measured] for name, x in axis_values(study.recording).items()})
    same = _same(diagnosis.scaling, diagnosis.thresholds.form.flat)
    side = more if float(np.sum(own[measured])) > 0.0 else less
    return f"{side}: {', '.join(part for part in (ends, same) if part)}.{_made_up(channel, own[measured], diagnosis)}"


def drift_words(study: Study, diagnosis: Diagnosis) -> str:
    """A drift of the first channel's meter as a rival, where what the claim adds goes with the order of the recording.

    Empty for the case drain, whose drift is a hypothesis, and for points in a mixed order.
    """
    channel = _channel(study, diagnosis)
    found = _added(study, diagnosis, channel) if channel in DRIFTS and diagnosis.effects else None
    if channel is None or found is None:
        return ""
    own, measured = found
    hours = study.recording.steady.hours
    order = hours if np.all(np.isfinite(hours)) else np.arange(len(hours), dtype=float)
    if np.ptp(own[measured]) == 0.0 or abs(float(spearmanr(order[measured], own[measured]).statistic)) < IN_ORDER:
        return ""
    return (
        f"A drift of the {DRIFTS[channel]}, which no hypothesis is, would look alike: the difference goes with the "
        "order of the points. Read the first points again at the end."
    )


def _added(study: Study, diagnosis: Diagnosis, channel: ChannelName) -> tuple[Array, NDArray[np.bool_]] | None:
    """Addition (N,) of the first explanation to a channel, and where that is measured; None without any."""
    try:
        added = explained_mismatch(study, diagnosis.hypotheses[0], diagnosis.thresholds).added
    except NotConverged:  # the explanation's own simulation stands; without the effect there is none to subtract from
        return None
    at = study.channels.index(channel)
    own, measured = added[:, at], study.observations.measured[:, at]
    return (own, measured) if np.any(own[measured]) else None


def _made_up(channel: ChannelName, added: Array, diagnosis: Diagnosis) -> str:
    """A sentence of its own, with a blank before it, where a fit without the finding hides most of the difference."""
    before = diagnosis.fit.before.get(channel)
    if before is None or float(np.sqrt(np.mean(added**2))) < HIDDEN * before:
        return ""
    left = f"{difference(channel, before):.2g} {difference_unit(channel)}"
    return f" Fitted without the finding, other values of pump and meters make up for it to {left} (rms)."


def _channel(study: Study, diagnosis: Diagnosis) -> ChannelName | None:
    """The channel of the sentence: the first one of the map with the mismatch."""
    agreed = diagnosis.kind is Kind.NO_MISMATCH or diagnosis.status is VerdictStatus.SUSPICION
    steady = [one for one in diagnosis.location.channels if one in study.channels and one in SIDES]
    return None if agreed or not steady else steady[0]


def _ends(channel: ChannelName, added: Array, axes: Mapping[ChannelName, Array]) -> str:
    """The differences at both ends of the axis of largest correlation; the median one where no axis varies."""
    if not axes or np.ptp(added) == 0.0:
        return _difference(channel, float(np.median(added)))
    axis = max(axes, key=lambda name: abs(_correlation(axes[name], added)))
    x = axes[axis]
    reach = ENDS * np.ptp(x)
    low, high = x <= x.min() + reach, x >= x.max() - reach
    least = NOTHING * float(np.abs(added).max())
    return ", ".join(
        f"{_difference(channel, float(np.median(added[part])), least)} at "
        f"{level_text(axis, float(np.median(x[part])))}{BEHIND.get(axis, '')}"
        for part in (low, high)
    )


def _correlation(one: Array, other: Array) -> float:
    return float(np.corrcoef(one, other)[0, 1]) if np.ptp(one) > 0.0 else 0.0


def _difference(channel: ChannelName, value: float, least: float = 0.0) -> str:
    if abs(value) < least:
        return "nothing"
    size = difference(channel, value)
    return f"{abs(size):.2g} {difference_unit(channel)} {'more' if size > 0.0 else 'less'}"


def _same(scaling: Scaling | None, flat: float) -> str:
    """Inputs on which the difference does not depend, where exponents are known."""
    if scaling is None:
        return ""
    names = [SAME[name] for name, power in scaling.exponents.items() if abs(power) <= flat >= scaling.sigma[name]]
    return f"at any {listed(names)} alike" if names else ""
