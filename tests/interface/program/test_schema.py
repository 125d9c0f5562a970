"""JSON Schemas of the files: every example holds to its own, and a wrong key does not."""

from __future__ import annotations

import copy
import json
import tomllib
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from swashfilm.cli.app import run_command
from swashfilm.console.schemas import SCHEMAS, schema_of
from system import load_pump, resolved_toml
from system.inputs.sections.fields import fields_of

ROOT = Path(__file__).parents[3]
FILES = {
    "case": [*ROOT.glob("examples/films/*.toml")],
    "optimise": [*ROOT.glob("examples/optimisations/*.toml")],
    "pump": [*ROOT.glob("system/description/pumps/*.toml"), *ROOT.glob("examples/pumps/*.toml")],
    "recording": [*ROOT.glob("examples/recordings/*/recording.toml")],
    "reference": [*ROOT.glob("examples/references/*.toml")],
    "transient": [*ROOT.glob("examples/transients/*.toml")],
}
VALIDATORS = {kind: Draft202012Validator(schema_of(kind)) for kind in SCHEMAS}
EVERY = [(kind, path) for kind, paths in FILES.items() for path in sorted(paths)]


def faults(kind, tables):
    return [f"{'.'.join(map(str, one.absolute_path))}: {one.message}" for one in VALIDATORS[kind].iter_errors(tables)]


@pytest.mark.parametrize("kind", SCHEMAS)
def test_the_command_prints_a_schema(kind, capsys):
    assert run_command(["schema", kind]) == 0
    schema = json.loads(capsys.readouterr().out)
    Draft202012Validator.check_schema(schema)
    assert schema["$schema"].endswith("2020-12/schema")


@pytest.mark.parametrize(
    ("kind", "path"), EVERY, ids=[f"{kind}-{path.parent.name}-{path.stem}" for kind, path in EVERY]
)
def test_every_example_holds_to_its_schema(kind, path):
    assert faults(kind, tomllib.loads(path.read_text("utf-8"))) == []


@pytest.mark.parametrize("kind", SCHEMAS)
def test_a_wrong_key_does_not(kind):
    tables = tomllib.loads(FILES[kind][0].read_text("utf-8"))
    for name, table in tables.items():
        if isinstance(table, dict):
            wrong = copy.deepcopy(tables)
            wrong[name]["no_such_key"] = True  # names of constants and boundaries are free, their values not
            assert faults(kind, wrong), name
    assert faults(kind, tables | {"no_such_table": {}})


def test_a_pump_file_is_held_to_quantities_choices_and_required_keys():
    tables = tomllib.loads(resolved_toml(load_pump("ref90")))
    assert faults("pump", tables) == []

    def with_value(table, key, value):
        wrong = copy.deepcopy(tables)
        wrong.setdefault(table, {})[key] = value
        return faults("pump", wrong)

    assert with_value("pump", "piston_diameter", 22)
    assert with_value("pump", "piston_diameter", "22")
    assert with_value("pump", "pistons", 2)
    assert with_value("retainer", "kind", "glue")
    assert with_value("oil", "grade", "ISO VG 46")  # beside the two viscosities
    assert not with_value("piston", "3", {"radial_clearance": "20 um"})
    del tables["piston"]["mass"]
    assert faults("pump", tables) == ["piston: 'mass' is a required property"]


MESH = 'mesh = { kind = "rectangle", size = ["1 mm", "1 mm"], cells = [2, 2] }'
FREE = f'format = 1\n[film]\n{MESH}\nthickness = "1 um"\n[boundary]\nleft = {{ pressure = "1 bar" }}\n'


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("thickness", "thikness"), ('"1 um"', "1e-6"), ("cells = [2, 2]", "cells = [2]"), ("cells = [2", "cells = [0"),
        ("rectangle", "circle"), ("{ pressure", "{ presure"), ('"1 bar"', "1e5"), ("size", "radius"),
        ("[boundary]", "[thermal]\nfixed_wall = 'cold'\nmoving_wall = 'adiabatic'\n[boundary]"),
        ("[boundary]", "[thermal]\nfixed_wall = { temperature = 300 }\nmoving_wall = 'adiabatic'\n[boundary]"),
        ("[boundary]", "[elastic.fixed]\nkind = 'half_space'\nyoungs_modulus = '1 GPa'\n[boundary]"),
        ("[boundary]", "[study]\ncombine = 'one'\n[boundary]"),
        ("[boundary]", "[study]\n'film.load' = { from = '1 N', to = '2 N' }\n[boundary]"),
    ],
)  # fmt: skip
def test_a_film_case_is_held_to_the_forms_of_its_tables(old, new):
    assert faults("case", tomllib.loads(FREE)) == []
    assert old in FREE
    assert faults("case", tomllib.loads(FREE.replace(old, new)))


GAP = 'format = 1\n[film]\ngap = "slipper"\npump = "ref90"\n'


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        (GAP, True), (GAP.replace("[film]\n", ""), True), (GAP + "revolution = true\n", True),
        (GAP + 'chamber_pressure = ["1 bar", "2 bar"]\n', True), (GAP + "chamber_pressure = 1\n", False),
        (GAP + 'revolution = true\nchamber_pressure = "cycle"\n', True), (GAP + "revolution = 1.5\n", False),
        (GAP + 'revolution = true\nchamber_pressure = [["0 deg", "1 bar"]]\n', True), (GAP.replace("slip", "z"), False),
        (GAP + 'revolution = true\nshaft_angle = "1 deg"\n', False), (GAP + 'shaft_angle = "1 deg"\n', True),
        (GAP + '[position]\nfilm_thickness = "1 um"\n', True), (GAP + "[position]\neccentricity_ratio = 0.5\n", True),
        (GAP + '[load]\nforce = ["1 N", "2 N"]\n', True), (GAP + '[load]\nforce = ["1 N"]\n', False),
    ],
)  # fmt: skip
def test_a_gap_case_is_one_at_an_instant_or_over_the_revolution(text, holds):
    assert (faults("case", tomllib.loads(text)) == []) is holds


def test_a_recording_is_held_to_units_channels_and_one_table_of_points():
    from examples.uci_hydraulic.rig import FORM

    tables = tomllib.loads(FORM.format(leak=0, cooler=100))
    assert faults("recording", tables) == []
    torque = {"column": "M", "unit": "N m"}

    def with_channel(**wrong):
        return faults("recording", tables | {"channel": {"torque": torque | wrong}})

    assert not with_channel(calibration={"zero": "0.1 N m"})
    assert with_channel(calibration={"zero": 0.1})
    assert with_channel(sigma="0.1")
    assert with_channel(reference="gauge")  # of pressures only
    assert faults("recording", tables | {"channel": {"torque": {"column": "M"}}})
    assert faults("recording", tables | {"channel": {}})
    time = {"column": "t", "unit": "s"}
    assert faults("recording", tables | {"steady": {"file": "a"}, "series": {"file": "a", "time": time}})


def test_comments_of_fields_are_descriptions():
    from system import PumpSection

    assert fields_of(PumpSection)["pitch_radius"].meaning == "of the ball centres at zero swash angle"
