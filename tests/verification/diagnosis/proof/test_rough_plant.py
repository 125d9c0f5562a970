"""The third plant of the proof: pumps known by their type plate, run through rough campaigns."""

from __future__ import annotations

from dataclasses import fields, replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from diagnosis import read_recording
from system import ChannelName


@pytest.fixture(scope="module")
def rough(proof: SimpleNamespace) -> SimpleNamespace:
    """Modules of the third plant by their names, and a pump on its bench."""
    assert proof is not None
    plant = {one: import_module(f"proof.rough.plant.{one}") for one in ("course", "hidden", "meters", "model", "pump")}
    own = {one: import_module(f"proof.rough.{one}") for one in ("cases", "recordings", "sizing")}
    case = import_module("proof.wide.case")
    return SimpleNamespace(**plant, **own, WideCase=case.WideCase, Part=proof.parts.Part)


def _bench(rough: SimpleNamespace, kind: str, seed: int = 5) -> object:
    rng = np.random.default_rng(seed)
    pump = rough.pump.drawn(rng)
    run = rough.course.course(pump, kind, rng)
    truth = rough.model.flows(pump, run.state)
    return rough.sizing.Bench(pump, run, rough.meters.drawn_meters(pump, run, truth, True, rng))


def test_pumps_are_of_any_size(rough: SimpleNamespace) -> None:
    """5 to 11 pistons, 10 to 250 cm3, 1.5 to 5 % of leakage at 24 MPa and 40 degC, the large ones slow."""
    rng = np.random.default_rng(1)
    pumps = [rough.pump.drawn(rng) for _ in range(200)]
    assert {one.pistons for one in pumps} == {5, 7, 9, 11}
    assert all(9.9e-6 <= one.plate <= 251e-6 for one in pumps)
    assert max(one.plate for one in pumps) > 6.0 * min(one.plate for one in pumps)
    assert all(one.speed * one.plate ** (1.0 / 3.0) < 9.0 for one in pumps)
    thick = pumps[0].thick(np.array([40.0, 100.0])) / pumps[0].density / pumps[0].viscosity
    cold, hot = rough.pump.GRADES[pumps[0].grade]
    own = np.exp(pumps[0].slope * np.array([0.0, 60.0]))
    assert thick == pytest.approx(1e-6 * np.array([cold, hot]) * own, rel=1e-9)


def test_flow_and_torque_balance(rough: SimpleNamespace) -> None:
    """Compression and leakage, squeezed too, take what is not delivered; torque is the ideal one and usual friction."""
    bench = _bench(rough, "triangles")
    pump, state = bench.pump, bench.course.state
    found = rough.model.flows(pump, state)
    swept = pump.displacement * state.speed / (2.0 * np.pi)
    drawn = pump.leak * pump.displacement * state.around / (2.0 * np.pi * pump.thick(state.case))
    dense = 1.0 - state.pressure / pump.modulus
    lost = (swept - found.Q_out - (found.Q_case + drawn) * dense) / swept
    assert lost == pytest.approx((1.0 + pump.dead) * state.pressure / pump.modulus, rel=1e-9)
    ideal = pump.displacement * state.pressure / (2.0 * np.pi)
    assert np.all(found.torque > ideal)
    loaded_and_warm = (state.pressure > 15.0e6) & (state.case > 40.0)
    assert np.all(found.torque[loaded_and_warm] < 1.25 * ideal[loaded_and_warm])


@pytest.mark.parametrize("kind", ["stairs", "ramps", "triangles", "sweep", "speeds"])
def test_courses_go_over_the_map(rough: SimpleNamespace, kind: str) -> None:
    """4,000 to 8,000 samples from some 20 bar to 200 at least, the oil 15 K warmer in the end."""
    state = _bench(rough, kind).course.state
    assert 4000 <= state.pressure.size <= 8000
    assert state.pressure.min() < 2.2e6
    assert state.pressure.max() > 19.0e6
    assert state.inlet[-100:].mean() > state.inlet[:100].mean() + 10.0
    assert (np.ptp(state.speed) > 0.4 * state.speed.max()) == (kind == "speeds")


MOVES = {  # signs of Q_out, Q_case, torque at high pressure
    "opening": (0.1, (-1, 1, 0)), "thickening": (0.2, (1, -1, 0)), "heating": (3.0, (-1, 1, -1)),
    "control": (0.002, (-1, 1, 0)), "short_circuit": (0.002, (-1, 0, 0)), "cross_leak": (0.002, (-1, 0, 0)),
    "squeeze": (0.001, (0, 1, 0)), "droop": (0.01, (-1, 0, -1)), "mixed": (0.02, (0, 0, 1)),
    "compression": (0.2, (0, 0, 1)), "churning": (0.2, (0, 0, 1)), "weeping": (0.01, (-1, 1, 0)),
    "swelling": (0.01, (None, 0, 0)), "softening": (0.005, (None, 0, 0)), "creeping": (0.1, (0, 0, 1)),
    "clearance": (0.005, (None, None, 0)),
}  # fmt: skip


