"""Volumes behind the pump's ports.

Closed forms of one volume with an orifice or an impedance, and the ripple of a whole pump against an independent
integration of all its chambers together with the port.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from reynolds import NotConverged
from system import (
    ImpedanceLine,
    PortOpening,
    ReliefGroove,
    SwashDrive,
    opening_area,
    orifice_flow,
    piston_displacement,
    piston_velocity,
)
from system.pump.chamber.port_coupling import SETTLED, PortedCycle, ported_cycle
from system.pump.chamber.port_volume import Supply, line_flow, line_power, port_balance
from system.pump.chamber.problem import ChamberProblem, LeakTable
from system.pump.laws.kinematics import drive_at_ratio, stand_out
from system.pump.ports.lines import HeldPressure, Impedance, Line, Lines, OrificeLine

DEGREES = np.pi / 180.0
AREA = np.pi / 4 * 22e-3**2
SPEED = 2100.0 * 2 * np.pi / 60
FULL = SwashDrive(45e-3, 5 * DEGREES, 16.2 * DEGREES)
PISTONS, SAMPLES = 9, 360
PERIOD = 2 * np.pi / (PISTONS * SPEED)
TIMES = PERIOD * np.arange(40) / 40
CLOSED = Impedance(np.array([1.0, 1e6]), np.full(2, 1e30 + 0j))


def volume_impedance(volume: float, bulk_modulus: float, frequency: np.ndarray) -> np.ndarray:
    """Z = K/(i w V), Pa s/m3, of a closed volume V (m3) of oil at frequencies in Hz; small ripple, no waves."""
    return bulk_modulus / (2j * np.pi * frequency * volume)


def pump(delivery_pressure: float = 35e6, ratio: float = 1.0) -> ChamberProblem:
    """A chamber of REF90, its leaks constant."""
    drive = drive_at_ratio(FULL, ratio)
    angles = np.array([-5.0, 10.0, 40.0, 140.0, 170.0]) * DEGREES
    port = PortOpening(0.0, *angles[1:], 152e-6, (ReliefGroove(angles[0], angles[1], 4e-6),))
    return ChamberProblem(
        drive=drive,
        shaft_speed=SPEED,
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
        leaks=LeakTable(np.full((3, 8), 1e-13), np.zeros((3, 8))),
    )


def settled(line: Line, supply: Supply, wanted: float) -> tuple[np.ndarray, float | None]:
    """The pressure of one volume under a given supply, and the orifice's area."""
    assert not isinstance(line, HeldPressure)
    pressure, oil = np.full(TIMES.size, wanted), pump()
    for _ in range(40):
        balance = port_balance(line, pressure, wanted, supply, oil)
        change, pressure = np.abs(balance.next_pressure - pressure).max(), balance.next_pressure
        if change < 1e-6:
            return pressure, balance.line.area
    raise AssertionError(f"still changing by {change} Pa")


def pulsing(mean: float, amplitude: float, order: int = 1) -> Supply:
    """An inflow mean + amplitude cos(order w t), m3/s at zero gauge pressure."""
    wave = 2 * np.pi * order / PERIOD
    return Supply(PERIOD, mean, amplitude / wave * np.sin(wave * TIMES), 0.0 * TIMES, 0.0)


def test_a_closed_volume_answers_with_its_modulus(validation):
    """V exp(p/K) = what has come in, exactly; K/(i w V) for a small pulse."""
    volume, amplitude, order, modulus = 1e-3, 1e-4, 2, 1.6e9
    supply = pulsing(0.0, amplitude, order)
    pressure, _ = settled(ImpedanceLine(volume, CLOSED), supply, 20e6)
    content = volume * np.exp(pressure / modulus) - supply.surge
    assert np.ptp(content) < 1e-9 * volume
    assert pressure.mean() == pytest.approx(20e6, abs=1e-3)
    found = 2.0 / TIMES.size * np.fft.rfft(pressure)[order]
    wanted = amplitude * volume_impedance(volume * np.exp(20e6 / modulus), modulus, np.array([order / PERIOD]))[0]
    validation(
        case="closed volume behind a port, sinusoidal flow",
        source="K/(i w V), closed form",
        quantity="pressure amplitude",
        unit="Pa",
        expected=abs(wanted),
        obtained=abs(found),
        relative_tolerance=abs(wanted) / modulus,  # the next term of the logarithm
    )
    assert np.angle(found) == pytest.approx(np.angle(wanted), abs=1e-6)


