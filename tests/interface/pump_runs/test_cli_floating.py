"""`swashfilm run --fidelity floating`: what the command line may say of gaps that float."""

from dataclasses import replace

import pytest

from gaps import Effect
from swashfilm.__main__ import main
from swashfilm.case.gap.physics import effect_rows
from swashfilm.case.gap.switches import SWITCHES
from swashfilm.cli.app import build_parser
from swashfilm.console.floating_options import floating_faults, floating_options
from swashfilm.runs.pump.floating import HEAD, floating_rows
from system import FloatingOptions, load_pump

FLOATING = ["run", "ref90", "--fidelity", "floating"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ([*FLOATING, "--steps", "70"], ["--steps", "multiple of the 9 pistons", "72"]),
        ([*FLOATING, "--steps", "1"], ["--steps", "24 to 7200", "27"]),
        ([*FLOATING, "--steps", "many"], ["--steps", "'many'", "a whole multiple"]),
        ([*FLOATING, "--finer", "0"], ["--finer", "'0'", "0.25 to 8"]),
        ([*FLOATING, "--finer", "fine"], ["--finer", "'fine'", "a number"]),
        (["run", "ref90", "--fidelity", "fixed", "--finer", "1"], ["--finer", "--fidelity floating"]),
        ([*FLOATING, "--rgid"], ["--rgid", "unknown option", "--rigid"]),
        (["run", "--fidelity", "lumped", "--smooth", "--steps", "72"], ["2 faults", "--smooth", "--steps"]),
        (["run", "--fidelity", "lumped", "--refine", "2"], ["--refine", "--fidelity floating"]),
        ([*FLOATING, "--refine", "9"], ["--refine", "'9'", "2 to 4"]),
    ],
)
def test_bad_options_end_with_2_and_say_what_to_do(words, told, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    text = capsys.readouterr().err
    for word in told:
        assert word in text, text
    assert not list(tmp_path.iterdir())


def test_options_of_the_command_line():
    """All physics goes by switches, oil that stiffens with elastic walls; fewer steps keep as many films."""
    usual, pump = FloatingOptions(), load_pump("ref90")
    words = [*FLOATING, "--rigid", "--isothermal", "--smooth", "--no-cavitation", "--steps", "72", "--finer", "2"]
    given = build_parser().parse_args(words)
    assert floating_faults(given, pump, given.fidelity) == []
    found = floating_options(given, pump)
    assert found.physics.left_out == tuple(Effect)
    rigid = floating_options(build_parser().parse_args([*FLOATING, "--rigid"]), pump)
    assert rigid.physics.left_out == (Effect.PRESSURE_VISCOSITY, Effect.ELASTIC_WALLS)
    assert (found.steps, found.keep) == (72, usual.keep * 72 // usual.steps)
    assert found.piston_cells == tuple(4 * cells for cells in usual.piston_cells)
    assert floating_options(build_parser().parse_args(FLOATING), pump) == usual
    assert usual.physics.left_out == ()
    seven = replace(pump, pump=replace(pump.pump, pistons=7))
    assert floating_options(build_parser().parse_args(FLOATING), seven).steps == 357


def test_physics_is_told_with_its_switches_and_what_it_took():
    """A row an effect; a time stands at the effect that ends its leg; every switch is one of the command line."""
    rows = {row[2]: row for row in effect_rows(["heat", "roughness"], {"rigid": 3.0, "elastic": 40.0})}
    assert set(rows) == set(SWITCHES)
    assert rows["--rigid"][1:] == ("on", "--rigid", "40.0 s")
    assert rows["--smooth"][1:] == ("off", "--smooth", "3.0 s")
    assert rows["--isothermal"][1:] == ("off", "--isothermal", "")


def test_rows_of_gaps_say_that_piston_and_slipper_are_one_of_several():
    numbers = {
        "film_thickness_mean_m": 15e-6, "film_thickness_min_m": 1e-6, "film_thickness_min_at_deg": 298.0,
        "leakage_flow_m3_per_s": 1e-7, "friction_power_W": 37.6, "rubbing_power_W": 0.3, "contact_load_max_N": 5.0,
        "turns": 1, "largest_multiplier": 0.21,
    }  # fmt: skip
    rows = floating_rows({"gaps": dict.fromkeys(("piston", "slipper", "valve_plate"), numbers), "unlike": {}})
    assert [row[0] for row in rows] == ["one piston-cylinder", "one slipper-swash plate", "valve plate-cylinder"]
    assert dict(zip(HEAD, rows[0], strict=True))["turns solved; disturbance left after a turn"] == "1; 21 %"
