"""Throats of relief grooves against geometry, and ports that open and shut by several of them."""

import numpy as np
import pytest
from bench_pump import BENCH

from system import (
    InputFaults,
    PortOpening,
    ReliefGroove,
    break_angles,
    load_pump,
    lumped_point,
    opening_area,
    operating_point,
    port_openings,
    resolved_toml,
)
from system.pump.lumped import full_drive, swept_displacement
from system.pump.ports.relief_grooves import round_groove, segment_area, v_groove

DEGREES = np.pi / 180.0
RADIUS, DEPTH = 44e-3, 2e-3
BEGINS, DEEP = -5.0 * DEGREES, 10.0 * DEGREES
KIDNEY = (10.0 * DEGREES, 40.0 * DEGREES, 140.0 * DEGREES, 170.0 * DEGREES, 152e-6)


def throat(groove: ReliefGroove, degrees: float) -> float:
    return float(opening_area(PortOpening(0.0, *KIDNEY, (groove,)), degrees * DEGREES))


def test_v_groove_is_a_leaning_triangle():
    """Corners of the section under the kidney's edge in space: its area is that of the triangle between them."""
    groove, opened = v_groove(BEGINS, DEEP, DEPTH, 60.0 * DEGREES, RADIUS), 40.0 * DEGREES
    slope = np.arctan(DEPTH / (RADIUS * (DEEP - BEGINS)))
    for degrees in (-4.0, 2.5, 10.0):
        way = RADIUS * (degrees * DEGREES - BEGINS)
        deep = way * np.tan(slope)
        # The edge's point on the plate, and the foot of the perpendicular on the bottom line.
        foot = np.array([way - deep * np.sin(slope) * np.cos(slope), -deep * np.cos(slope) ** 2])
        height = np.hypot(*(np.array([way, 0.0]) - foot))
        half_width = deep * np.tan(30.0 * DEGREES)  # on the plate, straight above
        assert throat(groove, degrees) == pytest.approx(half_width * height, rel=1e-12)
    assert throat(groove, 10.0) == groove.largest
    assert v_groove(BEGINS, DEEP, DEPTH, opened, RADIUS).largest < groove.largest


def test_round_groove_is_a_segment_of_its_tool():
    """The segment's area by quadrature of its chord over the depth; above the tool's middle walls are upright."""
    width = 3e-3
    groove = round_groove(BEGINS, DEEP, DEPTH, width, RADIUS)
    way = RADIUS * (DEEP - BEGINS)
    leant = way / np.hypot(way, DEPTH)
    for part in (0.1, 0.5, 0.75, 0.9, 1.0):
        level = np.linspace(0.0, 1.0, 20001) ** 2 * part * DEPTH  # from the bottom; dense where the chord turns
        chord = np.where(level < width / 2, 2.0 * np.sqrt(np.maximum(level * (width - level), 0.0)), width)
        wanted = leant * np.trapezoid(chord, level)
        assert throat(groove, -5.0 + 15.0 * part) == pytest.approx(wanted, rel=2e-7)
    assert segment_area(1.5, 1.5) == pytest.approx(np.pi * 1.5**2 / 2)
    assert groove.breaks[2] == pytest.approx(BEGINS + 0.75 * (DEEP - BEGINS))


def test_a_port_shuts_by_the_groove_behind_it():
    """Mirrored about the middle of the port, a groove ahead is one behind."""
    ahead = v_groove(BEGINS, DEEP, DEPTH, 60.0 * DEGREES, RADIUS)
    behind = v_groove(185.0 * DEGREES, 170.0 * DEGREES, DEPTH, 60.0 * DEGREES, RADIUS)
    port = PortOpening(np.pi, *KIDNEY, (ahead, behind))
    assert (port.opens, port.shuts) == (BEGINS, 185.0 * DEGREES)
    degrees = np.array([-4.0, 0.0, 9.0, 11.0, 25.0, 39.0])
    one, other = (opening_area(port, (180.0 + angles) * DEGREES) for angles in (degrees, 180.0 - degrees))
    np.testing.assert_allclose(one, other, rtol=1e-9)
    assert opening_area(port, (180.0 + 186.0) * DEGREES) == 0.0
    breaks = break_angles(port)
    assert breaks.size == 6
    assert opening_area(port, breaks + 1e-9) == pytest.approx(opening_area(port, breaks - 1e-9), abs=1e-12)


