"""Traces of a profilometer in pump files and gap cases, worn parts of one chamber, and the faults of wrong ones."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest
from bench_pump import BENCH

from swashfilm.case.file import load_case
from swashfilm.runs.film.checks.validity import film_warnings
from swashfilm.runs.film.solve.study import solve_case
from system import InputFaults, check_pump, floating_parts, load_pump, resolved_toml
from system.pump.chamber_kinds import kinds

HEAD = "place [mm],height [um]\n"
PLACES = np.arange(0.0, 45.001, 0.05)
UNWORN = [["15 mm", "30 mm"]]
TRACE = {"trace": "worn.csv", "level": "line", "unworn": UNWORN, "cutoff": "0.8 mm"}


def worn(place: np.ndarray) -> np.ndarray:
    """Material taken off (um) at places (mm)."""
    return np.asarray(4.0 * np.maximum(1.0 - place / 10.0, 0.0) ** 2)


def heights(place: np.ndarray) -> np.ndarray:
    """Reading of it by a profilometer, askew."""
    return np.asarray(25.0 - 0.3 * place - worn(place))


def written(folder: Path, rows: str | Iterable[Iterable[object]], head: str = HEAD, name: str = "worn.csv") -> None:
    """Write a file of rows, or of a text."""
    text = rows if isinstance(rows, str) else "\n".join(",".join(map(str, row)) for row in rows)
    (folder / name).write_text(head + text + "\n", "utf-8")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working directory, with a trace in it: files of a built-in pump are looked for there."""
    monkeypatch.chdir(tmp_path)
    written(tmp_path, zip(PLACES, heights(PLACES), strict=True))
    return tmp_path


def loaded(**changed: object):
    """The recordings' pump with the trace as its piston's profile, with other entries where changed (None: without)."""
    table = {key: value for key, value in (TRACE | changed).items() if value is not None}
    return load_pump(BENCH, {f"piston.profile.{key}": value for key, value in beside(table).items()})


def beside(table: dict[str, object]) -> dict[str, object]:
    """The same with the file's whole path: the pump's file lies elsewhere."""
    return {key: str(Path(str(value)).resolve()) if key == "trace" else value for key, value in table.items()}


def faults_of(**changed: object) -> dict[str, list[tuple[str, str, str]]]:
    with pytest.raises(InputFaults) as raised:
        loaded(**changed)
    found: dict[str, list[tuple[str, str, str]]] = {}
    for fault in raised.value.faults:
        found.setdefault(fault.path, []).append((fault.found, fault.expected, fault.nearest))
    return found


def test_a_trace_is_levelled_smoothed_and_resampled(folder):
    """Rows a tenth of the cutoff apart to the trace's end; wear to the filter's raise of a parabola, 0.9 nm."""
    rows = np.array(loaded().piston.profile)
    assert (rows[0, 0], rows[-1, 0]) == (0.0, 45e-3)
    assert np.diff(rows[:-1, 0]) == pytest.approx(np.full(len(rows) - 2, 0.08e-3))
    assert rows[:, 1] == pytest.approx(1e-6 * worn(1e3 * rows[:, 0]), abs=4e-9)
    inner = rows[(rows[:, 0] > 1e-3) & (rows[:, 0] < 9e-3)]
    raised = 0.8**2 * np.log(2.0) / np.pi / (4.0 * np.pi) * 2.0 * 4.0 / 10.0**2 * 1e-6
    assert inner[:, 1] - 1e-6 * worn(1e3 * inner[:, 0]) == pytest.approx(np.full(len(inner), raised), rel=0.02)


def test_the_resolved_pump_holds_the_rows(folder):
    pump = loaded()
    (folder / "worn.csv").unlink()
    (folder / "resolved.toml").write_text(resolved_toml(pump), "utf-8")
    assert load_pump(folder / "resolved.toml") == pump


def test_a_trace_that_is_not_levelled_keeps_its_tilt(folder):
    written(folder, zip(PLACES, heights(PLACES) - 25.0, strict=True))
    rows = np.array(loaded(level="none", unworn=None).piston.profile)
    places = 1e3 * rows[:, 0]
    assert rows[:, 1] == pytest.approx(1e-6 * (0.3 * places + worn(places)), abs=4e-9)


