"""Baselines and ablations of the proof: they find what is planted, and rebuild the study they take apart."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from diagnosis import Study, check_recording, load_thresholds, prepare, read_recording
from reynolds import Array
from system import load_pump, tolerances
from system.estimation.evidence import project


@pytest.fixture(scope="module")
def study(proof: SimpleNamespace, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Study]:
    """The study of 38 points at which nothing is concealed."""
    whole = proof.campaigns.campaigns()["map"]
    points = replace(whole.points, **{name: value[::3] for name, value in vars(whole.points).items()})
    proof.campaigns.campaigns()["third"] = replace(whole, name="third", points=points, traces=())
    made = proof.recordings.make(proof.cases.Case(proof.cases.Part.NULL, "third", 7))
    folder = tmp_path_factory.mktemp("third")
    proof.writing.write_recording(folder, "third", made.readings, "closed")
    pump = load_pump("ref90")
    recording = check_recording(read_recording(folder), pump.pump.displacement, load_thresholds().data)
    yield prepare(pump, recording, tolerances(pump)[0], load_thresholds())
    del proof.campaigns.campaigns()["third"]


def test_a_study_is_rebuilt(proof: SimpleNamespace, study: Study) -> None:
    """With the same noise and nothing held the rebuilt posterior is the study's; without inputs sigma falls."""
    same = proof.rivals._anew(study, study.base.whitening, ())
    assert same.base.residual == pytest.approx(study.base.residual, abs=1e-9)
    assert same.base.log_evidence == pytest.approx(study.base.log_evidence, abs=1e-6)
    exact = proof.rivals._without_inputs(study)
    assert np.all(exact.sigma <= study.base.whitening.sigma * (1.0 + 1e-12))
    assert exact.sigma.mean() < 0.99 * study.base.whitening.sigma.mean()


def test_a_planted_column_is_found_stepwise(proof: SimpleNamespace, study: Study) -> None:
    """Churning's column at z = 20 on top of the residual is the first to be added."""
    column = next(each.column for each in study.candidates if each.entry.id.value == "churning")
    left = proof.rivals.project(study.base, column)
    planted = replace(study.base, residual=study.base.residual + 20.0 / np.sqrt(column @ left) * left)
    assert proof.rivals._stepwise(replace(study, base=planted)).named[0] == "churning"


def test_baselines_see_what_is_large_and_nothing_in_noise(proof: SimpleNamespace, study: Study) -> None:
    """Four sigma that grow with pressure squared in the drain: both see it; white noise: the process does not."""
    shape = study.observations.values.shape
    noise = np.random.default_rng(5).normal(size=shape)
    drain = [channel.name for channel in study.observations.channels].index("Q_case")
    large = noise.copy()
    large[:, drain] += 4.0 * study.axes[:, 1] ** 2
    assert not proof.baselines.gaussian_process(study, noise).alarm
    assert proof.baselines.gaussian_process(study, large).alarm
    assert proof.baselines.sparse_regression(study, large).alarm


def test_lasso_keeps_what_carries(proof: SimpleNamespace) -> None:
    """Of ten unit columns one carries 20 sigma: it is kept, by Schwarz' criterion hardly anything else."""
    rng = np.random.default_rng(2)
    matrix = rng.normal(size=(100, 10))
    matrix /= np.linalg.norm(matrix, axis=0)
    found = proof.baselines._lasso(matrix, 20.0 * matrix[:, 3] + rng.normal(size=100))
    assert found[3] == pytest.approx(20.0, abs=5.0)
    assert np.abs(np.delete(found, 3)).max() < 4.0


def planted(study: Study, shift: Array) -> Study:
    """The study with white noise and a whitened shift, what its parameters absorb taken from both."""
    left = project(study.base, np.random.default_rng(11).normal(size=shift.size) + shift)
    return replace(study, base=replace(study.base, xi=0.0 * study.base.xi, residual=left))


def test_statistics_find_a_planted_column(proof: SimpleNamespace, study: Study) -> None:
    """Churning's column at z = 20: two methods name it; in white noise none sees anything."""
    rivals = importlib.import_module("concealed.rivals").rivals
    column = next(each.column for each in study.candidates if each.entry.id.value == "churning")
    shift = 20.0 / np.sqrt(column @ project(study.base, column)) * column
    found = rivals(planted(study, shift))
    assert found["kennedy-ohagan"].named == ("churning",)
    assert found["localise-and-test"].named == ("churning",)
    assert not any(one.alarm for one in rivals(planted(study, 0.0 * shift)).values())


def test_statistics_see_what_no_column_is(proof: SimpleNamespace, study: Study) -> None:
    """A wave over the pressure in the drain is a discrepancy; a film that differs from point to point is embedded."""
    rivals = importlib.import_module("concealed.rivals")
    shape = np.zeros(study.observations.values.shape)
    drain = [channel.name for channel in study.observations.channels].index("Q_case")
    shape[:, drain] = 8.0 * np.cos(5.0 * study.axes[:, 1]) * study.base.whitening.sigma[:, drain]
    assert rivals.kennedy_ohagan(planted(study, study.base.whitening.whiten(shape))).alarm
    at = study.base.index("film_thickness.slipper")
    points = study.base.whitening.rows[:, 0]
    own = np.random.default_rng(3).normal(size=points.max() + 1)[points]
    slope = study.base.slopes[:, at]
    told = rivals.embedded_discrepancy(planted(study, 6.0 * own * slope / np.abs(slope).max()))
    assert told.named == ("film_thickness",)
