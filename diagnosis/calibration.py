"""A pump calibrated by a recording: coefficients with their sigmas, undetermined combinations, models compared."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import process_time

from diagnosis.checks.check import with_notes
from diagnosis.checks.notes import note_text
from diagnosis.explain.hypotheses import hypotheses
from diagnosis.explain.ranked import Explanation
from diagnosis.explain.refit import refit
from diagnosis.recording.model import DataNote, NoteKind, Recording
from diagnosis.study.acceptance import accepted_recording, refuse_too_few
from diagnosis.study.inputs import bench_points
from diagnosis.study.model import Study, study_of
from diagnosis.study.prepare import prepare
from diagnosis.study.scaled.levels import at_level
from diagnosis.thresholds import Thresholds, load_thresholds
from diagnosis.verdict.suspects import unexplained
from reynolds.errors import InputError, NotConverged
from system.bench.calibration.equation_21 import EqFit, eq_fits, eq_twenty_one, measured_losses, unstated_priors
from system.bench.calibration.extended_pump import calibrated_pump
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
from system.estimation.fit import is_peak
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName
from system.pump_file.file import KnownPump, known_pump
from system.work.progress import Report, silent


@dataclass(frozen=True)
class Hersey:
    """Friction over the Hersey number beside constant coefficients: its fit, and ln odds for it.

    laws: switched on in the fit; supported: the odds are at least those that a named effect needs.
    """

    fit: Posterior
    laws: tuple[Extension, ...]
    evidence: float
    supported: bool


@dataclass(frozen=True)
class Calibration:
    """A pump calibrated by a recording, without missing physics.

    fit: base and sensor parameters, friction constant, without a stated sigma within the paper's ranges; hersey: None
    if not requested or without a fit; undetermined: combinations of parameters that `best` leaves to the priors;
    equation: Eq. (21) by itself, mixed: of coefficients that include the films' shear; rows: `best` and loss models in
    the same splits; assumptions: of the pump; notes: assumptions of the recording, and parts that could not be fitted.
    """

    pump: PumpDescription
    assumptions: tuple[str, ...]
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
        """The fit of the calibrated pump: over the Hersey number where the readings support it."""
        return self.hersey.fit if self.hersey is not None and self.hersey.supported else self.fit

    @property
    def laws(self) -> tuple[Extension, ...]:
        """Laws that are switched on in the calibrated pump."""
        return self.hersey.laws if self.hersey is not None and self.hersey.supported else ()

    @property
    def calibrated_pump(self) -> PumpDescription:
        """The pump with the values of `best`, and the fit's sigmas as its tolerances."""
        return calibrated_pump(self.pump, self.best, self.laws)


def calibrate(
    pump: PumpDescription | KnownPump,
    recording: Recording | Path | str,
    report: Report = silent,
    models: Sequence[LossModelName] = tuple(LossModelName),
    with_hersey: bool = True,
) -> Calibration:
    """Calibrate a pump by a recording.

    recording: a path, or a result of `checked_recording`; models: loss models fitted to the same readings; with_hersey:
    try friction over the Hersey number beside constant coefficients. A pump known by its type plate is first set to the
    level of the recording. Raises InputFaults for a recording with faults or too few readings, NotConverged where no
    fit converges, or the fit of the pump was given up.
    """
    begun, thresholds, steps = process_time(), load_thresholds(), 4 + len(models)
    known = known_pump(pump)
    report(0, steps, "simulating the recording")
    known, accepted = at_level(known, accepted_recording(recording, known), tolerances(known.pump)[0])
    accepted = with_notes(accepted, _other_make(known))
    study, bench, notes = _prepared(known, accepted, with_hersey, thresholds)
    report(1, steps, "fitting the pump")
    null = refit(study, hypotheses(study, thresholds)[0], thresholds)
    if aside := unexplained(study, (null,), thresholds):
        study, bench, notes = _prepared(known, with_notes(accepted, aside), with_hersey, thresholds)
        null = refit(study, hypotheses(study, thresholds)[0], thresholds)
    report(2, steps, "friction over the Hersey number")
    hersey = _hersey(study, null, thresholds, notes) if with_hersey else None
    fit = _constant(null, hersey, study, thresholds, notes)
    best, laws = (hersey.fit, hersey.laws) if hersey is not None and hersey.supported else (fit, ())
    report(3, steps, "Eq. (21)")
    equation, mixed = _equations(known.pump, bench, fit, study, notes)
    rows = _compared(known.pump, bench, best, study, models, notes, report)
    return Calibration(
        pump=known.pump,
        assumptions=tuple(str(one) for one in known.assumptions),
        study=study,
        points=bench.points,
        fit=fit,
        undetermined=undetermined(best),
        hersey=hersey,
        curves=hersey_curves(bench, best, laws),
        equation=equation,
        mixed=mixed,
        rows=rows,
        notes=tuple(notes),
        seconds=process_time() - begun,
    )


