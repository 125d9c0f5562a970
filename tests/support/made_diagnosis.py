"""A diagnosis that was made up and the recording it was found in, for tests of how it is told."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from diagnosis import (
    BenchBox,
    Circuit,
    Diagnosis,
    Explanation,
    NoteKind,
    PlainAnswer,
    RecordedChannel,
    Recording,
    SteadyTable,
    Study,
    load_thresholds,
    plain_answer,
)
from diagnosis.detect.mismatch import ChannelMisfit, Detection
from diagnosis.detect.regions import MapRegion
from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.explain.ranked import HeldOut
from diagnosis.explain.scaling import Scaling
from diagnosis.next_point.choose import ExpectedReading, NextPoint
from diagnosis.recording.model import DataNote
from diagnosis.verdict.diagnosis import ClaimedEffect, Estimate, VerdictStatus
from diagnosis.verdict.locate import Location
from reynolds import Array
from system import (
    Channel,
    ChannelName,
    Component,
    Dimension,
    EffectId,
    Gap,
    Kind,
    Observations,
    Parameter,
    Posterior,
    Role,
    Scale,
    load_pump,
    maximum_posterior,
    operating_point,
)
from system.estimation.posterior import FitEffort

LPM = 1.0 / 60000.0
PRESSURE = np.tile(np.linspace(5e6, 35e6, 7), 4)
SPEED = np.repeat([60.0, 110.0, 160.0, 210.0], 7)
E = EffectId
Q, T = ChannelName.Q_CASE, ChannelName.TORQUE


@dataclass(frozen=True)
class Lines:
    """Case flow ~ p and torque ~ p; the second parameter is a leak ~ p^2."""

    parameters: tuple[Parameter, ...]

    def predict(self, values: Array) -> Array:
        return np.einsum("nck,k->nc", self._columns(), np.append(values, 0.0)[:3])

    def _columns(self) -> Array:
        level = PRESSURE / 35e6
        nothing = np.zeros_like(level)
        flow = np.stack([5 * LPM * level, nothing, 2 * LPM * level**2], axis=-1)
        torque = np.stack([nothing, 400 * level + SPEED / 50, nothing], axis=-1)
        return np.stack([flow, torque], axis=1)

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        return self._columns()[:, :, [[one.name for one in self.parameters].index(name) for name in names]]

    def input_slopes(self, values: Array) -> Array:
        return np.zeros((PRESSURE.size, 2, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Lines:
        return replace(self, parameters=parameters)


def readings() -> Observations:
    rng = np.random.default_rng(5)
    sigma = np.tile([0.02 * LPM, 0.8], (PRESSURE.size, 1))
    truth = Lines(()).predict(np.array([1.0, 1.0, 0.4]))
    return Observations(
        channels=(Channel("Q_case", Dimension.VOLUME_FLOW), Channel("torque", Dimension.TORQUE)),
        values=truth + sigma * rng.normal(size=truth.shape),
        sigma=sigma,
        inputs=(),
        input_sigma=np.zeros((PRESSURE.size, 0)),
        quantum=np.zeros(2),
        blocks=np.arange(PRESSURE.size),
    )


def _fit(names: tuple[str, ...]) -> Posterior:
    def prior(name: str) -> Parameter:
        if name == "opening":
            return Parameter(name, Role.EXTENSION, Scale.HALF, 0.0, 1.0, 0.0, np.inf, None, "test")
        return Parameter(name, Role.BASE, Scale.NORMAL, 1.0, 0.05, 0.0, 5.0, None, "test")

    return maximum_posterior(Lines(tuple(prior(name) for name in names)), readings())


def hypothesis(*effects: EffectId, pair: Gap | None = None, kind: Kind = Kind.MISSING_PHYSICS) -> Hypothesis:
    return Hypothesis(effects, pair, kind, (), (), -2.0)


def named_diagnosis() -> Diagnosis:
    """A valve plate that opens under pressure, named."""
    before, after = _fit(("film", "friction")), _fit(("film", "friction", "opening"))
    rms = ({Q: 1e-6, T: 0.81}, {Q: 2.6e-7, T: 0.8}, {Q: 2.5e-7, T: 0.8})
    fit = HeldOut({"high p": 40.0, "low n": 3.0}, *rms, False, "five random fifths")
    opening = Estimate("elastic_opening.valve_plate.opening", 2.2e-8, 2e-9, Dimension.PRESSURE_COEFFICIENT)
    weighed = (
        Explanation(hypothesis(E.ELASTIC_OPENING, pair=Gap.VALVE_PLATE), -20.0, False, after, 22.0, 0.93, fit),
        Explanation(hypothesis(E.FILM_HEATING), -24.0, False, before, 20.0, 0.06, None),
        Explanation(hypothesis(kind=Kind.NO_MISMATCH), -400.0, False, before, 0.0, 0.0, None),
    )
    point = operating_point(load_pump("ref90"), shaft_speed=104.7, delivery_pressure=37e6)
    return Diagnosis(
        kind=Kind.MISSING_PHYSICS,
        status=VerdictStatus.NAMED,
        detection=Detection(1e-30, 9.1, {Q: ChannelMisfit(17.0, 0.97), T: ChannelMisfit(1.1, 0.03)}, 1e-20, ()),
        location=Location(
            channels=(Q,),
            region=MapRegion(Q, {"p_out": 25e6}, {}, 12.0, "p_out above 250 bar"),
            components=((Component.PLATE_LEAKAGE, 200.0),),
            tie=(Component.PLATE_LEAKAGE,),
            angle=None,
            time=None,
        ),
        effects=(ClaimedEffect(E.ELASTIC_OPENING, Gap.VALVE_PLATE, 0.93, (), (opening,)),),
        hypotheses=weighed,
        before=before,
        after=after,
        fit=fit,
        scaling=Scaling(
            Q,
            True,
            {"speed": 0.02, "pressure": 2.1, "displacement": 0.0, "viscosity": -1.0},
            dict.fromkeys(("speed", "pressure", "displacement", "viscosity"), 0.1),
        ),
        next_point=NextPoint(
            box=BenchBox(((104.7, 104.7), (1e6, 37e6), (1.0, 1.0), (343.15, 343.15)), 2e6, 1e5, 0.0, (40.0, 1.0)),
            point=point,
            inlet_temperature=343.15,
            between=("elastic opening at the valve plate", "film heating"),
            separates=(E.ELASTIC_OPENING, E.FILM_HEATING),
            before=np.log(15.5),
            gain=7.0,
            after=4.3,
            chance=0.87,
            repeats=3,
            expected=ExpectedReading("Q_case", Dimension.VOLUME_FLOW, 2.4 * LPM, 2.1 * LPM, 12.0),
            limits=load_thresholds().next_point,
        ),
        not_identifiable=("film_thickness slipper vs film_thickness piston",),
        notes=("row 3 of Q_case was removed",),
        effort=FitEffort(10, 3, 1.0),
        thresholds=load_thresholds(),
    )


def its_study(named: Diagnosis) -> Study:
    """The recording that it was found in."""
    values = np.full((PRESSURE.size, len(ChannelName)), np.nan)
    order = list(ChannelName)
    for name, column in {ChannelName.SPEED: SPEED, ChannelName.P_OUT: PRESSURE}.items():
        values[:, order.index(name)] = column
    values[:, [order.index(Q), order.index(T)]] = readings().values
    channels = (
        RecordedChannel(Q, "Q_case", "L/min", 0.02 * LPM, 0.0, 0.0, 0.0, 0.0, 0.0, ("gain_sigma",)),
        RecordedChannel(T, "M", "N m", 0.8, 0.0, 0.0, 0.0, 0.0, 0.0, ()),
    )
    notes = (DataNote(NoteKind.REMOVED, Q, (2,), "far from its neighbours"),)
    steady = SteadyTable(values, np.arange(PRESSURE.size), np.full(PRESSURE.size, np.nan), np.full_like(values, np.nan))
    recording = Recording("Bench <4>", "ref90", "ISO VG 46", Circuit.CLOSED, channels, steady, (), notes)
    lines: Any = Lines(named.before.parameters)
    return Study(recording, lines, readings(), named.before, (), {}, np.zeros((PRESSURE.size, 4)))


def its_answer(diagnosis: Diagnosis, cost: str = "") -> PlainAnswer:
    """The answer in plain words."""
    return plain_answer(its_study(diagnosis), diagnosis, cost)


def agreeing(diagnosis: Diagnosis) -> Diagnosis:
    detection = replace(diagnosis.detection, p_value=0.4, chi2_per_dof=1.0)
    return replace(diagnosis, kind=Kind.NO_MISMATCH, detection=detection, effects=(), scaling=None, next_point=None)
