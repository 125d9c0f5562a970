"""Detecting and locating on a toy pump whose truth is known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from toy_maps import LIMITS, SIGMA, ToySimulator, toy_observations, toy_recording

from diagnosis import Recording, Study
from diagnosis.detect.contrasts import contrasts, misfit
from diagnosis.detect.mismatch import Detection, detect
from diagnosis.detect.multiplicity import family_chance, holm, log_chances
from diagnosis.detect.regions import flagged, strongest_region
from diagnosis.detect.time_scan import TimeKind, remains
from diagnosis.study.map_axes import axis_values, inside, scaled_axes
from diagnosis.study.model import concerned, study_of
from diagnosis.study.noise_correlation import FitRemainder, noise_correlation, noise_excess
from diagnosis.verdict.locate import Location, locate, of_explanation
from reynolds import Array
from system import ChannelName, Component, EffectId, Extension, Kind, Parameter, Role, Scale
from system.effects.extension import Entry
from system.estimation.evidence import Sign

POINTS = 80


@cache
def _map() -> Recording:
    grid = [(n, p, e) for n in (50, 120, 200) for p in (5e6, 15e6, 25e6, 35e6) for e in (0.3, 0.6, 1.0)]
    return toy_recording(POINTS, grid, 50)


def _parts() -> dict[str, Array]:
    """Contribution of each part of the toy to the readings (N, 3): flows in L/min, torque in N m."""
    n, p, e, heat = (values for values in axis_values(_map()).values())
    viscosity = np.exp(-0.035 * (heat - 333.0))
    leakage, one = p / 35e6, np.ones(POINTS)
    parts = {
        "displacement": (0.85 * n * e, 0 * n, 1.4e-5 * p * e),
        "compression": (-0.02 * n * e * leakage, 0 * n, 0 * n),
        "piston_leakage": (-leakage / viscosity, leakage / viscosity, 0 * n),
        "slipper_leakage": (-0.6 * leakage * (1.0 - 0.3 * e) / viscosity, 0.6 * leakage / viscosity, 0 * n),
        "coulomb": (0 * n, 0 * n, 6.0 * leakage * e),
        "viscous": (0 * n, 0 * n, 4.0 * viscosity * n / 200.0),
        "Q_case.zero": (0 * n, one, 0 * n),
        "torque.zero": (0 * n, 0 * n, one),
    }
    return {name: np.stack(columns, axis=1) for name, columns in parts.items()}


EFFECTS = {
    EffectId.ELASTIC_OPENING: lambda n, p, e, T: (-((p / 35e6) ** 3), (p / 35e6) ** 3, 0 * n),
    EffectId.CHURNING: lambda n, p, e, T: (0 * n, 0 * n, (n / 200) ** 2),
    EffectId.PORT_SHORT_CIRCUIT: lambda n, p, e, T: (-np.sqrt(p / 35e6), 0 * n, 0 * n),
    EffectId.CONTROL_FLOW: lambda n, p, e, T: (-np.sqrt(p / 35e6), np.sqrt(p / 35e6), 0 * n),
    EffectId.SHEAR_THINNING: lambda n, p, e, T: (0 * n, 0 * n, -((n / 200) ** 2) * np.exp(-0.035 * (T - 333))),
}


def _effect(effect: EffectId) -> Array:
    return np.stack(EFFECTS[effect](*axis_values(_map()).values()), axis=1)


@dataclass(frozen=True)
class ToyPump(ToySimulator):
    """A pump linear in its parameters: every part has a factor or a zero of its own."""

    parameters: tuple[Parameter, ...]
    columns: tuple[Array, ...]  # (N, 3) by parameter, in SI

    def predict(self, values: Array) -> Array:
        return sum(value * column for value, column in zip(values, self.columns, strict=True))

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        return np.stack(self.columns, axis=2)

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> ToyPump:
        raise NotImplementedError

    def with_extensions(self, extensions: tuple[Extension, ...]) -> ToyPump:
        added = tuple(parameter for one in extensions for parameter in one.parameters)
        return ToyPump(self.parameters + added, (*self.columns, *(_effect(one.id) for one in extensions)))

    def components(self, values: Array) -> Mapping[Component, Array]:
        parts, plain = _parts(), self.predict(values)
        sensors = [plain * (np.arange(3) == channel) for channel in range(3)]
        return {
            Component.DISPLACEMENT: parts["displacement"],
            Component.PISTON_LEAKAGE: parts["piston_leakage"],
            Component.SLIPPER_LEAKAGE: parts["slipper_leakage"],
            Component.PISTON_FRICTION: parts["coulomb"],
            Component.CASE_DRAG: parts["viscous"],
            Component.Q_OUT_SENSOR: sensors[0],
            Component.Q_CASE_SENSOR: sensors[1],
            Component.TORQUE_SENSOR: sensors[2],
        }


@cache
def _pump() -> ToyPump:
    parts = _parts()
    spreads = (0.002, 0.1, 0.2, 0.2, 0.15, 0.15, 0.01, 0.2)
    parameters = []
    for (name, _), spread in zip(parts.items(), spreads, strict=True):
        zero = name.endswith("zero")
        role = Role.SENSOR if zero else Role.BASE
        centre = 0.0 if zero else 1.0
        parameters.append(Parameter(name, role, Scale.NORMAL, centre, spread, -np.inf, np.inf, None, "toy"))
    return ToyPump(tuple(parameters), tuple(parts.values()))


def _catalogue() -> list[Entry]:
    entries = []
    for effect in EFFECTS:
        name = f"{effect.value}.size"
        size = Parameter(name, Role.EXTENSION, Scale.HALF, 0.0, 1.0, 0.0, 10.0, None, "toy")
        extension = Extension(effect, None, lambda values, courses, state: None, (size,), ({},))  # type: ignore[arg-type, return-value]
        entries.append(Entry(effect, Kind.MISSING_PHYSICS, (extension,), (), (), "", (), "", ""))
    for effect in (EffectId.TORQUE_OFFSET, EffectId.Q_CASE_OFFSET):
        entries.append(Entry(effect, Kind.SENSOR_FAULT, (), (), (), "", (), "", ""))
    return entries


def _study(added: Array | float = 0.0, seed: int = 0) -> Study:
    """A study of readings of a pump within tolerance, with something added that the simulator lacks."""
    rng = np.random.default_rng([51, seed])
    pump = _pump()
    values = np.array([parameter.value(xi) for parameter, xi in zip(pump.parameters, rng.normal(size=8), strict=True)])
    readings = pump.predict(values) + added + SIGMA * rng.normal(size=(POINTS, 3))
    return study_of(_map(), pump, toy_observations(readings), scaled_axes(_map()), _catalogue(), LIMITS)


def _sized(effect: EffectId, z: float) -> Array:
    """An effect of the size that its own score is expected to be z."""
    found = detect(_study(), LIMITS)
    sigma = next(score.sigma for candidate, score in found.strongest if candidate.entry.id is effect)
    return z * sigma * _effect(effect)


@pytest.fixture(scope="module")
def nulls() -> list[Detection]:
    """300 recordings with nothing in them."""
    return [detect(_study(seed=seed), LIMITS) for seed in range(300)]


def test_alarms_come_as_often_as_they_say(nulls: list[Detection]) -> None:
    """300 readings without mismatch: the family's chance is below .05 and .2 in as many, within 3 sigma."""
    for level in (0.05, 0.2):
        alarms = np.mean([found.chance < level for found in nulls])
        assert abs(alarms - level) < 3.0 * np.sqrt(level * (1.0 - level) / len(nulls))