def _prepared(
    known: KnownPump, recording: Recording, with_hersey: bool, thresholds: Thresholds
) -> tuple[Study, LumpedBench, list[str]]:
    """The study with the paper's priors of friction where [tolerance] states none, its bench, and the notes."""
    catalogue, pump = (entry_of(EffectId.MIXED_FRICTION),) if with_hersey else (), known.pump
    allowed, taken = tolerances(pump)
    plain = prepare(pump, replace(recording, traces=()), allowed, thresholds, ())
    refuse_too_few(plain)
    priors, assumed = unstated_priors(pump)
    taken = tuple(one for one in taken if not one.path.endswith("friction"))  # `assumed` has theirs
    parameters = plain.simulator.with_parameters(priors).parameters
    points, _ = bench_points(plain.recording, pump)
    channels = tuple(ChannelName.named(one.name) for one in plain.observations.channels)
    inputs = tuple(ChannelName.named(one) for one in plain.observations.inputs)
    bench = LumpedBench(pump, points, channels, parameters, inputs=inputs)
    study = study_of(plain.recording, bench, plain.observations, plain.axes, catalogue, thresholds)
    notes = [*map(note_text, plain.recording.notes), *map(str, taken), *assumed]
    return replace(study, scant=known.scant), bench, notes


def _hersey(study: Study, null: Explanation, thresholds: Thresholds, notes: list[str]) -> Hersey | None:
    """Mixed friction fitted beside the constant coefficients; None, with a note, where that fails."""
    asked = (EffectId.MIXED_FRICTION,)
    listed = [one for one in hypotheses(study, thresholds) if one.effects == asked]
    if not listed:
        notes.append("friction over the Hersey number shows in no channel of this recording")
        return None
    try:
        found = refit(study, listed[0], thresholds)
        fit = _peak_of(found, study, thresholds)
    except NotConverged as reason:
        notes.append(f"friction over the Hersey number could not be fitted: {reason}")
        return None
    evidence = found.log_evidence - null.log_evidence
    return Hersey(fit, found.hypothesis.laws, evidence, evidence > thresholds.name.odds)


def _equations(
    pump: PumpDescription, bench: LumpedBench, fit: Posterior, study: Study, notes: list[str]
) -> tuple[tuple[EqFit, ...], tuple[EqFit, ...]]:
    """Eq. (21) beside the films' shear and including it, others as fitted; none, with a note, without flows."""
    own = tuple(one for one in bench.parameters if one.name.startswith("friction."))
    if not own:
        notes.append("Eq. (21) by itself: every friction coefficient of the pump is 0")
        return (), ()
    try:
        readings = measured_losses(bench.points, study.observations)
    except InputError as reason:
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
    """The fitted pump and loss models in the same splits; none, with a note, without their channels."""
    if not models:
        return ()
    try:
        rows = [*physics_rows(fit, study.observations, bench.points)]
        for at, name in enumerate(models):
            report(4 + at, 4 + len(models), f"loss model {name.value}")
            rows += model_rows(name, pump, bench.points, bench.inputs, study.observations)
    except InputError as reason:
        notes.append(f"loss models: {reason}")
        return ()
    return tuple(rows)


def _constant(
    null: Explanation, hersey: Hersey | None, study: Study, thresholds: Thresholds, notes: list[str]
) -> Posterior:
    """The fit with constant coefficients.

    One that was given up is only beside friction over the Hersey number that the readings support, with a note; else
    NotConverged is raised.
    """
    try:
        return _peak_of(null, study, thresholds)
    except NotConverged as reason:
        if null.posterior is None or hersey is None or not hersey.supported:
            raise
        notes.append(f"constant friction coefficients, and Eq. (21) beside them, do not hold: {reason}")
        return null.posterior


def _peak_of(explanation: Explanation, study: Study, thresholds: Thresholds) -> Posterior:
    """The fit of an explanation. Raises NotConverged for one that was given up: its values and sigmas do not hold."""
    fit = explanation.posterior
    if fit is None:
        raise ValueError(f"{explanation.hypothesis.text}: not fitted")
    if not is_peak(fit, thresholds.fit_limits(study.scant)):
        raise NotConverged(
            f"the fit was given up at a chi-square per reading of {fit.objective / fit.residual.size:.3g}, before its "
            "peak. The readings contradict the pump: `swashfilm diagnose` tells where; correct it, then calibrate"
        )
    return fit


def _other_make(known: KnownPump) -> Iterator[DataNote]:
    """A warning of a pump known by its type plate."""
    if known.scant:
        text = (
            f"{known.pump.name} is known by its type plate: coefficients and sigmas are those of ref90's laws, scaled. "
            "Laws of another make are not allowed for: friction may seem to change with the Hersey number"
        )
        yield DataNote(NoteKind.WARNED, None, (), text)
