"""Outer bearing pads of the valve plate: lift and friction by closed forms."""

from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH

from gaps import BlockDrive, BlockFilm, Effect, Physics, ValvePlateGeometry, constant, wall_shear
from gaps.shapes.bearing_pads import EDGE, BearingPads
from gaps.shapes.valve_plate_ring import Ring
from reynolds import FilmInputError, FilmSolution, FilmSolver, generalised_force, loads, modes_on
from system import InputFaults, Pair, load_pump, lumped_point, operating_point, resolved_toml, valve_plate_geometry
from system.pump_file.floating import check_floating

RADII = (26.5e-3, 31.5e-3, 40.5e-3, 45.7e-3)
SPEED, VISCOSITY, HEIGHT, TILT = 220.0, 0.0258, 10e-6, 0.5e-6
SUCTION, DELIVERY = (tuple(np.radians(arc).tolist()) for arc in ([25.0, 155.0], [205.0, 335.0]))
BARE = ValvePlateGeometry(RADII, 9, np.radians(30.0), SUCTION, DELIVERY)
RING = BearingPads(57e-3, 59e-3, 2.0 * np.pi, 1)
SECTORS = BearingPads(50e-3, 54e-3, np.radians(25.0), 9)
DRIVE = BlockDrive(SPEED, VISCOSITY, 0.0, 0.0, 0.0, -1e5, constant(0.0), constant(0.0, 0.0, 0.0), 0.0)
FULL = Physics().without(Effect.CAVITATION)


def solved(geometry: ValvePlateGeometry, position, time=0.0) -> tuple[np.ndarray, float, FilmSolution]:
    """Generalised forces (3,) N, friction torque N m and the film at a position."""
    film = BlockFilm(geometry, DRIVE, physics=FULL)
    problem, modes = film.problem_at(time), film.modes_at(time)
    opened = problem.film.thickness + problem.space.sample_vertices(modes @ np.asarray(position))
    oil = replace(problem.film, thickness=opened, thickness_at_vertices=None)
    solution = FilmSolver(film.space).solve(replace(problem, film=oil))
    force = generalised_force(solution.pressure, modes_on(problem.space, modes, {}), 0.0)
    return force, film.friction_torque(problem.space, wall_shear(solution, None, opened)), solution


def test_a_tilted_ring_pad_bears_as_a_short_bearing(validation):
    """f = mu w B^3 a sin(phi)/(2 h^3) a length of a narrow ring tilted by a cos(phi): about the other axis."""
    position, r4 = (HEIGHT, TILT, 0.0), RADII[3]
    alone, _, _ = solved(BARE, position)
    both, _, _ = solved(replace(BARE, pads=(RING,)), position)
    width, radius = RING.outer_radius - RING.inner_radius, RING.mean_radius
    rise = TILT * radius / r4
    expected = 0.5 * np.pi * VISCOSITY * SPEED * width**3 * rise * radius**2 / HEIGHT**3 / r4
    validation(
        case="Outer bearing pad, tilted ring",
        source="closed form, short bearing (Ocvirk 1952), first order in the tilt",
        quantity="generalised force of the pad",
        unit="N",
        expected=expected,
        obtained=float((both - alone)[2]),
        tolerance=0.025 * expected,  # (rise/h)^2, (B/R)^2 and eight cells across, one in 64
        note="rise 0.065 of the film",
    )
    assert abs((both - alone)[0]) < 1e-3 * expected


def test_pads_drag_by_their_shear_and_stand_still():
    """mu w/h int r^2 dA; at any shaft angle the same, while the ring's mesh has turned."""
    pads = (SECTORS, RING)
    flat = (HEIGHT, 0.0, 0.0)
    drag = sum(run.number * run.arc / 4.0 * (run.outer_radius**4 - run.inner_radius**4) for run in pads)
    found = []
    for time in (0.0, 0.3 / SPEED):
        with_pads, without = (solved(geometry, flat, time) for geometry in (replace(BARE, pads=pads), BARE))
        found.append(with_pads[1] - without[1])
        assert loads(with_pads[2]).flow[EDGE] == pytest.approx(0.0, abs=1e-12)
    # Polygons of the ring's cells have up to 2e-3 less of r^4.
    assert found == pytest.approx([VISCOSITY * SPEED / HEIGHT * drag] * 2, rel=3e-3)
    assert found[0] == pytest.approx(found[1], rel=1e-9)


def test_mesh_of_pads():
    ring, bare = Ring(replace(BARE, pads=(SECTORS, RING)), (4, 16)), Ring(BARE, (4, 16))
    space = ring.space
    assert space.vertices[: len(bare.space.vertices)] == pytest.approx(bare.space.vertices, abs=1e-18)
    assert set(space.edge_dofs) == {*bare.space.edge_dofs, EDGE}
    area = float(space.area.sum() - bare.space.area.sum())
    assert area == pytest.approx(SECTORS.area + RING.area, rel=3e-3)
    turned = ring.turned(0.3)
    still = ~ring.turns_with_block(space)[:, 0]
    assert np.array_equal(turned.vertices[space.cells[still]], space.vertices[space.cells[still]])
    with pytest.raises(FilmInputError, match="gaps between them"):
        BearingPads(50e-3, 54e-3, np.radians(40.0), 9)


PADS = [{"inner": "66 mm", "outer": "74 mm", "arc": "30 deg", "number": 9}]


def test_pads_hold_a_block_that_tips(tmp_path):
    """ref90's block presses at 73 mm: beyond its outer land, within pads that reach further."""
    pump = load_pump(BENCH, {"valve_plate.pads": PADS})
    file = tmp_path / "pump.toml"
    file.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(file) == pump
    assert "valve_plate.land_radius_4" not in {warning.path for warning in check_floating(pump).warnings}
    assert valve_plate_geometry(pump).pads == (BearingPads(66e-3, 74e-3, pump.valve_plate.kidney_arc, 9),)
    bare, point = load_pump(BENCH), operating_point(pump)
    loss = [lumped_point(one, point).pairs.loss(Pair.VALVE_PLATE_CYLINDER).mean for one in (pump, bare)]
    pads = pump.valve_plate.bearing_pads[0]
    speed = point.shaft_speed * 70e-3
    assert loss[0] - loss[1] == pytest.approx(point.viscosity * pads.area * speed**2 / 8e-6, rel=1e-9)


@pytest.mark.parametrize(
    ("changed", "path", "expected"),
    [
        ({"inner": "45 mm"}, "valve_plate.pads.1.inner", "more than 45.7 mm"),
        ({"outer": "66 mm"}, "valve_plate.pads.1.outer", "more than inner, 66 mm"),
        ({"arc": "40 deg"}, "valve_plate.pads.1.arc", "less than 40 deg"),
        ({"number": 2.5}, "valve_plate.pads.1.number", "a whole number"),
        ({"arc": "400 deg", "number": 1}, "valve_plate.pads.1.arc", "at most 360 deg"),
    ],
)
def test_pads_that_cannot_be_are_told(changed, path, expected):
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, {"valve_plate.pads": [PADS[0] | changed]})
    told = {fault.path: fault for fault in raised.value.faults}
    assert list(told) == [path]
    assert expected in told[path].expected
