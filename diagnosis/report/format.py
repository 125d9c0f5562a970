"""Words and numbers of a diagnosis as people read them: places, channels, settings, odds, ids as words."""

from __future__ import annotations

from collections.abc import Iterable

from diagnosis.detect.regions import MapRegion
from diagnosis.recording.units import channel_unit, reading
from diagnosis.study.map_axes import AXES
from system.description.gap import Gap
from system.effects.catalogue.bench_words import BENCH_WORDS
from system.effects.components import Component
from system.effects.effect import EffectId
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension, in_unit, reading_unit

MOST_ODDS = 1000000
"""Odds beyond which a number has no meaning: models are not that accurate."""

NOTHING = "no mismatch"
"""The explanation by no effect at all, in words."""

PLACES = {Gap.PISTON: "the pistons", Gap.SLIPPER: "the slippers", Gap.VALVE_PLATE: "the valve plate"}


CHANNELS = {
    ChannelName.SPEED: "speed", ChannelName.DISPLACEMENT_RATIO: "stroke", ChannelName.P_OUT: "delivery pressure",
    ChannelName.P_IN: "inlet pressure", ChannelName.P_CASE: "case pressure", ChannelName.T_IN: "inlet temperature",
    ChannelName.T_OUT: "outlet temperature", ChannelName.T_CASE: "case temperature",
    ChannelName.Q_OUT: "delivery flow", ChannelName.Q_IN: "inlet flow", ChannelName.Q_CASE: "case drain",
    ChannelName.Q_PISTON: "drain of the pistons", ChannelName.Q_SLIPPER: "drain of the slippers",
    ChannelName.Q_VALVE_PLATE: "drain of the valve plate", ChannelName.TORQUE: "shaft torque",
    ChannelName.TORQUE_UNCOUPLED: "torque of the uncoupled shaft", ChannelName.ELECTRIC_POWER: "motor power",
    ChannelName.ANGLE: "shaft angle", ChannelName.P_CHAMBER: "chamber pressure",
}  # fmt: skip
"""Names of the channels in sentences."""

C = Component
COMPONENTS = {
    C.PISTON_LEAKAGE: "leakage of the pistons", C.SLIPPER_LEAKAGE: "leakage of the slippers",
    C.PLATE_LEAKAGE: "leakage of the valve plate", C.CROSS_FLOW: "flow from delivery to inlet",
    C.DRAIN_FLOW: "flow into the case beside the films", C.DISPLACEMENT: "displacement",
    C.COMPRESSION: "compression of the oil", C.COMMUTATION: "pressure change at the ports",
    C.PISTON_FRICTION: "friction of the pistons", C.SLIPPER_FRICTION: "friction of the slippers",
    C.SOCKET_FRICTION: "friction of the ball joints", C.PLATE_FRICTION: "friction of the valve plate",
    C.GUIDE_FRICTION: "friction of the retainer's guide", C.BEARINGS: "friction of the bearings",
    C.CASE_DRAG: "drag in the case", C.THERMAL_STATE: "temperature of the films",
    C.Q_OUT_SENSOR: "reading of the delivery flow", C.Q_IN_SENSOR: "reading of the inlet flow",
    C.Q_CASE_SENSOR: "reading of the case drain", C.TORQUE_SENSOR: "reading of the shaft torque",
    C.T_OUT_SENSOR: "reading of the outlet temperature", C.ELECTRIC_POWER_SENSOR: "reading of the motor power",
}  # fmt: skip
"""Names of the components of the readings in sentences."""


def channel_words(channel: ChannelName) -> str:
    """A channel in words with its name, unless they contain it: "case drain (Q_case)", "shaft torque"."""
    words = CHANNELS[channel]
    return words if channel.value in words else f"{words} ({channel.value})"


def level_text(axis: ChannelName, value: float) -> str:
    """A value in SI of an axis of the map: "1000 r/min", "374 bar", "28 %", "59 degC"."""
    shown = reading(axis, value)
    forms = {
        ChannelName.SPEED: f"{shown:.0f} r/min",
        ChannelName.P_OUT: pressure_text(value),
        ChannelName.DISPLACEMENT_RATIO: f"{100.0 * shown:.0f} %",
        ChannelName.T_CASE: f"{shown:.0f} degC",
    }
    return forms[axis]


def setting_text(speed: float, pressure: float, stroke: float) -> str:
    """An operating point in SI in the words of a bench: "1000 r/min, 374 bar, 28 % stroke"."""
    axes = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO)
    turns, load, part = map(level_text, axes, (speed, pressure, stroke))
    return f"{turns}, {load}, {part} stroke"


def region_words(region: MapRegion) -> str:
    """Part of the map: "delivery pressures above 250 bar and strokes below 40 %"."""
    return listed(_range(axis, region) for axis in AXES if {axis.value} & (region.lower.keys() | region.upper.keys()))


def _range(axis: ChannelName, region: MapRegion) -> str:
    lower, upper = (
        "" if value is None else level_text(axis, value)
        for value in (region.lower.get(axis.value), region.upper.get(axis.value))
    )
    between = f"from {lower} to {upper}" if lower and upper else f"above {lower}" if lower else f"below {upper}"
    return f"{CHANNELS[axis]}s {between}"


def sentence_case(text: str) -> str:
    """A text with its first letter large, as a sentence begins; symbols of channels stay."""
    return text if "_" in text.partition(" ")[0] else f"{text[:1].upper()}{text[1:]}"


def pressure_text(pressure: float) -> str:
    """A delivery pressure in Pa in the requested unit: "374 bar"."""
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
    """Effects by their names on the bench, "nothing" without one: "elastic opening at the slippers"."""
    words = listed(BENCH_WORDS[effect].name for effect in effects) or "nothing"
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
