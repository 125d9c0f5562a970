"""Responses of a bench's readings at points before any is recorded: to uncertain parameters, and to every suspect.

All readings are the expected ones, at the prior mean of the pump's parameters; changes are to first order.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from diagnosis.next_point.operating_box import rows
from diagnosis.recording.model import Circuit, RecordedChannel, Recording, SteadyTable, TraceBlock
from diagnosis.study.inputs import WARMER
from diagnosis.study.map_axes import scaled_axes
from diagnosis.study.model import Candidate, PumpSimulator, Study, entry_candidates, study_of
from diagnosis.study.prepare import meter_parameters, uncertain_parameters
from diagnosis.study.readings import observations
from diagnosis.study.traces.bench import traced_bench
from diagnosis.study.traces.misfits import trace_parameters
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.bench.outputs import METERED
from system.bench.points import BenchPoints
from system.bench.simulator import LumpedBench
from system.description.pump import PumpDescription
from system.description.tolerances import Tolerances
from system.effects.catalogue.entries import CATALOGUE
from system.effects.extension import Entry
from system.estimation.observations import Observations
from system.estimation.parameters import Parameter
from system.estimation.posterior import values_at
from system.estimation.whitening import Whitening, whitener
from system.inputs.channels import INPUTS, ChannelName
from system.work.progress import Report, silent

TURN_ANGLES = 720
"""Readings of a trace over a turn."""
DRAIN_ZERO = f"{ChannelName.T_CASE.value}.zero"


@dataclass(frozen=True)
class White:
    """Responses of one bench's readings in sigma of a reading: m readings at each of N points.

    slopes: (N, m, k), to one sigma of each uncertain parameter; columns: (N, m, Q), to one spread of each candidate.
    """

    slopes: Array
    columns: Array


@dataclass(frozen=True)
class Responses:
    """Expected readings of all C channels at N points, SI, with their changes.

    slopes: (N, C, k), by one sigma of each of `parameters`; columns: (N, C, Q), by one spread of each candidate;
    input_slopes: (N, C, M), SI per SI.
    """

    readings: Observations
    parameters: tuple[Parameter, ...]
    slopes: Array
    columns: Array
    input_slopes: Array

    def white(self, channels: Collection[str]) -> White:
        """The responses of a bench with these channels; its drain has about the inlet's temperature if it has no
        thermometer there.
        """
        read = [at for at, one in enumerate(self.readings.channels) if one.name in channels]
        given = [at for at, name in enumerate(self.readings.inputs) if name in channels]
        own = replace(
            self.readings,
            channels=tuple(self.readings.channels[at] for at in read),
            values=self.readings.values[:, read],
            sigma=self.readings.sigma[:, read],
            inputs=tuple(self.readings.inputs[at] for at in given),
            input_sigma=self.readings.input_sigma[:, given],
            quantum=self.readings.quantum[read],
        )
        whitening = whitener(own, self.input_slopes[:, read][..., given])
        scale = np.array([self._taken(one, channels) for one in self.parameters])
        return White(_laid_out(whitening, self.slopes[:, read] * scale), _laid_out(whitening, self.columns[:, read]))

    @staticmethod
    def _taken(parameter: Parameter, channels: Collection[str]) -> float:
        """Factor on one sigma of a parameter on this bench: larger for inputs that are assumed, not measured."""
        if parameter.name == DRAIN_ZERO and ChannelName.T_CASE.value not in channels:
            return WARMER / parameter.spread
        return 1.0


def _laid_out(whitening: Whitening, changes: Array) -> Array:
    """Whitened changes (N, m, ...) of readings (N, m, ...); 0 for a number that a point does not have."""
    found = np.zeros_like(changes)
    found[whitening.measured] = whitening.whiten(changes)
    return found


@dataclass(frozen=True)
class Foreseen:
    """A bench before its campaign: all points with their responses, and the study with every candidate."""

    study: Study
    responses: Responses
    bench: LumpedBench

    @property
    def points(self) -> BenchPoints:
        """The N points."""
        return self.bench.points

    @property
    def candidates(self) -> tuple[Candidate, ...]:
        """The columns of the responses, in their order."""
        return self.study.candidates


def foresee(
    pump: PumpDescription,
    points: BenchPoints,
    meters: tuple[RecordedChannel, ...],
    tolerances: Tolerances,
    thresholds: Thresholds,
    catalogue: Sequence[Entry] = CATALOGUE,
    report: Report = silent,
) -> Foreseen:
    """Responses of all steady channels to the candidates of a catalogue.

    Raises NotConverged as the bench does.
    """
    recording = _recording(pump, points, meters)
    bench = LumpedBench(pump, points, METERED, _parameters(pump, recording, tolerances), inputs=INPUTS)
    centre = values_at(bench.parameters, np.zeros(len(bench.parameters)))
    recording = _with_readings(recording, bench.predict(centre))
    steady = observations(recording, METERED, INPUTS)
    bare = study_of(recording, bench, steady, scaled_axes(recording), (), thresholds)
    study = _with_candidates(bare, catalogue, thresholds, report)
    return Foreseen(study, _responses(study, centre), bench)


def foresee_traces(
    foreseen: Foreseen,
    channels: Collection[str],
    points: tuple[int, ...],
    thresholds: Thresholds,
    report: Report = silent,
) -> White:
    """Responses of chamber traces at some of the points on a bench of some channels, to the same candidates."""
    study, chosen = foreseen.study, np.array(points)
    bench = foreseen.bench.elsewhere(rows(foreseen.points, chosen))
    centre = values_at(bench.parameters, np.zeros(len(bench.parameters)))
    angles = 2.0 * np.pi * np.arange(TURN_ANGLES) / TURN_ANGLES
    turns = bench.traces(centre, tuple(range(len(points))), angles)
    blocks = tuple(TraceBlock(at, angles, turn, None, 1) for at, turn in enumerate(turns))
    transducer = study.recording.channel(ChannelName.P_CHAMBER)
    if transducer is None:
        raise ValueError("no chamber transducer among the meters")
    recording = replace(study.recording, steady=study.recording.steady.at(chosen), traces=blocks)
    traced = traced_bench(bench, blocks, transducer)
    whole = traced.observations(observations(recording, METERED, INPUTS))
    bare = study_of(recording, traced, whole, scaled_axes(recording), (), thresholds)
    wanted = {one.entry.id for one in study.candidates}
    own = _with_candidates(bare, [one for one in CATALOGUE if one.id in wanted], thresholds, report)
    known = {_key(one): one for one in own.candidates}
    empty = np.zeros(len(own.base.residual))
    aligned = tuple(
        replace(one, column=known[_key(one)].column if _key(one) in known else empty) for one in study.candidates
    )
    found = _responses(replace(own, candidates=aligned), centre)
    inputs = {one.value for one in INPUTS if one.value in channels}
    return found.white({ChannelName.P_CHAMBER.value, *inputs})


def expected_parameters(
    pump: PumpDescription, meters: tuple[RecordedChannel, ...], tolerances: Tolerances
) -> tuple[Parameter, ...]:
    """All uncertain parameters of pump and meters, those of traces too."""
    one = BenchPoints(**{field.name: np.full(1, np.nan) for field in fields(BenchPoints)})
    return _parameters(pump, _recording(pump, one, meters), tolerances)


def _parameters(pump: PumpDescription, recording: Recording, tolerances: Tolerances) -> tuple[Parameter, ...]:
    angle = np.zeros(1)
    traced = replace(recording, traces=(TraceBlock(0, angle, angle, None, 1),))
    meters = meter_parameters(recording, METERED)
    return (*uncertain_parameters(pump, tolerances), *meters, *trace_parameters(traced))


def _recording(pump: PumpDescription, points: BenchPoints, meters: tuple[RecordedChannel, ...]) -> Recording:
    count, names = len(points.speed), list(ChannelName)
    values = np.full((count, len(names)), np.nan)
    for name in INPUTS:
        values[:, names.index(name)] = getattr(points, name.value)
    steady = SteadyTable(values, np.arange(count), np.full(count, np.nan), np.full_like(values, np.nan))
    return Recording("plan", pump.name, "", Circuit.CLOSED, meters, steady, (), ())


def _with_readings(recording: Recording, expected: Array) -> Recording:
    values = recording.steady.values.copy()
    for at, name in enumerate(METERED):
        values[:, list(ChannelName).index(name)] = expected[:, at]
    return replace(recording, steady=replace(recording.steady, values=values))


def _with_candidates(study: Study, catalogue: Sequence[Entry], thresholds: Thresholds, report: Report) -> Study:
    """The study with every candidate of the catalogue."""
    found: list[Candidate] = []
    simulator: PumpSimulator = study.simulator
    for number, entry in enumerate(catalogue):
        report(number, len(catalogue), f"readings with {entry.id.value.replace('_', ' ')}")
        found += entry_candidates(entry, simulator, study.base, thresholds.name.fault_factor, study.place)
    return replace(study, candidates=tuple(found))


def _responses(study: Study, centre: Array) -> Responses:
    base = study.base
    columns = np.stack([one.column for one in study.candidates], axis=1)
    return Responses(
        readings=study.observations,
        parameters=base.parameters,
        slopes=base.whitening.unwhiten(base.slopes),
        columns=base.whitening.unwhiten(columns),
        input_slopes=study.simulator.input_slopes(centre),
    )


def _key(one: Candidate) -> tuple[str, str, int]:
    return one.entry.id.value, one.parameter, one.grid
