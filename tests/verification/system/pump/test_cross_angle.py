"""The cross angle: a plate tilted about two axes is one tilted about a third, seen from its own dead centres."""

import numpy as np
import pytest
from bench_pump import BENCH

from gaps.shapes.bearing_pads import EDGE
from gaps.shapes.valve_plate_ring import Ring
from system import (
    InputFaults,
    break_angles,
    load_pump,
    lumped_point,
    operating_point,
    piston_area,
    piston_motion,
    rotor,
    valve_plate_geometry,
)
from system.pump.laws import kinematics as kin
from system.pump.lumped import chamber_problem, lumped_leaks, swept_displacement

RADIUS, CONE, SWASH, CROSS = 45e-3, np.radians(5.0), np.radians(16.2), np.radians(3.0)


@pytest.mark.parametrize("ratio", [1.0, 0.5, 0.25])
def test_pistons_move_as_the_plane_of_two_tilts_moves_them(ratio):
    """Bore axes cut by the plane z = -x tan g + y tan k, in vectors, against the laws from the dead centre."""
    drive = kin.drive_at_ratio(kin.crossed_drive(RADIUS, CONE, SWASH, CROSS), ratio)
    swash = np.arctan(np.sqrt(np.tan(drive.swash_angle) ** 2 - np.tan(CROSS) ** 2))
    plate_angle = np.linspace(0.0, 2.0 * np.pi, 73)  # of a bore, from the valve plate's own axis
    outward = np.stack([np.cos(plate_angle), np.sin(plate_angle)])
    # Bore: (R outward, 0) + s (sin b outward, cos b); the plane through the shaft's point of zero swash.
    slope = -outward[0] * np.tan(swash) + outward[1] * np.tan(CROSS)
    way = RADIUS * slope / (np.cos(CONE) - np.sin(CONE) * slope)
    found = kin.piston_displacement(drive, plate_angle + drive.dead_centre_shift)
    assert found - found[0] == pytest.approx(way - way[0], abs=1e-14)
    assert np.ptp(way) == pytest.approx(kin.stroke(drive), rel=2e-3)
    assert kin.stroke(drive) == pytest.approx(ratio * kin.stroke(kin.crossed_drive(RADIUS, CONE, SWASH, CROSS)))


def test_dead_centres_move_with_the_displacement():
    full = kin.crossed_drive(RADIUS, 0.0, SWASH, CROSS)
    assert full.dead_centre_shift == pytest.approx(np.arctan(np.tan(CROSS) / np.tan(SWASH)))
    assert kin.crossed_drive(RADIUS, 0.0, SWASH, 0.0) == kin.SwashDrive(RADIUS, 0.0, SWASH)
    least = kin.least_ratio(full)
    assert least == pytest.approx(np.sin(full.dead_centre_shift))  # tan k over tan G on a cylindrical block
    assert kin.drive_at_ratio(full, least).dead_centre_shift == pytest.approx(np.pi / 2, abs=1e-6)
    with pytest.raises(ValueError, match="cross angle alone"):
        kin.drive_at_ratio(full, 0.9 * least)


def _problem(pump):
    point = operating_point(pump)
    motion = piston_motion(pump, point)
    return chamber_problem(pump, point, motion, lumped_leaks(pump, point, motion))


def test_ports_and_face_lie_later_by_the_shift():
    """In chamber and film alike; derived displacement counts from where the ports then shut."""
    stated = {"pump.cross_angle": "3 deg", "pump.displacement": "91.4 cm3/rev"}
    pads = [{"inner": "50 mm", "outer": "54 mm", "arc": "20 deg", "number": 3}]
    pump = load_pump(BENCH, stated | {"valve_plate.pads": pads})
    group = rotor(pump, operating_point(pump))
    shift = group.drive.dead_centre_shift
    problem = _problem(pump)
    assert problem.suction_port.dead_centre == shift
    assert problem.delivery_port.dead_centre == np.pi + shift
    plain = _problem(load_pump(BENCH))
    assert break_angles(problem.suction_port) == pytest.approx(
        np.sort((break_angles(plain.suction_port) + shift) % (2.0 * np.pi)), abs=1e-12
    )
    geometry = valve_plate_geometry(pump, shift)
    assert geometry.suction[0] == pytest.approx(np.radians([25.0, 155.0]) + shift)
    space = Ring(geometry, (2, 16)).space
    first = space.vertices[np.hypot(*space.vertices.T) > 49e-3]
    middle = np.angle(np.sum((first[:, 0] + 1j * first[:, 1]) ** 3)) / 3.0  # of three pads, the first one's
    assert middle == pytest.approx(shift, abs=1e-9)
    assert EDGE in space.edge_dofs
    shuts = kin.piston_displacement(group.drive, np.radians([170.0, 350.0]) + shift)
    area = piston_area(pump) + np.pi * 22e-3 * 15e-6 / 2.0
    assert swept_displacement(pump, group.drive) == pytest.approx(9 * area * (shuts[0] - shuts[1]), rel=1e-12)


def test_a_displacement_below_the_cross_angles_own_is_refused():
    stated = {"pump.cross_angle": "3 deg", "pump.displacement": "91.4 cm3/rev", "operating.displacement_ratio": 0.1}
    with pytest.raises(InputFaults, match=r"operating.displacement_ratio(?s:.*)at least 0.177"):
        load_pump(BENCH, stated)


def test_a_cone_on_which_no_plate_turns_is_a_fault_beside_a_cross_angle():
    """tan(cone) hypot(tan swash, tan cross) from one to two: pistons of such a cone have no stroke to compare with."""
    with pytest.raises(InputFaults) as told:
        load_pump(BENCH, {"pump.bore_cone_angle": "78 deg", "pump.cross_angle": "3 deg"})
    assert "pump.bore_cone_angle" in {fault.path for fault in told.value.faults}
    assert "operating.displacement_ratio" not in {fault.path for fault in told.value.faults}


def test_mass_and_energy_close_with_a_cross_angle():
    pump = load_pump(BENCH, {"pump.cross_angle": "2 deg", "operating.displacement_ratio": 0.5})
    found = lumped_point(pump, operating_point(pump))
    assert found.checks.energy_balance_error < 1e-3
    assert found.checks.mass_balance_error < 1e-6