def test_heights_are_material_taken_off_with_the_opposite_sign(folder):
    written(folder, "0,-4\n20,0\n45,1.5")
    stated = load_pump(BENCH, {"piston.profile": str(folder / "worn.csv")})
    assert stated.piston.profile == ((0.0, 4e-6), (20e-3, 0.0), (45e-3, -1.5e-6))


def test_each_angle_has_a_trace_levelled_by_itself(folder):
    """Traces with offsets, tilts and places of their own; the rows reach as far as all of them."""
    of_angle = {0: (25.0, -0.3, 1.0), 90: (-8.0, 0.1, 2.0), 180: (3.0, 0.0, 0.5)}
    rows = [
        (place, angle, height + tilt * place - share * worn(np.array(place)))
        for angle, (height, tilt, share) in of_angle.items()
        for place in np.arange(-0.001 * angle, 45.2, 0.05 + 1e-4 * angle)
    ]
    written(folder, rows, "place [mm],angle [deg],height [um]\n")
    found = np.array(loaded().piston.profile).reshape(-1, 3, 3)
    assert np.degrees(found[0, :, 1]) == pytest.approx([0.0, 90.0, 180.0])
    for k, (*_, share) in enumerate(of_angle.values()):
        place = found[:, k, 0]
        assert found[:, k, 2] == pytest.approx(share * 1e-6 * worn(np.maximum(1e3 * place, 0.0)), abs=8e-9)


def test_every_part_takes_a_trace(folder):
    """Bore, slipper, valve plate and block; those of plate and block add up in their film."""
    table = beside(TRACE)
    at = {"slipper": (7.0, 15.0), "valve_plate": (26.0, 47.0), "block": (26.0, 47.0), "bore": (0.0, 45.0)}
    stated = {}
    for part, (start, end) in at.items():
        place = np.linspace(start, end, 600)
        written(folder, zip(place, 1.0 - np.cos(place), strict=True), name=f"{part}.csv")
        unworn = [[f"{start} mm", f"{end} mm"]]
        stated[f"{part}.profile"] = table | {"trace": str(folder / f"{part}.csv"), "unworn": unworn}
    parts = floating_parts(load_pump(BENCH, stated))
    for shape in (parts.piston.bore, parts.slipper.face):
        assert len(shape.shapes) == 1
    place, angle = np.linspace(27e-3, 45e-3, 7), np.zeros(7)
    plate, block = (one(place, angle) for one in parts.block.faces.shapes)
    assert parts.block.faces(place, angle).depth == pytest.approx(plate.depth + block.depth, rel=1e-14)


# One chamber


def test_a_worn_piston_and_bore_are_those_of_their_chamber_only(folder):
    """The other chambers keep every part that they had."""
    pump = load_pump(
        BENCH, {"piston.3.profile": beside(TRACE), "bore.5.profile": [["0 mm", "3 um"], ["45 mm", "0 um"]]}
    )
    found = kinds(pump)
    assert [found.of_chamber.count(kind) for kind in range(3)] == [7, 1, 1]
    plain, single = floating_parts(load_pump(BENCH)), [floating_parts(one) for one in found.pumps]
    assert single[0] == plain
    worn_piston, worn_bore = (single[found.of_chamber[chamber - 1]] for chamber in (3, 5))
    assert worn_piston.piston.piston.shapes
    assert worn_bore.piston.bore.shapes
    assert worn_piston.piston.bore == plain.piston.bore
    assert worn_bore.piston.piston == plain.piston.piston
    assert worn_piston.slipper == worn_bore.slipper == plain.slipper
    assert load_pump(_file(folder, resolved_toml(pump))) == pump


def _file(folder: Path, text: str) -> Path:
    (folder / "resolved.toml").write_text(text, "utf-8")
    return folder / "resolved.toml"


# What is wrong


def test_all_lines_that_are_no_numbers_are_told_at_once(folder):
    written(folder, "0,1\n1,nan\n2\n3,0.5 um\n4,")
    told = faults_of()["piston.profile.trace"]
    assert [one[0] for one in told] == [
        "line 3 of worn.csv, height: 'nan um'",
        "line 4 of worn.csv: 1 values",
        "line 5 of worn.csv, height: '0.5 um um', which is not a length",
        "line 6 of worn.csv, height: ' um'",
    ]
    assert told[0][1] == "a number; the head says [um]"


