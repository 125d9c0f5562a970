"""Film physics that a simulation left out, found by tables of films: a stand-in for solved films, and its plant."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from bench_pump import BENCH
from stand_in_films import ThinningFilms

from diagnosis import Circuit, RecordedChannel, Recording, SteadyTable, Study, hidden_effects, load_thresholds
from diagnosis.procedure.floating_comparison import varied_pump
from diagnosis.procedure.recorded import diagnose_recording
from diagnosis.study.films.box import film_box
from diagnosis.study.films.noise import BALANCED_NAMES, table_noise
from diagnosis.study.prepare import prepare
from diagnosis.verdict.diagnosis import Diagnosis
from gaps.films.physics import Effect
from system import ChannelName, EffectId, load_pump, operating_point
from system.description.tolerances import tolerances
from system.points.floating_gaps import FloatingOptions
from system.points.table.film_physics import FilmModel, FilmTask, film_counts, film_model
from system.points.table.sources import films_alone

PUMP = load_pump(BENCH)
RPM, LPM = np.pi / 30.0, 1.0 / 60000.0
SIGMA = {
    ChannelName.Q_OUT: (0.05 * LPM, 0.003), ChannelName.Q_CASE: (0.01 * LPM, 0.003), ChannelName.TORQUE: (0.2, 0.002),
}  # fmt: skip
"""Noise of a reading, SI, and one sigma of the gain."""
WARM, OPEN = 0.12, 0.15
E = EffectId


def solver(options: FloatingOptions) -> ThinningFilms:
    """Films that open where walls are elastic, and thin where they warm."""
    physics = options.physics
    return ThinningFilms(WARM if physics.heat else 0.0, False, OPEN if physics.elastic_walls else 0.0)


def made(films: ThinningFilms, seed: int) -> Recording:
    """Readings of a plant with these films: 4 speeds, 7 pressures, full displacement, oil at 50 degC."""
    rng, order = np.random.default_rng(seed), list(ChannelName)
    values = np.full((28, len(order)), np.nan)
    for row, (speed, pressure) in enumerate(product((1000, 1367, 1733, 2100), np.linspace(7.5e6, 37.5e6, 7))):
        point = operating_point(
            PUMP, shaft_speed=speed * RPM, delivery_pressure=pressure, temperature=323.15, displacement_ratio=1.0
        )
        bench = films.solve(films_alone(PUMP), point).pump_point.bench
        stated = {
            ChannelName.SPEED: speed * RPM, ChannelName.P_OUT: pressure, ChannelName.P_IN: point.inlet_pressure,
            ChannelName.P_CASE: point.case_pressure, ChannelName.T_IN: 321.15, ChannelName.T_CASE: 323.15,
            ChannelName.DISPLACEMENT_RATIO: 1.0, ChannelName.Q_OUT: bench.delivery_flow,
            ChannelName.Q_CASE: bench.drain_flow, ChannelName.TORQUE: bench.shaft_torque,
        }  # fmt: skip
        for name, value in stated.items():
            values[row, order.index(name)] = value + SIGMA.get(name, (0.0, 0.0))[0] * rng.standard_normal()
    inputs = [name for name in order if np.isfinite(values[0, order.index(name)]) and name not in SIGMA]
    small = {ChannelName.SPEED: 0.01, ChannelName.DISPLACEMENT_RATIO: 1e-5, ChannelName.T_CASE: 0.02}
    channels = [
        RecordedChannel(name, name.value, "1", small.get(name, 200.0), 0.0, 0.0, 0.0, 0.0, 0.0, ()) for name in inputs
    ]
    channels += [
        RecordedChannel(name, name.value, "1", sigma, 0.0, 0.0, 0.0, gain, 0.0, ())
        for name, (sigma, gain) in SIGMA.items()
    ]
    steady = SteadyTable(values, np.arange(28), np.full(28, np.nan), np.full_like(values, np.nan))
    return Recording("films", PUMP.name, "ISO VG 46", Circuit.CLOSED, tuple(channels), steady, (), ())


@pytest.fixture(scope="module")
def films(tmp_path_factory: pytest.TempPathFactory) -> FilmModel:
    """The model of a simulation between rigid walls, with oil as warm as the case."""
    usual = FloatingOptions()
    options = replace(usual, physics=usual.physics.without(Effect.ELASTIC_WALLS, Effect.HEAT))
    box = film_box(PUMP, made(ThinningFilms(0.0), 1))
    task = FilmTask(box.pump, options, box.axes, 12, 3, solver=solver)
    return film_model(task, folder=tmp_path_factory.mktemp("cache"))


def diagnosed(films: FilmModel, plant: ThinningFilms, seed: int) -> tuple[Study, Diagnosis]:
    thresholds, allowed = load_thresholds(), tolerances(PUMP)[0]

    def prepared(usable: Recording) -> Study:
        return prepare(PUMP, usable, allowed, thresholds, films.catalogue, films=films)

    return diagnose_recording(PUMP, made(plant, seed), prepared, thresholds)


def test_nothing_is_named_where_the_simulation_lacks_nothing(films: FilmModel) -> None:
    """Whatever hides of elastic walls and of heat in films is a small share of what is computed."""
    study, found = diagnosed(films, ThinningFilms(0.0), 3)
    assert not found.effects
    hidden = {one.effect: one for one in hidden_effects(study, found)}
    for effect in (E.ELASTIC_OPENING, E.FILM_HEATING):
        assert hidden[effect].limited
        assert 0.0 < hidden[effect].size.value < 0.2
    assert max(found.fit.after[name] / found.fit.noise[name] for name in found.fit.after) < 1.3


@pytest.mark.slow
@pytest.mark.parametrize(
    ("plant", "concealed"),
    [
        (ThinningFilms(0.0, False, OPEN), {E.ELASTIC_OPENING}),
        pytest.param(ThinningFilms(WARM), {E.FILM_HEATING}, marks=pytest.mark.long),
        pytest.param(ThinningFilms(WARM, False, OPEN), {E.ELASTIC_OPENING, E.FILM_HEATING}, marks=pytest.mark.long),
    ],
)
def test_film_physics_left_out_is_named_with_its_size(films: FilmModel, plant: ThinningFilms, concealed: set) -> None:
    """One part or both; each share is that of the plant, 1, within three sigma."""
    _, found = diagnosed(films, plant, 4)
    assert {claim.effect for claim in found.effects} == concealed
    for claim in found.effects:
        (share,) = claim.parameters
        assert share.value == pytest.approx(1.0, abs=3.0 * share.sigma)


def test_hypotheses_are_what_the_films_leave_out_and_all_beside_the_films(films: FilmModel) -> None:
    names = {entry.id for entry in films.catalogue}
    assert {E.ELASTIC_OPENING, E.FILM_HEATING, E.CHURNING, E.SHEAR_THINNING, E.TORQUE_GAIN} <= names
    assert not {E.VISCOSITY_PRESSURE, E.SLIPPER_LIFT, E.BLOCK_TIPPING, E.SQUEEZE_PUMPING, E.THERMAL_CLEARANCE} & names
    assert [one.of_films for entry in films.entries for one in entry.extensions] == [True, True]


def test_the_tables_error_is_noise_of_the_readings(films: FilmModel) -> None:
    """Twice the error is twice the noise; films that balance forces have no uncertain thickness."""
    thresholds, allowed = load_thresholds(), tolerances(PUMP)[0]
    study = prepare(PUMP, made(ThinningFilms(0.0), 5), allowed, thresholds, films.catalogue, films=films)
    names = {parameter.name for parameter in study.simulator.parameters}
    assert not BALANCED_NAMES & names
    assert "film_thickness.piston" in names
    bench = study.simulator
    once = table_noise(bench, films)
    twice = table_noise(bench, replace(films, error={name: 2.0 * error for name, error in films.error.items()}))
    assert once.shape == study.observations.values.shape
    assert np.all(once[:, 1] > 0.0)
    assert twice == pytest.approx(2.0 * once, rel=0.05, abs=1e-12)


def test_the_box_holds_what_the_recording_holds() -> None:
    """Two inputs vary, with ends rounded outwards; the others are the pump's own there."""
    box = film_box(PUMP, made(ThinningFilms(0.0), 1))
    assert [axis.name for axis in box.axes] == ["shaft_speed", "delivery_pressure"]
    speed, pressure = box.axes
    assert (speed.lower / RPM, speed.upper / RPM) == pytest.approx((900.0, 2200.0))
    assert (pressure.lower, pressure.upper) == pytest.approx((7e6, 39e6))
    assert box.pump.operating.temperature == pytest.approx(323.15)
    assert film_counts(2) == (12, 3)
    assert film_counts(3) == (22, 5)


def test_a_variant_changes_what_its_file_states_otherwise(films: FilmModel) -> None:
    """The other file's clearance comes with the effect; name, operating point and tolerances stay."""
    worn = replace(PUMP, name="worn", piston=replace(PUMP.piston, radial_clearance=2e-5))
    task = replace(films.task, variants={E.WORN_PROFILE: worn})
    fitted = replace(PUMP, operating=replace(PUMP.operating, speed=100.0))
    varied = varied_pump(fitted, task, frozenset({E.WORN_PROFILE}))
    assert varied == replace(fitted, piston=worn.piston)
    assert varied_pump(fitted, task, frozenset()) == fitted
    assert [sorted(one.value for one in parts) for parts in task.sets] == [
        [], ["elastic_opening"], ["film_heating"], ["worn_profile"], ["elastic_opening", "film_heating"],
    ]  # fmt: skip
