"""Meters of a bench by a command line: `Q_out,Q_case=0.02 L/min,torque=0.2%`."""

from __future__ import annotations

from dataclasses import dataclass, field

from diagnosis.next_point.meters import ALWAYS, ORDINARY, WORDS, Stated
from diagnosis.recording.units import difference_unit
from system.bench.outputs import SIMULATED
from system.inputs.channels import ChannelName
from system.inputs.faults import Fault, nearest_choice
from system.inputs.units import Dimension, QuantityError, parse_quantity, parse_share

OPTION, FURTHER = "--sensors", "--further"
KNOWN = tuple(dict.fromkeys(one.value for one in (*SIMULATED, *WORDS, *ALWAYS)))
"""Channels with a sigma of their own; the inputs of a point are always read."""


@dataclass
class Bench:
    """Channels of the bench, and the sigma of those that have a stated one."""

    channels: tuple[str, ...]
    stated: dict[ChannelName, Stated] = field(default_factory=dict)


def bench_of(text: str | None, faults: list[Fault]) -> Bench:
    """Return the meters of a text; those of an ordinary bench without one; add faults to `faults`."""
    if text is None:
        return Bench(tuple(one.value for one in ORDINARY))
    found = Bench(tuple(one.value for one in ALWAYS))
    for part in text.split(","):
        name, equals, sigma = (one.strip() for one in part.partition("="))
        if name not in KNOWN:
            faults.append(_unknown(OPTION, name, KNOWN))
            continue
        found.channels = tuple(dict.fromkeys((*found.channels, name)))
        if equals:
            _state(found, ChannelName.named(name), sigma, faults)
    if not set(found.channels) & {one.value for one in SIMULATED}:
        outputs = ", ".join(one.value for one in SIMULATED)
        faults.append(Fault(OPTION, "no meter of what the pump does", f"one at least of {outputs}"))
    if ChannelName.TORQUE_UNCOUPLED.value in found.channels and ChannelName.TORQUE.value not in found.channels:
        expected = f"{ChannelName.TORQUE.value} beside it: it is this meter that reads without the pump"
        faults.append(Fault(OPTION, ChannelName.TORQUE_UNCOUPLED.value, expected, ChannelName.TORQUE.value))
    return found


def further_names(text: str | None, bench: Bench, faults: list[Fault]) -> tuple[str, ...] | None:
    """Return the meters of a text that the bench could add, None for all; add faults to `faults`."""
    if text is None:
        return None
    choices = tuple(one.value for one in WORDS if one.value not in bench.channels)
    names = tuple(dict.fromkeys(one.strip() for one in text.split(",")))
    for name in names:
        if name in bench.channels:
            faults.append(Fault(FURTHER, f"'{name}', a meter that the bench has", f"one of {', '.join(choices)}"))
        elif name not in choices:
            faults.append(_unknown(FURTHER, name, choices))
    return names


def _unknown(option: str, name: str, choices: tuple[str, ...]) -> Fault:
    expected = f"one of {', '.join(choices)}"
    return Fault(option, f"'{name}', no meter of a bench", expected, nearest_choice(name, choices))


def _state(bench: Bench, channel: ChannelName, text: str, faults: list[Fault]) -> None:
    warm = channel.dimension is Dimension.TEMPERATURE
    share = "" if warm else ", or a share, such as 0.2%"
    example = f"a sigma above 0 in {difference_unit(channel)}, such as 0.1 {difference_unit(channel)}{share}"
    try:
        stated = _sigma(channel, text)
    except QuantityError as reason:
        faults.append(Fault(OPTION, f"'{channel.value}={text}'", example, reason.nearest))
        return
    if not (stated.sigma or stated.share or 0.0) > 0.0:
        faults.append(Fault(OPTION, f"'{channel.value}={text}'", example))
        return
    bench.stated[channel] = stated


def _sigma(channel: ChannelName, text: str) -> Stated:
    """Return a sigma; raise QuantityError for a text that is not a sigma."""
    if text.endswith("%") and channel.dimension is not Dimension.TEMPERATURE:
        return Stated(share=parse_share(text))
    if channel.dimension is None:
        return Stated(sigma=parse_share(text))
    if channel.dimension is Dimension.TEMPERATURE:
        if not text.endswith("K"):
            raise QuantityError(repr(text), "a difference of temperatures in K")
        return Stated(sigma=parse_share(text.removesuffix("K")))
    return Stated(sigma=parse_quantity(text, channel.dimension))
