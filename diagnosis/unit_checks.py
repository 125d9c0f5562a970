"""Readings that no pump gives: units off by a factor, gauge for absolute, channels that have changed places."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from diagnosis.recording import Circuit, DataNote, NoteKind, RecordedChannel, Recording
from system.channels import ChannelName
from system.kinematics import Array
from system.units import STANDARD_ATMOSPHERE, Dimension, unit_scale

LIKELY = {
    Dimension.ANGULAR_SPEED: (1.0, 2000.0),
    Dimension.TEMPERATURE: (233.15, 423.15),
    Dimension.VOLUME_FLOW: (0.0, 0.1),
    Dimension.TORQUE: (0.0, 5e4),
}
"""SI bounds of what a pump's bench reads (median of the magnitude): to 19000 rpm, -40 .. 150 degC, 6000 L/min."""
HIGHEST = 1e8  # Pa
LOWEST_DELIVERY = 2e5  # Pa gauge
FLOW_RATIO = (0.4, 1.15)  # Q_out over displacement x speed
TORQUE_RATIO = (0.85, 2.5)  # torque over displacement x pressure difference
BULK_MODULUS = 1.6e9  # Pa, good to a fifth for any mineral oil in use
FLOW_SHARE = 0.005  # of a flow to which meters agree
OTHER_UNITS: Mapping[Dimension, tuple[str, ...]] = {
    Dimension.PRESSURE: ("bar", "MPa", "kPa", "psi", "Pa"),
    Dimension.ANGULAR_SPEED: ("rpm", "rad/s"),
    Dimension.VOLUME_FLOW: ("L/min", "m3/h", "mL/min", "gallon/min", "L/s", "m3/s"),
    Dimension.TORQUE: ("N m", "kN m", "lbf ft", "lbf inch"),
    Dimension.TEMPERATURE: ("degC", "degF", "K"),
}


def implausible(recording: Recording, displacement: float | None) -> Iterator[DataNote]:
    """Yield what is wrong with units, references and places of channels, by size alone.

    displacement in m3/rev, or None. Flow is held against displacement x speed, torque against displacement x
    pressure difference over 2 pi, both at the points' displacement ratios; medians over the points.
    """
    sizes = list(_sizes(recording))
    yield from sizes
    yield from _references(recording)
    yield from _places(recording)
    yield from _balance(recording)
    if displacement is not None and not sizes:
        yield from _ratios(recording, displacement)


def _sizes(recording: Recording) -> Iterator[DataNote]:
    """Channels whose readings are beyond what a bench reads."""
    for channel in recording.channels:
        values = recording.steady.column(channel.name)
        known = values[np.isfinite(values)]
        if channel.name.dimension is None and len(known) and channel.name is ChannelName.DISPLACEMENT_RATIO:
            if np.max(np.abs(known)) > 1.05:
                top = float(np.max(np.abs(known)))
                text = f"displacement_ratio up to {top:.3g}, at most 1 expected; unit = '%'?"
                yield DataNote(NoteKind.FAULT, channel.name, (), text)
            continue
        bounds = LIKELY.get(channel.name.dimension) if channel.name.dimension else None
        if channel.name.dimension is Dimension.PRESSURE:
            bounds = (LOWEST_DELIVERY if channel.name is ChannelName.P_OUT else 0.0, HIGHEST)
        if bounds is None or not len(known):
            continue
        middle = float(np.median(np.abs(known)))
        if not bounds[0] <= middle <= bounds[1]:
            yield _fault(channel, middle, _Span(*bounds))


@dataclass(frozen=True)
class _Span:
    """What a median, or its ratio to what is expected, may be."""

    lowest: float
    highest: float

    def holds(self, value: float) -> bool:
        """True within, bounds included."""
        return self.lowest <= value <= self.highest


def _fault(channel: RecordedChannel, middle: float, span: _Span) -> DataNote:
    dimension = channel.name.dimension
    assert dimension is not None
    factor, offset = unit_scale(channel.unit, dimension)
    shown = (middle - offset) / factor if dimension is Dimension.TEMPERATURE else middle / factor
    text = f"{channel.name.value} is {shown:.3g} {channel.unit} at half of the points, which no pump's bench reads"
    return DataNote(NoteKind.FAULT, channel.name, (), text + _meant(channel, middle, span))


def _meant(channel: RecordedChannel, found: float, span: _Span) -> str:
    """The units and powers of ten with which a value would be within its span, in words; empty without any."""
    dimension = channel.name.dimension
    assert dimension is not None
    own, own_offset = unit_scale(channel.unit, dimension)
    if dimension is not Dimension.TEMPERATURE:
        own_offset = 0.0  # of magnitudes; a pressure's offset is its reference
    ways = []
    for unit in OTHER_UNITS.get(dimension, ()):
        factor, offset = unit_scale(unit, dimension)
        if (factor, offset) != (own, own_offset) and span.holds((found - own_offset) / own * factor + offset):
            ways.append(f"unit = '{unit}'")
    ways += [f"a factor of {1.0 / power:g}" for power in (0.1, 10.0, 0.01, 100.0) if span.holds(found * power)]
    return f"; {' or '.join(ways)}?" if ways else ""


