"""Recorded chamber pressures against simulated ones, and the events of the ports that explain them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diagnosis.recording.model import RecordedChannel, Recording, TraceBlock, reading_sigma
from diagnosis.study.model import PortEvent, TraceMisfit
from diagnosis.study.traces.bench import TracedBench
from diagnosis.study.traces.fit import MOVING, settled_traces
from reynolds.numerics.arrays import Array
from system.bench.parameters import groove_parameters
from system.bench.sensors import encoder_parameter, transducer_parameters
from system.bench.simulator import LumpedBench
from system.description.pump import PumpDescription
from system.estimation.parameters import Parameter
from system.estimation.posterior import values_at
from system.inputs.channels import ChannelName
from system.inputs.units import TURN
from system.pump.lumped import port_openings
from system.pump.ports.areas import PortOpening

LINE_LAG = 1e-4  # s, one sigma: a transducer behind a bore follows within a degree at 1500 r/min
NO_ENCODER = 1e-6  # rad: one sigma of an encoder that is stated to be without offset


def trace_parameters(recording: Recording) -> tuple[Parameter, ...]:
    """Parameters of traces with hardly any effect on steady readings: encoder, transducer, relief grooves.

    None for a recording without traces.
    """
    transducer, encoder = recording.channel(ChannelName.P_CHAMBER), recording.channel(ChannelName.ANGLE)
    if transducer is None or not recording.traces:
        return ()
    offset = max(NO_ENCODER, 0.0 if encoder is None else encoder.zero_sigma)
    return (encoder_parameter(offset), *transducer_parameters(transducer, LINE_LAG), *groove_parameters())


def trace_misfits(traced: TracedBench, channel: RecordedChannel, reach: float) -> tuple[TraceMisfit, ...]:
    """The recorded traces less the simulated ones, and their nuisances.

    The simulation is the best fit within `reach` spreads of the prior mean (`settled_traces`). An angle is known
    to its step only, and a steep pressure by the same step.
    """
    settled = settled_traces(traced, reach)
    blocks = [row.block for row in traced.rows]
    return tuple(_misfit(block, channel, traced.bench.finely((block.point,)), settled) for block in blocks)


def port_events(pump: PumpDescription) -> tuple[PortEvent, ...]:
    """Events of the ports of a valve plate over the turn, by shaft angle in [0, 2 pi)."""
    found = []
    for name, port in zip(("suction", "delivery"), port_openings(pump), strict=True):
        found += [PortEvent((float(port.dead_centre) + angle) % TURN, f"{name} {text}") for angle, text in _of(port)]
    dead_centres = (PortEvent(0.0, "inner dead centre"), PortEvent(np.pi, "outer dead centre"))
    return tuple(sorted((*found, *dead_centres), key=lambda event: event.angle))


def _of(port: PortOpening) -> Iterator[tuple[float, str]]:
    for groove in port.grooves:
        ahead = groove.begins < groove.deep
        yield groove.begins, "groove begins to open" if ahead else "groove is shut"
        yield groove.deep, "groove is open" if ahead else "groove begins to close"
    yield port.kidney_start, "kidney begins to open"
    yield port.kidney_full_start, "kidney is open"
    yield port.kidney_full_end, "kidney begins to close"
    yield port.kidney_end, "kidney is shut"


def _misfit(trace: TraceBlock, channel: RecordedChannel, bench: LumpedBench, settled: Array) -> TraceMisfit:
    def simulated(xi: Array) -> Array:
        return bench.turns(values_at(bench.parameters, xi), trace.angle)[0]

    plain = simulated(settled)
    moving = [at for at, parameter in enumerate(bench.parameters) if parameter.name in MOVING]
    moved = [simulated(settled + (np.arange(settled.size) == at)) - plain for at in moving]
    rise = 0.5 * (np.roll(plain, -1) - np.roll(plain, 1))
    noise = np.hypot(reading_sigma(channel, trace.mean), channel.quantum / np.sqrt(12.0)) / np.sqrt(trace.cycles)
    sigma = np.hypot(noise, rise / np.sqrt(12.0))
    return TraceMisfit(trace, trace.mean - plain, np.stack(moved, axis=1), sigma)
