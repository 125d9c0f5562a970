"""Losses at the edges of lands: closed forms, limits, and that flow and energy stay whole."""

from __future__ import annotations

import numpy as np
import pytest
from bench_pump import BENCH

from gaps import PocketOrifice
from gaps.films.slipper import hagen_poiseuille_conductance, supply
from gaps.shapes.orifice_table import OrificeTable
from reynolds import InputError
from system import load_pump, lumped_point, operating_point, piston_motion
from system.effects.gap_states import bench_state
from system.effects.laws.film import through_orifice
from system.inputs.coefficients.edge_losses import KINETIC, Edge, LandPath, LossCourse, secant_conductance
from system.pump.land_losses import creeping_film_leaks, land_losses, orifice_table, with_inertia
from system.pump.lumped import lumped_leaks
from system.pump.operating import columns

DENSITY, VISCOSITY = 860.0, 0.02
NU = VISCOSITY / DENSITY
STEP_HEAD = "film_ratio [1], reynolds [1], extra_length [1], loss_factor [1]"
LOSSLESS = KINETIC, -KINETIC


def course(value: float) -> LossCourse:
    return LossCourse(np.array([0.0, 20.0]), np.array([value, value]))


def path_of(into: float, out: float, extra: float = 0.0) -> LandPath:
    forth, back = course(into), course(out)
    edges = (Edge(8e-3, extra, forth, back), Edge(14e-3, extra, back, forth))
    return LandPath(2.0 * np.pi, 20e-6, edges, ((8e-3, 14e-3),))


def step_file(place, extra, into, out, name="steps.csv"):
    rows = [f"{r}, {re}, {extra}, {k}" for r, k in ((0.02, into), (50, out)) for re in (0, 5, 20)]
    path = place / name
    path.write_text("\n".join(["# source: a test", STEP_HEAD, *rows]) + "\n", encoding="utf-8")
    return str(path)


def leakage(over):
    pump = load_pump(BENCH, over)
    return lumped_point(pump, operating_point(pump))


def test_edges_that_keep_kinetic_energy_leave_no_inertia():
    flow = np.array([-2e-5, 0.0, 1e-5])
    lossless = path_of(*LOSSLESS).inertia(flow, DENSITY, NU)
    alone = path_of(0.0, 0.0).inertia(flow, DENSITY, NU)
    assert np.abs(lossless).max() < 1e-12 * np.abs(alone).max()
    # Between discs: 27/35 rho u^2 from edge to edge (Hunt, Torbe 1962); the flow slows, so pressure is given back.
    speeds = flow[2] / (2.0 * np.pi * np.array([8e-3, 14e-3]) * 20e-6)
    assert alone[2] == pytest.approx(27.0 / 35.0 * DENSITY * (speeds[1] ** 2 - speeds[0] ** 2), rel=1e-12)


def test_flow_that_turns_enters_where_it_left():
    into, out = course(1.7), course(-0.8)
    edges = Edge(14e-3, 0.0, into, out), Edge(8e-3, 0.0, out, into)
    inward = LandPath(2.0 * np.pi, 20e-6, edges, ((14e-3, 8e-3),))
    flow = np.array([1e-5])
    assert inward.inertia(flow, DENSITY, NU) == pytest.approx(-path_of(1.7, -0.8).inertia(-flow, DENSITY, NU))
    assert inward.inertia(flow, DENSITY, NU)[0] > 0.0


def test_a_constant_factor_solves_the_quadratic():
    """dp = q/G + k q^2: the closed form, at drops of either sign, and G itself at none."""
    conductance, k = np.full(3, 1e-13), 5e17
    drop = np.array([-3e7, 0.0, 3e7])
    found = secant_conductance(conductance, lambda q: k * q * np.abs(q), drop, "x") * drop
    root = (np.sqrt(1.0 + 4.0 * k * conductance**2 * np.abs(drop)) - 1.0) / (2.0 * k * conductance)
    assert found == pytest.approx(np.sign(drop) * root, rel=1e-12)
    assert secant_conductance(conductance, lambda q: k * q * np.abs(q), drop, "x")[1] == pytest.approx(1e-13)


def test_a_drop_that_falls_with_the_flow_is_refused():
    with pytest.raises(InputError, match="grow with the flow"):
        secant_conductance(np.array([1e-13]), lambda q: -1e19 * q * np.abs(q), np.array([3e7]), "slipper")


def test_an_edge_adds_its_length_of_film():
    """A narrow ring is a plane land: length/h^3 more by extra_length h at each edge."""
    radius, land, film, extra = 1.0, 1e-3, 20e-6, 0.63
    edges = tuple(Edge(r, extra, course(0.0), course(0.0)) for r in (radius, radius + land))
    path = LandPath(2.0 * np.pi, film, edges)
    plane = 12.0 * VISCOSITY * 2.0 * extra * film / (2.0 * np.pi * radius * film**3)
    assert path.resistance(VISCOSITY) == pytest.approx(plane, rel=1e-3)
    assert path.extra_log == pytest.approx(2.0 * extra * film / radius, rel=1e-3)