def test_a_thousand_wrong_lines_are_counted(folder):
    written(folder, "\n".join(f"{place},nan" for place in range(1000)))
    *told, rest = faults_of()["piston.profile.trace"]
    assert len(told) == 10
    assert rest[0] == "worn.csv: 990 more faults"


@pytest.mark.parametrize(
    ("text", "found", "expected"),
    [
        ("", "at least 2 rows", ""),
        ("place,height [um]\n0,1\n", "the head 'place, height [um]' of worn.csv", "'height' in place of"),
        ("place [mm],hight [um]\n0,1\n", "the head 'place [mm], hight [um]' of worn.csv", "place [mm]"),
    ],
)
def test_a_file_without_rows_or_units(text, found, expected, folder):
    written(folder, "", head=text or HEAD)
    ((shown, wanted, _),) = faults_of()["piston.profile.trace"]
    assert found in shown + wanted
    assert expected in wanted


def test_an_empty_file(folder):
    (folder / "worn.csv").write_text("", "utf-8")
    ((shown, *_),) = faults_of()["piston.profile.trace"]
    assert "which is empty" in shown


def test_places_that_do_not_rise(folder):
    written(folder, "0,1\n1,1\n0.5,1\n2,1\n2,0\n45,1")
    ((shown, wanted, _),) = faults_of(cutoff="200 mm")["piston.profile.trace"]
    assert shown == "500 um after 1 mm, point 3; 2 such points"
    assert wanted == "places that rise from point to point"
    written(folder, zip(PLACES[::-1], heights(PLACES[::-1]), strict=True))
    ((*_, nearest),) = faults_of()["piston.profile.trace"]
    assert nearest == "the rows in reverse order"


def test_levelling_and_cutoff_that_the_trace_does_not_bear(folder):
    told = faults_of(unworn=[["50 mm", "60 mm"], ["3 mm", "1 mm"]], cutoff="60 um")
    assert told["piston.profile.unworn"] == [
        ("from 3 mm to 1 mm", "a start before the end", ""),
        ("50 mm to 60 mm, a trace from 0 mm to 45 mm", "a range with two points of the trace or more", ""),
    ]
    (cutoff,) = told["piston.profile.cutoff"]
    assert cutoff[0].startswith("60 um, points up to 50 um apart at ")
    assert cutoff[1] == "at least 100 um, twice that distance"
    assert faults_of(cutoff="50 mm")["piston.profile.cutoff"][0][1] == "at most the trace's length, 45 mm"
    assert "missing beside level = 'line'" in faults_of(unworn=None)["piston.profile.unworn"][0][0]
    assert faults_of(level="none")["piston.profile.unworn"][0][1] == "level = 'line', or no ranges"


def test_a_missing_file_hides_no_fault_of_the_other_keys(folder):
    told = faults_of(trace="nowhere.csv", unworn=[["3 mm", "1 mm"]], cutoff="0 mm")
    assert "which is no file" in told["piston.profile.trace"][0][0]
    assert told["piston.profile.unworn"] == [("from 3 mm to 1 mm", "a start before the end", "")]
    assert told["piston.profile.cutoff"][0][1] == "more than 0 mm"
    assert set(faults_of(trace="nowhere.csv", unworn=None)) == {"piston.profile.trace", "piston.profile.unworn"}
    assert set(faults_of(unworn=[["50 mm", "60 mm"]], level="plane")) == {
        "piston.profile.level", "piston.profile.unworn",
    }  # fmt: skip


def test_nothing_is_taken_where_a_key_is_missing(folder):
    told = faults_of(level=None, cutoff=None)
    assert told["piston.profile.level"][0][:2] == ("missing", "one of 'line', 'none'")
    assert told["piston.profile.cutoff"][0][0] == "missing"
    assert faults_of(filter="0.8 mm")["piston.profile.filter"][0][1] == "one of trace, level, unworn, cutoff"


def test_a_trace_that_ends_before_the_land(folder):
    written(folder, zip(PLACES[:-100], heights(PLACES[:-100]), strict=True))
    (fault,) = faults_of()["piston.profile"]
    assert fault[:2] == ("places from 0 mm to 40 mm", "places from 0 mm or less to 45 mm or more")


NET = [(f"{place} mm", f"{angle} deg", "1 um") for place in (0, 45) for angle in (0, 90)]
WIDE = [(f"{place} mm", f"{angle} deg", "1 um") for place in (0, 45) for angle in (0, 360)]


