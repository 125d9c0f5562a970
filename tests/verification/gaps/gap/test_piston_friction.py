"""Friction of film and contact on a floating piston: closed forms of the parallel piston."""

from __future__ import annotations

import numpy as np
import pytest

from gaps import (
    BushingPart,
    Effect,
    FilmLaws,
    Physics,
    PistonDrive,
    PistonFilm,
    PistonPart,
    PistonShape,
    constant,
    floating_piston,
    standing_piston,
)
from gaps.films.friction import WallShear
from gaps.films.piston import PistonFriction
from gaps.films.piston_deformation import PistonDeformation
from gaps.walls.springs import SpringBore
from reynolds import (
    Asperities,
    Elastic,
    FilmSolver,
    FloatingStage,
    boundary_flows,
    contact_pressure,
    held_at,
    loads,
    solve_stage,
    started,
)

DIAMETER, CLEARANCE, LENGTH, VISCOSITY = 22e-3, 15e-6, 40e-3, 0.0258
PRESSURE, CASE, OUTWARDS, PISTON, BORE = 20e6, 1e6, 2.89, 300.0, 220.0
RADIUS, AREA = 0.5 * DIAMETER, np.pi * DIAMETER * LENGTH


def _piston(cells: tuple[int, int], rough: Asperities | None = None, sideways: float = 0.0) -> PistonFilm:
    """A piston that moves out of a bore longer than it is engaged, pressed to one side (N) at either end."""
    drive = PistonDrive(
        shaft_speed=1.0,
        viscosity=VISCOSITY,
        case_pressure=CASE,
        cavitation_pressure=-1e5,
        piston_spin=PISTON,
        bore_spin=BORE,
        chamber_pressure=constant(PRESSURE),
        reach=lambda time: np.asarray(LENGTH - OUTWARDS * time),
        velocity=constant(OUTWARDS),
        outer=constant(sideways, 0.0, sideways, 0.0),
    )
    shape = PistonShape(DIAMETER, CLEARANCE, 45e-3)
    return PistonFilm(shape, drive, FilmLaws(asperities=rough), Physics().without(Effect.CAVITATION), cells)


def _let_go(film: PistonFilm, eccentricity: float) -> FloatingStage:
    """It stood parallel to its bore a moment ago."""
    start = started(floating_piston(film), 0.0, eccentricity * CLEARANCE * np.array([1.0, 0.0, 1.0, 0.0]))
    step = 1e-10
    return solve_stage(FilmSolver(film.space_at(0.0)), floating_piston(film), step, start.held, step, start.q, None)


def _at(
    eccentricity: float, cells: tuple[int, int], rough: Asperities | None = None
) -> tuple[FloatingStage, PistonFriction]:
    """The parallel piston and its friction."""
    film = _piston(cells, rough)
    stage = _let_go(film, eccentricity)
    return stage, film.friction(stage, film.wall_shear(stage))


@pytest.mark.parametrize("eccentricity", [0.0, 0.6])
def test_friction_of_a_parallel_piston(eccentricity, validation, refine):
    """h = c (1 - eps cos): int dphi/h = 2 pi/(c root), int cos dphi/h = 2 pi (1 - root)/(c eps root)."""
    root = np.sqrt(1.0 - eccentricity**2)
    wet, drop = AREA / (CLEARANCE * root), PRESSURE - CASE
    sliding = -VISCOSITY * OUTWARDS * wet
    force = sliding + 0.5 * np.pi * DIAMETER * CLEARANCE * drop
    # Along each line the pressure falls by the same drop, whatever spin makes of it in between.
    lopsided = 0.0 if eccentricity == 0.0 else (1.0 - root) / eccentricity
    turning = RADIUS * (-sliding * lopsided + 0.25 * np.pi * DIAMETER * CLEARANCE * drop * eccentricity)

    def solve(n: int) -> tuple[float, float]:
        found = _at(eccentricity, (4 * n, n))[1]
        return found.force, float(found.moment[1])

    along, moment = refine(solve, (6, 12, 24))
    rows = [("force along the bore", "N", force, along), ("moment of the axial shear", "N m", turning, moment)]
    for quantity, unit, expected, obtained in rows:
        if expected == 0.0:
            assert abs(obtained.finest) < 1e-9 * abs(force) * RADIUS
            continue
        validation(
            case="Floating piston, friction of the parallel piston",
            source="closed form, -mu v/h - h/2 dp/dy",
            quantity=f"{quantity}, eccentricity {eccentricity:g}",
            unit=unit,
            expected=expected,
            obtained=obtained.finest,
            # A step of 1e-10 s leaves a position as it was to 1e-8 of the clearance.
            tolerance=obtained.tolerance() + 1e-7 * abs(expected),
            order=obtained.order,
        )


def test_torque_and_power_of_a_centred_piston():
    stage, found = _at(0.0, (16, 4))
    assert found.torque == pytest.approx(-VISCOSITY * (PISTON - BORE) * RADIUS**2 * AREA / CLEARANCE, rel=1e-6)
    # Both walls feel the pressure's pull; only the piston moves along the bore.
    turned = -found.torque * (PISTON - BORE)
    assert found.power == pytest.approx(turned - found.force * OUTWARDS, rel=1e-6)
    assert stage.solution.problem.space.vertices[:, 1].min() == pytest.approx(5e-3, abs=1e-8)