def test_throats_add_up_below_the_kidney():
    one, two = ReliefGroove(BEGINS, DEEP, 2e-6), ReliefGroove(0.0, 20.0 * DEGREES, 4e-6)
    port = PortOpening(0.0, *KIDNEY, (one, two))
    assert opening_area(port, 10.0 * DEGREES) == pytest.approx(2e-6 + 1e-6, rel=1e-12)
    assert opening_area(port, 40.0 * DEGREES) == pytest.approx(152e-6)
    assert opening_area(port, 39.999 * DEGREES) == pytest.approx(152e-6, rel=1e-4)


GROOVES = [
    {"start": "-8 deg", "end": "10 deg", "shape": "v", "depth": "1.5 mm", "angle": "70 deg"},
    {"start": "-3 deg", "end": "10 deg", "shape": "round", "depth": "1 mm", "width": "2 mm"},
    {"start": "170 deg", "end": "171 deg", "shape": "area", "area": "3 mm2"},
]


@pytest.fixture
def grooved(tmp_path):
    """ref90 without its own groove, to which grooves are given."""

    def load(grooves):
        rows = resolved_toml(load_pump(BENCH)).splitlines()
        kept = [row for row in rows if not row.startswith(("groove_start", "groove_area"))]
        path = tmp_path / "pump.toml"
        path.write_text("\n".join(kept), "utf-8")
        return load_pump(path, {"ports.grooves": grooves} if grooves is not None else None)

    return load


def test_shapes_reach_the_chamber(grooved, tmp_path):
    pump = grooved(GROOVES)
    file = tmp_path / "again.toml"
    file.write_text(resolved_toml(pump), "utf-8")
    assert load_pump(file) == pump
    port = port_openings(pump)[0]
    assert [groove.begins < groove.deep for groove in port.grooves] == [True, True, False]
    found = lumped_point(pump, operating_point(pump))
    assert found.checks.energy_balance_error < 1e-3
    bare = grooved(None)
    assert port_openings(bare)[0].grooves == ()
    assert lumped_point(bare, operating_point(bare)).cycle.pressure.max() > found.cycle.pressure.max()
    drive = full_drive(pump)
    # The groove behind lets the port shut at 171 deg instead of 170: nearer to the full stroke.
    assert swept_displacement(pump, drive) > swept_displacement(bare, drive)


def test_paper_groove_is_one_of_a_known_area(grooved):
    own = grooved([{"start": "-5 deg", "end": "10 deg", "shape": "area", "area": "4 mm2"}])
    assert port_openings(own)[0] == port_openings(load_pump(BENCH))[0]


@pytest.mark.parametrize(
    ("changed", "path", "expected"),
    [
        ({"shape": "u"}, "ports.grooves.1.shape", "one of 'v', 'round', 'area'"),
        ({"depth": "1.5 bar"}, "ports.grooves.1.depth", "a length"),
        ({"deep": "1 mm"}, "ports.grooves.1.deep", "one of start, end"),
        ({"width": "2 mm"}, "ports.grooves.1.width", "depth and angle alone"),
        ({"shape": "round"}, "ports.grooves.1.width", "depth and width"),
        ({"end": "-9 deg"}, "ports.grooves.1.end", "more than start"),
        ({"end": "60 deg"}, "ports.grooves.1", "an end by kidney_full_start, 40 deg"),
        ({"start": "150 deg", "end": "160 deg"}, "ports.grooves.1.end", "more than kidney_end, 170 deg"),
        ({"start": "150 deg", "end": "190 deg"}, "ports.grooves.1.end", "short-circuited"),
        ({"depth": "30 mm"}, "ports.grooves", "less than kidney_area"),
    ],
)
def test_grooves_that_cannot_be_are_told(changed, path, expected, grooved):
    with pytest.raises(InputFaults) as raised:
        grooved([GROOVES[0] | changed])
    told = {fault.path: fault for fault in raised.value.faults}
    assert path in told
    assert expected in told[path].expected


def test_two_ways_of_stating_a_groove_are_one_too_many(tmp_path):
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, {"ports.grooves": GROOVES})
    assert {fault.path for fault in raised.value.faults} == {"ports.groove_start", "ports.groove_area"}
    file = tmp_path / "pump.toml"
    text = resolved_toml(load_pump(BENCH)) + '\n[[ports.grooves]]\nstart = "1 deg"\nend = "0 bar"\nshape = "v"\n'
    file.write_text(text, "utf-8")
    with pytest.raises(InputFaults, match=rf"ports.grooves.1.end \(line {len(text.splitlines()) - 1}\)"):
        load_pump(file)