@pytest.mark.parametrize(
    ("rows", "found"),
    [
        ([("0 mm", "1 um"), ("45 mm", "1 um"), ("30 mm", "1 um")], "30 mm after 45 mm in row 3"),
        (NET[:-1], "0 rows at 45 mm, 90 deg"),
        ([*NET, NET[0]], "2 rows at 0 mm, 0 deg"),
        ([row for row in NET if row[1] == "0 deg"], "2 places, 1 angles"),
        (WIDE, "angles from 0 deg to 360 deg"),
    ],
)
def test_rows_of_a_profile_grow_or_make_a_net(rows, found):
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, {"piston.profile": [list(row) for row in rows]})
    assert [(one.path, one.found) for one in raised.value.faults] == [("piston.profile", found)]


def test_a_profile_with_angles_is_taken_in_any_order():
    pump = load_pump(BENCH, {"piston.profile": [list(row) for row in NET[::-1]]})
    assert pump.piston.profile is not None
    assert len(pump.piston.profile) == len(NET)


def test_a_block_with_angles(folder):
    rows = [[f"{place} mm", f"{angle} deg", "1 um"] for place in (26, 47) for angle in (0, 90)]
    with pytest.raises(InputFaults) as raised:
        load_pump(BENCH, {"block.profile": rows})
    (fault,) = raised.value.faults
    assert (fault.path, fault.found) == ("block.profile", "rows with angles")


def test_millimetres_for_micrometres_give_a_warning(folder):
    written(folder, zip(PLACES, -0.2 * worn(PLACES), strict=True), "place [mm],height [mm]\n")
    (warning,) = [one for one in check_pump(loaded()).warnings if one.path == "piston.profile"]
    assert warning.value.endswith("taken off at 0 mm")
    assert warning.limit == "100 um of wear"
    assert "um, not mm?" in warning.remedy
    written(folder, zip(PLACES, heights(PLACES), strict=True))
    assert not [one for one in check_pump(loaded()).warnings if one.path == "piston.profile"]


def test_a_key_below_a_value_of_the_file_is_not_lost(folder):
    """A table takes the place of rows; of a number it is a fault."""
    written(folder, "0,0\n45,0", name="plain.csv")
    file = _file(folder, resolved_toml(load_pump(BENCH, {"piston.profile": str(folder / "plain.csv")})))
    stated = {f"piston.profile.{key}": value for key, value in beside(TRACE).items()}
    assert load_pump(file, stated).piston.profile == loaded().piston.profile
    with pytest.raises(InputFaults, match=r"piston\.mass"):
        load_pump(file, {"piston.mass.value": "3 g"})


# Gap cases

CASE = """format = 1
[film]
gap = "piston"
pump = "{pump}"
shaft_angle = "270 deg"
[position]
eccentricity_ratio = 0.5
[pump.piston.profile]
trace = "worn.csv"
level = "line"
unworn = [["15 mm", "30 mm"]]
cutoff = "{cutoff}"
"""


def test_a_gap_case_has_a_trace_beside_it_and_a_warning_of_waves_within_a_cell(folder):
    """The trace's roughness is below the mesh; a cutoff of a cell takes it out."""
    rough = heights(PLACES) + 0.3 * np.random.default_rng(5).standard_normal(len(PLACES))
    written(folder, zip(PLACES, rough, strict=True))
    case = folder / "worn.toml"
    told = []
    for cutoff in ("0.2 mm", "3 mm"):
        case.write_text(CASE.format(pump=BENCH, cutoff=cutoff), "utf-8")
        told.append({one["name"]: one["text"] for one in film_warnings(solve_case(load_case(case)))})
    assert "of the rise of the piston's profile (limit " in told[0]["profile_not_resolved"]
    assert "use a longer cutoff" in told[0]["profile_not_resolved"]
    assert "profile_not_resolved" not in told[1]


def test_a_gap_case_tells_a_faulty_trace_by_its_key(folder):
    written(folder, "0,1\n0,1")
    case = folder / "worn.toml"
    case.write_text(CASE.format(pump=BENCH, cutoff="0.8 mm"), "utf-8")
    with pytest.raises(InputFaults) as raised:
        load_case(case)
    assert [fault.path for fault in raised.value.faults] == ["pump.piston.profile.trace"]