@pytest.fixture
def plain():
    return leakage({}).leakage_flow


def test_lossless_files_leave_the_pump_as_it_is(tmp_path, plain):
    file = step_file(tmp_path, 0.0, *LOSSLESS)
    found = leakage({"slipper.pocket_file": file, "valve_plate.kidney_file": file}).leakage_flow
    for gap in ("piston", "slipper", "valve_plate"):
        assert getattr(found, gap) == pytest.approx(getattr(plain, gap), rel=1e-9)


def test_extra_length_is_that_much_land(tmp_path, plain):
    pump = load_pump(BENCH)
    slipper, plate = pump.slipper, pump.valve_plate
    file = step_file(tmp_path, 0.63, *LOSSLESS)
    found = leakage({"slipper.pocket_file": file, "valve_plate.kidney_file": file}).leakage_flow
    longer = 0.63 * slipper.film_thickness * (1 / slipper.land_inner_radius + 1 / slipper.land_outer_radius)
    log = slipper.lands.log_ratio
    assert found.slipper / plain.slipper == pytest.approx(log / (log + longer), abs=1e-5)
    logs = [
        (np.log(out / inner), 0.63 * plate.film_thickness * (1.0 / out + 1.0 / inner))
        for inner, out in ((plate.land_radius_1, plate.land_radius_2), (plate.land_radius_3, plate.land_radius_4))
    ]
    share = sum(1.0 / (log + more) for log, more in logs) / sum(1.0 / log for log, _ in logs)
    assert found.valve_plate / plain.valve_plate == pytest.approx(share, abs=1e-5)


def test_films_that_are_parallel_lose_as_the_lumped_law(tmp_path):
    """Leaks of a parallel film with edges in series are those of the law whose logarithms have grown."""
    file = step_file(tmp_path, 0.63, 1.6, -1.4)
    over = {"slipper.film_thickness": "30 um", "valve_plate.film_thickness": "24 um"}
    plain, edged = (
        load_pump(BENCH, over | files) for files in ({}, {"slipper.pocket_file": file, "valve_plate.kidney_file": file})
    )
    point = operating_point(plain)
    motion = piston_motion(plain, point)
    found = creeping_film_leaks(edged, lumped_leaks(plain, point, motion), point.viscosity)
    law = lumped_leaks(edged, point, motion)
    assert found.conductance == pytest.approx(law.conductance, rel=1e-6, abs=0.0)
    drop = np.full(motion.shaft_angle.size, 3e7)
    one, other = (with_inertia(edged, leaks, drop, point.viscosity, bore=True) for leaks in (found, law))
    assert one.conductance == pytest.approx(other.conductance, rel=1e-6, abs=0.0)
    assert np.all(one.conductance[1:] < law.conductance[1:])
    assert np.array_equal(one.conductance[0], law.conductance[0])


def test_leakage_falls_with_every_loss_and_nothing_is_lost(tmp_path):
    flows = []
    for into in (KINETIC, 3.0, 30.0, 300.0):
        file = step_file(tmp_path, 0.63, into, -KINETIC, f"steps_{into:g}.csv")
        found = leakage({"slipper.pocket_file": file, "valve_plate.kidney_file": file})
        flows.append([found.leakage_flow.slipper, found.leakage_flow.valve_plate])
        assert found.checks.mass_balance_error < 1e-9
        assert found.checks.work_balance_error < 1e-6
    assert np.all(np.diff(flows, axis=0) < 0.0)


def poiseuille(ratio: float, reynolds=(0.1, 1.0, 10.0, 1e4)) -> OrificeTable:
    log = np.log(np.array(reynolds))
    return OrificeTable(tuple(0.5 * (log + np.log(64.0 * ratio))), tuple(log))


def test_a_table_of_poiseuille_flow_is_the_capillary():
    d, length = 0.9e-3, 5e-3
    table = poiseuille(length / d)
    assert table.equal_length(d) == pytest.approx(length, rel=1e-12)
    capillary = hagen_poiseuille_conductance(d, length, VISCOSITY)
    assert table.conductance(d, VISCOSITY) == pytest.approx(capillary, rel=1e-12, abs=0.0)
    fed = supply(PocketOrifice(d, length, None, table), VISCOSITY, DENSITY)
    for drop in (-2e5, 0.0, 1e-3, 2e5):
        flow, slope = fed(drop)
        assert flow == pytest.approx(capillary * drop, rel=1e-12)
        assert slope == pytest.approx(capillary, rel=1e-12, abs=0.0)


