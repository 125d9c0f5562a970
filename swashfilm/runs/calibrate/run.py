"""A pump calibrated by a recording: coefficients with their widths, what is left open, and models compared."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import process_time

from diagnosis.checks.check import too_few
from diagnosis.checks.notes import note_text
from diagnosis.explain.hypotheses import hypotheses
from diagnosis.explain.ranked import Weighed
from diagnosis.explain.refit import refit
from diagnosis.recording.model import Recording
from diagnosis.study.inputs import bench_points
from diagnosis.study.model import Study, study_of
from diagnosis.study.prepare import prepare
from diagnosis.thresholds import Thresholds, load_thresholds
from reynolds.errors import FilmInputError
from system.bench.calibration.equation_21 import (
    EqFit,
    eq_fits,
    eq_twenty_one,
    measured_losses,
    paper_priors,
)
from system.bench.calibration.held_out import HeldOutRow, model_rows, physics_rows
from system.bench.calibration.hersey_curve import HerseyCurve, hersey_curves
from system.bench.loss_models.model import LossModelName
from system.bench.points import BenchPoints
from system.bench.simulator import LumpedBench
from system.description.pump import PumpDescription
from system.description.tolerances import tolerances
from system.effects.catalogue.entries import entry_of
from system.effects.effect import EffectId
from system.effects.extension import Extension
from system.estimation.determined import Combination, undetermined
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName
from system.inputs.errors import NotConverged
from system.inputs.faults import Fault, InputFaults
from system.work.progress import Report


@dataclass(frozen=True)
class Hersey:
    """Friction over the Hersey number beside constant coefficients: its fit, and ln odds for it.

    laws: what the fit has switched on; carried: the odds are what a name needs.
    """

    fit: Posterior
    laws: tuple[Extension, ...]
    evidence: float
    carried: bool


@dataclass(frozen=True)
class Calibration:
    """What a recording says about a pump of which nothing is taken to be missing.

    fit: base and sensor parameters, friction by the paper's ranges, constant; hersey: None where it was not asked
    for or not to be fitted; undetermined, rows: what `best` leaves to the priors, and it beside loss models in the
    same splits; equation: Eq. (21) by itself, mixed: of coefficients that hold the films' shear too; notes: what
    was taken, and what could not be done.
    """

    study: Study
    points: BenchPoints
    fit: Posterior
    undetermined: tuple[Combination, ...]
    hersey: Hersey | None
    curves: tuple[HerseyCurve, ...]
    equation: tuple[EqFit, ...]
    mixed: tuple[EqFit, ...]
    rows: tuple[HeldOutRow, ...]
    notes: tuple[str, ...]
    seconds: float

    @property
    def best(self) -> Posterior:
        """The fit that the calibrated pump is made of: with the Hersey number where the data carry it."""
        return self.hersey.fit if self.hersey is not None and self.hersey.carried else self.fit

    @property
    def laws(self) -> tuple[Extension, ...]:
        """What that pump has switched on."""
        return self.hersey.laws if self.hersey is not None and self.hersey.carried else ()


def calibrate(
    pump: PumpDescription,
    recording: Recording,
    models: Sequence[LossModelName],
    with_hersey: bool,
    report: Report,
) -> Calibration:
    """Calibrate a pump by a checked recording. Raises InputFaults for too few readings, NotConverged."""
    begun, thresholds, steps = process_time(), load_thresholds(), 4 + len(models)
    report(0, steps, "simulating the recording")
    study, bench, notes = _prepared(pump, recording, with_hersey, thresholds)
    report(1, steps, "fitting the pump")
    null = refit(study, hypotheses(study, thresholds)[0], thresholds)
    fit = _fit_of(null)
    report(2, steps, "friction over the Hersey number")
    hersey = _hersey(study, null, thresholds, notes) if with_hersey else None
    shown, laws = (hersey.fit, hersey.laws) if hersey is not None and hersey.carried else (fit, ())
    report(3, steps, "Eq. (21)")
    equation, mixed = _equations(pump, bench, fit, study, notes)
    rows = _compared(pump, bench, shown, study, models, notes, report)
    return Calibration(
        study=study,
        points=bench.points,
        fit=fit,
        undetermined=undetermined(shown),
        hersey=hersey,
        curves=hersey_curves(bench, shown, laws),
        equation=equation,
        mixed=mixed,
        rows=rows,
        notes=tuple(notes),
        seconds=process_time() - begun,
    )


def _prepared(
    pump: PumpDescription, recording: Recording, with_hersey: bool, thresholds: Thresholds
) -> tuple[Study, LumpedBench, list[str]]:
    """The study with the paper's priors of friction, its bench by itself, and what is to be told."""
    catalogue = (entry_of(EffectId.MIXED_FRICTION),) if with_hersey else ()
    allowed, taken = tolerances(pump)
    plain = prepare(pump, replace(recording, traces=()), allowed, thresholds, ())
    few = too_few(plain.recording, len(plain.simulator.parameters))
    if few is not None:
        raise InputFaults(recording.title, [Fault("recording", few.text, "more readings than parameters")])
    priors, told = paper_priors(pump)
    parameters = plain.simulator.with_parameters(priors).parameters
    points, _ = bench_points(plain.recording, pump)
    channels = tuple(ChannelName.named(one.name) for one in plain.observations.channels)
    inputs = tuple(ChannelName.named(one) for one in plain.observations.inputs)
    bench = LumpedBench(pump, points, channels, parameters, inputs=inputs)
    study = study_of(plain.recording, bench, plain.observations, plain.axes, catalogue, thresholds)
    return study, bench, [*map(note_text, plain.recording.notes), *map(str, taken), *told]


