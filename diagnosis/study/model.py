"""Study: a recording and its simulator, readings, linear posterior, and the columns of all candidates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Protocol, Self

import numpy as np

from diagnosis.recording.model import Recording, TraceBlock
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.effects.components import Component
from system.effects.effect import EffectId
from system.effects.extension import Entry, Extension
from system.estimation.evidence import Sign
from system.estimation.observations import Observations
from system.estimation.parameters import Parameter, Scale
from system.estimation.posterior import Posterior, linear_posterior, values_at
from system.estimation.simulator import Simulator
from system.inputs.channels import ChannelName

SUBJECTS: Mapping[EffectId, str] = {
    EffectId.TORQUE_OFFSET: "torque.zero",
    EffectId.TORQUE_GAIN: "torque.gain",
    EffectId.Q_OUT_GAIN: "Q_out.gain",
    EffectId.Q_IN_GAIN: "Q_in.gain",
    EffectId.Q_CASE_OFFSET: "Q_case.zero",
    EffectId.Q_CASE_DRIFT: "Q_case.drift",
    EffectId.Q_CASE_GAIN: "Q_case.gain",
    EffectId.FLOW_LAG: "Q_out.lag",
    EffectId.P_OUT_OFFSET: "p_out.zero",
    EffectId.T_CASE_OFFSET: "T_case.zero",
    EffectId.T_IN_OFFSET: "T_in.zero",
    EffectId.FILM_THICKNESS: "film_thickness",
    EffectId.VISCOSITY_GRADE: "viscosity",
    EffectId.BULK_MODULUS: "bulk_modulus",
    EffectId.DEAD_VOLUME: "dead_volume",
    EffectId.FRICTION_COEFFICIENT: "friction",
    EffectId.DISPLACEMENT: "displacement",
}
"""Parameter of an effect without a law, or its name up to the dot if there are several."""


class PumpSimulator(Simulator, Protocol):
    """A simulator of a pump's bench map in which laws of the catalogue can be switched on."""

    def elsewhere(self, points: BenchPoints) -> PumpSimulator:
        """The same pump with the same parameters and laws at other points, steady readings alone."""
        ...

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Self:
        """The same model with these parameters: replaced where a name is there already, added where not."""
        ...

    def with_extensions(self, extensions: tuple[Extension, ...]) -> Self:
        """The same pump with these laws, each of one member of its grid: their parameters appended."""
        ...

    def difference(self, values: Array, other: Array) -> Array:
        """Readings (N, C) at `other` values less those at `values`; may be approximate, as slopes are."""
        ...

    def traces(self, values: Array, points: tuple[int, ...], angles: Array) -> Array:
        """Chamber pressure (len(points), K) in Pa gauge at shaft angles (K,) in rad as read by an encoder."""
        ...

    def components(self, values: Array) -> Mapping[Component, Array]:
        """Contribution (N, C) of each component to the readings, in SI."""
        ...


@dataclass(frozen=True)
class Candidate:
    """One action of an entry of the catalogue: its whitened column (n,) for one spread of `parameter`.

    extension: of one member of its grid; None for sensors and parameters, which the model has already; grid: the
    member's place. The size has the prior N(0, (w width)^2) in spreads for the widths w of the thresholds: width is 1
    for an extension, whose spread is its own size, and the fault factor for a parameter with a stated tolerance.
    """

    entry: Entry
    extension: Extension | None
    grid: int
    parameter: str
    column: Array
    width: float
    sign: Sign


@dataclass(frozen=True)
class PortEvent:
    """A shaft angle in rad at which a port begins or ends to open or close, and the event as text."""

    angle: float
    text: str


@dataclass(frozen=True)
class TraceMisfit:
    """A recorded chamber pressure less the simulated one, (K,) in Pa, and its nuisances.

    nuisances: (K, m), change of the simulated trace by one spread of each of its parameters; sigma:
    (K,), one sigma of the recorded mean, Pa.
    """

    block: TraceBlock
    residual: Array
    nuisances: Array
    sigma: Array


