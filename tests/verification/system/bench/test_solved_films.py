"""Films of response tables in a bench map: readings of runs by table, shares between tables, the table's error."""

from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH
from stand_in_films import ThinningFilms

from system import build_table, load_pump, table_point
from system.bench.outputs import SIMULATED
from system.bench.points import BenchPoints
from system.bench.simulator import LumpedBench
from system.effects.effect import EffectId
from system.points.table.build import TableCase, point_at, table_axes
from system.points.table.film_law import SolvedFilms, share_name
from system.points.table.film_physics import film_entry
from system.points.table.sources import films_alone

PUMP = load_pump(BENCH)
PARTS = (EffectId.ELASTIC_OPENING, EffectId.FILM_HEATING)


def case(exponent: float) -> TableCase:
    axes = table_axes(PUMP, held=("viscosity", "displacement_ratio"))
    return TableCase(PUMP, ThinningFilms(exponent), axes, 12, 4)


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    """Tables of four pumps, by the exponent of their films."""
    folder = tmp_path_factory.mktemp("cache")
    return {exponent: build_table(case(exponent), folder=folder) for exponent in (0.0, 0.05, 0.1, 0.2)}


@pytest.fixture(scope="module")
def places(tables):
    return np.concatenate([tables[0.1].response.learnt.points[-4:], tables[0.1].response.held_out.points])


def bench(places, law, pump=PUMP) -> LumpedBench:
    points = [point_at(case(0.1), x) for x in places]

    def column(name):
        return np.array([getattr(point, name) for point in points])

    warm = column("temperature")
    map_points = BenchPoints(
        speed=column("shaft_speed"), displacement_ratio=column("displacement_ratio"),
        p_out=column("delivery_pressure"), p_in=column("inlet_pressure"), p_case=column("case_pressure"),
        T_in=warm, T_case=warm, hours=np.zeros(len(points)), order=np.arange(len(points), dtype=float),
        warming=np.zeros(len(points)),
    )  # fmt: skip
    return LumpedBench(films_alone(pump), map_points, SIMULATED, (), samples_per_pitch=40, own_laws=((law, {}),))


def readings(places, law, shares=None):
    """Readings (N, 4) with given shares."""
    own = bench(places, law).with_extensions(tuple(film_entry(part).extensions[0] for part in PARTS))
    named = {share_name(part): share for part, share in (shares or {}).items()}
    return own.predict(np.array([named.get(one.name, 0.0) for one in own.parameters]))


def by_table(places, table):
    found = [table_point(PUMP, point_at(case(0.1), x), table).pump_point.bench for x in places]
    return np.array([(one.delivery_flow, one.inlet_flow, one.drain_flow, one.shaft_torque) for one in found])


def test_a_bench_reads_what_runs_by_table_give(tables, places):
    """Flows and torque at every point; chambers of the bench are solved to 1e-5 of the pressure."""
    told = readings(places, SolvedFilms(films_alone(PUMP), tables[0.1]))
    expected = by_table(places, tables[0.1])
    assert told[:, [0, 1, 3]] == pytest.approx(expected[:, [0, 1, 3]], rel=2e-4)
    assert told[:, 2] == pytest.approx(expected[:, 2], rel=2e-3)


def test_contact_remains_without_a_coefficient(tables, places):
    """Two fifths of the slippers' loss is contact by the table, [friction] has none: the bench's torque has it too."""
    pump = replace(PUMP, friction=replace(PUMP.friction, slipper_swash_plate=0.0))
    table = tables[0.0]
    names, learnt = [one.name for one in table.response.outputs], table.response.learnt
    values = learnt.values.copy()
    values[:, names.index("slipper.contact_share")] = 0.4
    rubbed = replace(table, response=replace(table.response, learnt=replace(learnt, values=values)))
    expected = [table_point(pump, point_at(case(0.0), x), rubbed).pump_point for x in places]
    law = SolvedFilms(films_alone(pump), rubbed)
    told = bench(places, law, pump).predict(np.zeros(0))[:, 3]
    contact = np.array([one.pairs.slipper_swash_plate.mean_coulomb / one.point.shaft_speed for one in expected])
    assert contact.min() > 0.4
    assert told == pytest.approx([one.bench.shaft_torque for one in expected], rel=2e-4)


def test_shares_lead_from_table_to_table(tables, places):
    """Neither, one or both parts of the physics: the readings of the table that has them."""
    pair = {frozenset(PARTS): tables[0.2]}
    law = SolvedFilms(films_alone(PUMP), tables[0.0], dict(zip(PARTS, (tables[0.05], tables[0.1]), strict=True)), pair)
    one, other = PARTS
    for shares, exponent in (({}, 0.0), ({one: 1.0}, 0.05), ({other: 1.0}, 0.1), ({one: 1.0, other: 1.0}, 0.2)):
        alone = readings(places, SolvedFilms(films_alone(PUMP), tables[exponent]))
        assert readings(places, law, shares) == pytest.approx(alone, rel=1e-9), shares


def test_without_a_table_of_both_parts_their_changes_add(tables, places):
    """Half a share is half the change of the leakage, and two parts without a table of both add theirs."""
    law = SolvedFilms(films_alone(PUMP), tables[0.0], dict(zip(PARTS, (tables[0.05], tables[0.1]), strict=True)))
    none, half, whole = (readings(places, law, {PARTS[0]: share})[:, 2] for share in (0.0, 0.5, 1.0))
    assert half - none == pytest.approx(0.5 * (whole - none), rel=0.02)
    other = readings(places, law, {PARTS[1]: 1.0})[:, 2]
    both = readings(places, law, dict.fromkeys(PARTS, 1.0))[:, 2]
    assert both - none == pytest.approx(whole + other - 2.0 * none, rel=0.02)


def test_an_error_of_the_table_moves_the_readings(tables, places):
    """A tenth more leakage of all gaps is a tenth more case drain than dragged oil accounts for."""
    law = SolvedFilms(films_alone(PUMP), tables[0.1])
    more = {f"{gap}.leakage": 0.1 for gap in ("piston", "slipper", "valve_plate")}
    plain, moved = readings(places, law), readings(places, replace(law, off=more))
    assert moved[:, 2] == pytest.approx(1.1 * plain[:, 2], rel=5e-3)
    assert np.all(moved[:, 0] < plain[:, 0])