def _hersey(study: Study, null: Weighed, thresholds: Thresholds, notes: list[str]) -> Hersey | None:
    """Mixed friction fitted beside the constant coefficients; None, and told, where that fails."""
    asked = (EffectId.MIXED_FRICTION,)
    listed = [one for one in hypotheses(study, thresholds) if one.effects == asked]
    if not listed:
        notes.append("friction over the Hersey number shows in no channel of this recording")
        return None
    try:
        found = refit(study, listed[0], thresholds)
    except NotConverged as reason:
        notes.append(f"friction over the Hersey number could not be fitted: {reason}")
        return None
    evidence = found.log_evidence - null.log_evidence
    return Hersey(_fit_of(found), found.hypothesis.laws, evidence, evidence > thresholds.name.odds)


def _equations(
    pump: PumpDescription, bench: LumpedBench, fit: Posterior, study: Study, notes: list[str]
) -> tuple[tuple[EqFit, ...], tuple[EqFit, ...]]:
    """Eq. (21) beside the films' shear and with it held, all else as fitted; nothing, and told, without flows."""
    own = tuple(one for one in bench.parameters if one.name.startswith("friction."))
    if not own:
        notes.append("Eq. (21) by itself: every friction coefficient of the pump is 0")
        return (), ()
    try:
        readings = measured_losses(bench.points, study.observations)
    except FilmInputError as reason:
        notes.append(f"Eq. (21) by itself: {reason}")
        return (), ()
    eq, rated = eq_twenty_one(bench, fit.values, own), pump.pump.rated_speed
    beside, mixed = (eq_fits(one, readings, bench.points, rated) for one in (eq, eq.mixed))
    return beside, mixed


def _compared(
    pump: PumpDescription,
    bench: LumpedBench,
    fit: Posterior,
    study: Study,
    models: Sequence[LossModelName],
    notes: list[str],
    report: Report,
) -> tuple[HeldOutRow, ...]:
    """The fitted pump and loss models in the same splits; nothing, and told, without the channels of these."""
    if not models:
        return ()
    try:
        rows = [*physics_rows(fit, study.observations, bench.points)]
        for at, name in enumerate(models):
            report(4 + at, 4 + len(models), f"loss model {name.value}")
            rows += model_rows(name, pump, bench.points, bench.inputs, study.observations)
    except FilmInputError as reason:
        notes.append(f"loss models: {reason}")
        return ()
    return tuple(rows)


def _fit_of(weighed: Weighed) -> Posterior:
    if weighed.posterior is None:
        raise ValueError(f"{weighed.hypothesis.text}: not fitted")
    return weighed.posterior
