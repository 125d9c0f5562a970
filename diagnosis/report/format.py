"""Words and numbers of a diagnosis as people read them: places, channels, settings, odds, ids as words."""

from __future__ import annotations

from collections.abc import Iterable

from diagnosis.recording.units import channel_unit, reading
from system.description.gap import Gap
from system.effects.effect import EffectId
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension, in_unit, reading_unit

MOST_ODDS = 1000000
"""Odds beyond which a number means nothing: models are not that true."""

NOTHING = "no mismatch"
"""The explanation by no effect at all, in words."""

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


def setting_text(speed: float, pressure: float, stroke: float) -> str:
    """An operating point in SI in the words of a bench: "1000 r/min, 374 bar, 28 % stroke"."""
    turns, load = reading(ChannelName.SPEED, speed), pressure_text(pressure)
    return f"{turns:.0f} r/min, {load}, {100.0 * stroke:.0f} % stroke"


def pressure_text(pressure: float) -> str:
    """A delivery pressure in Pa with the unit that is asked for: "374 bar"."""
    return f"{reading(ChannelName.P_OUT, pressure):.3g} {channel_unit(ChannelName.P_OUT)}"


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


def if_words(first: str, second: str) -> tuple[str, str]:
    """Conditions that either of two explanations is true, short where they differ by their place alone.

    "if the cause is churning" and "if nothing is wrong"; "if it is the pistons" and "if it is the slippers".
    """
    (one, _, here), (other, _, there) = first.partition(" at "), second.partition(" at ")
    if one == other and here and there:
        return f"if it is {here}", f"if it is {there}"
    return _if(first), _if(second)


def _if(explanation: str) -> str:
    return "if nothing is wrong" if explanation == NOTHING else f"if the cause is {explanation}"


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