def test_the_objective_is_chi_square_distributed(nulls: list[Detection]) -> None:
    """p of the goodness of fit is uniform where the model holds: below .1 in 10 +- 7 % of 300 (4 sigma)."""
    p_values = np.array([found.p_value for found in nulls])
    assert abs(np.mean(p_values < 0.1) - 0.1) < 0.07
    assert abs(np.median(p_values) - 0.5) < 4 * 0.5 / np.sqrt(300)


def test_noise_that_remembers_is_told_from_white_noise() -> None:
    """Noise of correlation .5 from point to point, thrice as strong as stated, over white noise: .45 is found."""

    def remembering(seed: int) -> Array:
        rng = np.random.default_rng([53, seed])
        noise = rng.normal(size=(POINTS, 3))
        for at in range(1, POINTS):
            noise[at] = 0.5 * noise[at - 1] + np.sqrt(0.75) * noise[at]
        return 3.0 * SIGMA * noise

    white = [noise_correlation(_study(seed=seed), LIMITS.mismatch) for seed in range(40)]
    assert sum(bool(found) for found in white) <= 2  # one in 740 each
    found = [noise_correlation(_study(remembering(seed), seed), LIMITS.mismatch) for seed in range(10)]
    sizes = [one[0] for one in found if one]
    assert len(sizes) >= 9
    assert abs(np.mean(sizes) - 0.45) < 0.1  # 190 pairs: .07 each


