"""A loss model as a simulator of a test bench: its coefficients are parameters, fitted like any others."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.bench.loss_models.model import LossModel, Term, columns
from system.bench.loss_models.points import LossPoints, loss_points
from system.bench.points import BenchPoints
from system.bench.simulator import INPUT_STEPS
from system.description.pump import PumpDescription
from system.estimation.observations import Observations
from system.estimation.parameters import Parameter, Role, Scale
from system.inputs.channels import ChannelName

MODELLED = (ChannelName.Q_OUT, ChannelName.TORQUE)
"""Channels that loss models give, in the order of every reading."""


@dataclass(frozen=True)
class LossModelBench:
    """Q_out in m3/s and torque in N m at N points by a loss model; a `system.estimation.simulator.Simulator`.

    Parameters are flow.NAME and torque.NAME, coefficients of unknown size: priors as wide as a loss of the pump's whole
    power, so that readings determine them. Coefficients with one physical sign have it.
    """

    model: LossModel
    pump: PumpDescription
    points: BenchPoints
    inputs: tuple[ChannelName, ...]
    parameters: tuple[Parameter, ...]

    def predict(self, values: Array) -> Array:
        """Readings (N, 2) in SI."""
        return self._read(loss_points(self.pump, self.points), values)

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d readings / d coefficient, (N, 2, len(names)); exact."""
        places = [[parameter.name for parameter in self.parameters].index(name) for name in names]
        return self._columns(loss_points(self.pump, self.points))[..., places]

    def input_slopes(self, values: Array) -> Array:
        """d readings / d input, (N, 2, M), by small steps."""
        before = self.predict(values)
        found = np.zeros((*before.shape, len(self.inputs)))
        for at, channel in enumerate(self.inputs):
            step = INPUT_STEPS[channel]
            moved = replace(self.points, **{channel.value: getattr(self.points, channel.value) + step})
            found[..., at] = (self._read(loss_points(self.pump, moved), values) - before) / step
        return found

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> LossModelBench:
        """The same model with other priors; raises InputError for a name that is no coefficient of it."""
        new = {parameter.name: parameter for parameter in parameters}
        own = tuple(new.pop(parameter.name, parameter) for parameter in self.parameters)
        if new:
            known = ", ".join(parameter.name for parameter in own)
            raise InputError("loss model", ", ".join(new), f"coefficients among {known}")
        return replace(self, parameters=own)

    def _columns(self, points: LossPoints) -> Array:
        flow, torque = columns(self.model.flow, points), columns(self.model.torque, points)
        found = np.zeros((len(points.speed), 2, flow.shape[1] + torque.shape[1]))
        found[:, 0, : flow.shape[1]] = -flow
        found[:, 1, flow.shape[1] :] = torque
        return found

    def _read(self, points: LossPoints, values: Array) -> Array:
        ideal = np.stack([points.ideal_flow, points.ideal_torque], axis=-1)
        return np.asarray(ideal + self._columns(points) @ values)


def loss_model_bench(
    model: LossModel, pump: PumpDescription, points: BenchPoints, inputs: tuple[ChannelName, ...]
) -> LossModelBench:
    """A model at the points of a bench, with priors of its coefficients by the size of their columns there."""
    at_bench = loss_points(pump, points)
    parameters = (
        *_coefficients("flow", model.flow, at_bench, float(np.abs(at_bench.ideal_flow).max())),
        *_coefficients("torque", model.torque, at_bench, float(np.abs(at_bench.ideal_torque).max())),
    )
    return LossModelBench(model, pump, points, inputs, parameters)


def modelled(observations: Observations) -> Observations:
    """The readings that loss models give; raises InputError where one of the two channels was not measured."""
    names = [channel.name for channel in observations.channels]
    missing = [channel.value for channel in MODELLED if channel.value not in names]
    if missing:
        wanted = " and ".join(channel.value for channel in MODELLED)
        raise InputError("loss models", f"no {' and no '.join(missing)}", f"{wanted} as measured")
    own = [names.index(channel.value) for channel in MODELLED]
    return replace(
        observations,
        channels=tuple(observations.channels[at] for at in own),
        values=observations.values[:, own],
        sigma=observations.sigma[:, own],
        quantum=observations.quantum[own],
    )


def _coefficients(loss: str, terms: tuple[Term, ...], points: LossPoints, most: float) -> tuple[Parameter, ...]:
    found = []
    for term in terms:
        size = float(np.sqrt(np.mean(term.column(points) ** 2)))
        spread = most / size if size > 0.0 else 1.0
        scale, lower = (Scale.HALF, 0.0) if term.positive else (Scale.NORMAL, -inf)
        found.append(
            Parameter(
                f"{loss}.{term.name}", Role.BASE, scale, 0.0, spread, lower, inf, None, f"{loss} as large as ideal"
            )
        )
    return tuple(found)
