"""Flow coefficients from files: the table on the plain orifice law."""

from __future__ import annotations

import pickle
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from system import Gap, load_pump, lumped_point, operating_point, resolved_toml
from system.effects.opening_tables import OpeningCase
from system.inputs.coefficients.flow_files import FlowCoefficients
from system.paper.points import PRESSURES, RATED, PaperFidelity, PaperWork, Place
from system.pump.ports.areas import FLOW_FROM, PORT_SIZE, as_array, orifice, orifice_coefficients
from system.pump.ports.flow_coefficients import (
    MOST_OPENINGS,
    PlainLaw,
    file_law,
    flow_scale,
    flow_table,
    port_table,
    with_factor,
)
from system.pump_file.file import pump_of_tables

LAW = PlainLaw(0.7, 12.0)
OIL = 860.0, 30e-6  # kg/m3, m2/s


def made(openings, reynolds, coefficient) -> FlowCoefficients:
    """Coefficients by a function of opening and Reynolds number."""
    grid = np.meshgrid(reynolds, openings)
    return FlowCoefficients(Path("made.csv"), "made", np.array(openings), grid[0], coefficient(grid[1], grid[0]))


def of_law(law: PlainLaw, openings=(1e-6, 1e-4)) -> FlowCoefficients:
    """The plain law as if it came from a file, with many rows."""
    numbers = np.geomspace(0.1, 1e5, 200)
    coefficient = np.exp(law.log_coefficient(np.log(numbers))[0])
    shape = len(openings), 1
    return FlowCoefficients(
        Path("made.csv"), "made", np.array(openings), np.tile(numbers * coefficient, shape), np.tile(coefficient, shape)
    )


def flow(coefficients, law, area, drops):
    """Volume flows and their slopes at pressure drops."""
    row = flow_table(coefficients, law).row
    scale = flow_scale(area, *OIL, row)
    way = orifice_coefficients(area, law.flow_coefficient, *OIL, law.critical_reynolds)
    return np.array([with_factor(*orifice(drop, *way), drop, scale, area, row) for drop in drops]).T


def test_the_plain_law_in_a_file_is_the_plain_law():
    drops = np.geomspace(1.0, 1e8, 60)
    way = orifice_coefficients(2e-5, LAW.flow_coefficient, *OIL, LAW.critical_reynolds)
    plain = np.array([orifice(drop, *way)[0] for drop in drops])
    assert flow(of_law(LAW), LAW, 2e-5, drops)[0] == pytest.approx(plain, rel=1e-3)


def test_a_table_of_ones_is_the_plain_law_to_the_last_digits():
    row = flow_table(of_law(LAW), LAW).row
    row[3 + MOST_OPENINGS :] = 0.0
    way = orifice_coefficients(2e-5, LAW.flow_coefficient, *OIL, LAW.critical_reynolds)
    for drop in (0.0, 1e-3, 1e3, -1e7):
        plain = orifice(drop, *way)
        assert with_factor(*plain, drop, flow_scale(2e-5, *OIL, row), 2e-5, row) == pytest.approx(plain, rel=1e-12)


def test_flow_meets_the_rows_of_its_file():
    coefficients = made([2e-6, 8e-6], [2.0, 10.0, 50.0, 300.0, 4000.0], lambda a, re: 0.75 * re / (re + 9.0))
    for k, area in enumerate(coefficients.opening):
        speed = coefficients.reynolds[k] * OIL[1] / np.sqrt(4.0 * area / np.pi)
        drops = 0.5 * OIL[0] * (speed / coefficients.flow_coefficient[k]) ** 2
        found = flow(coefficients, file_law(coefficients), area, drops)[0]
        assert found == pytest.approx(speed * area, rel=5e-3)


def test_flow_rises_with_the_drop_and_its_slope_is_that_of_its_differences():
    coefficients = made([2e-6, 8e-6], [2.0, 30.0, 300.0], lambda a, re: np.minimum(0.72, 0.2 * re**0.3))
    law, step = file_law(coefficients), 1e-4
    drops = np.geomspace(1.0, 1e8, 300)
    for area in (1e-6, 4e-6, 1e-4):
        found, slope = flow(coefficients, law, area, drops)
        assert np.all(np.diff(found) > 0.0)
        around = (
            flow(coefficients, law, area, drops * (1 + step))[0] - flow(coefficients, law, area, drops * (1 - step))[0]
        )
        assert np.median(np.abs(around / (2.0 * step * drops) / slope - 1.0)) < 1e-6
        assert np.max(np.abs(around / (2.0 * step * drops) / slope - 1.0)) < 1e-2


def test_flow_through_zero_is_even_and_laminar():
    coefficients = made([2e-6], [2.0, 30.0, 300.0], lambda a, re: 0.1 * re**0.3)
    law = file_law(coefficients)
    (forth, back, none), slopes = flow(coefficients, law, 2e-6, [1e-3, -1e-3, 0.0])
    assert forth == pytest.approx(-back, rel=1e-12)
    assert none == 0.0
    assert slopes == pytest.approx(forth / 1e-3, rel=1e-6)


def test_more_openings_than_fit_are_refused():
    with pytest.raises(ValueError, match="at most 12"):
        flow_table(made(np.linspace(1e-6, 9e-5, 13), [1.0, 2.0], lambda a, re: 0.1 * re**0.4), LAW)