def test_pairs_of_what_a_fit_leaves_take_no_matrix_of_all_readings() -> None:
    """tr M P and 2 tr M P M P as by full matrices; of 100 000 readings these would need 80 GB each."""
    columns = np.linalg.qr(np.random.default_rng(6).normal(size=(40, 5)))[0] * [0.9, 0.8, 0.5, 0.3, 0.1]
    pairs = np.stack([np.arange(0, 30), np.arange(3, 33)], axis=1)
    half, left = np.zeros((40, 40)), np.eye(40) - columns @ columns.T
    half[tuple(pairs.T)] = half[tuple(pairs[:, ::-1].T)] = 0.5
    paired = half @ left
    expected = np.trace(paired), np.sqrt(2.0 * np.trace(paired @ paired))
    assert FitRemainder(columns).of_pairs(pairs) == pytest.approx(expected, rel=1e-12)
    assert FitRemainder(columns).diagonal == pytest.approx(np.diag(left), rel=1e-12)
    many = np.stack([np.arange(99_999), np.arange(1, 100_000)], axis=1)
    assert FitRemainder(np.full((100_000, 3), 1e-3)).of_pairs(many)[1] == pytest.approx(np.sqrt(99_999), rel=0.01)


def test_an_effect_is_no_memory() -> None:
    """An effect of thirty sigma, and points in an order of no system: nothing goes on from one to the next."""
    assert noise_correlation(_study(_sized(EffectId.ELASTIC_OPENING, 30.0), seed=3), LIMITS.mismatch) == ()


def test_scatter_beyond_the_noise_is_that_of_the_readings() -> None:
    """Noise 1.3 times as strong as stated in the first channel; three times as strong is taken for no noise, and of
    physics of thirty sigma only what is not smooth.
    """
    drawn = np.random.default_rng(11).normal(size=(POINTS, 3)) * SIGMA * [1.0, 0.0, 0.0]
    found = noise_excess(_study(np.sqrt(0.69) * drawn, seed=4), LIMITS.mismatch)
    assert found[0] == pytest.approx(1.3, abs=0.15)  # some 64 free readings: 9 %
    assert noise_excess(_study(np.sqrt(8.0) * drawn, seed=4), LIMITS.mismatch)[0] == 1.0
    assert found[1:] == pytest.approx(1.0, abs=0.3)
    opened = noise_excess(_study(_sized(EffectId.ELASTIC_OPENING, 30.0), seed=3), LIMITS.mismatch)
    assert np.all(opened < 1.5)  # with what is smooth the readings are 3.5 of their sigma off


def test_pulls_have_the_variance_that_is_promised() -> None:
    """Squares of single readings' residuals over their variance under the model: 1 on average, per channel."""
    squares = np.stack([misfit(_study(seed=seed).base).pull ** 2 for seed in range(100)])
    free = misfit(_study().base).variance
    ratio = squares.mean(axis=0).sum(axis=0) / free.sum(axis=0)
    assert np.abs(ratio - 1.0).max() < 4 * np.sqrt(2.0 / (100 * POINTS))


def test_an_effect_of_eight_sigma_is_detected_and_leads() -> None:
    for effect in EFFECTS:
        found = detect(_study(_sized(effect, 8.0), seed=3), LIMITS)
        assert found.chance < LIMITS.mismatch.chance
        assert found.strongest[0][0].entry.id is effect


def test_a_size_of_the_wrong_sign_is_no_evidence() -> None:
    """Churning cannot take torque away: the p of this sign is above one half, whatever its size."""
    found = detect(_study(_sized(EffectId.CHURNING, -8.0), seed=3), LIMITS)
    place = [candidate.entry.id for candidate, _ in found.strongest].index(EffectId.CHURNING)
    assert found.strongest[place][0].sign is Sign.POSITIVE
    assert found.strongest[place][1].z < -5.0
    assert place > 0


def test_channels_share_the_excess() -> None:
    found = detect(_study(_sized(EffectId.CHURNING, 15.0)), LIMITS)
    assert found.channels[ChannelName.TORQUE].share > 0.9
    assert found.channels[ChannelName.TORQUE].chi2_per_dof > 2.0
    assert sum(channel.share for channel in found.channels.values()) == pytest.approx(1.0)


def test_holm_counts_all_candidates() -> None:
    assert holm(np.array([0.01, 0.3])) == pytest.approx(0.02)
    assert holm(np.array([])) == 1.0


