"""The proof's bench: sizes reach their score, readings have the noise they state, files are as documented."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from scipy import stats

from diagnosis import read_recording
from diagnosis.recording.model import reading_sigma
from system import ChannelName


@pytest.fixture(scope="module")
def small(proof: SimpleNamespace) -> Iterator[str]:
    """A campaign of few points, by its name."""
    whole = proof.campaigns.campaigns()["map"]
    points = replace(whole.points, **{name: value[::9] for name, value in vars(whole.points).items()})
    proof.campaigns.campaigns()["few"] = replace(whole, name="few", points=points, traces=(3,))
    yield "few"
    del proof.campaigns.campaigns()["few"]


def test_an_outcome_is_of_another_program_once_anything_that_made_it_changes(proof: SimpleNamespace) -> None:
    """All that a trial imports of the diagnosis and the simulation is counted, laws of the catalogue with it."""
    counted = proof.store.counted()
    tree = ast.parse(Path(proof.trial.__file__).read_text("utf-8"))
    taken = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and not node.level}
    assert {name for name in taken if name and name.split(".")[0] in proof.store.PACKAGES} <= counted
    assert {
        "diagnosis.checks.check",
        "system.effects.laws.film",
        "system.bench.simulator",
        "reynolds.laws.oil",
    } <= counted


def test_words_about_a_program_make_no_other_program(proof: SimpleNamespace, tmp_path: Path) -> None:
    """Comments, docstrings, layout and the order of a table's keys leave the digest; a value changes it."""
    module, table = tmp_path / "law.py", tmp_path / "limits.toml"

    def digest(code: str, values: str) -> str:
        module.write_text(code, encoding="utf-8")
        table.write_text(values, encoding="utf-8")
        return str(proof.store._digest([module, table]))

    plain = digest("def double(x):\n    return 2 * x\n\nLEAST = 1", "a = 1\nb = 2")
    told = digest(
        '"""A law."""\ndef double(x):\n    """Twice x."""\n    return 2 * x  # why\n\nLEAST = 1\n"""Why."""\n',
        "b = 2  # why\na = 1",
    )
    assert told == plain
    assert digest("def double(x):\n    return 3 * x\n\nLEAST = 1", "a = 1\nb = 2") != plain
    assert digest("def double(x):\n    return 2 * x\n\nLEAST = 2", "a = 1\nb = 2") != plain
    assert digest("def double(x):\n    return 2 * x\n\nLEAST = 1", "a = 1\nb = 3") != plain


def test_every_part_has_its_cases(proof: SimpleNamespace) -> None:
    """At least 200 nulls, 12 effects at five scores, pairs, parameters, sensors and what is in no catalogue."""
    cases: ModuleType = proof.cases
    found = {part: cases.cases(part, 52) for part in cases.Part}
    assert len(found[cases.Part.NULL]) >= 200
    graded = {(case.concealed[0].label, case.score) for case in found[cases.Part.GRADED]}
    assert len(graded) == 5 * len(cases.PHYSICS)
    assert len({one.id for one in cases.PHYSICS}) >= 12
    assert all(case.concealed[0].id == "" for case in found[cases.Part.UNKNOWN])
    for listed in found.values():
        assert len({case.seed for case in listed}) == len(listed)


@pytest.mark.parametrize("label", ["churning", "viscosity_pressure"])
def test_a_size_reaches_its_score(proof: SimpleNamespace, small: str, label: str) -> None:
    """The shift at the size found has the score asked for; a torque of its own (churning) goes with the size."""
    one = next(one for one in proof.cases.PHYSICS if one.label == label)
    case = proof.cases.Case(proof.cases.Part.GRADED, small, 1, (one,), 5.0)
    factors, scores = proof.recordings.sized(case)
    assert scores[0] == pytest.approx(5.0, rel=proof.sizing.NEAR)
    hidden = one.hidden.scaled(2.0 * factors[0])
    doubled = proof.sizing.z_of(small, proof.sizing.shift(small, hidden, (), proof.sizing.typical()))
    assert doubled == pytest.approx(2.0 * scores[0], rel=1e-6) if label == "churning" else doubled > 7.0


def test_what_a_tolerance_explains_has_a_small_score(proof: SimpleNamespace, small: str) -> None:
    """A shift of one tolerance in each of the plant's parts has a score below sqrt(their number): z^2 = sum of a^T
    A^T (S + A A^T)^-1 A a < |a|^2."""
    machine = proof.sizing.typical()
    changed = replace(machine, slipper_film=machine.slipper_film * 1.08, friction_piston=machine.friction_piston * 1.15)
    moved = proof.sizing.shift(small, proof.recordings.NOTHING, (), changed)
    assert proof.sizing.z_of(small, moved) < np.sqrt(2.0)


def test_readings_have_the_noise_they_state(proof: SimpleNamespace) -> None:
    """Unit variance but for 3 % of Student's t (variance 3), first-order memory."""
    rng = np.random.default_rng(3)
    noise = proof.sensors._noise(40000, rng)
    assert noise.var() == pytest.approx(0.97 + 0.03 * 3.0, rel=0.1)
    memory = np.mean(noise[1:] * noise[:-1]) / noise.var()
    assert memory == pytest.approx(0.97**2 * proof.sensors.MEMORY / noise.var(), abs=4.0 / np.sqrt(40000))
    beyond = 40000 * (0.97 * 2.0 * stats.norm.sf(4.0) + 0.03 * 2.0 * stats.t.sf(4.0, 3))
    assert np.sum(np.abs(noise) > 4.0) == pytest.approx(beyond, abs=4.0 * np.sqrt(beyond))  # 36; Gaussian: 3


def test_a_recording_is_read_as_it_was_written(proof: SimpleNamespace, small: str, tmp_path: Path) -> None:
    """Every channel with its sigma, every point, the trace; the same case gives the same recording."""
    case = proof.cases.Case(proof.cases.Part.NULL, small, 7)
    made, again = proof.recordings.make(case), proof.recordings.make(case)
    assert all(
        np.array_equal(made.readings.columns[name], again.readings.columns[name]) for name in made.readings.columns
    )
    proof.writing.write_recording(tmp_path, "few", made.readings, "closed")
    found = read_recording(tmp_path)
    assert found.steady.column(ChannelName.TORQUE) == pytest.approx(made.readings.columns["torque"])
    flow = found.channel(ChannelName.Q_OUT)
    assert flow is not None
    meter, reading = proof.sensors.METERS["Q_out"], found.steady.column(ChannelName.Q_OUT)
    stated = (meter.sigma + meter.relative * reading / meter.scale) * meter.scale
    assert reading_sigma(flow, reading) == pytest.approx(stated)
    assert (flow.gain_sigma, flow.zero_sigma) == pytest.approx((meter.gain, meter.zero * meter.scale))
    assert [trace.point for trace in found.traces] == [3]
