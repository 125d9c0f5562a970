"""The request where no points of the recorded range settle two explanations: another range, a meter more."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import diagnosis.procedure.next_test as ask
from diagnosis import Circuit, RecordedChannel, Recording, SteadyTable, load_thresholds
from diagnosis.next_point.meters import meters
from diagnosis.next_point.operating_box import ordinary_box, rig_box
from reynolds import Array, NotConverged
from system import ChannelName, load_pump

RPM = 2.0 * np.pi / 60.0
LIMITS = load_thresholds().next_point


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


def test_meters_of_an_ordinary_bench_are_of_class_a() -> None:
    """ISO 4409, class A: 0.5 % of flow and torque as limits, anywhere between them as likely."""
    within = np.random.default_rng(4).uniform(-0.005, 0.005, 100_000)
    gains = {one.name: one.gain_sigma for one in meters(load_pump("ref90"), {})}
    for name in (ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE, ChannelName.TORQUE):
        assert gains[name] == pytest.approx(np.std(within), rel=0.01)


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

    chance: float
    is_open: bool = True
    beyond: bool = False
    note: str = ""
    after: float = 0.0
    box: str = "rig"

    @property
    def settles(self) -> bool:
        return self.chance >= LIMITS.promised


@pytest.fixture
def choice(monkeypatch: pytest.MonkeyPatch) -> Callable[[Promise, Promise | Exception, Promise], Any]:
    """The test that is asked for, of the best in the rig's box, in an ordinary bench's, and with a meter."""

    def chosen(near: Promise, far: Promise | Exception, metered: Promise) -> Any:
        def best(study: object, pump: object, box: str, *contenders: object) -> Promise:
            if box == "rig":
                return near
            if isinstance(far, Exception):
                raise far
            return far

        monkeypatch.setattr(ask, "rig_box", lambda *_: "rig")
        monkeypatch.setattr(ask, "ordinary_box", lambda *_: "ordinary")
        monkeypatch.setattr(ask, "next_point", best)
        monkeypatch.setattr(ask, "further_meters", lambda *_: ("a drain",))
        monkeypatch.setattr(ask, "metered_test", lambda *_: metered)
        study: Any = SimpleNamespace(recording=None)
        contender: Any = None
        return ask.proposed_point(study, contender, contender, contender, LIMITS)

    return chosen


NOT_ASKED = Promise(-1.0)


@pytest.mark.parametrize(
    ("near", "far", "metered", "expected"),
    [
        (Promise(0.9), Promise(1.0), NOT_ASKED, Promise(0.9)),
        (Promise(0.1), Promise(0.9), Promise(1.0), Promise(0.9, beyond=True)),
        (Promise(0.1), Promise(0.2), Promise(0.9), Promise(0.9)),
        (Promise(0.3), Promise(0.2), Promise(0.1), Promise(0.3)),
        (Promise(0.1), Promise(0.3), Promise(0.2), Promise(0.3, beyond=True)),
        (Promise(0.1, is_open=False), Promise(0.9), Promise(0.9), Promise(0.1, is_open=False)),
    ],
)
def test_the_least_is_asked_for_that_settles(
    choice: Callable[..., Any], near: Promise, far: Promise, metered: Promise, expected: Promise
) -> None:
    """The rig's own points where they settle, then an ordinary bench's, then a meter; else what has the best chance."""
    assert choice(near, far, metered) == expected


def test_a_farther_point_that_cannot_be_simulated_is_told(choice: Callable[..., Any]) -> None:
    """The rig's own best stays, with what failed in words."""
    found = choice(Promise(0.2), NotConverged("chambers of point 3 do not repeat"), Promise(0.1))
    assert "chambers of point 3 do not repeat" in found.note


def test_the_charge_pressure_of_a_closed_circuit_can_be_set() -> None:
    """From .6 to 1.2 of its own where it was measured; an open circuit's inlet is what the tank gives."""
    pump, recording = load_pump("ref90"), _recording(np.ones(8))
    assert len(ordinary_box(recording, pump).ends) == 4
    values = recording.steady.values.copy()
    values[:, list(ChannelName).index(ChannelName.P_IN)] = 2e6
    charge = RecordedChannel(ChannelName.P_IN, "", "", 1e3, 0.0, 0.0, 0.0, 0.0, 0.0, ())
    charged = replace(
        recording, channels=(*recording.channels, charge), steady=replace(recording.steady, values=values)
    )
    box = ordinary_box(charged, pump)
    assert box.ends[4] == pytest.approx((1.2e6, 2.4e6))
    assert box.points([np.array([end[0]]) for end in box.ends]).p_in == pytest.approx(1.2e6)
    assert len(ordinary_box(replace(charged, circuit=Circuit.OPEN), pump).ends) == 4
