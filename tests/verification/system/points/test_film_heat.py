"""Floating gap with heat: closed forms of a turning piston in the middle of its bore, and its heat balance."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from gaps import (
    Accuracy,
    Effect,
    GapRevolution,
    Physics,
    PistonDrive,
    PistonFilm,
    PistonPart,
    PistonShape,
    constant,
    evenly,
    floating_piston,
    piston_report,
    run_revolution,
    warm_revolution,
)
from gaps.films.reports import PistonReport
from gaps.revolution.film_heat import GapHeat, Sink
from gaps.revolution.warmth import ViscosityRatios
from reynolds import Elastic, FilmNotConverged, FilmSolver, InputError
from reynolds.floating.stage import FloatingStage
from system.films.heat import rod, slab, tube

DIAMETER, CLEARANCE, LENGTH, VISCOSITY = 22e-3, 15e-6, 40e-3, 0.03
DENSITY, SPECIFIC_HEAT, CONDUCTIVITY, INLET, THINNING = 860.0, 2000.0, 0.14, 313.15, 0.03
PRESSURE, SHAFT, SPIN = 20e6, 220.0, 900.0
SPEED, AREA = 0.5 * DIAMETER * SPIN, np.pi * DIAMETER * LENGTH
NOTHING_PASSES = 1e6  # m2 K/W
SCHEDULE, ROUGHLY = evenly(SHAFT, 12, keep=1), Accuracy(step=3e-2)


def piston(side: float = 0.0, spin: float = SPIN) -> PistonFilm:
    """A piston that turns and stays where it is along its bore; a force (N) pressed on it turns with the shaft."""

    def outer(angle: float) -> np.ndarray:
        return side * np.array([np.cos(angle), np.sin(angle), np.cos(angle), np.sin(angle)])

    drive = PistonDrive(
        shaft_speed=SHAFT,
        viscosity=VISCOSITY,
        case_pressure=0.0,
        cavitation_pressure=-1e5,
        piston_spin=spin,
        bore_spin=0.0,
        chamber_pressure=constant(PRESSURE),
        reach=constant(LENGTH),
        velocity=constant(0.0),
        outer=outer,
    )
    shape, physics = PistonShape(DIAMETER, CLEARANCE, LENGTH), Physics().without(Effect.CAVITATION)
    return PistonFilm(shape, drive, None, physics, (12, 3))


def oil(thinning: float, resistance: float, specific_heat: float = SPECIFIC_HEAT) -> GapHeat:
    """mu = mu0 exp(-thinning (T - T_in)) between walls of one resistance to the inlet's temperature."""
    wall = Sink(INLET, resistance)
    return GapHeat(
        density=DENSITY,
        specific_heat=specific_heat,
        conductivity=CONDUCTIVITY,
        temperature=INLET,
        thins=lambda temperature: np.exp(-thinning * (temperature - INLET)),
        fixed=wall,
        moving=wall,
    )


def warm(
    film: PistonFilm, heat: GapHeat, before: GapRevolution[PistonReport] | None = None
) -> GapRevolution[PistonReport]:
    solver, start, look = FilmSolver(film.space_at(0.0)), np.zeros(4), partial(piston_report, film)
    return warm_revolution(solver, floating_piston(film), SCHEDULE, start, look, heat, accuracy=ROUGHLY, before=before)


def cold(film: PistonFilm) -> GapRevolution[PistonReport]:
    solver, start, look = FilmSolver(film.space_at(0.0)), np.zeros(4), partial(piston_report, film)
    return run_revolution(solver, floating_piston(film), SCHEDULE, start, look, accuracy=ROUGHLY)


def leakage(found: GapRevolution[PistonReport]) -> float:
    return float(np.mean([instant.report.leakage for instant in found.turn.instants]))


def shear(found: GapRevolution[PistonReport]) -> float:
    return float(np.mean([instant.report.heat.shear for instant in found.turn.instants]))


def test_no_heat_passes_the_walls(validation):
    """All heat leaves with the leakage: mu U^2 A/c + p Q = rho c Q dT, Q = pi d c^3 p/(12 mu L)."""
    spin = 100.0
    found = warm(piston(spin=spin), oil(0.0, NOTHING_PASSES))
    flow = np.pi * DIAMETER * CLEARANCE**3 * PRESSURE / (12.0 * VISCOSITY * LENGTH)
    sheared = VISCOSITY * (0.5 * DIAMETER * spin) ** 2 * AREA / CLEARANCE
    assert found.warmth is not None
    flows = found.warmth.flows
    validation(
        case="Turning piston between adiabatic walls",
        source="heat balance, closed form",
        quantity="temperature rise of the leakage",
        unit="K",
        expected=(sheared + PRESSURE * flow) / (DENSITY * SPECIFIC_HEAT * flow),
        obtained=flows.convected_out / (DENSITY * SPECIFIC_HEAT * leakage(found)),
        # The walls' temperature is settled to 0.05 K of some 20, at a conductance of k/c on both sides.
        relative_tolerance=1e-3,
    )
    assert found.warmth.walls == pytest.approx(np.full(2, found.warmth.mean.mean()), abs=1.0)
    assert flows.balance_error < 1e-3


