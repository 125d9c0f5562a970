"""Response tables: a pump's gaps condensed.

The fidelity that is condensed here is a stand-in: the lumped law with films that thin under load as a power of the
Hersey number, which takes milliseconds. What a table must give back, and how far off it may be, is then known.
"""

from __future__ import annotations

import json
import math
import pickle
import re
from dataclasses import asdict, dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest
from bench_pump import BENCH
from stand_in_films import ThinningFilms

from gaps.response import Measure, Samples
from reynolds import FilmNotConverged, InputError, NotConverged
from system import InputFaults, Pair, PumpPoint, build_table, find_table, load_pump, operating_point, table_point
from system.description.effects import PhysicsSection
from system.inputs.sections.reader import section_of
from system.points.table.build import TableCase, point_at, table_axes
from system.points.table.means import GAP_PAIRS, MEANINGS, mean_ratios
from system.points.table.point import TablePoint
from system.points.table.pump_numbers import numbers_error, pump_numbers
from system.points.table.sources import FilmsSolver, Source, films_alone, left_out
from system.points.table.store import keep_table, own_table, pump_key, read_table, table_record
from system.work.processes import process_pool
from system.work.sampled_points import points_of, tables_folder

PUMP = load_pump(BENCH)
NAMES = list(MEANINGS)


@dataclass(frozen=True)
class NeverCalled(ThinningFilms):
    """The same content as `ThinningFilms`, but solving is a fault."""

    def solve(self, pump, point):
        raise AssertionError("a kept point was solved again")


@dataclass(frozen=True)
class Stops(ThinningFilms):
    """Breaks off with Ctrl-C at the points of full displacement, the upper half of the corners."""

    def solve(self, pump, point):
        if point.displacement_ratio > 0.9:
            raise KeyboardInterrupt
        return super().solve(pump, point)


def case(solver=None, learnt=48, held_out=12, pump=PUMP):
    return TableCase(pump, solver or ThinningFilms(), table_axes(pump), learnt, held_out)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(scope="module")
def table(folder):
    return build_table(case(), folder=folder)


def numbers(point: PumpPoint) -> dict[str, float]:
    """The values that a table must return."""
    flows = {f"leakage {gap}": flow for gap, flow in asdict(point.leakage_flow).items()}
    losses = {pair.value: point.pairs.loss(pair).mean for pair in Pair}
    return flows | losses | {"torque": point.bench.shaft_torque, "delivery": point.bench.delivery_flow}


def test_a_learnt_point_comes_back(table):
    """Ratios and their inverse: only the pressure's own small change by other leakage is left."""
    x = table.response.learnt.points[20]
    point = point_at(case(), x)
    direct, told = ThinningFilms().solve(PUMP, point), table_point(PUMP, point, table)
    assert numbers(told.pump_point) == pytest.approx(numbers(direct.pump_point), rel=1e-3)
    assert asdict(told.film_mean) == pytest.approx(asdict(direct.film_mean), rel=1e-9)
    assert asdict(told.film_least) == pytest.approx(asdict(direct.film_least), rel=1e-9)
    assert told.pump_point.checks.energy_balance_error < 1e-3


def test_an_unseen_point_is_within_the_stated_error(table):
    """At every held-out point, leakage and losses of the pump against the direct run of the same point."""
    largest = dict(zip(NAMES, table.response.held_out_error.largest, strict=True))
    for x in table.response.held_out.points:
        point = point_at(case(), x)
        direct, told = ThinningFilms().solve(PUMP, point).pump_point, table_point(PUMP, point, table).pump_point
        for gap, pair in GAP_PAIRS.items():
            flow, friction = (
                (getattr(p.leakage_flow, gap) for p in (told, direct)),
                (p.pairs.loss(pair).mean for p in (told, direct)),
            )
            for (got, true), name in ((flow, "leakage"), (friction, "friction")):
                assert abs(got / true - 1.0) <= largest[f"{gap}.{name}"] + 1e-3, (gap, name)


