"""The second plant of the proof: a pump of the same drawing, other code, other laws."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from dataclasses import fields, replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

BENCHMARKS = Path(__file__).resolve().parents[4] / "benchmarks"
RPM = 2.0 * np.pi / 60.0


@pytest.fixture(scope="module")
def plant(proof: SimpleNamespace) -> SimpleNamespace:
    """The plant's modules by their names."""
    names = ("chamber", "gaps", "hidden", "motion", "oil", "points", "pump", "rig")
    assert proof is not None
    return SimpleNamespace(**{name: import_module(f"proof.other.plant.{name}") for name in names})


@pytest.fixture
def coarse(plant: SimpleNamespace, monkeypatch: pytest.MonkeyPatch) -> None:
    """A turn of some 170 steps: enough where no number of it counts."""
    monkeypatch.setattr(plant.chamber, "FINE", 1.0)
    monkeypatch.setattr(plant.chamber, "COARSE", 5.0)


@pytest.fixture
def few(proof: SimpleNamespace) -> Iterator[str]:
    """A campaign of thirteen points, by its name."""
    whole = proof.campaigns.campaigns()["scattered"]
    points = replace(whole.points, **{name: value[::7] for name, value in vars(whole.points).items()})
    proof.campaigns.campaigns()["thirteen"] = replace(whole, name="thirteen", points=points)
    yield "thirteen"
    del proof.campaigns.campaigns()["thirteen"]


def _points(plant: SimpleNamespace) -> object:
    """10, 20 and 35 MPa at 2100 r/min, 80 % of the stroke, 50 degC."""
    one = np.ones(3)
    p_out = np.array([10.0e6, 20.0e6, 35.0e6])
    return plant.points.Points(2100.0 * RPM * one, 0.8 * one, p_out, 2.5e6 * one, 0.15e6 * one, 323.15 * one,
                               323.15 * one)  # fmt: skip


def test_drains_of_the_gaps_make_the_case_drain(plant: SimpleNamespace, coarse: None) -> None:
    """Pistons, slippers and plate leak what the case drains; an opening of the plate shows in its drain alone."""
    at = _points(plant)
    sound, opened = (
        plant.rig.run(plant.pump.Pump(), at, plant.hidden.Hidden(opening_plate=size)) for size in (0.0, 2e-8)
    )
    parts = [sound.Q_piston, sound.Q_slipper, sound.Q_valve_plate]
    assert all(np.all(part > 0.0) for part in parts)
    assert np.sum(parts, axis=0) == pytest.approx(sound.Q_case, rel=1e-12)
    assert np.all(opened.Q_valve_plate > 1.05 * sound.Q_valve_plate)
    assert opened.Q_slipper == pytest.approx(sound.Q_slipper, rel=5e-3)


@pytest.mark.parametrize("room", ["other", "rough"])
def test_a_plant_shares_nothing(room: str) -> None:
    """Neither a package of this project nor another plant: numpy, scipy, the standard library and its own files."""
    allowed = {"numpy", "scipy", *sys.stdlib_module_names}
    for path in (BENCHMARKS / "proof" / room / "plant").glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            names = [one.name for one in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom):
                assert node.level < 2, path.name
                names += [node.module or ""] if node.level == 0 else []
            assert {name.split(".")[0] for name in names} <= allowed, path.name


def test_the_drawing_is_that_of_the_pump(plant: SimpleNamespace) -> None:
    """Check values: displacement, largest speed, viscosity, leakage of rigid films at 35 MPa and 50 degC."""
    pump = plant.pump.Pump()
    move = plant.motion.motion(pump, np.ones(1), np.linspace(0.0, 2.0 * np.pi, 3601))
    assert pump.pistons * pump.area * np.ptp(move.travel) == pytest.approx(89.86e-6, rel=1e-4)
    assert np.abs(move.slope).max() * 2100.0 * RPM == pytest.approx(2.890, abs=5e-4)
    for rises, rate in ((move.travel[0], move.slope[0]), (move.slope[0], move.bend[0])):
        assert np.diff(rises) == pytest.approx(np.diff(move.angle) * 0.5 * (rate[1:] + rate[:-1]), abs=1e-10)
    kelvin = np.array([308.15, 323.15, 333.15, 348.15])
    walther = 860.0 * 1e-6 * (10.0**10.0 ** (9.4180 - 3.6844 * np.log10(kelvin)) - 0.7)
    assert pump.oil(0.0).thick(kelvin) == pytest.approx(walther, rel=0.01)
    films = plant.gaps.gaps(pump, plant.hidden.Hidden(), _points(plant))
    slipper = films.leak[1] / (1.0 + films.leak[1] * films.choked)
    leaks = 4.5 * 35.0e6 * 60e3 * np.array([slipper[2], films.leak[2][2]])
    assert leaks == pytest.approx([0.363, 0.155], rel=0.02)


def test_a_chamber_balances_and_converges(plant: SimpleNamespace, monkeypatch: pytest.MonkeyPatch) -> None:
    """Oil that is drawn is delivered or leaks; flow and work of half the steps differ by less than half of a sigma."""
    pump, at, nothing = plant.pump.Pump(), _points(plant), plant.hidden.Hidden()

    def turn() -> SimpleNamespace:
        move = plant.motion.motion(pump, at.ratio, plant.chamber.grid())
        return plant.chamber.march(pump, nothing, at, move, plant.gaps.gaps(pump, nothing, at))

    usual = turn()
    assert usual.drawn == pytest.approx(usual.delivered + usual.leaked, rel=2e-5)
    monkeypatch.setattr(plant.chamber, "FINE", 0.125)
    monkeypatch.setattr(plant.chamber, "COARSE", 1.0)
    fine = turn()
    assert usual.drawn == pytest.approx(fine.drawn, rel=3e-4)
    assert usual.work == pytest.approx(fine.work, rel=3e-4)


