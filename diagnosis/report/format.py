"""Numbers of a diagnosis as people read them: the unit of each quantity, values with their sigma, ids as words."""

from __future__ import annotations

from collections.abc import Iterable

from diagnosis.verdict.diagnosis import Estimate
from system.description.gap import Gap
from system.effects.effect import EffectId
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension, in_unit, reading_unit

MOST_ODDS = 1000000
"""Odds beyond which a number means nothing: models are not that true."""

PLACES = {Gap.PISTON: "the pistons", Gap.SLIPPER: "the slippers", Gap.VALVE_PLATE: "the valve plate"}


CHANNELS = {
    ChannelName.Q_OUT: "delivery flow", ChannelName.Q_IN: "inlet flow", ChannelName.Q_CASE: "case drain",
    ChannelName.TORQUE: "shaft torque", ChannelName.T_OUT: "outlet temperature",
    ChannelName.ELECTRIC_POWER: "motor power", ChannelName.P_CHAMBER: "chamber pressure",
}  # fmt: skip
"""Names of the outputs in sentences."""


def channel_words(channel: ChannelName) -> str:
    """A channel in words with its name: "case drain (Q_case)"."""
    words = CHANNELS.get(channel)
    return f"{words} ({channel.value})" if words else channel.value


def estimate_text(estimate: Estimate) -> str:
    """A parameter with one sigma: "opening 22 +- 2 1/GPa". Temperatures are differences, in K."""
    unit, factor = parameter_unit(estimate.dimension, estimate.value)
    size = f"{estimate.value * factor:.3g} +- {estimate.sigma * factor:.2g}"
    return f"{last_word(estimate.name)} {size} {unit.removesuffix('1')}".rstrip()


def parameter_unit(dimension: Dimension | None, size: float) -> tuple[str, float]:
    """Unit that a parameter of this size (SI) is read in, and its factor on SI; temperatures are differences."""
    if dimension is None:
        return "1", 1.0
    if dimension is Dimension.TEMPERATURE:
        return "K", 1.0
    unit = reading_unit(size, dimension)
    return unit, in_unit(1.0, unit, dimension)


def last_word(name: str) -> str:
    """The quantity of a parameter without its place: "elastic_opening.slipper.opening" is an opening."""
    return name.rpartition(".")[2].replace("_", " ")


def effect_words(effects: Iterable[EffectId], pair: Gap | None = None) -> str:
    """Ids as words: "elastic opening of the slippers", "churning and torque offset", "nothing"."""
    words = listed(effect.value.replace("_", " ") for effect in effects) or "nothing"
    return f"{words} at {PLACES[pair]}" if pair else words


def listed(words: Iterable[str], last: str = "and") -> str:
    """Words in a row: "a", "a and b", "a, b and c"."""
    *before, final = list(words) or [""]
    return f"{', '.join(before)} {last} {final}" if before else final


def odds_text(first: float, other: float) -> str:
    """Odds of one probability to another: "1:12", "below 1:1000000"."""
    if other * MOST_ODDS < first:
        return f"below 1:{MOST_ODDS}"
    against = first / other
    return f"1:{against:.2g}" if against < 99.5 else f"1:{round(against, 1 - len(str(int(against)))):.0f}"


def chance(probability: float) -> str:
    """A probability that never claims to be certain."""
    if probability > 0.999:
        return "above 0.999"
    if probability > 0.99:
        return f"{probability:.3f}"
    return "below 0.001" if probability < 0.001 else f"{probability:.2g}"