def test_candidates_that_look_alike_count_once() -> None:
    """One column twenty times: the chance of any is that of one, within 3 sigma of 4999 draws; Holm has twenty."""
    study = _study()
    own = next(each for each in study.candidates if each.sign is Sign.POSITIVE)
    log_p = log_chances(np.full(20, 2.0), [own] * 20)
    found = family_chance(study.base, [own] * 20, log_p, 4999, 1)
    alone = float(np.exp(log_p[0]))
    assert abs(found - alone) < 3.0 * np.sqrt(alone / 4999)
    assert holm(np.exp(log_p)) == pytest.approx(20 * alone)
    assert family_chance(study.base, [], np.zeros(0), 99, 1) == 1.0


@pytest.mark.parametrize(
    ("lower", "upper"),
    [
        ({"p_out": 20e6}, {}),
        ({}, {"speed": 80.0}),
        ({"p_out": 20e6}, {"displacement_ratio": 0.8}),
        ({"T_case": 343.0}, {}),
    ],
)
def test_a_planted_region_is_found(lower: dict[str, float], upper: dict[str, float]) -> None:
    """Intersection over union of the points within, .7 at least, for a step of 3 sigma in the drain flow."""
    axes = axis_values(_map())
    within = inside(axes, lower, upper)
    added = 3 * SIGMA * within[:, None] * np.array([0, 1, 0])
    region = locate(_study(added, seed=4), LIMITS).region
    assert region is not None
    assert region.channel is ChannelName.Q_CASE
    found = inside(axes, region.lower, region.upper)
    assert np.sum(found & within) / np.sum(found | within) >= 0.7
    assert set(region.lower) | set(region.upper) == set(lower) | set(upper)
    assert all(name in region.text for name in (*lower, *upper))


@pytest.mark.parametrize("power", [1, 3])
def test_an_effect_is_strongest_where_it_is_half_its_most(power: int) -> None:
    """Of p^m the points above 2^(-1/m) of the highest pressure; nowhere more than elsewhere where it is even."""
    study, axes = _study(seed=4), axis_values(_map())
    pressure = axes[ChannelName.P_OUT]
    found = contrasts(study.base, 1)
    region = strongest_region(ChannelName.Q_CASE, found, -(pressure**power), axes, LIMITS.locate)
    assert region is not None
    assert region.lower.keys() == {"p_out"}
    assert not region.upper
    strong = pressure >= 0.5 ** (1.0 / power) * pressure.max()
    within = inside(axes, region.lower, region.upper)
    assert np.sum(strong & within) / np.sum(strong | within) >= 1.0 - 1.0 / LIMITS.locate.edges
    assert strongest_region(ChannelName.Q_CASE, found, np.ones_like(pressure), axes, LIMITS.locate) is None


def test_no_regions_are_flagged_without_a_mismatch() -> None:
    """Benjamini and Hochberg at .05: any flag at all in 5 % of nulls, 10 % of 300 at most (4 sigma)."""
    axes = axis_values(_map())
    studies = (_study(seed=seed) for seed in range(300))
    by_channel = ({name: contrasts(own.base, at) for at, name in enumerate(own.channels)} for own in studies)
    assert np.mean([len(flagged(own, axes, LIMITS)) > 0 for own in by_channel]) < 0.10


def test_an_effect_shows_in_its_channel_and_region() -> None:
    """Churning in the torque at high speed, opening in the drain flow at high pressure, from 8 sigma on."""
    churning, opening = (
        locate(_study(_sized(effect, 8.0), seed=3), LIMITS) for effect in (EffectId.CHURNING, EffectId.ELASTIC_OPENING)
    )
    assert churning.channels[0] is ChannelName.TORQUE
    assert churning.region is not None
    assert churning.region.lower.keys() == {"speed"}
    assert opening.channels[0] is ChannelName.Q_CASE
    assert opening.region is not None
    assert opening.region.lower.keys() == {"p_out"}


def test_components_are_found_or_tied() -> None:
    opening = locate(_study(_sized(EffectId.ELASTIC_OPENING, 20.0)), LIMITS)
    assert {Component.PISTON_LEAKAGE, Component.SLIPPER_LEAKAGE} & set(opening.tie)
    churning = locate(_study(_sized(EffectId.CHURNING, 20.0)), LIMITS)
    assert {Component.CASE_DRAG, Component.TORQUE_SENSOR} >= set(churning.tie)
    assert churning.components[0][0] is Component.CASE_DRAG


