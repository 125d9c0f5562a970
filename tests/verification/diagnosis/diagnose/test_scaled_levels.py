"""A pump known by its type plate is set to the level of its recording, whatever inputs that has, or it is told."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from diagnosis import Recording, load_thresholds, prepare, read_recording
from diagnosis.study.scaled import levels
from diagnosis.study.scaled.levels import levelled
from system import ChannelName, tolerances
from system.pump_file.file import KnownPump, load_known_pump

OPEN = Path(__file__).parents[4] / "examples" / "recordings" / "open-01"
PLATE = """[pump]
displacement = "90 cm3"
pistons = 9
rated_speed = "2100 rpm"
rated_pressure = "350 bar"
[oil]
grade = "ISO VG 46"
[operating]
pressure = "200 bar"
"""


@pytest.fixture(scope="module")
def known(tmp_path_factory: pytest.TempPathFactory) -> KnownPump:
    path = tmp_path_factory.mktemp("plate") / "plate.toml"
    path.write_text(PLATE, "utf-8")
    return load_known_pump(path)


def _recording(without: frozenset[ChannelName] = frozenset()) -> Recording:
    """Points of the recording at 150 to 250 bar, without some of its channels and without traces."""
    read = read_recording(OPEN)
    pressure = read.steady.column(ChannelName.P_OUT)
    steady = read.steady.at((pressure > 150e5) & (pressure < 250e5))
    values = steady.values.copy()
    values[:, [list(ChannelName).index(name) for name in without]] = np.nan
    channels = tuple(one for one in read.channels if one.name not in without)
    return replace(read, steady=replace(steady, values=values), channels=channels, traces=())


@pytest.mark.parametrize("without", [set(), {ChannelName.P_OUT}, {ChannelName.P_OUT, ChannelName.P_IN}])
def test_an_input_that_is_not_recorded_is_that_of_the_pump_file(known: KnownPump, without: set[ChannelName]) -> None:
    """The level follows, and so does the study. Displacement is that of the plate, to what its round number leaves."""
    allowed = tolerances(known.pump)[0]
    recording = _recording(frozenset(without))
    found = levelled(known, recording, allowed)
    assert found.pump.pump.displacement == pytest.approx(90e-6, rel=0.03)
    study = prepare(found.pump, recording, allowed, load_thresholds(), (), scant=True)
    assert np.isfinite(study.base.objective)


def test_a_level_that_is_not_reached_is_told(known: KnownPump, monkeypatch: pytest.MonkeyPatch) -> None:
    allowed, recording = tolerances(known.pump)[0], _recording()

    def reasons() -> set[str]:
        return {one.reason for one in levelled(known, recording, allowed).assumptions}

    assert levels.AT_LEVEL in reasons()
    monkeypatch.setattr(levels, "STEPS", 3)
    assert levels.NEAR_LEVEL in reasons()
    assert levels.AT_LEVEL not in reasons()
