"""Readings that no pump has: units wrong by a factor, gauge for absolute, swapped channels."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.model import Circuit, DataNote, NoteKind, RecordedChannel, Recording
from diagnosis.recording.units import OTHER_UNITS
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName
from system.inputs.units import STANDARD_ATMOSPHERE, Dimension, format_quantity, unit_scale

LIKELY = {
    Dimension.ANGULAR_SPEED: (1.0, 2000.0),
    Dimension.TEMPERATURE: (233.15, 423.15),
    Dimension.VOLUME_FLOW: (0.0, 0.1),
    Dimension.TORQUE: (0.0, 5e4),
}
"""SI bounds of readings of a pump's bench (median of the magnitude): to 19000 rpm, -40 .. 150 degC, 6000 L/min."""
HIGHEST = 1e8  # Pa
LOWEST_DELIVERY = 2e5  # Pa gauge
FLOW_RATIO = (0.4, 1.15)  # Q_out over displacement x speed
INLET_RATIO = (0.4, 1.5)  # Q_in over the same
APART = 0.15  # share of a flow by which two groups of points differ that are not of one pump at one setting
LIKE = 0.5  # of a flow's step between groups, to which the torque's is equal
TORQUE_RATIO = (0.85, 2.5)  # torque over displacement x pressure difference
TRACE_RATIO = (0.5, 2.0)  # upper tenth of a chamber's pressure over p_out
CHARGED = 5e5  # Pa gauge: beyond it an inlet is charged
CASE_PRESSURE = (-3e4, 1e6)  # Pa gauge: no vacuum, and less than any shaft seal bears
HOTTEST = 383.15  # K: beyond, oil ages within hours
DRAIN_WARMER = (-1.0, 80.0)  # K, T_case less T_in: leakage has been throttled
BULK_MODULUS = 1.6e9  # Pa, within a fifth for any mineral oil in use
FLOW_SHARE = 0.005  # of a flow to which meters agree
SEVERAL = "two pumps or settings in one recording; a recording for each"
Ratio = Callable[[Recording], float | None]
Marks = NDArray[np.bool_]
_RATIO = ChannelName.DISPLACEMENT_RATIO
_TENFOLD = (("large", 0.1), ("small", 10.0))
_DIRECTED = (ChannelName.SPEED, ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE, ChannelName.TORQUE)
"""Counted in the direction of a pump: from inlet to delivery, out of the case, driven."""


def implausible(recording: Recording, displacement: float | None) -> Iterator[DataNote]:
    """Yield faults of units, references and places of channels, by size alone.

    displacement in m3/rev, or None. Flow is compared with displacement x speed, torque with displacement x
    pressure difference over 2 pi, both at the points' displacement ratios; medians over the points.
    """
    sizes = list(_sizes(recording))
    yield from sizes
    yield from _references(recording)
    yield from _places(recording)
    yield from _balance(recording)
    yield from _signs(recording)
    yield from _case(recording)
    if displacement is not None and not sizes:
        yield from _ratios(recording, displacement)
        yield from _groups(recording, displacement)


def _sizes(recording: Recording) -> Iterator[DataNote]:
    """Channels whose readings are beyond the range of a bench."""
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
    """Allowed range of a median, or of its ratio to the expected value."""

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
    text = f"{channel.name.value} is {shown:.3g} {channel.unit} at half of the points, beyond any pump's bench"
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
    """Flows and torque that do not go with the pump's size."""

    def flow_of(name: ChannelName) -> Ratio:
        return lambda given: _median(given.steady.column(name) / _swept(given, displacement))

    def torque_of(given: Recording) -> float | None:
        return _median(_torque_ratio(given, displacement))

    plate = _other_displacement(flow_of(ChannelName.Q_OUT)(recording), torque_of(recording), displacement)
    swap = _swapped(recording, flow_of(ChannelName.Q_OUT), torque_of)
    for name, span in ((ChannelName.Q_OUT, _Span(*FLOW_RATIO)), (ChannelName.Q_IN, _Span(*INLET_RATIO))):
        text = f"{name.value} is {{:.3g}} times displacement x speed at half of the points"
        also = plate | swap.get(name, {})
        yield from _ratio_fault(recording, flow_of(name), text, (name, ChannelName.SPEED), span, also)
    text = "torque is {:.3g} times displacement x pressure difference / 2 pi at half of the points"
    names = (ChannelName.TORQUE, ChannelName.P_OUT, ChannelName.P_IN)
    torque = recording.channel(ChannelName.TORQUE)
    own = 1.0 if torque is None else unit_scale(torque.unit, Dimension.TORQUE)[0]
    power = {"torque is the shaft's power in kW": 1e3 / own / recording.steady.column(ChannelName.SPEED)}
    also = plate | power | swap.get(ChannelName.TORQUE, {})
    yield from _ratio_fault(recording, torque_of, text, names, _Span(*TORQUE_RATIO), also)


