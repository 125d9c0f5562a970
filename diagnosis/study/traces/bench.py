"""A bench whose chamber is recorded over the turn at some points: traces are further channels of its readings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from diagnosis.recording.model import RecordedChannel, TraceBlock
from diagnosis.study.traces.rows import TraceRows, trace_rows
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.bench.simulator import INPUT_STEPS, LumpedBench
from system.effects.components import Component
from system.effects.extension import Extension
from system.estimation.observations import Channel, Observations
from system.estimation.parameters import Parameter
from system.estimation.posterior import values_at
from system.inputs.channels import ChannelName


@dataclass(frozen=True, eq=False)
class TracedBench:
    """A bench of C channels whose readings (N, C + F) include F numbers of the traces at their points.

    rows: of each trace; fine: the bench at their points, in their order. Elsewhere the F numbers are 0, and not
    measured.
    """

    bench: LumpedBench
    fine: LumpedBench
    rows: tuple[TraceRows, ...]

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Those of the bench; the order of every vector of values."""
        return self.bench.parameters

    def predict(self, values: Array) -> Array:
        """Readings (N, C + F). Raises NotConverged."""
        return self._beside(self.bench.predict(values), self.numbers(values))

    def difference(self, values: Array, other: Array) -> Array:
        """Readings (N, C + F) at `other` values less those at `values`: of the bench's kind, of traces exact."""
        change = self._numbers(self.fine, other) - self._numbers(self.fine, values)
        return self._beside(self.bench.difference(values, other), change)

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d readings / d value of the named parameters, (N, C + F, len(names)), by differences."""
        return self._beside(self.bench.slopes(values, names), self.number_slopes(values, names))

    def input_slopes(self, values: Array) -> Array:
        """d readings / d input, (N, C + F, M), in SI per SI."""
        here, changes = self._numbers(self.fine, values), []
        for channel in self.bench.inputs:
            at, step = self.fine.points, INPUT_STEPS[channel]
            moved = replace(at, **{channel.value: getattr(at, channel.value) + step})
            changes.append((self._numbers(self.fine.elsewhere(moved), values) - here) / step)
        return self._beside(self.bench.input_slopes(values), np.stack(changes, axis=-1))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> TracedBench:
        """The same with these parameters: replaced where a name is there already, added where not."""
        return replace(self, bench=self.bench.with_parameters(parameters), fine=self.fine.with_parameters(parameters))

    def with_extensions(self, extensions: tuple[Extension, ...]) -> TracedBench:
        """The same with these laws beside those it has."""
        return replace(self, bench=self.bench.with_extensions(extensions), fine=self.fine.with_extensions(extensions))

    def elsewhere(self, points: BenchPoints) -> LumpedBench:
        """The bench at other points, where its chamber is not recorded."""
        return self.bench.elsewhere(points)

    def traces(self, values: Array, points: tuple[int, ...], angles: Array) -> Array:
        """Chamber pressure (len(points), K) in Pa gauge at shaft angles (K,) rad, as read."""
        return self.bench.traces(values, points, angles)

    def components(self, values: Array) -> Mapping[Component, Array]:
        """Contribution (N, C + F) of each component; a multiple of one has no meaning for the traces."""
        nothing = np.zeros_like(self._numbers(self.fine, values))
        return {part: self._beside(added, nothing) for part, added in self.bench.components(values).items()}

    def observations(self, steady: Observations) -> Observations:
        """The steady readings (N, C) with the numbers of the traces beside them."""
        values = self._beside(steady.values, self.recorded, np.nan)
        noise = np.ones((len(steady.values), self._count))
        return replace(
            steady,
            channels=(*steady.channels, *self._channels),
            values=values,
            sigma=np.hstack([steady.sigma, noise]),
            quantum=np.concatenate([steady.quantum, np.zeros(self._count)]),
        )

    def trace_observations(self) -> Observations:
        """The numbers (T, F) of the T traces alone."""
        recorded = self.recorded
        count = len(recorded)
        noise, none = np.ones_like(recorded), np.zeros((count, 0))
        return Observations(self._channels, recorded, noise, (), none, np.zeros(self._count), np.arange(count))

    @property
    def recorded(self) -> Array:
        """(T, F), of the recorded traces; nan beyond the numbers of a trace that has fewer."""
        found = np.full((len(self.rows), self._count), np.nan)
        for own, row in zip(found, self.rows, strict=True):
            own[: len(row.weights)] = row.values
        return found

    def numbers(self, values: Array) -> Array:
        """(T, F), of the traces as simulated; 0 beyond those of a trace that has fewer. Raises NotConverged."""
        return self._numbers(self.fine, values)

    def number_slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d numbers / d value of the named parameters, (T, F, len(names)), by differences."""
        here, own = self.numbers(values), [parameter.name for parameter in self.parameters]
        columns = np.zeros((*here.shape, len(names)))
        for at, name in enumerate(names):
            moved = np.array(values, dtype=float)
            step = self.fine.step_of(name, values)
            moved[own.index(name)] += step
            columns[..., at] = (self.numbers(moved) - here) / step
        return columns

    @property
    def _channels(self) -> tuple[Channel, ...]:
        return (Channel(ChannelName.P_CHAMBER.value, None),) * self._count

    @property
    def _count(self) -> int:
        return max(len(row.weights) for row in self.rows)

    def _numbers(self, fine: LumpedBench, values: Array) -> Array:
        """(T, F), of the T traces as simulated; those of one raster are read together."""
        found = np.zeros((len(self.rows), self._count))
        for samples in {len(row.block.angle) for row in self.rows}:
            own = [at for at, row in enumerate(self.rows) if len(row.block.angle) == samples]
            turns = fine.turns(values, self.rows[own[0]].block.angle)
            for at in own:
                found[at, : len(self.rows[at].weights)] = self.rows[at].weights @ turns[at]
        return found

    def _beside(self, steady: Array, numbers: Array, elsewhere: float = 0.0) -> Array:
        """(N, C + F, ...): the numbers (T, F, ...) at their points, `elsewhere` at all others."""
        beside = np.full((len(steady), *numbers.shape[1:]), elsewhere)
        beside[[row.block.point for row in self.rows]] = numbers
        return np.concatenate([steady, beside], axis=1)


def traced_bench(bench: LumpedBench, traces: tuple[TraceBlock, ...], channel: RecordedChannel) -> TracedBench:
    """A bench with its traces, windows by its own turn at the prior mean."""
    fine = bench.finely(tuple(block.point for block in traces))
    centre = values_at(fine.parameters, np.zeros(len(fine.parameters)))
    rows = tuple(trace_rows(block, channel, fine.turns(centre, block.angle)[at]) for at, block in enumerate(traces))
    return TracedBench(bench, fine, rows)
