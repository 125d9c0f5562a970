"""Detecting and locating on recordings of the bench."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from bench_pump import BENCH

from diagnosis import NoteKind, Recording, Study, load_thresholds, prepare, read_recording
from diagnosis.checks.check import too_rough, understated
from diagnosis.detect.mismatch import detect
from diagnosis.study.prepare import meter_parameters
from diagnosis.study.traces.misfits import port_events
from diagnosis.verdict.locate import locate
from reynolds import Array, InputError
from system import ChannelName, load_pump, tolerances
from system.bench.outputs import shear_torques

LIMITS = load_thresholds()
Q = ChannelName.Q_CASE
RECORDINGS = Path(__file__).parents[4] / "examples" / "recordings"
PUMP = load_pump(BENCH)


def _every(recording: Recording, step: int) -> Recording:
    """Every step-th point, without traces."""
    steady = recording.steady.at(slice(None, None, step))
    return replace(recording, steady=steady, traces=())


def _study(name: str, step: int = 1) -> Study:
    recording = read_recording(RECORDINGS / name)
    picked = recording if step == 1 else _every(recording, step)
    return prepare(PUMP, picked, tolerances(PUMP)[0], LIMITS)


@pytest.mark.slow
def test_a_bench_without_mismatch_has_none() -> None:
    """chi-square per reading 1 within 4 sigma of its scatter, no candidate, no place."""
    study = _study("open-01")
    found, place = detect(study, LIMITS), locate(study, LIMITS)
    assert abs(found.chi2_per_dof - 1.0) < 4 * np.sqrt(2.0 / study.base.residual.size)
    assert found.chance > 0.05
    assert place.tie == ()
    assert place.time is None
    assert place.angle is None


def test_a_short_circuit_lies_in_the_cross_flow() -> None:
    """Every third point of a recorded map: the first candidate, its channels, its component."""
    study = _study("open-06", step=3)
    found, place = detect(study, LIMITS), locate(study, LIMITS)
    assert found.chance < LIMITS.mismatch.chance
    assert found.strongest[0][0].entry.id.value in ("port_short_circuit", "laminar_cross_leak")
    assert set(place.channels) == {ChannelName.Q_OUT, ChannelName.Q_IN}
    assert place.components[0][0].value == "cross_flow"


def _with_sigmas(recording: Recording, share: float) -> Recording:
    """The recording with a share of the repeatability of every channel."""
    stated = [replace(one, sigma=share * one.sigma, sigma_relative=share * one.sigma_relative)
              for one in recording.channels]  # fmt: skip
    return replace(recording, channels=tuple(stated))


@pytest.mark.parametrize(("name", "share", "told"), [("open-01", 1.0, False), ("open-06", 1.0, False),
                                                     ("open-01", 0.5, True), ("open-06", 0.2, True)])  # fmt: skip
def test_of_a_repeatability_stated_too_small_the_scatter_is_used(name: str, share: float, told: bool) -> None:
    """Noise of twice the stated sigma in every channel was once, very surely, an effect that no catalogue has."""
    recording = _with_sigmas(replace(read_recording(RECORDINGS / name), traces=()), share)
    study = prepare(PUMP, recording, tolerances(PUMP)[0], LIMITS, ())
    texts = [note.text for note in study.recording.notes if "this scatter is used" in note.text]
    assert bool(texts) is told
    assert not told or "Q_out" in texts[0]
    right = prepare(PUMP, _with_sigmas(recording, 1.0 / share), tolerances(PUMP)[0], LIMITS, ())
    ratio = np.nanmedian(study.observations.sigma / right.observations.sigma, axis=0)
    assert ratio == pytest.approx(1.0, abs=0.5)


def test_of_one_channel_the_scatter_is_a_warning_alone() -> None:
    """An effect without a smooth course may be in one channel; in all of them none is."""
    sigma = {Q: 0.01 / 6e4, ChannelName.TORQUE: 0.2, ChannelName.Q_OUT: 0.1 / 6e4}
    assert list(too_rough({Q: 1.9, ChannelName.TORQUE: 1.0, ChannelName.Q_OUT: 1.9}, sigma)) == []
    assert list(too_rough({}, sigma)) == []
    alone = {Q: 2.0}
    some = {Q: 4.0, ChannelName.TORQUE: 1.0, ChannelName.Q_OUT: 1.9}
    every = {Q: 3.0, ChannelName.TORQUE: 1.6, ChannelName.Q_OUT: 2.0}
    assert [understated(one) for one in (alone, some, every)] == [False, False, True]
    (one,), (beside,), (all_of_them,) = (too_rough(each, sigma) for each in (alone, some, every))
    assert {each.kind for each in (one, beside, all_of_them)} == {NoteKind.WARNED}
    assert "Q_case 3.0 times (0.03 L/min), torque 1.6 times (0.32 N m), Q_out 2.0 times (0.2 L/min); this scatter" in (
        all_of_them.text
    )
    assert "inputs: Q_case 4.0 times (0.04 L/min); state" in beside.text


def test_a_recording_without_simulated_outputs_is_refused() -> None:
    recording = read_recording(RECORDINGS / "open-01")
    bare = replace(recording, channels=tuple(one for one in recording.channels if one.name is ChannelName.SPEED))
    with pytest.raises(InputError, match="Q_case"):
        prepare(PUMP, bare, tolerances(PUMP)[0], LIMITS)


@pytest.mark.parametrize(("stated", "lag", "sigma"), [(0.0, 25.0, 20.0), (10.0, 10.0, 3.0)])
def test_the_cases_thermometer_lags_where_its_oil_warms(stated: float, lag: float, sigma: float) -> None:
    """By the prior where no lag is stated; points at rest have no such parameter."""
    still = read_recording(RECORDINGS / "open-01")
    steady = replace(still.steady, warming=np.full(len(still.steady.values), 0.01))
    channels = tuple(replace(one, lag=stated) if one.name is ChannelName.T_CASE else one for one in still.channels)
    at_rest, warming = (
        {one.name: one for one in meter_parameters(each, (ChannelName.Q_CASE,))}
        for each in (still, replace(still, steady=steady, channels=channels))
    )
    assert set(warming) - set(at_rest) == {"T_case.lag"}
    assert (warming["T_case.lag"].centre, warming["T_case.lag"].spread) == pytest.approx((lag, sigma))


def test_a_lag_that_no_reading_feels_keeps_that_of_its_prior() -> None:
    """Without the parameter the bench would have a thermometer without lag."""
    recording = _every(read_recording(RECORDINGS / "open-01"), 6)
    steady = replace(recording.steady, warming=np.full(len(recording.steady.values), 1e-7))
    study = prepare(PUMP, replace(recording, steady=steady), tolerances(PUMP)[0], LIMITS)
    values = dict(zip((one.name for one in study.simulator.parameters), study.base.values, strict=True))
    assert values["T_case.lag"] == pytest.approx(25.0, abs=0.1)


def test_ports_tell_their_events_in_order() -> None:
    events = port_events(PUMP)
    angles = [event.angle for event in events]
    assert angles == sorted(angles)
    assert {"outer dead centre", "delivery groove begins to open", "suction kidney is shut"} <= {
        event.text for event in events
    }


@pytest.mark.parametrize("limit", ["recovered", "sheared"])
def test_torque_that_no_type_plate_tells_is_uncertain_where_that_is_all_that_is_known(limit: str) -> None:
    """Torque may be off by what ports give back or films shear, and no other channel is by that.

    Within one sigma: a quarter of z V_d dp^2/(2 K) over a turn, half of what the film that shears most takes. The
    strain of such a pattern, min |w - R b|^2 + |b|^2 with w and departures R in sigma: nearly one where the pattern is
    among the departures, several without it. A pump in full has no departures.
    """
    recording = _every(read_recording(RECORDINGS / "open-01"), 4)

    def departures(share: float, scant: bool = True) -> tuple[Study, Array]:
        alone = replace(LIMITS.form, recovered=0.0, sheared=0.0)
        limits = replace(LIMITS, form=replace(alone, **{limit: share}))
        study = prepare(PUMP, recording, tolerances(PUMP)[0], limits, scant=scant)
        names = tuple(one.name for one in study.simulator.parameters if one.name.startswith("form."))
        return study, study.simulator.slopes(study.base.values, names)

    def pattern(study: Study) -> Array:
        if limit == "sheared":
            sheared = shear_torques(study.simulator.solved(study.base.values))
            return 0.5 * sheared[:, np.argmax(sheared.mean(axis=0))]
        column = recording.steady.column
        across, pump = column(ChannelName.P_OUT) - column(ChannelName.P_IN), PUMP.pump
        return 0.25 * pump.pistons * pump.dead_volume * across**2 / (2.0 * PUMP.oil.bulk_modulus) / (2.0 * np.pi)

    def strain(share: float) -> float:
        study, columns = departures(share)
        wanted, sigma = np.zeros(columns.shape[:2]), study.observations.sigma
        wanted[:, study.channels.index(ChannelName.TORQUE)] = pattern(study)
        rows = (columns / sigma[..., None]).reshape(-1, columns.shape[-1])
        white = (wanted / sigma).ravel()
        sizes = np.linalg.solve(rows.T @ rows + np.eye(rows.shape[1]), rows.T @ white)
        return float(white @ (white - rows @ sizes))

    usual = getattr(LIMITS.form, limit)
    assert 0.6 < strain(usual) < 1.05
    assert strain(0.0) > 3.0
    assert departures(usual, scant=False)[1].shape[-1] == 0