def _swapped(recording: Recording, flow: Ratio, torque: Ratio) -> dict[ChannelName, dict[str, Array]]:
    """Factors (N,) by which delivery flow and torque have each other's numbers, in words; empty where these do not fit.

    flow, torque: medians over those of the pump file's displacement.
    """
    pair = (ChannelName.Q_OUT, ChannelName.TORQUE)
    units = [recording.channel(name) for name in pair]
    numbers = [
        recording.steady.column(name) / unit_scale(one.unit, name.dimension)[0]
        for name, one in zip(pair, units, strict=True)
        if one is not None and name.dimension is not None
    ]
    if len(numbers) < len(pair):
        return {}
    by = numbers[1] / numbers[0]
    other = _scaled(_scaled(recording, pair[0], by), pair[1], 1.0 / by)
    ratios = flow(other), torque(other)
    if ratios[0] is None or ratios[1] is None:
        return {}
    fits = _Span(*FLOW_RATIO).holds(ratios[0]) and _Span(*TORQUE_RATIO).holds(ratios[1])
    words = "the columns of Q_out and torque swapped"
    return {pair[0]: {words: by}, pair[1]: {words: 1.0 / by}} if fits else {}


def _other_displacement(flow: float | None, torque: float | None, displacement: float) -> dict[str, Array]:
    """The displacement in words that agrees with flow and torque, and the factor on a channel with the same effect.

    flow, torque: medians over those of the pump file's displacement. Empty where no displacement agrees with both.
    """
    if flow is None or torque is None or flow <= 0.0 or not _Span(*TORQUE_RATIO).holds(torque / flow):
        return {}
    meant = format_quantity(displacement * flow, Dimension.DISPLACEMENT, digits=2)
    return {f"pump.displacement of the pump file about {meant}": np.array(1.0 / flow)}


def _swept(recording: Recording, displacement: float) -> Array:
    """Displacement x speed, m3/s, at the points' displacement ratios; full if not recorded."""
    ratio = recording.steady.column(ChannelName.DISPLACEMENT_RATIO)
    swept: Array = np.where(np.isfinite(ratio), ratio, 1.0) * recording.steady.column(ChannelName.SPEED)
    return displacement / (2.0 * math.pi) * swept


def _torque_ratio(recording: Recording, displacement: float) -> Array:
    """Torque over displacement x pressure difference over 2 pi, (N,), at the points' displacement ratios."""
    column = recording.steady.column
    rise = column(ChannelName.P_OUT) - np.nan_to_num(column(ChannelName.P_IN))
    ideal = _swept(recording, displacement) / column(ChannelName.SPEED) * rise
    return np.asarray(column(ChannelName.TORQUE) / ideal)