def test_an_orifice_passes_the_mean_flow(validation):
    flow, oil = 3e-3, pump()
    supply = Supply(PERIOD, flow, 0.0 * TIMES, 0.0 * TIMES, 0.0)
    pressure, area = settled(OrificeLine(1e-3, 2.5e6), supply, 35e6)
    assert np.ptp(pressure) == 0.0
    at_port = flow * np.exp(-35e6 / oil.bulk_modulus)
    validation(
        case="orifice behind a port, steady flow",
        source="q = Cd A sqrt(2 dp/rho), closed form",
        quantity="area that keeps 35 MPa",
        unit="mm2",
        expected=at_port / (0.7 * np.sqrt(2 * 32.5e6 / 860.0)) * 1e6,
        obtained=area * 1e6,
        relative_tolerance=1e-3,
    )
    back, same = settled(OrificeLine(1e-3, 2.5e6, area), supply, 30e6)
    assert same == area
    np.testing.assert_allclose(back, pressure, rtol=1e-9)


def test_a_small_pulse_on_volume_and_orifice(validation):
    """p = Q/(G + i w V/K) with G = q/(2 dp): both in one amplitude and its phase."""
    mean, volume, modulus = 3e-3, 20e-6, 1.6e9
    amplitude = 1e-4 * mean
    pressure, _ = settled(OrificeLine(volume, 0.0), pulsing(mean, amplitude), 35e6)
    dense, wave = np.exp(35e6 / modulus), 2 * np.pi / PERIOD
    # both sides in mass over the density at zero gauge pressure; the orifice's oil thickens with p, too
    slope = mean / (2 * 35e6) + mean / modulus
    expected = amplitude / (slope + 1j * wave * volume * dense / modulus)
    found = 2.0 / TIMES.size * np.fft.rfft(pressure)[1]
    assert 0.3 < wave * volume * dense / modulus / slope < 3.0  # neither alone would do
    validation(
        case="volume and orifice behind a port, small pulse",
        source="Q/(G + i w V/K), closed form",
        quantity="pressure amplitude",
        unit="Pa",
        expected=abs(expected),
        obtained=abs(found),
        relative_tolerance=1e-3,
    )
    assert np.angle(found) == pytest.approx(np.angle(expected), abs=1e-3)


def test_films_draw_from_the_port():
    drawn = replace(pulsing(3e-3, 0.0), draw=np.full(TIMES.size, 1e-3))
    _, area = settled(OrificeLine(1e-3, 0.0), drawn, 35e6)
    _, whole = settled(OrificeLine(1e-3, 0.0), pulsing(3e-3, 0.0), 35e6)
    assert area / whole == pytest.approx(2 / 3, rel=1e-3)
    wave = 1e-5 * np.cos(2 * np.pi * TIMES / PERIOD)
    taken, _ = settled(OrificeLine(1e-3, 0.0), replace(pulsing(3e-3, 0.0), draw=wave), 35e6)
    lacking, _ = settled(OrificeLine(1e-3, 0.0), pulsing(3e-3, -1e-5), 35e6)
    np.testing.assert_allclose(taken, lacking, rtol=1e-9)  # a draw is an inflow that is missing


