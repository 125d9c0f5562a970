"""Course of a meter's drift against laws of the inputs; parameters that no reading feels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH

from diagnosis import Recording, Study, load_thresholds, prepare, read_recording
from diagnosis.study.drift_course import drift_courses
from diagnosis.study.felt import felt
from system import ChannelName, load_pump, tolerances
from system.bench.simulator import LumpedBench

LIMITS = load_thresholds()
PUMP = load_pump(BENCH)


@pytest.fixture(scope="module")
def recording(request: pytest.FixtureRequest) -> Recording:
    """Every third point of a bench map, half an hour apart."""
    read = read_recording(request.config.rootpath / "examples" / "recordings" / "open-01")
    steady = read.steady.at(slice(None, None, 3))
    return replace(read, steady=replace(steady, hours=0.5 * np.arange(len(steady.hours))), traces=())


def _study(recording: Recording) -> Study:
    return prepare(PUMP, recording, tolerances(PUMP)[0], LIMITS, ())


def _with(recording: Recording, added: np.ndarray) -> Recording:
    """The same with more in the case drain (SI)."""
    values = recording.steady.values.copy()
    values[:, list(ChannelName).index(ChannelName.Q_CASE)] += added
    return replace(recording, steady=replace(recording.steady, values=values))


def _courses(study: Study) -> Mapping[ChannelName, np.ndarray]:
    """Courses of drifts that the simulator of a study has."""
    simulator = study.simulator
    assert isinstance(simulator, LumpedBench)
    return simulator.drifts


def test_a_meter_without_drift_has_no_course(recording: Recording) -> None:
    assert drift_courses(_study(recording), LIMITS) == {}


def test_a_bump_in_time_is_the_course_of_a_drift(recording: Recording) -> None:
    """The course follows the bump that was added, and no law of speed, pressure or stroke is taken for one."""
    hours = recording.steady.hours
    past = hours / hours.max()
    bump = np.exp(-(((past - 0.5) / 0.15) ** 2))
    level = np.nanmedian(recording.steady.column(ChannelName.Q_CASE))
    found = _study(_with(recording, 0.3 * level * bump))
    course = _courses(found)[ChannelName.Q_CASE]
    assert course[0] == 0.0
    assert np.abs(course).max() == 1.0
    assert np.corrcoef(course, bump)[0, 1] > 0.97
    pressure = recording.steady.column(ChannelName.P_OUT)
    law = 0.3 * level * (pressure / pressure.max()) ** 2
    assert _courses(_study(_with(recording, law))) == {}
    assert drift_courses(found, LIMITS) == {}  # none beside what the fit now has


def test_what_no_reading_feels_is_left_out(recording: Recording) -> None:
    """Without a torque meter no friction is a parameter; films and displacement are."""
    order = list(ChannelName)
    values = recording.steady.values.copy()
    values[:, order.index(ChannelName.TORQUE)] = np.nan
    channels = tuple(one for one in recording.channels if one.name is not ChannelName.TORQUE)
    study = _study(replace(recording, channels=channels, steady=replace(recording.steady, values=values)))
    names = {one.name for one in study.base.parameters}
    assert not {name for name in names if name.startswith("friction.")}
    assert {"film_thickness.piston", "film_thickness.slipper", "displacement"} <= names
    assert len(felt(study, LIMITS)) == len(study.base.parameters)


def test_a_parameter_that_others_replace_is_left_out(recording: Recording) -> None:
    """Eccentricity is replaced by clearance where a tolerance is wide; what a hypothesis may find wrong stays."""
    allowed = replace(tolerances(PUMP)[0], film_thickness=0.5, eccentricity_ratio=0.05)
    names = {one.name for one in prepare(PUMP, recording, allowed, LIMITS, ()).base.parameters}
    assert "eccentricity_ratio" not in names
    assert {"film_thickness.piston", "film_thickness.slipper", "film_thickness.valve_plate", "viscosity"} <= names