def _ratio_fault(
    recording: Recording,
    ratio: Ratio,
    text: str,
    names: tuple[ChannelName, ...],
    span: _Span,
    also: Mapping[str, Array] = MappingProxyType({}),
) -> Iterator[DataNote]:
    """A fault of a ratio beyond its span, with each unit, power of ten or sign of a channel that would correct it.

    also: factors (N,) on the first channel by their meaning; those that correct the ratio are listed as well.
    """
    found = ratio(recording)
    if found is None or span.holds(found):
        return

    def mends(name: ChannelName, factor: float | Array) -> bool:
        mended = ratio(_scaled(recording, name, factor))
        return mended is not None and span.holds(mended)

    ways = [words for words, by in also.items() if mends(names[0], by)]
    for name in names:
        channel = recording.channel(name)
        if channel is None or name.dimension is None:
            continue
        own = unit_scale(channel.unit, name.dimension)[0]
        changes = {unit: unit_scale(unit, name.dimension)[0] / own for unit in OTHER_UNITS[name.dimension]}
        ways += [
            f"{name.value} in '{unit}'" for unit, by in changes.items() if not math.isclose(by, 1) and mends(name, by)
        ]
        ways += [f"{name.value} too {word} by a factor of 10" for word, by in _TENFOLD if mends(name, by)]
        ways += [f"{name.value} of the other sign"] * (name in _DIRECTED and mends(name, -1.0))
    if recording.channel(_RATIO) is not None:
        shares = (("1", 100.0), ("%", 0.01))
        ways += [f"displacement_ratio in '{unit}'" for unit, by in shares if mends(_RATIO, by)]
    hint = f"; {' or '.join(ways)}?" if ways else ""
    yield DataNote(NoteKind.FAULT, names[0], (), text.format(found) + hint)


def _scaled(recording: Recording, name: ChannelName, factor: float | Array) -> Recording:
    """The recording with one channel's readings times a factor, or one a point."""
    values = recording.steady.values.copy()
    values[:, list(ChannelName).index(name)] *= factor
    return replace(recording, steady=replace(recording.steady, values=values))


def _references(recording: Recording) -> Iterator[DataNote]:
    """Absolute pressures read as gauge ones and the reverse, by their sizes."""
    for name in (ChannelName.P_IN, ChannelName.P_CASE):
        middle = _median(recording.steady.column(name))
        if middle is None:
            continue
        if middle < -0.9 * STANDARD_ATMOSPHERE:
            text = f"{name.value} is {middle / 1e5:.2f} bar gauge, a vacuum: a gauge pressure taken as absolute?"
            yield DataNote(NoteKind.FAULT, name, (), text)
        elif name is ChannelName.P_IN and recording.circuit is Circuit.OPEN and middle > CHARGED:
            text = f"p_in of an open circuit is {middle / 1e5:.1f} bar gauge, above any tank's; circuit = 'closed'?"
            yield DataNote(NoteKind.WARNED, name, (), text)
        elif name is ChannelName.P_IN and recording.circuit is Circuit.OPEN and abs(middle - 1e5) < 0.15e5:
            text = f"p_in of an open circuit is {middle / 1e5:.2f} bar gauge: an absolute pressure taken as gauge?"
            yield DataNote(NoteKind.WARNED, name, (), text)


def _places(recording: Recording) -> Iterator[DataNote]:
    """Channels that seem to be swapped."""
    steady = recording.steady
    rise = _median(steady.column(ChannelName.P_OUT) - steady.column(ChannelName.P_IN))
    if rise is not None and rise < 0.0:
        mended = _median(10.0 * steady.column(ChannelName.P_OUT) - steady.column(ChannelName.P_IN))
        ten = "; p_out too small, or p_in too large, by a factor of 10?" if mended and mended > 0.0 else ""
        text = f"p_out is below p_in at half of the points: are they swapped?{ten}"
        yield DataNote(NoteKind.FAULT, ChannelName.P_OUT, (), text)
    drawn = steady.column(ChannelName.Q_IN) - steady.column(ChannelName.Q_OUT)
    lost: Array = drawn / np.abs(steady.column(ChannelName.Q_CASE))
    share = _median(lost)
    if share is not None and share < -0.3:
        text = "Q_in is below Q_out at half of the points, while oil leaves by the case: are they swapped?"
        yield DataNote(NoteKind.WARNED, ChannelName.Q_IN, (), text)


def _signs(recording: Recording) -> Iterator[DataNote]:
    """Channels that read below zero where a pump's read above."""
    for name in _DIRECTED:
        middle = _median(recording.steady.column(name))
        if middle is not None and middle < 0.0:
            text = f"{name.value} is below zero at half of the points or more: of the other sign?"
            yield DataNote(NoteKind.FAULT, name, (), text)


