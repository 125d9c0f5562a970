"""Chamber pressure against closed forms, an independent stiff solver, and its own conservation laws."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from reynolds import NotConverged
from system import (
    PortOpening,
    ReliefGroove,
    SwashDrive,
    opening_area,
    orifice_flow,
    piston_conductance,
    piston_displacement,
    piston_velocity,
)
from system.pump.chamber import kernels as kernel
from system.pump.chamber.cycle import bubbly_volume, solve_cycle
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.chamber.problem import ChamberProblem, LeakTable, PortPressure
from system.pump.chamber.setup import periodic_cubics
from system.pump.chamber.state_kernels import energy_at, oil_volume
from system.pump.laws.kinematics import drive_at_ratio, stand_out
from system.pump.laws.leakage import piston_drag_flow

DEGREES = np.pi / 180.0
AREA = np.pi / 4 * 22e-3**2
SPEED = 2100.0 * 2 * np.pi / 60
FULL = SwashDrive(45e-3, 5 * DEGREES, 16.2 * DEGREES)
ANGLES = np.array([-5.0, 10.0, 40.0, 140.0, 170.0]) * DEGREES
SHUT = PortOpening(0.0, *ANGLES[1:], 0.0)
GROOVE = ReliefGroove(ANGLES[0], ANGLES[1], 4e-6)
COLUMNS = 90


def leak_table(drive: SwashDrive, shaft_speed: float) -> LeakTable:
    """Piston leakage as on REF90, two constant leaks beside it."""
    angle = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
    length = 45e-3 - stand_out(FULL, drive) - piston_displacement(drive, angle)
    conductance = np.stack([piston_conductance(22e-3, 15e-6, length, 0.6, 25.8e-3)] * 3)
    conductance[1:] = [[3.8e-14], [1.6e-14]]
    carried = np.zeros_like(conductance)
    carried[0] = piston_drag_flow(22e-3, 15e-6, piston_velocity(drive, angle, shaft_speed))
    return LeakTable(conductance, carried)


def pump(delivery_pressure: float, ratio: float, shaft_speed: float = SPEED) -> ChamberProblem:
    """A chamber of REF90."""
    drive = drive_at_ratio(FULL, ratio)
    port = replace(SHUT, grooves=(GROOVE,), kidney_area=152e-6)
    return ChamberProblem(
        drive=drive,
        shaft_speed=shaft_speed,
        piston_area=AREA,
        dead_volume=6e-6 + AREA * stand_out(FULL, drive),
        delivery_pressure=delivery_pressure,
        inlet_pressure=2.5e6,
        case_pressure=0.15e6,
        bulk_modulus=1.6e9,
        density=860.0,
        kinematic_viscosity=30e-6,
        flow_coefficient=0.7,
        critical_reynolds=150.0,
        delivery_port=replace(port, dead_centre=np.pi),
        suction_port=port,
        leaks=leak_table(drive, shaft_speed),
    )


def sealed(leak: float) -> ChamberProblem:
    """A chamber without ports, one linear leak and a volume so large that it hardly changes."""
    conductance = np.zeros((3, 8))
    conductance[2] = leak
    return replace(
        pump(50e6, 1.0),
        drive=SwashDrive(45e-3, 0.0, 16.2 * DEGREES),
        dead_volume=1.0,
        inlet_pressure=50e6,
        case_pressure=50e6,
        delivery_port=SHUT,
        suction_port=SHUT,
        leaks=LeakTable(conductance, np.zeros((3, 8))),
    )


@pytest.mark.parametrize(("weights", "order"), [(kernel.WEIGHTS, 4), (kernel.EMBEDDED, 3)])
def test_order_conditions_of_the_method(weights, order):
    a, c = kernel.TABLEAU, kernel.NODES
    conditions = [
        (1, weights.sum(), 1.0),
        (2, weights @ c, 1 / 2),
        (3, weights @ c**2, 1 / 3),
        (3, weights @ a @ c, 1 / 6),
        (4, weights @ c**3, 1 / 4),
        (4, weights @ (c * (a @ c)), 1 / 8),
        (4, weights @ a @ c**2, 1 / 12),
        (4, weights @ a @ a @ c, 1 / 24),
    ]
    for rank, found, wanted in conditions:
        if rank <= order:
            assert found == pytest.approx(wanted, abs=1e-15)
    np.testing.assert_allclose(a.sum(axis=1), c, atol=1e-15)
    np.testing.assert_allclose((a @ c)[1:], c[1:] ** 2 / 2, atol=1e-15)  # stage order 2


def test_a_closed_chamber_follows_the_bulk_modulus():
    problem = replace(sealed(0.0), dead_volume=1e-3, drive=FULL)
    cycle = solve_cycle(problem, 360)
    volume = problem.dead_volume + AREA * piston_displacement(FULL, cycle.shaft_angle)
    expected = cycle.pressure[0] + problem.bulk_modulus * np.log(volume[0] / volume)
    np.testing.assert_allclose(cycle.pressure, expected, atol=1.0)  # Newton's tolerance, some mPa, per step
    np.testing.assert_allclose(cycle.volume, volume, rtol=1e-14)
    assert np.ptp(cycle.pressure) > 15e6


def test_growth_of_a_closed_chamber_counts_as_volume():
    """Parts that move by micrometres: p = p0 + K ln(V0/V) with their volume in V, and their work in the work."""
    angle = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
    growth = 2e-6 * np.sin(angle + 0.7) ** 3
    leaks = LeakTable(np.zeros((3, COLUMNS)), np.zeros((3, COLUMNS)))
    problem = replace(sealed(0.0), dead_volume=1e-3, drive=FULL, leaks=leaks, growth=growth)
    cycle = solve_cycle(problem, 4 * COLUMNS)
    volume = problem.dead_volume + AREA * piston_displacement(FULL, cycle.shaft_angle)
    volume[::4] += growth
    expected = cycle.pressure[0] + problem.bulk_modulus * np.log(volume[0] / volume)
    np.testing.assert_allclose(cycle.pressure[::4], expected[::4], atol=1.0)
    np.testing.assert_allclose(cycle.volume[::4], volume[::4], rtol=1e-14)
    swell = AREA * piston_velocity(FULL, cycle.shaft_angle, 1.0)
    piston_work = -np.mean(cycle.pressure * swell) * 2 * np.pi
    # a closed chamber takes no work in all; sin^3 by trapezoids of 1 deg is good to (3 deg)^2/6 = 5e-4
    assert abs(cycle.growth_work) > 1.0
    assert cycle.indicated_work == pytest.approx(0.0, abs=1e-6 * abs(cycle.growth_work))
    assert piston_work == pytest.approx(-cycle.growth_work, rel=5e-4)


def test_growth_and_leaks_have_the_same_angles():
    with pytest.raises(ValueError, match=r"growth of the chamber: found shape \(5,\)"):
        solve_cycle(replace(sealed(0.0), growth=np.zeros(5)), 36)


@pytest.mark.parametrize("columns", [120, 360])
def test_mass_and_energy_close_with_pulsing_ports(columns):
    angle = 2 * np.pi * np.arange(columns) / columns
    ports = PortPressure(35e6 + 1e6 * np.sin(9 * angle), 2.5e6 + 2e5 * np.cos(9 * angle))
    problem = replace(pump(35e6, 1.0), port_pressure=ports)
    cycle = solve_cycle(problem, 360)
    assert cycle.checks.mass_balance_error < 1e-12
    assert cycle.checks.energy_balance_error < 1e-6
    held = solve_cycle(pump(35e6, 1.0), 360)
    delivering = (cycle.shaft_angle > 230 * DEGREES) & (cycle.shaft_angle < 310 * DEGREES)
    behind = 1e6 * np.sin(9 * cycle.shaft_angle)
    # between its ends an open chamber follows its port, but for the drop of the orifice
    follows = (cycle.pressure - held.pressure)[delivering]
    np.testing.assert_allclose(follows, behind[delivering], atol=0.02e6)
    # what the ports have passed since shaft angle 0 and the mean flow make up the samples' integral
    passed = np.gradient(cycle.surge[0], cycle.shaft_angle) * problem.shaft_speed
    passed += float(cycle.outflow.delivery) * problem.shaft_speed / (2 * np.pi)
    dense = np.exp(cycle.pressure / problem.bulk_modulus)
    np.testing.assert_allclose(passed[delivering], (cycle.flow.delivery * dense)[delivering], rtol=2e-2)


def test_constant_port_pressures_are_held_ones():
    ports = PortPressure(np.full(12, 35e6), np.full(12, 2.5e6))
    held, same = (solve_cycle(replace(pump(35e6, 1.0), port_pressure=p), 360) for p in (None, ports))
    np.testing.assert_allclose(same.pressure, held.pressure, atol=1.0)
    with pytest.raises(ValueError, match="port pressures"):
        PortPressure(np.zeros(3), np.zeros(3))


def test_a_linear_leak_gives_the_closed_periodic_answer():
    # y' = -a y - b sin(phi) with a = K G/(V w) = 1, b = K Ap R tan(g)/V has y = -b (a sin - cos)/(1 + a^2).
    problem = sealed(0.0)
    leak = problem.dead_volume * problem.shaft_speed / problem.bulk_modulus
    problem = sealed(leak)
    cycle = solve_cycle(problem, 360, tolerance=1e-10)
    swing = problem.bulk_modulus * AREA * problem.drive.stroke_scale / problem.dead_volume
    expected = -swing * (np.sin(cycle.shaft_angle) - np.cos(cycle.shaft_angle)) / 2
    # the volume changes by 1e-5, the tolerance is 1e-10 of (0 + 1e5) Pa and periodicity 1e-8 of it
    np.testing.assert_allclose(cycle.pressure - 50e6, expected, atol=3e-5 * swing)
    assert cycle.effort.revolutions > 1


def test_a_chamber_that_never_settles_raises():
    problem = sealed(0.0)
    leak = 1e-4 * problem.dead_volume * problem.shaft_speed / problem.bulk_modulus
    with pytest.raises(NotConverged, match="still changes"):
        solve_cycle(replace(sealed(leak), case_pressure=0.0), 36)


@pytest.mark.parametrize(("pressure", "ratio"), [(20e6, 0.13), (5e6, 0.13)])
def test_against_an_independent_integration_of_equation_14(pressure, ratio):
    problem = pump(pressure, ratio)
    cycle = solve_cycle(problem, 360)
    law = (problem.flow_coefficient, problem.density, problem.kinematic_viscosity, problem.critical_reynolds)
    gap_angle = 2 * np.pi * np.arange(COLUMNS + 1) / COLUMNS
    gaps = np.concatenate([problem.leaks.conductance, problem.leaks.conductance[:, :1]], axis=1).sum(axis=0)

    def slope(phi: float, state: np.ndarray) -> list[float]:
        p, drive = float(state[0]), problem.drive
        velocity = float(piston_velocity(drive, phi, problem.shaft_speed))
        out = float(
            orifice_flow(p - problem.delivery_pressure, float(opening_area(problem.delivery_port, phi)), *law)
            + orifice_flow(p - problem.inlet_pressure, float(opening_area(problem.suction_port, phi)), *law)
        )
        out += np.interp(phi % (2 * np.pi), gap_angle, gaps) * (p - problem.case_pressure)
        out += float(piston_drag_flow(22e-3, 15e-6, velocity))
        volume = problem.dead_volume + AREA * float(piston_displacement(drive, phi))
        return [-problem.bulk_modulus / volume * (AREA * velocity + out) / problem.shaft_speed]

    kinks = np.array([90, 140, 170, 175, 190, 220, 320, 350, 355, 370, 400, 450]) * DEGREES
    state, worst = cycle.pressure[90], 0.0
    for begin, end in pairwise(kinks):
        samples = np.arange(np.ceil(begin / DEGREES - 1e-9), np.floor(end / DEGREES + 1e-9) + 1) * DEGREES
        samples = np.clip(samples, begin, end)
        run = solve_ivp(slope, (begin, end), [state], "Radau", samples, rtol=1e-8, atol=1.0)
        found = cycle.pressure[np.round(samples / DEGREES).astype(int) % 360]
        worst = max(worst, np.abs(run.y[0] - found).max())
        state = run.y[0][-1]
    # 1e-6 per step over some 400 steps bounds the error by 4e-4 of the pressure difference
    assert worst < 4e-4 * (pressure - problem.inlet_pressure)


@pytest.mark.parametrize(
    ("pressure", "ratio", "rpm"),
    [(35e6, 1.0, 2100), (5e6, 1.0, 2100), (35e6, 0.13, 1000), (15e6, 0.5, 1500), (2.5e6, 1.0, 2100)],
)
def test_mass_and_energy_close(pressure, ratio, rpm):
    problem = pump(pressure, ratio, rpm * 2 * np.pi / 60)
    cycle = solve_cycle(problem, 360)
    assert cycle.checks.mass_balance_error < 1e-12
    assert cycle.checks.energy_balance_error < 1e-6
    assert cycle.checks.periodicity_error <= 1e-8 * (pressure - 2.5e6 + 1e5)
    assert min(float(cycle.path_energy.delivery), float(cycle.path_energy.suction)) > 0.0
    # the work by quadrature of the samples, an independent path to the same number (second order in 1 degree)
    swell = AREA * piston_velocity(problem.drive, cycle.shaft_angle, 1.0)
    work = -np.mean(cycle.pressure * swell) * 2 * np.pi
    assert work == pytest.approx(cycle.indicated_work, abs=2e-3 * AREA * 27e-3 * 35e6 * ratio)


def test_the_samples_add_up_to_the_integrals():
    # The flow bends like a root where the pressures meet: order 1.5 in the half degree, so some 1e-3.
    cycle = solve_cycle(pump(35e6, 1.0), 720)
    problem = pump(35e6, 1.0)
    dense = np.exp(cycle.pressure / problem.bulk_modulus) * 2 * np.pi / problem.shaft_speed
    swept = AREA * 2 * problem.drive.stroke_scale
    for name in ("delivery", "suction", "piston", "slipper", "valve_plate"):
        total = np.mean(getattr(cycle.flow, name) * dense)
        assert total == pytest.approx(float(getattr(cycle.outflow, name)), abs=1e-3 * swept), name


@pytest.mark.parametrize(("pressure", "ratio"), [(35e6, 1.0), (5e6, 1.0), (35e6, 0.28), (10e6, 0.13)])
def test_the_answer_moves_with_the_tolerance(pressure, ratio):
    problem = pump(pressure, ratio)
    span = pressure - problem.inlet_pressure
    reference = solve_cycle(problem, 360, 1e-10)
    for tolerance in (1e-4, 1e-5, 1e-6):
        cycle = solve_cycle(problem, 360, tolerance)
        # some 400 steps, each good to the tolerance; open ports forget most of them
        assert np.abs(cycle.pressure - reference.pressure).max() < 50 * tolerance * span
        work = abs(cycle.indicated_work - reference.indicated_work)
        assert work < tolerance * abs(reference.indicated_work)


def test_oil_bears_no_tension_and_the_cavity_keeps_its_mass():
    problem = pump(35e6, 1.0)
    cycle = solve_cycle(problem, 360)
    assert cycle.cavitates
    assert cycle.pressure.min() > -101325.0
    void = cycle.pressure < CAVITY_PRESSURE
    assert 0.01 < void.mean() < 0.06
    assert not solve_cycle(pump(20e6, 0.13), 360).cavitates


def test_a_starved_chamber_takes_in_what_its_orifice_passes():
    """A port of 20 mm2 at 3600 r/min: liquid comes in whatever void stands behind it (0.2 %: angles of 1 deg)."""
    narrow = replace(SHUT, grooves=(GROOVE,), kidney_area=20e-6)
    problem = replace(
        pump(20e6, 1.0, 377.0),
        inlet_pressure=0.0,
        case_pressure=0.0,
        suction_port=narrow,
        delivery_port=replace(narrow, dead_centre=np.pi),
    )
    cycle = solve_cycle(problem, 360)
    void = cycle.pressure < CAVITY_PRESSURE
    assert void.mean() > 0.4  # so that the void's share of the volume matters
    law = (problem.flow_coefficient, problem.density, problem.kinematic_viscosity, problem.critical_reynolds)
    areas = opening_area(problem.suction_port, cycle.shaft_angle)
    taken = [orifice_flow(-p, area, *law) for p, area in zip(cycle.pressure, areas, strict=True)]
    density = np.exp(np.maximum(cycle.pressure, CAVITY_PRESSURE) / problem.bulk_modulus)
    assert -cycle.outflow.suction == pytest.approx(np.mean(density * taken) * 2 * np.pi / problem.shaft_speed, rel=2e-3)


def test_leak_spline_is_periodic_and_fourth_order():
    def worst(columns: int) -> float:
        angle = 2 * np.pi * np.arange(columns) / columns
        row = np.exp(np.sin(angle))
        table = periodic_cubics(np.stack([row] * 3))
        np.testing.assert_allclose(table[:, 0, 0], row, rtol=1e-14)
        middle = table[:, 0] @ 0.5 ** np.arange(4)
        return float(np.abs(middle - np.exp(np.sin(angle + np.pi / columns))).max())

    assert np.log2(worst(24) / worst(48)) == pytest.approx(4.0, abs=0.3)


@pytest.mark.parametrize(
    ("conductance", "carried", "what"),
    [
        (np.zeros((3, 8)), np.zeros((3, 7)), "expected \\(3, N\\)"),
        (np.full((3, 8), -1e-12), np.zeros((3, 8)), "expected 0 or more"),
    ],
)
def test_a_void_leak_table_is_refused(conductance, carried, what):
    with pytest.raises(ValueError, match=what):
        LeakTable(conductance, carried)


def test_a_closed_chamber_with_bubbles_follows_their_polytrope():
    """V = s(p) M with s = exp(-p/K) + x (p0/p)^m: as the piston moves in, from the pressure that it had."""
    problem = replace(sealed(0.0), dead_volume=1e-4, drive=FULL, free_air=0.02, air_exponent=1 / 1.2)
    cycle = solve_cycle(problem, samples=60)
    oil = cycle.volume / bubbly_volume(cycle.pressure, problem)
    np.testing.assert_allclose(oil, oil[0], rtol=1e-6)
    assert cycle.checks.energy_balance_error < 1e-5  # twice what the method itself estimates


@pytest.mark.parametrize("exponent", [1.0, 1 / 1.2, 1 / 1.4])
def test_energy_of_bubbly_oil_is_the_integral_of_its_volume(exponent):
    oil = (1.6e9, 0.03, exponent)
    for pressure in (-0.9e5, 3e5, 35e6):
        told, _ = quad(lambda p: oil_volume(p, oil)[0], 0.0, pressure, epsrel=1e-10, limit=200)
        assert energy_at(pressure, oil) == pytest.approx(told, rel=1e-6)
        step = 1e-5 * (pressure + 1.1e5)
        slope = (oil_volume(pressure + step, oil)[0] - oil_volume(pressure - step, oil)[0]) / (2 * step)
        assert oil_volume(pressure, oil)[2] == pytest.approx(-slope, rel=1e-6, abs=0.0)


def test_bubbles_delay_the_rise_of_pressure_and_take_the_place_of_oil():
    plain, bubbly = (replace(pump(20e6, 1.0), inlet_pressure=1e5, free_air=air) for air in (0.0, 0.03))
    cycles = [solve_cycle(problem, samples=360) for problem in (plain, bubbly)]
    rises = [cycle.shaft_angle[180:][np.argmax(cycle.pressure[180:] > 10e6)] for cycle in cycles]
    delivered = [cycle.outflow.delivery for cycle in cycles]
    share = 0.03 * (101325.0 / 201325.0)  # of the displaced volume, more by the dead volume and the port's loss
    assert rises[1] > rises[0] + 1.0 * DEGREES
    assert 1.0 - 3.0 * share < delivered[1] / delivered[0] < 1.0 - share