def test_a_starved_chamber_keeps_its_mass(plant: SimpleNamespace, coarse: None) -> None:
    """Behind a line that loses 50 kPa less comes in, and as much less goes out."""
    at = replace(_points(plant), ratio=np.ones(3), p_in=np.array([0.6e5, 0.8e5, 1.2e5]), speed=np.full(3, 230.0))
    oil = plant.pump.Pump().oil(0.0)
    starved = plant.rig.run(plant.pump.Pump(), at, plant.hidden.Hidden(suction=5e4))
    sound = plant.rig.run(plant.pump.Pump(), at)
    share = starved.Q_out / sound.Q_out
    assert share[0] < 0.95
    assert np.all(np.diff(share) > 0.0)
    left = oil.dense(at.p_in) * starved.Q_in - oil.dense(at.p_out) * starved.Q_out - 860.0 * starved.Q_case
    assert np.abs(left).max() < 0.01 * 860.0 * starved.Q_in.max()


MOVES = {  # signs of Q_out, Q_in, Q_case, torque; 0: not moved; None: not asked
    "viscosity_pressure": (1e-8, (1, None, -1, 1)), "opening_plate": (1e-8, (-1, None, 1, None)),
    "film_heating": (0.5, (-1, None, 1, -1)), "shear_thinning": (1e-4, (0, 0, 0, -1)),
    "mixed_friction": (0.05, (0, 0, 0, 1)), "squeeze": (5e-6, (0, 1, 1, 0)), "churning": (1.0, (0, 0, 0, 1)),
    "seal": (1.0, (0, 0, 0, 1)), "charge_pump": (1e-5, (0, 0, 0, 1)), "short_circuit": (1e-7, (-1, -1, 0, 0)),
    "cross_leak": (1e-15, (-1, -1, 0, 0)), "control_flow": (5e-6, (-1, 0, 1, 0)), "droop": (2e-3, (-1, -1, None, -1)),
    "throttling": (5e4, (0, 0, 0, 1)), "air": (0.01, (-1, None, None, None)), "compression": (0.3, (0, 0, 0, 1)),
    "resonance": (0.01, (1, 0, 0, 0)), "weeping": (1e-5, (None, 0, None, 0)), "pocketing": (1.0, (0, 0, 0, 1)),
}  # fmt: skip


@pytest.mark.parametrize("name", MOVES)
def test_each_effect_moves_what_its_sheet_says(plant: SimpleNamespace, coarse: None, name: str) -> None:
    """The expected sign of every reading, and none where the effect does not act."""
    size, signs = MOVES[name]
    pump, at = plant.pump.Pump(), _points(plant)
    runs = [plant.rig.run(pump, at, hidden) for hidden in (plant.hidden.Hidden(), plant.hidden.Hidden(**{name: size}))]
    for channel, sign in zip(("Q_out", "Q_in", "Q_case", "torque"), signs, strict=True):
        if sign is not None:
            assert np.all(np.sign(getattr(runs[1], channel) - getattr(runs[0], channel)) == sign), channel


def test_every_effect_has_a_law_and_a_case(proof: SimpleNamespace, plant: SimpleNamespace) -> None:
    """No field of Hidden is left out; every id of missing physics with a law but a block that tips has cases."""
    from system import EffectId, Kind, entry_of

    cases = import_module("proof.other.cases")
    listed = (*cases.EFFECTS, *cases.STARVED, *cases.WORN, *cases.UNLISTED)
    fields_listed = {one.label for one in listed}
    assert {one.name for one in fields(plant.hidden.Hidden)} - fields_listed <= {"thermal_piston", "thermal_plate"}
    physics = {
        one.value for one in EffectId
        if one is not EffectId.UNKNOWN_PHYSICS
        and entry_of(one).verdict is Kind.MISSING_PHYSICS
        and entry_of(one).extensions
    }  # fmt: skip
    assert physics - {one.id for one in listed} == {"block_tipping"}


def test_a_size_reaches_its_score(proof: SimpleNamespace, coarse: None, few: str) -> None:
    """The shift at the size found has the score asked for; a fault's score is that of its own channel."""
    cases, sizing = import_module("proof.other.cases"), import_module("proof.other.sizing")
    secrets = [next(one for one in cases.EFFECTS if one.label == "droop"), cases.FAULTS[0]]
    case = import_module("proof.wide.case").WideCase(proof.parts.Part.OTHER_SENSOR, few, 1, tuple(secrets), 6.0)
    factors, scores = sizing.sized(case)
    assert scores == pytest.approx([6.0, 6.0], rel=0.02)
    moved = sizing.shift(few, secrets[1:], factors[1:])
    assert np.all(moved[:, :3] == 0.0)
    assert moved[:, 3] == pytest.approx(factors[1] * secrets[1].size)


def test_readings_are_those_of_the_version(plant: SimpleNamespace) -> None:
    """Of a drawn machine with something concealed: where they differ, raise VERSION in benchmarks/proof/other."""
    assert import_module("proof.other").VERSION == 1
    concealed = plant.hidden.Hidden(opening_plate=1e-8, churning=1.0, mixed_friction=0.02)
    found = plant.rig.run(plant.pump.drawn(np.random.default_rng(3)), _points(plant), concealed)
    means = [60e3 * float(one.mean()) for one in (found.Q_out, found.Q_in, found.Q_case)]
    assert [*means, float(found.torque.mean())] == pytest.approx(MEANS, rel=1e-6)


MEANS = (144.4147958433683, 146.85315093099797, 0.6845784590623829, 246.44668162992696)