def _case(recording: Recording) -> Iterator[DataNote]:
    """Warnings of unusual pressures and temperatures of the case and of the drain."""
    steady = recording.steady
    pressure = _median(steady.column(ChannelName.P_CASE))
    if pressure is not None and not CASE_PRESSURE[0] <= pressure <= CASE_PRESSURE[1]:
        way = "a gauge pressure taken as absolute" if pressure < 0.0 else "another unit"
        text = f"p_case is {pressure / 1e5:.3g} bar gauge at half of the points: {way}?"
        yield DataNote(NoteKind.WARNED, ChannelName.P_CASE, (), text)
    for name in (ChannelName.T_IN, ChannelName.T_CASE):
        middle = _median(steady.column(name))
        if middle is not None and middle > HOTTEST:
            text = f"{name.value} is {middle - 273.15:.3g} degC at half of the points; unit = 'degF'?"
            yield DataNote(NoteKind.WARNED, name, (), text)
    warmer = _median(steady.column(ChannelName.T_CASE) - steady.column(ChannelName.T_IN))
    if warmer is not None and not DRAIN_WARMER[0] <= warmer <= DRAIN_WARMER[1]:
        text = f"T_case less T_in is {warmer:+.3g} K at half of the points: a wrong unit, or are they swapped?"
        yield DataNote(NoteKind.WARNED, ChannelName.T_CASE, (), text)


def trace_sizes(recording: Recording) -> Iterator[DataNote]:
    """Yield a fault of chamber pressures that in half of the traces stay far below delivery's or pass it far."""
    channel, span = recording.channel(ChannelName.P_CHAMBER), _Span(*TRACE_RATIO)
    delivered = recording.steady.column(ChannelName.P_OUT)
    tops = np.array([np.quantile(trace.mean, 0.9) for trace in recording.traces])
    ratio = _median(tops / np.array([delivered[trace.point] for trace in recording.traces]))
    if channel is not None and ratio is not None and not span.holds(ratio):
        text = f"p_chamber reaches {ratio:.3g} times p_out in half of the traces{_meant(channel, ratio, span)}"
        yield DataNote(NoteKind.FAULT, ChannelName.P_CHAMBER, (), text)


def _groups(recording: Recording, displacement: float) -> Iterator[DataNote]:
    """Flows in two groups, a tenth of the points or more in each, that one pump at one setting does not have.

    A fault where the torque steps by as much between the same points: a step of the flow alone may be due to a meter,
    or to a starved inlet.
    """
    swept = _swept(recording, displacement)
    for name in (ChannelName.Q_IN, ChannelName.Q_OUT):
        flow = recording.steady.column(name) / swept
        shares = np.sort(flow[np.isfinite(flow)])
        tenth = max(2, math.ceil(0.1 * len(shares)))
        steps = np.diff(shares)[tenth - 1 : len(shares) - tenth]
        if not len(steps) or steps.max() < APART * abs(float(np.median(shares))):
            continue
        at = tenth + int(np.argmax(steps))
        found = (
            f"{name.value} over displacement x speed is {np.median(shares[:at]):.2g} at {at} points and "
            f"{np.median(shares[at:]):.2g} at {len(shares) - at}"
        )
        above = flow > 0.5 * (shares[at - 1] + shares[at])
        step, torque = (_step(each, above) for each in (flow, _torque_ratio(recording, displacement)))
        if step is not None and torque is not None and abs(torque - step) <= LIKE * step:
            yield DataNote(NoteKind.FAULT, name, (), f"{found}, torque over displacement x pressure alike: {SEVERAL}")
        else:
            yield DataNote(NoteKind.NOTED, name, (), f"{found}: two pumps or settings in one recording?")
        return


def _step(ratio: Array, above: Marks) -> float | None:
    """Step of the logarithm of a ratio (N,) to the points above from the rest; None where one has no positive ratio."""
    known = np.isfinite(ratio) & (ratio > 0.0)
    if not (known & above).any() or not (known & ~above).any():
        return None
    return math.log(np.median(ratio[known & above]) / np.median(ratio[known & ~above]))


def _balance(recording: Recording) -> Iterator[DataNote]:
    """Case flow a power of ten beyond inlet less delivery flow, with compression."""
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
    """Median of the finite values, or None."""
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else None