def test_walls_at_one_temperature(validation):
    """Nahme's film: stress arcsinh(r)/(r sqrt(1 + r^2)) of that of cold oil, r^2 = beta mu U^2/(8 k).

    Leakage at a hundredth of the pressure's heat would disturb it: conduction across outweighs it 500 times.
    """
    found = warm(piston(), oil(THINNING, 0.0))
    root = np.sqrt(THINNING * VISCOSITY * SPEED**2 / (8.0 * CONDUCTIVITY))
    stress = np.arcsinh(root) / (root * np.sqrt(1.0 + root**2))
    carried = found.warmth.flows.convected_out / found.warmth.flows.dissipation
    validation(
        case="Turning piston between walls at the oil's temperature",
        source="Nahme 1940, closed form",
        quantity="power of shear over that of cold oil",
        unit="1",
        expected=stress,
        obtained=shear(found) / (VISCOSITY * SPEED**2 * AREA / CLEARANCE),
        tolerance=3.0 * carried * (1.0 - stress) + 1e-3,
        note="tolerance: thrice the heat that leakage carries away, and the 6 levels",
    )


def test_walls_pass_heat_by_their_resistance():
    resistance = 1e-4
    found = warm(piston(), oil(THINNING, resistance))
    assert found.warmth is not None
    passed = np.array([found.warmth.flows.to_fixed, found.warmth.flows.to_moving]) / AREA
    assert found.warmth.walls - INLET == pytest.approx(resistance * passed, abs=0.1)
    assert passed.min() > 5e4  # a wall that no heat reaches would pass the line above
    assert found.warmth.change < 0.01


def test_oil_that_stays_cold_moves_as_without_heat():
    """Heat capacity without bound and a pressed piston: the very motion of the isothermal film."""
    film = piston(side=20.0)
    heated = warm(film, oil(0.0, 0.0, SPECIFIC_HEAT * 1e6))
    without = cold(film)
    assert np.ptp(without.positions[:, 0]) > 1e-8
    assert heated.positions == pytest.approx(without.positions, abs=1e-6 * CLEARANCE)
    assert heated.warmth is not None
    assert heated.warmth.rounds == 1
    assert without.warmth is None


def test_heat_of_rubbing_goes_into_both_walls():
    """In the middle of its bore: half into either, which the resistance of a wall turns into its temperature."""
    film, heat, rubbing = piston(spin=100.0), oil(0.0, 1e-4), 40.0

    def look(stage: FloatingStage) -> PistonReport:
        report = piston_report(film, stage)
        return replace(report, heat=replace(report.heat, rubbing=rubbing))

    solver, start = FilmSolver(film.space_at(0.0)), np.zeros(4)
    found = warm_revolution(solver, floating_piston(film), SCHEDULE, start, look, heat, accuracy=ROUGHLY).warmth
    assert found is not None
    flows = found.flows
    assert flows.rubbing == pytest.approx(rubbing)
    assert flows.to_fixed == pytest.approx(flows.to_moving, rel=1e-3)
    assert flows.balance_error < 1e-6
    passed = np.array([flows.to_fixed, flows.to_moving]) / AREA
    assert found.walls - INLET == pytest.approx(1e-4 * passed, abs=0.05)


def test_warm_oil_rubs_less_and_leaks_more():
    film = piston(side=20.0)
    heated, without = warm(film, oil(THINNING, 2e-5)), cold(film)
    assert shear(heated) < 0.98 * shear(without)
    assert leakage(heated) > 1.02 * leakage(without)
    assert heated.warmth is not None
    flows = heated.warmth.flows
    assert flows.balance_error < 1e-6
    turned = float(np.mean([one.report.heat.flow + one.report.heat.shear for one in heated.turn.instants]))
    assert flows.dissipation == pytest.approx(turned, rel=0.01)  # to which rounds are taken
    again = warm(film, oil(THINNING, 2e-5), heated)
    assert again.warmth is not None
    assert again.warmth.rounds == 1


def test_oil_beyond_its_law_is_told():
    def ends(temperature: np.ndarray) -> np.ndarray:
        raise InputError("oil temperature", f"{temperature.max():.0f} K", "at most 300 K")

    with pytest.raises(FilmNotConverged, match="temperature of the piston at 30 deg: oil temperature: 313 K; expected"):
        warm(piston(), replace(oil(THINNING, 0.0), thins=ends))


def test_viscosity_between_angles():
    angles = np.array([0.0, 1.0, 3.0])
    logs = np.array([0.0, 1.0, -1.0])[:, None, None] * np.ones((3, 2, 4))
    shares = ViscosityRatios(angles, logs)
    found = [float(np.log(shares.at(angle)[0, 0])) for angle in (0.0, 0.5, 1.0, 2.0, 3.0)]
    assert found == pytest.approx([0.0, 0.5, 1.0, 0.0, -1.0])
    assert shares.at(2.0).shape == (2, 4)


def test_resistance_of_parts():
    """A tube of thin wall and a slab are one; a rod's mean by its T(x) = q U/(2 k A) x (L - x)."""
    assert tube(1.0, 1e-4, 50.0) == pytest.approx(slab(1e-4, 50.0), rel=1e-4)
    part = PistonPart(22e-3, 10e-3, 60e-3, Elastic(210e9, 0.3))
    x = np.linspace(0.0, part.length, 2001)
    per_section = 4.0 * part.diameter / (part.diameter**2 - part.inner_diameter**2)
    rise = per_section / (2.0 * 46.0) * x * (part.length - x)
    assert rod(part, 46.0) == pytest.approx(np.trapezoid(rise, x) / part.length, rel=1e-5)