@dataclass(frozen=True)
class Study:
    """All data for detecting, locating and naming.

    base: linear posterior about the prior mean, or about standard numbers by name where `about` has some; candidates
    and components are those there. components: contribution (N, C) of each to the readings, in SI.
    axes: (N, 4), scaled to [-1, 1]: logarithm of speed, delivery pressure, displacement ratio, case temperature.
    scant: little more than the pump's type plate is known.
    """

    recording: Recording
    simulator: PumpSimulator
    observations: Observations
    base: Posterior
    candidates: tuple[Candidate, ...]
    components: Mapping[Component, Array]
    axes: Array
    traces: tuple[TraceMisfit, ...] = ()
    events: tuple[PortEvent, ...] = ()
    scant: bool = False
    about: Mapping[str, float] = field(default_factory=dict)

    @property
    def place(self) -> Array:
        """Standard numbers (k,) of the simulator's parameters about which the study is linear."""
        return place_of(self.simulator, self.about)

    @property
    def channels(self) -> tuple[ChannelName, ...]:
        """Channels of the steady points, the first C of the observations; numbers of traces follow them."""
        names = (ChannelName.named(channel.name) for channel in self.observations.channels)
        return tuple(name for name in names if name is not ChannelName.P_CHAMBER)

    @property
    def shown_channels(self) -> tuple[ChannelName, ...]:
        """The same, and the chamber's pressure where it was recorded."""
        traced = len(self.observations.channels) > len(self.channels)
        return (*self.channels, ChannelName.P_CHAMBER) if traced else self.channels

    def by_shown(self, sums: Array) -> Array:
        """Sums of the observations' columns as sums of `shown_channels`: those of the traces' numbers are one."""
        count = len(self.channels)
        return np.append(sums[:count], sums[count:].sum()) if count < sums.size else sums


def study_of(
    recording: Recording,
    simulator: PumpSimulator,
    observations: Observations,
    axes: Array,
    catalogue: Iterable[Entry],
    thresholds: Thresholds,
    about: Mapping[str, float] | None = None,
) -> Study:
    """The study of readings with their simulator.

    All slopes are at the prior mean unless standard numbers are given by name: a null model fitted to readings that it
    cannot explain moves its parameters by tens of sigma, where slopes are useless.
    """
    place = place_of(simulator, about or {})
    base = linear_posterior(simulator, observations, place)
    centre = values_at(simulator.parameters, place)
    factor = thresholds.name.fault_factor
    candidates = tuple(one for entry in catalogue for one in entry_candidates(entry, simulator, base, factor, place))
    components = simulator.components(centre)
    return Study(recording, simulator, observations, base, candidates, components, axes, about=about or {})


def place_of(simulator: PumpSimulator, about: Mapping[str, float]) -> Array:
    """Standard numbers (k,) of a simulator's parameters by name, 0 for others."""
    return np.array([about.get(parameter.name, 0.0) for parameter in simulator.parameters])


def entry_candidates(
    entry: Entry, simulator: PumpSimulator, base: Posterior, factor: float, place: Array
) -> Iterator[Candidate]:
    """The columns of an entry beside the linear posterior about xi = `place`; `factor` widens a stated tolerance."""
    return _of_extensions(entry, simulator, base, place) if entry.extensions else _of_parameters(entry, base, factor)


def concerned(effect: EffectId, parameters: Iterable[Parameter]) -> tuple[str, ...]:
    """Names of the base and sensor parameters of an effect without a law of its own."""
    subject = SUBJECTS.get(effect)
    names = (parameter.name for parameter in parameters)
    return tuple(name for name in names if subject and (name == subject or name.startswith(subject + ".")))


def _of_parameters(entry: Entry, base: Posterior, factor: float) -> Iterator[Candidate]:
    """Columns of parameters of the model, for sizes far beyond their stated tolerance."""
    for name in concerned(entry.id, base.parameters):
        at = base.index(name)
        yield Candidate(entry, None, 0, name, base.slopes[:, at], factor, _sign(base.parameters[at]))


def _of_extensions(entry: Entry, simulator: PumpSimulator, base: Posterior, place: Array) -> Iterator[Candidate]:
    """Columns of laws that the model lacks: change by one spread of each size.

    A difference, not a slope: laws with a threshold have no slope where they are off.
    """
    for extension in entry.extensions:
        for number, member in enumerate(extension.members):
            extended = simulator.with_extensions((member,))
            names = [parameter.name for parameter in extended.parameters]
            off = np.zeros(len(names))
            off[: place.size] = place  # parameters of a law are appended
            for parameter in member.parameters:
                on = off.copy()
                on[names.index(parameter.name)] = 1.0
                change = extended.difference(values_at(extended.parameters, off), values_at(extended.parameters, on))
                column = base.whitening.whiten(change)
                if np.any(column):
                    yield Candidate(entry, member, number, parameter.name, column, 1.0, _sign(parameter))


def _sign(parameter: Parameter) -> Sign:
    """The sign that a size may have: of HALF scales and of bounds at the centre."""
    if parameter.scale is Scale.HALF or parameter.lower == parameter.centre:
        return Sign.POSITIVE
    return Sign.NEGATIVE if parameter.upper == parameter.centre else Sign.EITHER