def test_a_table_states_what_its_runs_miss(table):
    """The pump's numbers by the table at every held-out point, against the direct runs: nothing is left out."""
    direct, told = [], []
    for x in table.response.held_out.points:
        point = point_at(case(), x)
        direct.append(pump_numbers(ThinningFilms().solve(PUMP, point).pump_point))
        told.append(pump_numbers(table_point(PUMP, point, table).pump_point))
    off = np.abs(np.array(told) / np.array(direct) - 1.0).max(axis=0)
    assert list(table.numbers.largest().values()) == pytest.approx(list(off), rel=1e-6)
    assert set(table.numbers.measures) == {Measure.RELATIVE}
    assert table.numbers.largest()["slipper.leakage_flow"] < 0.01


def test_numbers_that_pass_through_nothing_err_by_their_largest():
    """A leakage of -1 told as 1 is off by half of 4."""
    solved, told = np.array([[-1.0, 2.0], [4.0, 2.0]]), np.array([[1.0, 2.2], [4.0, 2.0]])
    found = numbers_error(told, solved)
    assert found.measures == (Measure.OF_LARGEST, Measure.RELATIVE)
    assert found.error.largest == pytest.approx([0.5, 0.1])
    assert list(found.error.worst) == [0, 0]


def test_the_stand_in_is_learnt(table):
    """Films over a factor of three, leakage over thirty: the held-out points find them to some per cent."""
    error = dict(zip(NAMES, table.response.held_out_error.largest, strict=True))
    assert error["slipper.film_mean"] < 1e-6  # a power of the inputs: linear in their logarithms
    assert error["slipper.leakage"] < 0.01
    assert error["slipper.friction"] < 0.1


def test_kept_points_are_not_solved_again(table, folder):
    again = build_table(case(NeverCalled()), folder=folder)
    assert np.array_equal(again.response.learnt.values, table.response.learnt.values)
    more = build_table(case(ThinningFilms(), learnt=60), folder=folder)  # the held-out 12 are the next to learn
    assert len(list((folder / "tables" / "points").glob("*.json"))) == 72
    assert np.array_equal(more.response.learnt.values[48:], table.response.held_out.values)


def test_other_content_is_another_point(table, folder):
    """Another solver, part, oil or case pressure finds nothing; name, operating point and line do not matter."""
    with pytest.raises(RuntimeError, match="kept point"):
        build_table(case(NeverCalled(exponent=0.2)), folder=folder)
    thinner = load_pump(BENCH, {"slipper.film_thickness": "9 um"})
    with pytest.raises(RuntimeError, match="kept point"):
        build_table(case(NeverCalled(), pump=thinner), folder=folder)
    keys = {
        pump_key(load_pump(BENCH, stated))
        for stated in (
            {}, {"operating.case_pressure": "2 bar"}, {"oil.density": "870 kg/m3"}, {"piston.mass": "150 g"},
        )
    }  # fmt: skip
    assert len(keys) == 4
    same = load_pump(BENCH, {"name": "other", "operating.speed": "900 rpm", "operating.temperature": "60 degC"})
    assert pump_key(same) == pump_key(PUMP)


def test_an_interrupted_table_goes_on(tmp_path):
    with pytest.raises(KeyboardInterrupt):
        build_table(case(Stops()), folder=tmp_path)
    kept = len(list((tmp_path / "tables" / "points").glob("*.json")))
    assert kept > 0
    told = []
    build_table(case(), folder=tmp_path, report=lambda done, total, what: told.append((done, total, what)))
    assert told[0] == (0, 60 - kept, f"{kept} points kept")
    assert told[-1][:2] == (60 - kept, 60 - kept)


def test_points_that_fail_are_told(tmp_path):
    table = build_table(case(ThinningFilms(broken=True)), folder=tmp_path)
    assert table.origin.failed
    assert all("made to fail" in one.reason for one in table.origin.failed)
    assert all(one.at[1] > 35e6 for one in table.origin.failed)
    count = len(table.response.learnt.points) + len(table.response.held_out.points)
    assert count + len(table.origin.failed) == 60


def test_a_table_of_failures_is_none(tmp_path):
    """Nothing to learn from is no table, and the first reason is told; failures are tried again."""

    @dataclass(frozen=True)
    class Fails(ThinningFilms):
        def solve(self, pump, point):
            raise FilmNotConverged("made to fail", "nothing")

    with pytest.raises(NotConverged, match=r"60 of 60 points have no result.*made to fail"):
        build_table(case(Fails()), folder=tmp_path)
    assert not list(tmp_path.rglob("*.json"))


