"""The request where no point of the recorded range settles two explanations: another range, a gap's leak."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import diagnosis.procedure.next_test as ask
from diagnosis import BenchBox, Circuit, RecordedChannel, Recording, SteadyTable, load_thresholds
from diagnosis.next_point.forecast import Contender
from diagnosis.next_point.operating_box import ordinary_box, rig_box
from diagnosis.procedure.gap_leak_test import LEAKS, gap_leak_test
from reynolds import Array, NotConverged
from system import BenchPoints, ChannelName, Component, EffectId, Gap, Parameter, Role, Scale, load_pump

BAR, LPM, RPM = 1e5, 1.0 / 60000.0, 2.0 * np.pi / 60.0
METER = 0.02 * LPM
LIMITS = load_thresholds().next_point
BOX = BenchBox(((100.0, 200.0), (50 * BAR, 350 * BAR), (0.3, 1.0), (320.0, 324.0)), 25 * BAR, 1 * BAR, 2.0, (9.0, 1.0))


@dataclass(frozen=True)
class Gaps:
    """Three leaks that grow with pressure, shares of 1 L/min at 350 bar: the drain sees their sum alone."""

    shares: tuple[float, float, float]
    points: BenchPoints
    parameters: tuple[Parameter, ...]

    def elsewhere(self, points: BenchPoints) -> Gaps:
        return replace(self, points=points)

    def components(self, values: Array) -> dict[Component, Array]:
        level = self.points.p_out / (350 * BAR) * LPM
        return {
            part: (share * value * level)[:, None]
            for part, share, value in zip(LEAKS.values(), self.shares, values, strict=True)
        }


def _contender(shares: tuple[float, float, float], known: float) -> Contender:
    """Films whose leaks are known to a share `known`."""
    parameters = tuple(
        Parameter(gap.value, Role.BASE, Scale.NORMAL, 1.0, known, 0.0, 2.0, None, "test") for gap in LEAKS
    )
    posterior: Any = SimpleNamespace(xi=np.zeros(3), covariance=np.eye(3))
    simulator: Any = Gaps(shares, BOX.points(tuple(np.array([end[0]]) for end in BOX.ends)), parameters)
    return Contender((EffectId.ELASTIC_OPENING,), simulator, posterior, "", 0.5)


def _study(channels: tuple[ChannelName, ...]) -> Any:
    drain = RecordedChannel(ChannelName.Q_CASE, "", "", METER, 0.0, 0.0, 0.0, 0.0, 0.0, ())
    recording = SimpleNamespace(channel=lambda name: drain if name in channels else None)
    return SimpleNamespace(recording=recording, channels=channels)


def test_the_gap_whose_leak_parts_two_is_told_with_numbers() -> None:
    """Slipper .5 against .2 L/min in one sum: its leak is asked for at the highest pressure, with both values."""
    known = [_contender(shares, 0.05) for shares in ((0.2, 0.5, 0.2), (0.45, 0.2, 0.25))]
    found = gap_leak_test(_study((ChannelName.Q_CASE,)), BOX, *known, LIMITS)
    assert found is not None
    assert found.gap is Gap.SLIPPER
    assert found.leaks == pytest.approx((0.5 * LPM, 0.2 * LPM))
    assert found.sigma == pytest.approx(METER + 0.01 * 0.5 * LPM)
    variance = [found.sigma**2 / 3 + (0.05 * leak) ** 2 for leak in found.leaks]
    gain = [
        0.5 * (own / other - 1.0 + (0.3 * LPM) ** 2 / other + np.log(other / own))
        for own, other in (variance, variance[::-1])
    ]
    assert found.gain == pytest.approx(min(gain), rel=1e-9)
    for part in ("the leakage of the slippers by itself", "350 bar", "0.5 L/min", "0.2 L/min"):
        assert part in found.text


def test_a_leak_that_is_known_too_badly_is_not_asked_for() -> None:
    """Films known to half of their leak: no reading of one leak settles anything; nor where no meter is."""
    known = [_contender(shares, 0.5) for shares in ((0.2, 0.3, 0.2), (0.3, 0.2, 0.2))]
    assert gap_leak_test(_study((ChannelName.Q_CASE,)), BOX, *known, LIMITS) is None
    assert gap_leak_test(_study((ChannelName.TORQUE,)), BOX, *known, LIMITS) is None


def _recording(ratio: Array) -> Recording:
    columns = {
        ChannelName.SPEED: np.linspace(1000 * RPM, 1500 * RPM, 8), ChannelName.P_OUT: np.linspace(1e7, 2e7, 8),
        ChannelName.DISPLACEMENT_RATIO: ratio, ChannelName.T_IN: np.full(8, 323.15),
        ChannelName.T_CASE: np.full(8, 326.15),
    }  # fmt: skip
    values = np.full((8, len(ChannelName)), np.nan)
    for name, column in columns.items():
        values[:, list(ChannelName).index(name)] = column
    channels = tuple(RecordedChannel(name, "", "", 1e-3, 0.0, 0.0, 0.0, 0.0, 0.0, ()) for name in columns)
    steady = SteadyTable(values, np.arange(8), np.full(8, np.nan), np.full_like(values, np.nan))
    return Recording("toy", "ref90", "", Circuit.CLOSED, channels, steady, (), ())


def test_an_ordinary_bench_goes_to_the_rating_and_warms_the_oil() -> None:
    """Rated speed and pressure, inlet 30 to 80 degC; displacement only where the pump was swivelled."""
    pump = load_pump("ref90")
    box = ordinary_box(_recording(np.ones(8)), pump)
    assert box.ends[0] == pytest.approx((0.25 * pump.pump.rated_speed, pump.pump.rated_speed))
    inlet, rated = pump.operating.inlet_pressure, pump.pump.rated_pressure
    assert box.ends[1] == pytest.approx((inlet + 0.1 * (rated - inlet), rated))
    assert box.ends[2] == (1.0, 1.0)
    assert box.ends[3] == pytest.approx((306.15, 356.15))
    swivelled = _recording(np.linspace(0.5, 0.9, 8))
    assert ordinary_box(swivelled, pump).ends[2] == pytest.approx((0.2, 1.0))
    for own, more in zip(rig_box(swivelled, pump).ends, ordinary_box(swivelled, pump).ends, strict=True):
        assert more[0] <= own[0] <= own[1] <= more[1]
    unmeasured = replace(swivelled, channels=swivelled.channels[:3])
    assert ordinary_box(unmeasured, pump).ends[3] == rig_box(unmeasured, pump).ends[3]


@dataclass(frozen=True)
class Promise:
    """As much of a NextPoint as the choice of the one asked for looks at."""

    settles: bool
    is_open: bool = True
    beyond: bool = False
    instead: str = ""


@pytest.mark.parametrize(
    ("near", "far", "expected"),
    [
        (Promise(True), Promise(True), Promise(True)),
        (Promise(False), Promise(True), Promise(True, beyond=True)),
        (Promise(False), Promise(False), Promise(False, instead="its leak")),
        (Promise(False, is_open=False), Promise(True), Promise(False, is_open=False)),
    ],
)
def test_a_farther_point_is_asked_for_where_none_near_settles(
    monkeypatch: pytest.MonkeyPatch, near: Promise, far: Promise, expected: Promise
) -> None:
    """The rig's own point where it settles, then an ordinary bench's, then the rig's with what would instead."""
    monkeypatch.setattr(ask, "rig_box", lambda *_: "rig")
    monkeypatch.setattr(ask, "ordinary_box", lambda *_: "ordinary")
    monkeypatch.setattr(ask, "next_point", lambda study, pump, box, *_: near if box == "rig" else far)
    monkeypatch.setattr(ask, "gap_leak_test", lambda *_: SimpleNamespace(text="its leak"))
    study: Any = SimpleNamespace(recording=None)
    pump: Any = None
    contender: Any = None
    assert ask.proposed_point(study, pump, contender, contender, LIMITS) == expected


def test_a_farther_point_that_cannot_be_simulated_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """The rig's own best stays, with what failed in words."""

    def best(study: object, pump: object, box: str, *contenders: object) -> Promise:
        if box == "ordinary":
            raise NotConverged("chambers of point 3 do not repeat")
        return Promise(False)

    monkeypatch.setattr(ask, "rig_box", lambda *_: "rig")
    monkeypatch.setattr(ask, "ordinary_box", lambda *_: "ordinary")
    monkeypatch.setattr(ask, "next_point", best)
    study: Any = SimpleNamespace(recording=None)
    contender: Any = None
    found = ask.proposed_point(study, contender, contender, contender, LIMITS)
    assert "chambers of point 3 do not repeat" in found.instead