def test_pressure_pushes_a_piston_by_its_dents():
    """Dents that grow evenly towards the chamber, where pressure does: -int (p - p_case) dg/dy dA of the flank and
    -(P - p_case) pi d g of the end leave half of the latter; what they take is missing in the swept clearance."""
    film = _piston((8, 4))
    stage, deepest = _let_go(film, 0.0), 2e-6
    along = stage.instant.shape.space.vertices[:, 1]
    dents = deepest * (along.max() - along) / np.ptp(along)
    by = film.wall_shear(stage)
    plain, dented = (film.friction(stage, by, given) for given in (None, PistonDeformation(dents, dents, 0.0)))
    rim = np.pi * DIAMETER * deepest
    assert dented.force - plain.force == pytest.approx(-0.5 * rim * (PRESSURE - CASE), rel=1e-6)
    assert dented.power - plain.power == pytest.approx(0.5 * rim * (PRESSURE - CASE) * OUTWARDS, rel=1e-6)
    flows = boundary_flows(stage.solution)
    rigid, soft = (film.chamber_flow(stage, flows, given) for given in (None, PistonDeformation(dents, dents, 0.0)))
    assert soft - rigid == pytest.approx(-OUTWARDS * rim, rel=1e-9)


def test_forces_on_both_walls_of_a_piston_askew_are_those_on_its_film():
    """The chamber's pressure on the ring of oil is all that presses on the film along the bore, however it wedges."""
    film = _piston((24, 6), sideways=1000.0)
    floating, step = floating_piston(film), 1e-10
    askew = CLEARANCE * np.array([0.7, 0.1, -0.6, 0.2])
    start = started(floating, 0.0, askew)
    stage = solve_stage(FilmSolver(film.space_at(0.0)), floating, step, start.held, step, start.q, None)
    by = film.wall_shear(stage)
    space, ring = stage.solution.problem.space, np.pi * DIAMETER * CLEARANCE
    found, on_bore = film.friction(stage, by), float(np.sum(by.on_fixed[1] * space.area))
    assert found.force + on_bore == pytest.approx((PRESSURE - CASE) * ring, rel=1e-6)
    on_piston = float(np.sum(by.on_moving[1] * space.area))
    assert found.force - on_piston == pytest.approx(-2000.0 * 1.3 * CLEARANCE / 45e-3, rel=1e-6)  # load times slope
    spent = -on_piston * OUTWARDS - _turned_power(stage, by)
    assert found.power == pytest.approx(spent, rel=1e-9)  # along its own axis it slides freely


def _turned_power(stage: FloatingStage, by: WallShear) -> float:
    """Power (W) of the shear around the bore on both parts."""
    around = PISTON * by.on_moving[0] + BORE * by.on_fixed[0]
    return RADIUS * float(np.sum(around * stage.solution.problem.space.area))


def test_contact_rubs_against_the_sliding(validation):
    """Touching asperities bear by their own law and rub with 0.1 of it, against v along and R (w1 - w2) around."""
    rough = Asperities(density=1e10, radius=1e-5, height=4e-7, modulus=8e10, friction_coefficient=0.1)
    stage, found = _at(0.97, (48, 4), rough)
    bare = PistonFriction(*_film_alone(stage))
    # All that presses presses at angle 0, where the film is thin: pressure times area is next to the force.
    pressed, slip = _pressed(stage, rough), (RADIUS * (PISTON - BORE), OUTWARDS)
    speed = float(np.hypot(*slip))
    validation(
        case="Floating piston, friction of contact",
        source="boundary friction times the contact's pressure over the film",
        quantity="axial force of contact",
        unit="N",
        expected=-0.1 * pressed * slip[1] / speed,
        obtained=found.force - bare.force,
        relative_tolerance=1e-9,
    )
    assert found.torque - bare.torque == pytest.approx(-0.1 * pressed * RADIUS * slip[0] / speed, rel=1e-9)
    spent = found.power - bare.power
    assert spent == pytest.approx(0.1 * pressed * speed, rel=1e-9)


def test_contact_of_elastic_walls_counts_once():
    """A piston askew that touches: forces along the bore are those without the deformation, which is next to none."""
    rough = Asperities(density=1e10, radius=1e-5, height=4e-7, modulus=8e10, friction_coefficient=0.1)
    rigid, steel = _piston((48, 6), rough), Elastic(210e9, 0.3)
    parts = PistonPart(DIAMETER, 0.0, 60e-3, steel), BushingPart(DIAMETER, 5e-3, 45e-3, steel)
    walls = SpringBore(*parts, compliance=1e-19)
    film = PistonFilm(rigid.shape, rigid.drive, FilmLaws(asperities=rough, walls=walls), Physics(), (48, 6))
    stage = held_at(FilmSolver(film.space_at(0.0)), standing_piston(film), 0.0, np.array([14.8e-6, 0.0, 13.8e-6, 0.0]))
    by = film.wall_shear(stage)
    assert by.load() > 100.0
    nothing = np.zeros(len(stage.solution.problem.space.vertices))
    without, given = (film.friction(stage, by, one) for one in (None, PistonDeformation(nothing, nothing, 0.0)))
    assert without.force == pytest.approx(given.force, rel=1e-12)


def _pressed(stage: FloatingStage, rough: Asperities) -> float:
    """Contact pressure over the film, N."""
    return float(np.sum(contact_pressure(rough, stage.gap).value * stage.solution.problem.space.area))


def _film_alone(stage: FloatingStage) -> tuple[float, float, np.ndarray, float]:
    """Force, torque, moment and power of the oil, by `reynolds.solve.loads`."""
    found = loads(stage.solution)
    around, along = found.friction_moving
    fixed = found.friction_fixed[0]
    power = -along * OUTWARDS - RADIUS * (PISTON * around + BORE * fixed)
    return along, RADIUS * around, np.zeros(2), power
