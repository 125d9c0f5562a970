"""A bench with a meter in a separate drain of each gap: leakage of the gaps as further channels of its readings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.outputs import Solved
from system.bench.points import BenchPoints
from system.bench.sensors import SENSOR_NAMES
from system.bench.simulator import INPUT_STEPS, LumpedBench
from system.description.gap import Gap
from system.effects.components import Component
from system.effects.extension import Extension
from system.estimation.parameters import Parameter
from system.inputs.channels import INPUTS
from system.inputs.units import TURN
from system.pump.power import chamber_exchange, gap_leakage

DRAINS: Mapping[Gap, str] = {gap: f"leak.{gap.value}" for gap in Gap}
"""Name of the channel of each gap's own drain."""
_INPUT_ZEROS = {f"{one.value}.zero" for one in INPUTS}


@dataclass(frozen=True, eq=False)
class DrainedBench:
    """A bench of C channels whose readings (N, C + 3) go on with the leakage of each gap, m3/s at case pressure."""

    bench: LumpedBench

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Those of the bench; the order of every vector of values."""
        return self.bench.parameters

    def predict(self, values: Array) -> Array:
        """Readings (N, C + 3). Raises NotConverged."""
        return np.hstack([self.bench.predict(values), self._leaks(values)])

    def difference(self, values: Array, other: Array) -> Array:
        """Readings (N, C + 3) at `other` values less those at `values`: of the bench's kind, of leakage exact."""
        return np.hstack([self.bench.difference(values, other), self._leaks(other) - self._leaks(values)])

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d readings / d value of the named parameters, (N, C + 3, len(names)), by differences."""
        here, own = self._leaks(values), [parameter.name for parameter in self.parameters]
        changes = np.zeros((*here.shape, len(names)))
        for at, name in enumerate(names):
            if name in SENSOR_NAMES and name not in _INPUT_ZEROS:
                continue
            moved, step = np.array(values, dtype=float), self.bench.step_of(name, values)
            moved[own.index(name)] += step
            changes[..., at] = (self._leaks(moved) - here) / step
        return np.concatenate([self.bench.slopes(values, names), changes], axis=1)

    def input_slopes(self, values: Array) -> Array:
        """d readings / d input, (N, C + 3, M), in SI per SI."""
        here, changes, points = self._leaks(values), [], self.bench.points
        for channel in self.bench.inputs:
            step = INPUT_STEPS[channel]
            moved = replace(points, **{channel.value: getattr(points, channel.value) + step})
            changes.append((leaks(self.bench.elsewhere(moved).solved(values)) - here) / step)
        return np.concatenate([self.bench.input_slopes(values), np.stack(changes, axis=-1)], axis=1)

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> DrainedBench:
        """The same with these parameters: replaced where a name is there already, added where not."""
        return DrainedBench(self.bench.with_parameters(parameters))

    def with_extensions(self, extensions: tuple[Extension, ...]) -> DrainedBench:
        """The same with these laws beside those it has."""
        return DrainedBench(self.bench.with_extensions(extensions))

    def elsewhere(self, points: BenchPoints) -> DrainedBench:
        """The same pump with the same parameters and laws at other points."""
        return DrainedBench(self.bench.elsewhere(points))

    def traces(self, values: Array, points: tuple[int, ...], angles: Array) -> Array:
        """Chamber pressure (len(points), K) in Pa gauge at shaft angles (K,) rad."""
        return self.bench.traces(values, points, angles)

    def components(self, values: Array) -> Mapping[Component, Array]:
        """Contribution (N, C + 3) of each component; leakage by gap is told by its own channel."""
        none = np.zeros_like(self._leaks(values))
        return {part: np.hstack([added, none]) for part, added in self.bench.components(values).items()}

    def _leaks(self, values: Array) -> Array:
        return leaks(self.bench.solved(values))


def leaks(solved: Solved) -> Array:
    """Leakage (N, 3) of the gaps in the order of `Gap`, m3/s at case pressure."""
    chamber, totals = solved.setting.problem.chamber, solved.courses.totals
    rate = solved.setting.pump.pump.pistons * chamber.shaft_speed / TURN
    found = gap_leakage(chamber, totals, rate, chamber_exchange(totals, rate))
    return np.column_stack([getattr(found, gap.value) + np.zeros_like(rate) for gap in Gap])
