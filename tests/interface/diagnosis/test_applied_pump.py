"""The pump file of a finding: its name, origin, tolerances, and what each fidelity does with its effects."""

from dataclasses import replace
from datetime import date

from made_diagnosis import its_study, named_diagnosis

from diagnosis import DiagnosisResult
from diagnosis.procedure.compared import NO_COMPARISON
from swashfilm.runs.diagnose.applied import applied_toml
from system import entry_of, extended_pump, load_pump
from system.effects.effect import EffectId

PUMP = load_pump("ref90")
NAMED = named_diagnosis()
DAY = date(2026, 11, 23)
VALUES = {"churning.factor": 0.8, "viscosity_pressure.coefficient": 1.5e-8}


def _with(*effects: EffectId):
    return extended_pump(PUMP, VALUES, [entry_of(effect).extensions[0] for effect in effects])


def _applied(pump, title="bench 7\nmap"):
    study = its_study(NAMED)
    study = replace(study, recording=replace(study.recording, title=title))
    found = DiagnosisResult(PUMP, study, NAMED, (), pump, NO_COMPARISON)
    return applied_toml(found, pump, DAY)


def test_the_file_has_its_origin_and_loads_to_the_pump_under_a_name_of_its_own(tmp_path):
    path, pump = tmp_path / "found.toml", _with(EffectId.CHURNING)
    path.write_text(_applied(pump), "utf-8")
    head = path.read_text("utf-8").splitlines()
    assert head[0] == "# ref90 as fitted to the recording 'bench 7 map', 28 points, on 2026-11-23."
    claim = NAMED.effects[0]
    assert any(f"{claim.effect.value} of the" in line and "+-" in line for line in head[1:5])
    assert load_pump(path) == replace(pump, name="ref90, fitted to bench 7 map")


def test_each_fidelity_is_named_with_what_it_does_of_the_effects():
    whole = _applied(_with(EffectId.CHURNING, EffectId.VISCOSITY_PRESSURE))
    assert "fixed solves viscosity_pressure in the films" in whole
    assert "fixed has churning as closed-form laws" in whole
    assert "floating solves viscosity_pressure in the films" in whole
    assert "floating has churning as closed-form laws" in whole
    lifted = _applied(
        extended_pump(PUMP, {"slipper_lift.ride_height": 5e-5}, entry_of(EffectId.SLIPPER_LIFT).extensions)
    )
    assert "fixed has slipper_lift as closed-form laws" in lifted
    assert "floating solves slipper_lift in the films" in lifted
    assert "It runs in every fidelity" in _applied(PUMP)


def test_a_table_is_named_for_chambers_that_are_alike_alone():
    """A response table has the films of one kind of chamber: the fidelity refuses a pump of several."""
    heated = _with(EffectId.VISCOSITY_PRESSURE)
    worn = replace(heated, single_pistons=((3, replace(heated.piston, radial_clearance=20e-6)),))
    assert "--fidelity table has" in _applied(heated)
    told = _applied(worn)
    assert "Its chambers differ" in told
    assert "--fidelity table" not in told
