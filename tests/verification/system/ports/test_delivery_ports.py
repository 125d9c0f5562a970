"""Ports that differ: [ports.delivery] beside [ports], in the chamber's law, the film's ring and the checks."""

import numpy as np
import pytest
from bench_pump import BENCH

from system import (
    InputFaults,
    load_pump,
    lumped_point,
    opening_area,
    operating_point,
    port_openings,
    resolved_toml,
    valve_plate_geometry,
)

PUMP = load_pump(BENCH)
ARC = PUMP.valve_plate.kidney_arc
LATER = {"ports.delivery.kidney_end": "173 deg", "ports.delivery.kidney_full_end": "143 deg"}


def test_said_alike_they_are_alike():
    own = load_pump(BENCH, {"ports.delivery.kidney_area": f"{PUMP.ports.kidney_area * 1e6!r} mm2"})
    assert port_openings(own) == port_openings(PUMP)
    assert valve_plate_geometry(own) == valve_plate_geometry(PUMP)


def test_each_port_opens_by_its_own_law():
    """The delivery's kidney alone is smaller; grooves of another kind take the place of that of [ports]."""
    groove = [{"start": "2 deg", "end": "12 deg", "shape": "area", "area": "3 mm2"}]
    own = load_pump(BENCH, {"ports.delivery.kidney_area": "140 mm2", "ports.delivery.grooves": groove})
    (suction, delivery), (plain, _) = port_openings(own), port_openings(PUMP)
    assert suction == plain
    quarter = np.array([0.5 * np.pi, 1.5 * np.pi])
    assert opening_area(delivery, quarter) == pytest.approx([0.0, 140e-6])
    assert opening_area(suction, quarter) == pytest.approx([PUMP.ports.kidney_area, 0.0])
    assert len(delivery.grooves) == 1
    assert delivery.grooves[0].largest == pytest.approx(3e-6)
    assert delivery.dead_centre == pytest.approx(np.pi)


def test_the_films_ports_follow_their_own_side(tmp_path):
    own = load_pump(BENCH, LATER | {"ports.delivery.webs": [["90 deg", "20 deg"]]})
    found, plain = valve_plate_geometry(own), valve_plate_geometry(PUMP)
    assert found.suction == plain.suction
    assert len(found.delivery) == 2
    assert found.delivery_arc == pytest.approx((plain.delivery_arc[0], np.radians(353.0) - 0.5 * ARC))
    file = tmp_path / "pump.toml"
    file.write_text(resolved_toml(own), "utf-8")
    assert load_pump(file) == own


def test_a_delivery_port_that_opens_late_leaves_the_chamber_empty_for_longer():
    """Just behind the outer dead centre its pressure is lower; the suction stroke knows nothing of it."""
    late = {"ports.delivery.groove_start": "8 deg", "ports.delivery.groove_area": "5 mm2"}
    own, point = load_pump(BENCH, late), operating_point(PUMP)
    cycle, other = (lumped_point(pump, point).cycle for pump in (PUMP, own))
    at = np.searchsorted(cycle.shaft_angle, np.radians(186.0))
    assert other.pressure[at] < 0.5 * cycle.pressure[at]
    assert other.pressure[at // 2] == pytest.approx(cycle.pressure[at // 2], rel=1e-3)


def test_faults_stand_at_the_table_that_brings_them():
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, {"ports.delivery.kidney_end": "200 deg", "ports.delivery.kidney_area": "900 mm2"})
    told = {fault.path: f"{fault.found} {fault.expected}" for fault in raised.value.faults}
    assert "delivery is still open when suction opens" in told["ports.delivery.kidney_end"]
    assert "square ends" in told["ports.delivery.kidney_area"]
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, LATER | {"ports.kidney_end": "186 deg", "ports.delivery.groove_start": "1 deg"})
    (late,) = (fault for fault in raised.value.faults if "short-circuited" in fault.expected)
    assert late.path == "ports.kidney_end"
    assert late.found.startswith("186 deg: suction is still open when delivery opens")
    assert "181 deg (180 deg + ports.delivery.groove_start)" in late.expected
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, {"ports.delivery.kidney_ends": "170 deg"})
    assert [fault.nearest for fault in raised.value.faults] == ["kidney_end"]