def written(path: Path, rows) -> Path:
    lines = ["# source: a test", "opening [mm2], reynolds [1], flow_coefficient [1]"]
    path.write_text("\n".join([*lines, *(f"{a:.9g}, {re:.9g}, {cd:.9g}" for a, re, cd in rows)]) + "\n")
    return path


def law_rows(law: PlainLaw, factor=1.0):
    numbers = np.geomspace(0.3, 3e4, 60)
    coefficient = np.exp(law.log_coefficient(np.log(numbers))[0])
    return [(a, n * c * factor, c * factor) for a in (0.1, 200.0) for n, c in zip(numbers, coefficient, strict=True)]


def pump_with(file: Path | None, **stated):
    tables = tomllib.loads(resolved_toml(load_pump("ref90")))
    if file is not None:
        del tables["ports"]["flow_coefficient"], tables["ports"]["critical_reynolds"]
        tables["ports"]["coefficient_file"] = str(file)
    tables["ports"] |= stated
    return pump_of_tables("made", tables)


def test_a_pump_with_a_file_of_its_own_law_is_the_pump(tmp_path):
    plain = load_pump("ref90")
    law = PlainLaw(plain.ports.flow_coefficient, plain.ports.critical_reynolds)
    pump = pump_with(written(tmp_path / "own.csv", law_rows(law)))
    assert pump.ports.flow_coefficient == pytest.approx(law.flow_coefficient, rel=1e-6)
    assert pump.ports.critical_reynolds == pytest.approx(law.critical_reynolds, rel=1e-2)
    own, found = (lumped_point(one, operating_point(one)) for one in (plain, pump))
    assert found.bench.shaft_torque == pytest.approx(own.bench.shaft_torque, rel=1e-4)
    assert found.bench.delivery_flow == pytest.approx(own.bench.delivery_flow, rel=1e-4)
    assert found.cycle.pressure == pytest.approx(own.cycle.pressure, abs=2e-3 * np.max(own.cycle.pressure))


def drop_of_an_open_port(pump) -> float:
    """Chamber over delivery pressure a quarter turn after the outer dead centre, Pa."""
    point = lumped_point(pump, operating_point(pump))
    return float(point.cycle.pressure[3 * point.cycle.pressure.size // 4] - point.point.delivery_pressure)


def test_half_the_coefficient_by_file_is_four_times_the_drop(tmp_path):
    plain = load_pump("ref90")
    law = PlainLaw(plain.ports.flow_coefficient, plain.ports.critical_reynolds)
    half = pump_with(written(tmp_path / "half.csv", law_rows(law, 0.5)))
    drop = drop_of_an_open_port(plain)
    assert drop_of_an_open_port(half) == pytest.approx(4.0 * drop, rel=0.01)
    scaled = pump_with(tmp_path / "half.csv", flow_coefficient=law.flow_coefficient)
    assert drop_of_an_open_port(scaled) == pytest.approx(drop, rel=0.01)


def test_a_port_without_a_file_carries_no_table():
    port = load_pump("ref90")
    from system import port_openings

    for opening in port_openings(port):
        assert as_array(opening).shape == (PORT_SIZE,)
        assert not as_array(opening)[FLOW_FROM:].any()
        assert replace(opening).coefficients.numbers == ()


def test_a_resolved_pump_keeps_its_file(tmp_path):
    law = PlainLaw(0.65, 10.0)
    pump = pump_with(written(tmp_path / "own.csv", law_rows(law)))
    again = pump_of_tables("again", tomllib.loads(resolved_toml(pump)))
    assert again == pump
    assert hash(again) == hash(pump)
    written(tmp_path / "own.csv", law_rows(law, 0.9))
    other = pump_of_tables("other", tomllib.loads(resolved_toml(pump)))
    assert other != pump
    assert other.file_contents != pump.file_contents


def test_kept_results_know_the_content_of_a_file(tmp_path):
    """The same resolved pump file, other coefficients under its path: other points of the paper, other films."""
    read = []
    for factor in (1.0, 0.9):
        orifice_file = written(tmp_path / "bore.csv", law_rows(PlainLaw(0.65, 10.0), factor))
        tables = tomllib.loads(resolved_toml(load_pump("ref90")))
        tables["slipper"]["orifice_file"] = str(orifice_file)
        read.append(pump_of_tables("made", tables))
    assert resolved_toml(read[0]) == resolved_toml(read[1])
    place = Place(RATED, PRESSURES[-1], 1.0)
    assert len({PaperWork(pump, PaperFidelity.FIXED).key(place) for pump in read}) == 2
    assert len({OpeningCase(pump, Gap.SLIPPER).key(np.array([20e6])) for pump in read}) == 2


def test_a_loaded_pump_needs_its_file_no_more(tmp_path):
    """Tables are read with the pump: solved anywhere, with the file changed or gone, it gives the same numbers."""
    path = written(tmp_path / "own.csv", law_rows(PlainLaw(0.65, 10.0)))
    pump = pump_with(path)
    point = operating_point(pump)
    before = lumped_point(pump, point).cycle.pressure
    path.unlink()
    moved = pickle.loads(pickle.dumps(pump))
    assert moved == pump
    port_table.cache_clear()
    assert np.array_equal(lumped_point(moved, point).cycle.pressure, before)