def test_a_case_can_be_sent_to_another_process():
    """Workers get the same points by the same names."""
    here = case(FilmsSolver())
    there = pickle.loads(pickle.dumps(here))
    assert there == here
    assert there.key(points_of(there)[0]) == here.key(points_of(here)[0])
    with process_pool(2) as executor:
        assert sorted(executor.do(math.sqrt, [1.0, 4.0])) == [1.0, 2.0]
        assert sorted(executor.do(math.exp, [0.0, 0.0])) == [1.0, 1.0]


def test_a_table_is_found_by_its_pump(table, folder, tmp_path):
    build_table(case(learnt=60), folder=folder)
    point = operating_point(PUMP, delivery_pressure=20e6)
    assert len(find_table(PUMP, point, folder).response.learnt.points) == 60  # that of the most points
    with pytest.raises(InputFaults, match="delivery pressure"):
        find_table(PUMP, operating_point(PUMP, delivery_pressure=60e6), folder)
    with pytest.raises(InputFaults, match="swashfilm table PUMP"):
        find_table(PUMP, point, tmp_path)


def test_of_two_tables_the_one_that_leaves_out_less_is_taken(table, tmp_path):
    """Also where it has fewer points, in either order of building."""
    physics = "gaps float; left out: {}"
    for name, without, points in (("a", "elastic walls, heat", 48), ("b", "nothing", 36), ("c", "roughness", 48)):
        stated = dict(table.origin.stated) | {"physics": physics.format(without)}
        learnt = table.response.learnt
        response = replace(table.response, learnt=Samples(learnt.points[:points], learnt.values[:points]))
        kept = replace(table, origin=replace(table.origin, source=Source.FLOATING, stated=stated), response=response)
        keep_table(kept, tables_folder(tmp_path) / f"{pump_key(PUMP)}-{name}")
    point = operating_point(PUMP, delivery_pressure=20e6)
    found = find_table(PUMP, point, tmp_path)
    assert found.origin.stated["physics"] == physics.format("nothing")
    assert left_out(found.origin.stated) == ()
    assert left_out({"physics": physics.format("elastic walls, heat")}) == ("elastic walls", "heat")
    with pytest.raises(InputFaults) as refused:
        find_table(PUMP, replace(point, delivery_pressure=60e6), tmp_path)
    assert refused.value.faults[0].expected.count("shaft speed") == 1


def test_effects_outside_the_films_act_beside_a_table(table, folder):
    """The plain pump's table serves: drag, stroke, ports, inlet and a boundary layer act as in a direct run."""
    tables = {
        "control_flow": {"area": 2e-7, "laminar": 0.5},
        "churning": {"factor": 1.0},
        "swash_droop": {"rate": 5e-11, "play": 1e-3},
        "notch_erosion": {"advance": 0.02, "widening": 0.3},
        "mixed_friction": {"piston": 0.05, "hersey_scale": 1e-6},
        "incomplete_filling": {"inlet_loss": 3.0, "laminar": 0.3},
    }
    pump = replace(PUMP, physics=section_of(PhysicsSection, tables))
    point = point_at(case(), table.response.learnt.points[20])
    assert pump_key(pump) == pump_key(PUMP)
    told, direct = table_point(pump, point, table).pump_point, ThinningFilms().solve(pump, point).pump_point
    plain = table_point(PUMP, point, table).pump_point
    assert numbers(told) == pytest.approx(numbers(direct), rel=2e-3)
    drains = [one.bench.drain_flow - plain.bench.drain_flow for one in (told, direct)]
    assert drains[0] == pytest.approx(drains[1], rel=0.01)
    assert drains[0] > 1e-5
    assert direct.suction.mean_pressure < point.inlet_pressure - 1e3
    assert told.suction.mean_pressure == pytest.approx(direct.suction.mean_pressure, rel=1e-9)
    assert told.checks.energy_balance_error < 1e-3


def test_effects_of_films_make_another_table():
    tables = {"viscosity_pressure": {"coefficient": 1e-8}, "churning": {"factor": 1.0}}
    pump = replace(PUMP, physics=section_of(PhysicsSection, tables))
    assert pump_key(pump) != pump_key(PUMP)
    kept = films_alone(pump).physics
    assert (kept.viscosity_pressure is not None, kept.churning) == (True, None)


