"""Films at given positions with elastic or warm walls, and the law that a table of them makes."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH

from gaps import Axis, Response, floating_slipper
from gaps.response import Samples
from gaps.revolution.film_heat import Sink
from gaps.standing.heat import warm_turn
from reynolds import FilmSolver, boundary_flows, dynamic_viscosity, held_at
from system import (
    SIMULATED,
    SMOOTH,
    BenchPoints,
    BenchState,
    EffectId,
    Gap,
    GapCourse,
    InputFaults,
    LumpedBench,
    extended_pump,
    floating_parts,
    load_pump,
    lumped_point,
    operating_point,
    resolved_toml,
    rotor,
)
from system.effects import switched
from system.effects.catalogue import entries as catalogue
from system.effects.opening_tables import COMPLIANCE, OUTPUTS, OpeningCase, OpeningTable, SolvedOpening
from system.films.heat import slipper_heat
from system.films.positions import given_slipper, instant_drives
from system.films.problems import slipper_film
from system.pump.lumped import SAMPLES_PER_PITCH

REF90 = load_pump(BENCH)
STEEPEST = 1.5 * np.pi
SLOPE = 3e-8  # 1/Pa, of the leakage in the tables made up here
ROUNDED = 1e-14  # some tens of roundings of a table that is looked up


def made_up(gap: Gap, film: float = 10e-6) -> OpeningTable:
    """A table in which leakage rises and shear falls in proportion to the pressure, up to 60 MPa."""

    def samples(pressure):
        return Samples(pressure[:, None], np.column_stack([1.0 + SLOPE * pressure, 1.0 / (1.0 + SLOPE * pressure)]))

    axes = (Axis("pressure", 0.0, 60e6),)
    learnt, held_out = samples(np.linspace(0.0, 60e6, 13)), samples(np.array([7e6, 33e6]))
    return OpeningTable(gap, film, Response(axes, OUTPUTS, learnt, held_out))


def courses(pressure, film=10e-6):
    full = np.full((1, 4), 1.0)
    course = GapCourse(pressure * full, 9.9 * full, film * full, full, full, full, full, np.ones(1), np.ones(1))
    return dict.fromkeys(Gap, course)


def state(pressure):
    one = np.ones(1)
    return BenchState(
        220 * one, one, (pressure + 1.5e5) * one, 2.5e6 * one, 1.5e5 * one, 0.02 * one, 323 * one, 0 * one, REF90
    )


@pytest.mark.parametrize("gap", list(Gap))
def test_walls_without_compliance_change_nothing(gap):
    found = SolvedOpening(made_up(gap))({COMPLIANCE: 0.0}, courses(20e6), state(20e6))
    np.testing.assert_allclose(found.conductance, 1.0, rtol=ROUNDED)
    np.testing.assert_allclose(found.viscous, 1.0, rtol=ROUNDED)


@pytest.mark.parametrize(
    ("compliance", "film", "factor"), [(1.0, 10e-6, 1.6), (0.5, 10e-6, 1.3), (1.0, 20e-6, 1.3), (1.5, 10e-6, 1.9)]
)
def test_softer_walls_and_thinner_films_stand_at_a_higher_pressure_of_the_table(compliance, film, factor):
    """The law knows compliance times pressure over film alone; only its own gap is opened."""
    found = SolvedOpening(made_up(Gap.PISTON))({COMPLIANCE: compliance}, courses(20e6, film), state(20e6))
    assert found.conductance[0] == pytest.approx(factor, rel=1e-3)
    assert found.viscous[0] == pytest.approx(1.0 / factor, rel=1e-3)
    np.testing.assert_allclose(found.conductance[1:], 1.0, rtol=ROUNDED)


def test_a_ring_shears_under_the_delivery_pressure_at_every_angle():
    found = SolvedOpening(made_up(Gap.VALVE_PLATE))({COMPLIANCE: 1.0}, courses(0.0), state(20e6))
    np.testing.assert_allclose(found.conductance, 1.0, rtol=ROUNDED)
    assert found.viscous[2] == pytest.approx(1.0 / 1.6, rel=1e-3)


def test_a_table_that_comes_back_from_another_process_is_the_same_law():
    """Hypotheses fitted side by side come back as copies, and are looked up among the candidates."""
    law = SolvedOpening(made_up(Gap.PISTON))
    copied = pickle.loads(pickle.dumps(law))
    assert copied == law
    assert hash(copied) == hash(law)
    samples = law.table.response.learnt
    steeper = replace(samples, values=1.1 * samples.values)
    assert law != SolvedOpening(replace(law.table, response=replace(law.table.response, learnt=steeper)))


@pytest.mark.slow
def test_solved_films_open_by_compliance_times_pressure_over_film():
    """Of a slipper that hardly slides: under half the pressure a film of half the thickness opens as far."""
    crawling = replace(REF90, pump=replace(REF90.pump, rated_speed=5.0))
    part = crawling.slipper
    thinner = replace(crawling, slipper=replace(part, film_thickness=5e-6))
    whole = OpeningCase(crawling, Gap.SLIPPER).solve(np.array([20e6]))
    half = OpeningCase(thinner, Gap.SLIPPER).solve(np.array([10e6]))
    assert whole[0] > 1.5
    np.testing.assert_allclose(half, whole, rtol=5e-3)


def test_a_film_between_warm_walls_leaks_by_the_viscosity_of_their_temperature():
    """A slipper that hardly moves: oil takes its walls' temperature in a hundredth of the land's width."""
    point = replace(operating_point(REF90), shaft_speed=5.0, delivery_pressure=2e6)
    at, parts = rotor(REF90, point), floating_parts(REF90)
    drive = instant_drives(at, parts, STEEPEST, np.array([2e6])).slipper
    film = slipper_film(at, parts, drive, SMOOTH, (6, 24))
    floating, time = floating_slipper(film), STEEPEST / drive.shaft_speed
    solver = FilmSolver(film.space)
    cold = held_at(solver, floating, time, given_slipper(at, STEEPEST))
    kelvin = point.temperature + 10.0
    heat = replace(slipper_heat(at, parts), fixed=Sink(kelvin), moving=Sink(kelvin))
    (warm,) = warm_turn(solver, floating, [cold], heat, 0.0)
    thinner = [dynamic_viscosity(REF90.oil.fluid, each) for each in (point.temperature, kelvin)]
    leaks = [sum(boundary_flows(stage.solution)[edge] for edge in film.shape.lands.open) for stage in (cold, warm)]
    assert leaks[1] / leaks[0] == pytest.approx(thinner[0] / thinner[1], rel=0.02)


@pytest.mark.parametrize("keys", ["", 'opening = "20 1/GPa"\ncompliance = 1.0'])
def test_a_gap_opens_by_one_key(tmp_path, keys):
    file = tmp_path / "pump.toml"
    own = resolved_toml(REF90)
    file.write_text(f"{own}\n[physics.elastic_opening.slipper]\n{keys}\n", encoding="utf-8")
    with pytest.raises(InputFaults, match="one of the two"):
        load_pump(str(file))


def test_a_pump_that_states_its_compliance_runs_to_the_maps_readings(tmp_path, monkeypatch):
    """The catalogue's law at a value, and the file of the pump that a fit makes of it."""
    for module in (catalogue, switched):
        monkeypatch.setattr(module, "opening_table", lambda pump, gap, *report: made_up(gap))
    entry = next(one for one in catalogue.with_films_solved(REF90) if one.id is EffectId.ELASTIC_OPENING)
    law = next(one for one in entry.extensions if one.pair is Gap.SLIPPER)
    point = operating_point(REF90)
    here = [np.array([value]) for value in (point.shaft_speed, 1.0, point.delivery_pressure)]
    around = [np.array([value]) for value in (point.inlet_pressure, point.case_pressure, point.temperature)]
    points = BenchPoints(*here, *around, around[2], *np.zeros((3, 1)))
    bench = LumpedBench(REF90, points, SIMULATED, (), (law,), samples_per_pitch=SAMPLES_PER_PITCH)
    value = {"elastic_opening.slipper.compliance": 0.8}
    read = bench.predict(np.array(list(value.values())))[0]
    file = tmp_path / "extended.toml"
    file.write_text(resolved_toml(extended_pump(REF90, value, [law])), "utf-8")
    reading = lumped_point(load_pump(file), point).bench
    one = [reading.delivery_flow, reading.inlet_flow, reading.drain_flow, reading.shaft_torque]
    np.testing.assert_allclose(read, one, rtol=3e-5)
    assert reading.drain_flow > 1.1 * lumped_point(REF90, point).bench.drain_flow