def test_kinematic_flow_ripple(validation):
    """Stiff oil, no leaks, ports wide open from dead centre to dead centre: the ripple of z sine strokes."""
    angles = np.array([0.0, 0.05, 0.1, 179.9, 180.0]) * DEGREES
    port = PortOpening(0.0, *angles[1:], 10e-3, (ReliefGroove(angles[0], angles[1], 5e-3),))
    stiff = replace(
        pump(),
        drive=SwashDrive(45e-3, 0.0, 16.2 * DEGREES),
        bulk_modulus=1e13,
        delivery_pressure=2.5e6,
        case_pressure=2.5e6,
        delivery_port=replace(port, dead_centre=np.pi),
        suction_port=port,
        leaks=LeakTable(np.zeros((3, 8)), np.zeros((3, 8))),
    )
    flow = ported_cycle((stiff,), Lines(), PISTONS, 4 * SAMPLES).delivery.line_flow
    validation(
        case="kinematic flow ripple of nine pistons",
        source="(pi/2z) tan(pi/4z): 1.53 %",
        quantity="peak to peak of the mean flow",
        unit="%",
        expected=100 * np.pi / 18 * np.tan(np.pi / 36),
        obtained=100 * np.ptp(flow) / np.mean(flow),
        tolerance=0.005,  # half a unit of the last digit
    )
    orders = np.abs(np.fft.rfft(flow))
    assert orders[18] > 30.0 * orders[9]  # odd z: twice the order


@pytest.fixture(scope="module")
def rippled() -> PortedCycle:
    return ported_cycle((pump(20e6, 0.13),), Lines(OrificeLine(0.1e-3, 2.5e6)), PISTONS, SAMPLES)


def test_ripple_against_all_chambers_integrated_with_the_port(rippled):
    """One pitch of nine chambers and the port by an independent stiff solver, from the state found at angle 0."""
    problem, cycle, port = rippled.problem, rippled.cycle, rippled.delivery
    law = (problem.flow_coefficient, problem.density, problem.kinematic_viscosity, problem.critical_reynolds)
    modulus, shifts = problem.bulk_modulus, 2 * np.pi * np.arange(PISTONS) / PISTONS

    def slope(phi: float, state: np.ndarray) -> np.ndarray:
        p, behind, angle = state[:-1], state[-1], phi + shifts
        delivered, drawn = (
            np.array([float(orifice_flow(d, float(a), *law)) for d, a in zip(p - outside, areas, strict=True)])
            for outside, areas in (
                (behind, opening_area(problem.delivery_port, angle)),
                (problem.inlet_pressure, opening_area(problem.suction_port, angle)),
            )
        )
        out = delivered + drawn + 3e-13 * (p - problem.case_pressure)
        volume = problem.dead_volume + AREA * piston_displacement(problem.drive, angle)
        swept = AREA * piston_velocity(problem.drive, angle, SPEED)
        dense = np.exp((p - behind) / modulus)
        taken = float(orifice_flow(behind - 2.5e6, port.orifice_area, *law))
        rate = modulus / 0.1e-3 * (float(np.sum(delivered * dense)) - taken)
        return np.append(-modulus / volume * (swept + out), rate) / SPEED

    pitch = SAMPLES // PISTONS
    start = np.append(cycle.pressure[::pitch], port.pressure[0])
    angles = cycle.shaft_angle[: pitch + 1]
    state, worst, sampled = start, 0.0, [start]
    for begin, end in zip(angles[:-1:5], angles[5::5], strict=True):  # every break lies on a fifth degree
        run = solve_ivp(slope, (begin, end), state, "Radau", np.linspace(begin, end, 6), rtol=1e-7, atol=10.0)
        sampled += list(run.y.T[1:])
        state = run.y[:, -1]
    found = np.array(sampled)
    worst = np.abs(found[:, -1] - port.pressure[: pitch + 1]).max()
    assert np.ptp(port.pressure) > 0.2e6
    # settled to SETTLED tolerances of the chamber, and as much again by the integrations of either side
    assert worst < 3 * SETTLED * 1e-6 * problem.pressure_span
    np.testing.assert_allclose(found[-1, :-1], np.roll(start[:-1], -1), atol=4e-4 * problem.pressure_span)


