"""Recorded chamber pressures against simulated ones, and the events of the ports they are read by."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diagnosis.recording import RecordedChannel, Recording, TraceBlock, reading_sigma
from diagnosis.study import PortEvent, PumpSimulator, TraceMisfit
from system.channels import ChannelName
from system.description import PumpDescription
from system.estimation.observations import Array
from system.estimation.posterior import values_at
from system.lumped import port_openings
from system.physics.catalogue import entry_of
from system.physics.effects import EffectId
from system.ports import TURN, PortOpening
from system.sensors import encoder_parameter

MOVING = (
    "encoder_offset", "bulk_modulus", "dead_volume", "flow_coefficient", "stand_out_share", "p_out.zero",
    "film_thickness.piston", "film_thickness.slipper", "film_thickness.valve_plate", "viscosity",
)  # fmt: skip
"""Parameters that a chamber's pressure over the turn hangs on."""
GROOVES = tuple(law.members[0] for law in entry_of(EffectId.NOTCH_EROSION).extensions)
GROOVE_TOLERANCE = 0.3  # of the spread of eroded grooves: half a degree of their start, a tenth of their area
SMOOTHED = np.radians(1.0)  # over which a transducer and its bore smooth a pressure, one sigma
NO_ENCODER = 1e-6  # rad: one sigma of an encoder that is stated to be without offset


def trace_misfits(recording: Recording, simulator: PumpSimulator) -> tuple[TraceMisfit, ...]:
    """The recorded traces less those simulated at the prior mean, with what may explain them away.

    Beside the pump's own parameters: the offset of the encoder, gain, zero and smoothing of the pressure sensor,
    and the tolerance of the relief grooves. An angle is known to its step, so where pressure is steep it is not.
    """
    channel = recording.channel(ChannelName.P_CHAMBER)
    if channel is None:
        return ()
    encoder = recording.channel(ChannelName.ANGLE)
    offset = max(NO_ENCODER, 0.0 if encoder is None else encoder.zero_sigma)
    with_encoder = simulator.with_parameters((encoder_parameter(offset),))
    return tuple(_misfit(trace, channel, with_encoder) for trace in recording.traces)


def port_events(pump: PumpDescription) -> tuple[PortEvent, ...]:
    """What the ports of a valve plate do over the turn, by shaft angle in [0, 2 pi)."""
    found = []
    for name, port in zip(("suction", "delivery"), port_openings(pump), strict=True):
        found += [
            PortEvent((float(port.dead_centre) + angle) % TURN, f"{name} {text}") for angle, text in _of(port)
        ]
    dead_centres = (PortEvent(0.0, "inner dead centre"), PortEvent(np.pi, "outer dead centre"))
    return tuple(sorted((*found, *dead_centres), key=lambda event: event.angle))


def _of(port: PortOpening[float]) -> Iterator[tuple[float, str]]:
    for groove in port.grooves:
        ahead = groove.begins < groove.deep
        yield groove.begins, "groove begins to open" if ahead else "groove is shut"
        yield groove.deep, "groove is open" if ahead else "groove begins to close"
    yield port.kidney_start, "kidney begins to open"
    yield port.kidney_full_start, "kidney is open"
    yield port.kidney_full_end, "kidney begins to close"
    yield port.kidney_end, "kidney is shut"


def _misfit(trace: TraceBlock, channel: RecordedChannel, simulator: PumpSimulator) -> TraceMisfit:
    eroded = simulator.with_extensions(GROOVES)
    spreads = {parameter.name: GROOVE_TOLERANCE for law in GROOVES for parameter in law.parameters}
    spreads |= dict.fromkeys(MOVING, 1.0)
    start = np.zeros(len(eroded.parameters))

    def simulated(xi: Array) -> Array:
        return eroded.traces(values_at(eroded.parameters, xi), (trace.point,), trace.angle)[0]

    plain = simulated(start)
    moved = []
    for at, parameter in enumerate(eroded.parameters):
        if parameter.name in spreads:
            xi = start.copy()
            xi[at] = spreads[parameter.name]
            moved.append(simulated(xi) - plain)
    step = TURN / len(plain)
    steepness = (np.roll(plain, -1) - np.roll(plain, 1)) / (2.0 * step)
    bend = (np.roll(plain, -1) - 2.0 * plain + np.roll(plain, 1)) / step**2
    sensor = (channel.gain_sigma * plain, np.full_like(plain, channel.zero_sigma), 0.5 * SMOOTHED**2 * bend)
    noise = np.hypot(reading_sigma(channel, trace.mean), channel.quantum / np.sqrt(12.0)) / np.sqrt(trace.cycles)
    sigma = np.hypot(noise, steepness * step / np.sqrt(12.0))
    return TraceMisfit(trace, trace.mean - plain, np.stack([*moved, *sensor], axis=1), sigma)