def test_flow_and_drop_of_a_table_are_each_other_s_inverse():
    reynolds = np.array([1.0, 5.0, 20.0, 60.0, 200.0])
    coefficient = 0.7 * reynolds**0.5 / (reynolds + 30.0) ** 0.5
    table = OrificeTable(tuple(np.log(reynolds / coefficient)), tuple(np.log(reynolds)))
    drops = np.array([-1e7, -1e5, 1e2, 1e4, 1e6, 1e8])
    flows = [table.flow(drop, 1e-3, VISCOSITY, DENSITY) for drop in drops]
    assert table.drop(np.array([flow for flow, _ in flows]), 1e-3, VISCOSITY, DENSITY) == pytest.approx(drops)
    for drop, (_, slope) in zip(drops, flows, strict=True):
        beside = [float(table.flow(drop * (1.0 + e), 1e-3, VISCOSITY, DENSITY)[0]) for e in (-1e-5, 1e-5)]
        assert slope == pytest.approx((beside[1] - beside[0]) / (2e-5 * drop), rel=1e-6, abs=0.0)


def test_a_bore_s_file_takes_the_place_of_its_length(tmp_path):
    """A file of Poiseuille's flow through 5 mm is the pump's own bore; one of twice the length is another."""
    pump = load_pump(BENCH)
    opening = 0.25e6 * np.pi * pump.slipper.orifice_diameter**2

    def file(ratio):
        path = tmp_path / f"bore_{ratio:g}.csv"
        rows = [f"{opening:.12g}, {re}, {np.sqrt(re / (64.0 * ratio)):.12g}" for re in (0.01, 0.1, 10.0, 100.0, 400.0)]
        head = ["# source: Poiseuille", "opening [mm2], reynolds [1], flow_coefficient [1]"]
        path.write_text("\n".join([*head, *rows]) + "\n", encoding="utf-8")
        return str(path)

    own = pump.slipper.orifice_length / pump.slipper.orifice_diameter
    point = operating_point(pump)
    motion = piston_motion(pump, point)
    wanted = lumped_leaks(pump, point, motion).conductance[1]
    same = load_pump(BENCH, {"slipper.orifice_file": file(own)})
    assert lumped_leaks(same, point, motion).conductance[1] == pytest.approx(wanted, rel=1e-9, abs=0.0)
    assert leakage({"slipper.orifice_file": file(own)}).leakage_flow.slipper == pytest.approx(
        leakage({}).leakage_flow.slipper, rel=1e-8
    )
    longer = load_pump(BENCH, {"slipper.orifice_length": "10 mm"})
    twice = load_pump(BENCH, {"slipper.orifice_file": file(2.0 * own)})
    assert lumped_leaks(twice, point, motion).conductance[1] == pytest.approx(
        lumped_leaks(longer, point, motion).conductance[1], rel=1e-9, abs=0.0
    )
    left = [through_orifice(np.array([1e9]), bench_state(one, columns(point), np.zeros(1))) for one in (twice, longer)]
    assert left[0] == pytest.approx(left[1], rel=1e-9)


def test_openings_between_rows_are_interpolated():
    from pathlib import Path

    from system.inputs.coefficients.flow_files import FlowCoefficients

    reynolds = np.array([[1.0, 10.0, 100.0]] * 2)
    coefficients = np.array([[0.1, 0.3, 0.6], [0.2, 0.4, 0.7]])
    made = FlowCoefficients(Path("x"), "x", np.array([1e-6, 4e-6]), reynolds, coefficients)
    between = orifice_table(made, 2e-6).laminar
    ends = [orifice_table(made, size).laminar for size in (1e-6, 4e-6)]
    assert between == pytest.approx(np.sqrt(ends[0] * ends[1]), rel=1e-9)
    assert orifice_table(made, 1e-9).laminar == pytest.approx(ends[0])


def test_grooves_take_their_own_file(tmp_path):
    head = "# source: x\nfilm_ratio [1], width_ratio [1], reynolds [1], extra_length [1], loss_factor [1]\n"
    rows = [f"{r}, {w}, {re}, {0.1 * w}, {k}" for r in (2, 8) for w in (1, 100) for re, k in ((0, 0), (5, 0.2))]
    groove = tmp_path / "grooves.csv"
    groove.write_text(head + "\n".join(rows) + "\n", encoding="utf-8")
    steps = step_file(tmp_path, 0.6, 1.6, -1.5)
    stated = {"slipper.groove_file": str(groove), "slipper.pocket_file": steps}
    pump = load_pump(BENCH, {**stated, "slipper.grooves": [["10 mm", "10.1 mm"]]})
    path = land_losses(pump).slipper
    into, middle, out = path.edges
    assert (into.radius, middle.radius, out.radius) == (8.2e-3, pytest.approx(10.05e-3), 14e-3)
    width = 0.1e-3 / pump.slipper.film_thickness
    lengths = np.interp(np.log(width), np.log([1.0, 100.0]), [0.1 + 1.0 / 512.0, 10.0 + 100.0 / 512.0])
    assert middle.extra_length == pytest.approx(lengths, rel=1e-12)
    assert middle.forth.at(np.array([0.0, 5.0])) == pytest.approx([0.0, 0.2])
    assert path.lands == ((8.2e-3, 14e-3),)