def test_mass_and_energy_of_the_port_close(rippled):
    problem, cycle, port = rippled.problem, rippled.cycle, rippled.delivery
    assert port.balance_error < 1e-4
    assert cycle.checks.mass_balance_error < 1e-12
    assert cycle.checks.energy_balance_error < 1e-6
    rate = PISTONS * SPEED / (2 * np.pi)
    given = rate * float(cycle.port_energy[0])
    assert line_power(port.line_flow, port.pressure, problem) == pytest.approx(given, rel=1e-5)
    assert port.ripple_power > 0.0


def test_ripple_falls_with_the_volume():
    """A large volume leaves the pump as a held pressure has it; ripple is flow ripple over V."""
    held = ported_cycle((pump(),), Lines(), PISTONS, SAMPLES)
    one, ten = (ported_cycle((pump(),), Lines(OrificeLine(v, 2.5e6)), PISTONS, SAMPLES) for v in (10e-3, 100e-3))
    ripples = [np.ptp(one.delivery.pressure), np.ptp(ten.delivery.pressure)]
    assert ripples[0] / ripples[1] == pytest.approx(10.0, rel=0.01)  # open chambers are 0.6 % of 10 L
    assert float(ten.cycle.outflow.delivery) == pytest.approx(float(held.cycle.outflow.delivery), rel=1e-5)
    assert held.rounds == 0
    assert held.problem.port_pressure is None
    assert np.mean(held.delivery.line_flow) == pytest.approx(np.mean(ten.delivery.line_flow), rel=1e-3)


def test_a_volume_known_by_its_impedance_is_that_volume():
    """0.1 L and an impedance of 0.9 L are 1 L."""
    frequency = np.linspace(300.0, 7000.0, 2000)
    rest = Impedance(frequency, volume_impedance(0.9e-3, 1.6e9, frequency))
    whole = ported_cycle((pump(),), Lines(ImpedanceLine(1e-3, CLOSED)), PISTONS, SAMPLES)
    split = ported_cycle((pump(),), Lines(ImpedanceLine(0.1e-3, rest)), PISTONS, SAMPLES)
    ripple = np.ptp(whole.delivery.pressure)
    # linear in 1/Z between frequencies, and small ripple in it: p/K
    np.testing.assert_allclose(split.delivery.pressure, whole.delivery.pressure, atol=5e-3 * ripple)


def test_both_ports_at_once():
    lines = Lines(OrificeLine(1e-3, 2.5e6), OrificeLine(1e-3, 3.0e6))
    found = ported_cycle((pump(),), lines, PISTONS, SAMPLES)
    assert found.suction.mean_pressure == pytest.approx(2.5e6, abs=SETTLED * 1e-6 * found.problem.pressure_span)
    assert 0.02e6 < np.ptp(found.suction.pressure) < 0.5e6
    assert found.suction.line_flow.max() < 0.0
    assert found.rounds < 12


def test_what_cannot_be_is_refused(tmp_path):
    with pytest.raises(ValueError, match="volume: found 0 m3, expected above 0"):
        OrificeLine(0.0, 0.0)
    with pytest.raises(NotConverged, match="expected both of one sign"):
        ported_cycle((pump(),), Lines(OrificeLine(1e-3, 40e6)), PISTONS, SAMPLES)
    level = np.full(40, 40e6)  # of the tank: no area passes anything
    with pytest.raises(NotConverged, match="to pass at 0 MPa over the tank"):
        line_flow(OrificeLine(1e-3, 40e6), level, Supply(PERIOD, 1e-3, np.zeros(40), np.zeros(40), 0.0), pump())
    with pytest.raises(NotConverged, match="suction port: its pressure falls"):
        ported_cycle((pump(),), Lines(suction=OrificeLine(1e-3, 0.0, 60e-6)), PISTONS, SAMPLES)
    narrow = Impedance(np.array([300.0, 400.0]), np.ones(2) * 1e9j)
    with pytest.raises(ValueError, match="harmonics of the pump's ripple"):
        ported_cycle((pump(),), Lines(ImpedanceLine(1e-3, narrow)), PISTONS, SAMPLES)
    with pytest.raises(ValueError, match="rising from above zero"):
        Impedance(np.array([2.0, 1.0]), np.ones(2) + 0j)
