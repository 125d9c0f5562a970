"""Ports of several kidneys: what webs cover, and the film on them."""

from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH

from gaps.shapes.valve_plate_ring import Ring
from system import (
    InputFaults,
    PortOpening,
    break_angles,
    load_pump,
    lumped_point,
    opening_area,
    operating_point,
    port_openings,
    resolved_toml,
    valve_plate_geometry,
)
from system.pump.ports.webs import PortWebs

DEGREES = np.pi / 180.0
ARC = 30.0 * DEGREES
KIDNEY = (10.0 * DEGREES, 40.0 * DEGREES, 140.0 * DEGREES, 170.0 * DEGREES, 152e-6)
SPANS = ((58.0 * DEGREES, 62.0 * DEGREES), (98.0 * DEGREES, 104.0 * DEGREES))
PORT = PortOpening(0.0, *KIDNEY, webs=PortWebs(ARC, SPANS))


def test_area_is_what_port_and_kidney_have_in_common():
    """Kidney and port as sets of angles, counted: the share of the block's kidney that lies over the port."""
    ports = [(25.0, 58.0), (62.0, 98.0), (104.0, 155.0)]
    grid = (np.arange(30000) + 0.5) / 1000.0 - 15.0
    for middle in (12.0, 30.0, 44.0, 45.5, 60.0, 74.9, 80.0, 90.0, 118.0, 150.0, 168.0):
        places = middle + grid
        over = np.any([(places > start) & (places < end) for start, end in ports], axis=0)
        assert opening_area(PORT, middle * DEGREES) == pytest.approx(152e-6 * over.mean(), rel=1e-3)


def test_webs_bend_the_area_at_breaks():
    bends = break_angles(PORT)
    assert bends.size == 4 + 8
    for angle in (43.0, 47.0, 73.0, 77.0, 83.0, 89.0, 113.0, 119.0):
        assert np.min(np.abs(bends - angle * DEGREES)) < 1e-12
    assert opening_area(replace(PORT, webs=PortWebs()), 60.0 * DEGREES) == 152e-6


def test_ring_has_a_film_on_the_webs():
    """Cells of the kidneys' ring over a web are film again; its unknowns are held by no port."""
    geometry = valve_plate_geometry(load_pump(BENCH, {"ports.webs": [["90 deg", "20 deg"]]}))
    assert np.degrees(geometry.suction) == pytest.approx(np.array([[25.0, 80.0], [100.0, 155.0]]))
    assert np.degrees(geometry.delivery) == pytest.approx(np.array([[205.0, 260.0], [280.0, 335.0]]))
    # At 70 deg of shaft angle the block's web between kidneys 1 and 2 lies from 85 to 95 deg.
    for one, is_film in ((geometry, True), (replace(geometry, webs=()), False)):
        ring = Ring(one, (2, 16))
        space = ring.turned(70.0 * DEGREES)
        x, y = space.vertices[space.cells].mean(axis=1).T
        on_web = (np.hypot(x, y) > 31.5e-3) & (np.hypot(x, y) < 40.5e-3) & (np.abs(np.arctan2(x, y)) < 5.0 * DEGREES)
        assert on_web.sum() == 2 * 4
        assert ring.over_port(space)[on_web, 0].tolist() == [not is_film] * 8


def test_webs_reach_the_chamber(tmp_path):
    pump = load_pump(BENCH, {"ports.webs": [["90 deg", "20 deg"]]})
    file = tmp_path / "pump.toml"
    file.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(file) == pump
    area = opening_area(port_openings(pump)[1], np.radians([270.0, 230.0]))
    assert area == pytest.approx([152e-6 * (1.0 - 20.0 / 30.0), 152e-6])
    plain, point = load_pump(BENCH), operating_point(pump)
    throttled, free = (lumped_point(one, point).cycle.pressure[270] for one in (pump, plain))
    assert throttled - free > 0.0  # a delivery kidney that is two thirds covered


@pytest.mark.parametrize(
    ("webs", "found", "expected"),
    [
        ([["90 deg", "30 deg"]], "web 1, 30 deg wide", "less than kidney_arc, 30 deg"),
        ([["26 deg", "4 deg"]], "web 1 from 24 deg to 28 deg", "within 25 deg to 155 deg"),
        ([["90 deg", "4 deg"], ["92 deg", "4 deg"]], "web 2 from 90 deg", "within 92 deg"),
        ([["90 deg", "4 mm"]], "as width of row 1", "an angle"),
    ],
)
def test_webs_that_cannot_be_are_told(webs, found, expected):
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, {"ports.webs": webs})
    (fault,) = raised.value.faults
    assert fault.path == "ports.webs"
    assert found in fault.found
    assert expected in fault.expected