def test_every_effect_is_tried(rough: SimpleNamespace) -> None:
    """Signs are asked of every field, and every field has a case."""
    names = {one.name for one in fields(rough.hidden.Hidden)}
    assert names == set(MOVES)
    assert names == {one.label for one in (*rough.cases.EFFECTS, *rough.cases.UNLISTED)}


@pytest.mark.parametrize("name", MOVES)
def test_each_effect_moves_what_its_sheet_says(rough: SimpleNamespace, name: str) -> None:
    """The expected sign of every reading, to rounding; none where the effect does not act."""
    bench = _bench(rough, "stairs")
    high = bench.course.state.pressure > 19.0e6
    size, signs = MOVES[name]
    nothing = rough.model.flows(bench.pump, bench.course.state)
    found = rough.model.flows(bench.pump, bench.course.state, rough.hidden.Hidden(**{name: size}))
    for channel, sign in zip(("Q_out", "Q_case", "torque"), signs, strict=True):
        before, after = getattr(nothing, channel)[high], getattr(found, channel)[high]
        moved = np.where(np.abs(after - before) > 1e-12 * np.abs(before), np.sign(after - before), 0.0)
        if sign is not None:
            assert np.all(moved == sign), channel


def test_meters_read_with_lag_band_and_memory(rough: SimpleNamespace) -> None:
    """A lagging meter is behind a ramp by its lag; none reads less than its band; noise has its memory."""
    meter = rough.meters.Meter("x", "L/min", 1.0, 1e-9, 1.0, 6, lag=4.0, band=20.0)
    ramp = np.arange(300.0)
    rng = np.random.default_rng(2)
    found = rough.meters._reading(meter, ramp, np.zeros(300), rng)
    assert found[100:] == pytest.approx(ramp[100:] - 3.52, abs=0.05)  # 1/(e^(1/4) - 1)
    assert found.min() == 20.0
    noise = rough.meters._noise(40000, replace(meter, memory=3.0), rng)
    assert np.mean(noise[1:] * noise[:-1]) / noise.var() == pytest.approx(0.99**2 * np.exp(-1.0 / 3.0), abs=0.04)
    assert rough.meters._noise(200000, replace(meter, slow=100.0), rng).var() == pytest.approx(1.18, abs=0.06)


def test_a_size_reaches_its_score(rough: SimpleNamespace) -> None:
    """An opening of score 8; what the type plate leaves open has less than one sigma each."""
    bench, sizing = _bench(rough, "ramps"), rough.sizing
    case = rough.WideCase(rough.Part.ROUGH_EFFECT, "ramps", 5, rough.cases.EFFECTS[:1], 8.0)
    factors, scores, strength = sizing.sized(case, bench)
    assert scores == pytest.approx([8.0], rel=0.02)
    assert 0.0 < factors[0] <= case.secrets[0].most
    assert max(strength, key=lambda name: strength[name]) == "Q_case"
    white = sizing.whitening_of(bench, sizing.noise(bench))
    leaky = replace(bench.pump, leak=1.01 * bench.pump.leak)
    moved = bench.means(leaky, bench.course.state) - bench.means(bench.pump, bench.course.state)
    assert white.z(moved) < 0.01 / 0.7 * 1.001


def test_a_recording_is_read_as_it_was_written(rough: SimpleNamespace, tmp_path: Path) -> None:
    """Every row, with decimal commas too; the same case gives the same files."""
    seeds = iter(range(40))
    case = next(
        one for one in (rough.WideCase(rough.Part.ROUGH_NULL, "ramps", seed) for seed in seeds)
        if rough.recordings.recorded(one)[0].commas
    )  # fmt: skip
    found, told = rough.recordings.recorded(case)
    assert told.truth == "no_mismatch"
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        rough.recordings.make(case).write(tmp_path / name)
    files = [(tmp_path / name / "data.csv").read_bytes() for name in ("one", "other")]
    assert files[0] == files[1]
    rows = files[0].decode().replace(",", ".").replace(";", ",").splitlines()
    cells = np.array([[float(cell) for cell in row.split(",")] for row in rows[1:]])
    assert cells[:, 1:] == pytest.approx(np.column_stack(list(found.columns.values())))
    few = "\n".join(files[0].decode().splitlines()[:200])
    (tmp_path / "one" / "data.csv").write_text(few, encoding="utf-8")
    recording = read_recording(tmp_path / "one")
    assert recording.channel(ChannelName.Q_CASE) is not None
    assert np.nanmax(recording.steady.column(ChannelName.P_OUT)) > 3.0e6


def test_readings_are_those_of_the_version(rough: SimpleNamespace) -> None:
    """Means of a recording with something concealed: where they differ, raise VERSION in benchmarks/proof/rough."""
    case = rough.WideCase(rough.Part.ROUGH_EFFECT, "sweep", 3, rough.cases.EFFECTS[2:3], 8.0)
    found, told = rough.recordings.recorded(case)
    assert import_module("proof.rough").VERSION == 3
    assert told.effects == ("control_flow",)
    means = [float(found.columns[name].mean()) for name in ("p_out", "Q_out", "Q_case")]
    assert means == pytest.approx(MEANS, rel=1e-5)


MEANS = (127.33221045978829, 12.241633591404645, 0.37391404645283616)