def test_a_clearance_by_temperature_makes_a_table_of_its_own_temperature():
    """It counts from the pump's temperature, which is an axis of all other tables."""
    warm = {"operating.temperature": "70 degC"}
    growing = section_of(PhysicsSection, {"thermal_clearance": {"piston": {"rate": 5e-3}}})
    keys = [pump_key(replace(load_pump(BENCH, stated), physics=growing)) for stated in ({}, warm)]
    assert keys[0] != keys[1]
    assert pump_key(load_pump(BENCH, warm)) == pump_key(PUMP)


def test_a_table_comes_back_from_its_files(table, tmp_path):
    keep_table(table, tmp_path / "mine")
    back = read_table(tmp_path / "mine.npz")
    assert back.origin == table.origin
    assert table_record(back) == table_record(table)
    point = operating_point(PUMP)
    assert back.at(PUMP, point) == table.at(PUMP, point)
    assert own_table(tmp_path / "mine.json", PUMP).origin == table.origin
    with pytest.raises(InputFaults, match="this very pump"):
        own_table(tmp_path / "mine.json", load_pump(BENCH, {"piston.mass": "150 g"}))
    record = json.loads((tmp_path / "mine.json").read_text())
    (tmp_path / "mine.json").write_text(json.dumps(record | {"table_format": 0}))
    with pytest.raises(InputFaults, match="build it anew"):
        read_table(tmp_path / "mine.json")
    (tmp_path / "mine.json").write_text("{")
    with pytest.raises(InputFaults, match="side by side"):
        read_table(tmp_path / "mine.json")


def test_another_inlet_pressure_is_refused(table):
    with pytest.raises(InputError, match="inlet pressure"):
        table_point(PUMP, operating_point(PUMP, inlet_pressure=1e6), table)
    with pytest.raises(InputError, match="nothing is extrapolated") as told:
        table_point(PUMP, operating_point(PUMP, shaft_speed=np.pi / 3.0, delivery_pressure=90e6), table)
    assert told.value.where == "shaft speed, delivery pressure"
    assert told.value.found == "10 rpm, 90 MPa"
    box = r"[\d.]+ rpm \.\. [\d.]+ rpm, [\d.]+ MPa \.\. [\d.]+ MPa, the table's box: .*"
    assert re.fullmatch(box, told.value.expected)


def test_a_line_of_stated_orifice_is_met(table):
    """The delivery pressure that the orifice makes of the flow is the one that the table is asked at."""
    held = table_point(PUMP, operating_point(PUMP, delivery_pressure=20e6), table)
    lined = {"delivery_line.kind": "orifice", "delivery_line.volume": "1 L"}
    free = table_point(load_pump(BENCH, lined), operating_point(PUMP, delivery_pressure=20e6), table)
    area = free.pump_point.delivery.orifice_area
    pump = load_pump(BENCH, lined | {"delivery_line.orifice_area": f"{area * 1e6!r} mm2"})
    found = table_point(pump, operating_point(PUMP, delivery_pressure=26e6), table).pump_point
    assert found.point.delivery_pressure == pytest.approx(20e6, rel=1e-3)
    assert numbers(found) == pytest.approx(numbers(held.pump_point), rel=2e-3)


@pytest.mark.slow
def test_films_point_by_its_own_ratios():
    """A table that knows a point of the fidelity fixed gives its leakage, losses and torque back to 0.2 %.

    What is lost is the course over the angle of each gap's conductance and friction; means are kept.
    """
    solver, point = FilmsSolver(positions_per_pitch=2), operating_point(PUMP, delivery_pressure=20e6)
    solved = solver.solve(PUMP, point)
    told = at_ratios(point, mean_ratios(PUMP, solved))
    direct = solved.pump_point
    assert numbers(told.pump_point) == pytest.approx(numbers(direct), rel=2e-3)
    assert told.pump_point.checks.energy_balance_error < 1e-3


def at_ratios(point, ratios) -> TablePoint:
    """A point by a table that has the same ratios everywhere."""

    @dataclass(frozen=True)
    class Everywhere:
        origin = SimpleNamespace(source=Source.FIXED)

        def at(self, pump, point):
            return dict(zip(NAMES, ratios, strict=True))

    return table_point(PUMP, point, Everywhere())
