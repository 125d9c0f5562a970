"""Values of the pump that a gap case states itself, in place of the pump file's."""

import numpy as np
import pytest

from reynolds.errors import FilmInputError
from swashfilm.__main__ import main
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.study import StudyCase, load_film
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary
from system import InputFaults

GAP = 'format = 1\n[film]\ngap = "piston"\npump = "ref90"\n'


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def loaded(here, text):
    path = here / "gap.toml"
    path.write_text(GAP + text, encoding="utf-8")
    return load_film(path)


def test_a_case_puts_its_values_in_place_of_the_pumps(here):
    case = loaded(here, '[pump.piston]\nradial_clearance = "20 um"\n[pump.ports]\ngroove_area = "2 mm2"\n')
    assert isinstance(case, GapCase)
    assert case.rotor.pump.piston.radial_clearance == 20e-6
    assert case.rotor.pump.ports.groove_area == 2e-6
    again = here / "again.toml"
    again.write_text(case.resolved, encoding="utf-8")
    resolved = load_film(again)
    assert isinstance(resolved, GapCase)
    assert resolved.rotor == case.rotor


def test_a_study_varies_a_value_of_the_pump(here):
    study = loaded(here, '[study]\n"pump.piston.radial_clearance" = ["15 um", "20 um"]\n')
    assert isinstance(study, StudyCase)
    found = [study.case(point).rotor.pump.piston.radial_clearance for point in study.points]
    assert found == [15e-6, 20e-6]


def test_faults_stand_at_the_cases_own_keys(here):
    with pytest.raises(InputFaults) as raised:
        loaded(here, '[pump.piston]\nradial_clearence = "20 um"\nmass = 3\n[operating]\nspeed = "3 kg"\n')
    faults = {fault.path: fault for fault in raised.value.faults}
    assert set(faults) == {"pump.piston.radial_clearence", "pump.piston.mass", "operating.speed"}
    assert faults["pump.piston.radial_clearence"].nearest == "radial_clearance"
    assert raised.value.lines["pump.piston.mass"] == 7
    with pytest.raises(InputFaults, match=r"pump\.operating"):
        loaded(here, '[pump.operating]\nspeed = "1000 rpm"\n')
    with pytest.raises(InputFaults, match=r'study\."pump\.piston\.radial_clearence"'):
        loaded(here, '[study]\n"pump.piston.radial_clearence" = ["15 um", "20 um"]\n')


def test_a_case_with_values_of_a_pump_is_no_pump_file(here, capsys):
    loaded(here, '[pump.piston]\nradial_clearance = "20 um"\n')
    assert main(["check", "gap.toml"]) == 0
    assert "[pump]\npiston.radial_clearance" in capsys.readouterr().out
    assert main(["run", "gap.toml"]) == 2
    assert "swashfilm film gap.toml" in capsys.readouterr().err


def test_films_of_a_case_solve_what_its_pump_states_of_them(here):
    """[physics] of the pump: stiffening by Barus where the film is held, by Roelands where it floats; heat over a turn
    alone."""
    stiff = '[pump.physics.viscosity_pressure]\ncoefficient = "20 1/GPa"\n'
    held = loaded(here, "[position]\neccentricity_ratio = 0.1\n" + stiff)
    floats = loaded(here, stiff)
    plain = loaded(here, "")
    assert not plain.physics.pressure_viscosity
    assert held.physics.pressure_viscosity
    assert floats.physics.pressure_viscosity
    thick = [case.parts.piston.laws.fluid.viscosity(35e6, 0.02)[0] for case in (held, floats)]
    above = 20e-9 * (35e6 - held.rotor.point.case_pressure)
    assert thick[0] == pytest.approx(0.02 * np.exp(above), rel=1e-9)
    assert thick[1] < thick[0]
    turn = here / "turn.toml"
    warm = '[pump.physics.film_heating]\npiston = "1e-4 m2 K/W"\n'
    turn.write_text(GAP.replace('"ref90"', '"ref90"\nrevolution = true') + '[revolution]\nheat = "none"\n' + warm)
    case = load_film(turn)
    assert case.options.physics.heat
    with pytest.raises(InputFaults, match=r"(?s)film_heating.*depends on the whole turn"):
        loaded(here, warm)


def test_clearances_change_from_the_temperature_of_the_pumps_own_file(here):
    """An [operating] of the case moves the film away from it, not the law's own temperature with it."""
    law = '[pump.physics.thermal_clearance.piston]\nrate = "0.01 1/K"\n'
    films = {}
    for celsius in (50, 70):
        case = loaded(here, f'{law}[operating]\ntemperature = "{celsius} degC"\n')
        assert isinstance(case, GapCase)
        films[celsius] = case.rotor.pump.piston.radial_clearance
    assert films[70] == pytest.approx(1.2 * films[50], rel=1e-9)  # ref90 states 50 degC


def test_walls_that_overlap_are_told_by_the_keys_of_the_case(here):
    path = here / "plate.toml"
    text = 'format = 1\n[film]\ngap = "valve_plate"\npump = "ref90"\n[position]\nfilm_thickness = "2 um"\n'
    path.write_text(text + '[physics]\nsurfaces = "smooth"\n', encoding="utf-8")
    with pytest.raises(FilmInputError, match=r"position\.film_thickness: a least gap of -.*walls apart: more film"):
        solve_case(load_film(path))


def test_values_that_the_pump_file_leaves_out_stay_with_the_result(here):
    text = '[pump]\ndisplacement = "60 cm3/rev"\npistons = 9\n[oil]\ngrade = "ISO VG 46"\n'
    (here / "scant.toml").write_text(text, encoding="utf-8")
    (here / "gap.toml").write_text(GAP.replace("ref90", "scant.toml"), encoding="utf-8")
    found = film_summary(solve_case(load_film(here / "gap.toml")))
    assert any(one.startswith("pump.piston_diameter") for one in found["assumptions"])