def test_nothing_is_located_in_nulls() -> None:
    """No component 3 nats ahead of nothing, no drift, in 60 nulls, but for 3 of them at most."""
    found = [locate(_study(seed=seed), LIMITS) for seed in range(60)]
    assert sum(bool(place.tie) for place in found) <= 3
    assert sum(place.time is not None for place in found) <= 3
    assert all(place.angle is None for place in found)


def test_a_drift_and_an_onset_are_told() -> None:
    order = np.arange(POINTS)
    drift, onset = np.zeros((2, POINTS, 3))
    drift[:, 1] = 5 * SIGMA[1] * order / POINTS
    onset[order >= 50, 1] = 3 * SIGMA[1]
    drifting, set_in = (locate(_study(added, seed=5), LIMITS).time for added in (drift, onset))
    assert drifting is not None
    assert set_in is not None
    assert (drifting.kind, drifting.channel) == (TimeKind.DRIFT, ChannelName.Q_CASE)
    assert (set_in.kind, set_in.channel) == (TimeKind.ONSET, ChannelName.Q_CASE)
    assert abs(set_in.at - 50) <= 1


def test_an_onset_that_an_explanation_takes_up_is_none_of_time() -> None:
    """A step that the fit follows is gone behind it; one that the fit does not follow is still there."""
    order = np.arange(POINTS)
    onset = np.zeros((POINTS, 3))
    onset[order >= 50, 1] = 3 * SIGMA[1]
    study, sound = _study(onset, seed=5), _study(seed=5)
    mark = locate(study, LIMITS).time
    assert mark is not None
    assert remains(mark, study, study.base, LIMITS)
    assert not remains(mark, study, sound.base, LIMITS)


def test_an_effect_of_pressure_is_no_drift_when_pressure_rises_with_time() -> None:
    study = _study(_sized(EffectId.ELASTIC_OPENING, 20.0))
    pressure = axis_values(_map())[ChannelName.P_OUT]
    order = np.argsort(pressure, kind="stable")
    steady = study.recording.steady
    recording = replace(study.recording, steady=replace(steady, values=steady.values[order]))
    readings = study.observations
    sorted_readings = replace(readings, values=readings.values[order], sigma=readings.sigma[order])
    pump = ToyPump(_pump().parameters, tuple(column[order] for column in _pump().columns))
    again = study_of(recording, pump, sorted_readings, scaled_axes(recording), [], LIMITS)
    again = replace(again, components={})
    assert locate(again, LIMITS).time is None


def test_contrasts_are_standard_normal_and_leave_out_what_parameters_take_up() -> None:
    """z of a random pattern over 300 nulls: variance 1 within 4 sigma; a parameter's own pattern, freed, is 0."""
    pattern = np.random.default_rng(52).normal(size=(POINTS, 1))
    z = [float(contrasts(_study(seed=seed).base, 0).z(pattern)[0]) for seed in range(300)]
    assert abs(np.var(z) - 1.0) < 4 * np.sqrt(2.0 / 300)
    study = _study(seed=7)
    beside = study.base.whitening.whiten(1e6 * SIGMA[:, None] * np.ones((POINTS, 3, 1)) * np.eye(3)[1][:, None])
    freed = contrasts(study.base, 1, beside)
    assert abs(freed.z(np.ones((POINTS, 1)))[0]) < 1e-3


def test_effects_without_a_law_find_their_parameters() -> None:
    assert concerned(EffectId.Q_CASE_OFFSET, _pump().parameters) == ("Q_case.zero",)
    assert concerned(EffectId.CHURNING, _pump().parameters) == ()


def test_components_are_not_told_of_traces_alone() -> None:
    """Two columns, the second of traces: what adds to it alone is no part's flow or torque."""
    whitening = SimpleNamespace(measured=np.ones((POINTS, 2), dtype=bool), sigma=np.ones((POINTS, 2)))
    study = SimpleNamespace(
        base=SimpleNamespace(whitening=whitening),
        channels=(ChannelName.TORQUE,),
        shown_channels=(ChannelName.TORQUE, ChannelName.P_CHAMBER),
        by_shown=lambda sums: sums,
    )
    before = Location((ChannelName.TORQUE,), None, (), (Component.DISPLACEMENT,), None, None)
    added = np.tile([0.0, 1.0], (POINTS, 1))
    found = of_explanation(study, before, added, LIMITS)  # type: ignore[arg-type]
    assert found.channels == (ChannelName.P_CHAMBER,)
    assert found.tie == ()