def _ratios(recording: Recording, displacement: float) -> Iterator[DataNote]:
    """Flow and torque that do not go with the pump's size."""
    steady = recording.steady
    speed, p_out, torque, flow = (
        steady.column(name)
        for name in (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.TORQUE, ChannelName.Q_OUT)
    )
    ratio, p_in = steady.column(ChannelName.DISPLACEMENT_RATIO), steady.column(ChannelName.P_IN)
    per_radian = displacement / (2.0 * math.pi) * np.where(np.isfinite(ratio), ratio, 1.0)
    volumetric = _median(flow / (per_radian * speed))
    mechanical = _median(torque / (per_radian * (p_out - np.nan_to_num(p_in))))
    flow_span, torque_span = _Span(*FLOW_RATIO), _Span(*TORQUE_RATIO)
    if volumetric is not None and not flow_span.holds(volumetric):
        text = f"Q_out is {volumetric:.3g} times displacement x speed at half of the points"
        yield _ratio_fault(recording, text, {ChannelName.Q_OUT: 1, ChannelName.SPEED: -1}, volumetric, flow_span)
    if mechanical is not None and not torque_span.holds(mechanical):
        text = f"torque is {mechanical:.3g} times displacement x pressure difference / 2 pi at half of the points"
        yield _ratio_fault(
            recording, text, {ChannelName.TORQUE: 1, ChannelName.P_OUT: -1}, mechanical, torque_span
        )


def _ratio_fault(
    recording: Recording, text: str, powers: Mapping[ChannelName, int], found: float, span: _Span
) -> DataNote:
    """A fault of a ratio of two channels, with the unit of either that would mend it."""
    for name, power in powers.items():
        channel = recording.channel(name)
        if channel is None or name.dimension is None:
            continue
        own = unit_scale(channel.unit, name.dimension)[0]
        for unit in OTHER_UNITS.get(name.dimension, ()):
            change = unit_scale(unit, name.dimension)[0] / own
            if not math.isclose(change, 1.0) and span.holds(found * change**power):
                text += f"; {name.value} in '{unit}'?"
    for power_of_ten in (0.1, 10.0):
        if span.holds(found * power_of_ten):
            text += f"; a factor of {1.0 / power_of_ten:g}?"
    return DataNote(NoteKind.FAULT, next(iter(powers)), (), text)


def _references(recording: Recording) -> Iterator[DataNote]:
    """Absolute pressures read as gauge ones and the reverse, where sizes tell."""
    for name in (ChannelName.P_IN, ChannelName.P_CASE):
        middle = _median(recording.steady.column(name))
        if middle is None:
            continue
        if middle < -0.9 * STANDARD_ATMOSPHERE:
            text = f"{name.value} is {middle / 1e5:.2f} bar gauge, a vacuum: a gauge pressure taken as absolute?"
            yield DataNote(NoteKind.FAULT, name, (), text)
        elif name is ChannelName.P_IN and recording.circuit is Circuit.OPEN and abs(middle - 1e5) < 0.15e5:
            text = f"p_in of an open circuit is {middle / 1e5:.2f} bar gauge: an absolute pressure taken as gauge?"
            yield DataNote(NoteKind.TOLD, name, (), text)


def _places(recording: Recording) -> Iterator[DataNote]:
    """Channels that seem to have changed places."""
    steady = recording.steady
    rise = _median(steady.column(ChannelName.P_OUT) - steady.column(ChannelName.P_IN))
    if rise is not None and rise < 0.0:
        text = "p_out is below p_in at half of the points: have they changed places?"
        yield DataNote(NoteKind.FAULT, ChannelName.P_OUT, (), text)
    drawn = steady.column(ChannelName.Q_IN) - steady.column(ChannelName.Q_OUT)
    lost: Array = drawn / np.abs(steady.column(ChannelName.Q_CASE))
    share = _median(lost)
    if share is not None and share < -0.3:
        text = "Q_in is below Q_out at half of the points, while oil leaves by the case: have they changed places?"
        yield DataNote(NoteKind.TOLD, ChannelName.Q_IN, (), text)


def _balance(recording: Recording) -> Iterator[DataNote]:
    """Case flow that is a power of ten beyond what goes in and does not come out, compression counted."""
    steady = recording.steady
    flow, case = steady.column(ChannelName.Q_OUT), steady.column(ChannelName.Q_CASE)
    squeezed = flow * (steady.column(ChannelName.P_OUT) - steady.column(ChannelName.P_IN)) / BULK_MODULUS
    lost = steady.column(ChannelName.Q_IN) - flow - squeezed
    doubt = 0.2 * np.abs(squeezed) + FLOW_SHARE * np.abs(flow)
    off = _median(np.abs(case - lost) / doubt)
    if off is None or off < 3.0:
        return
    for factor in (10.0, 100.0):
        mended = _median(np.abs(case / factor - lost) / doubt)
        if mended is not None and mended < 1.0:
            text = f"Q_case is far beyond Q_in less Q_out at half of the points; a factor of {factor:g}?"
            yield DataNote(NoteKind.FAULT, ChannelName.Q_CASE, (), text)
            return


def _median(values: Array) -> float | None:
    """Median of the finite values, None where there is none."""
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else None
