"""Diagnosis of one case as by a user: a folder with a recording, the pump's name, and the verdict."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import isfinite
from pathlib import Path
from time import process_time

import numpy as np

from diagnosis.explain.ranked import Explanation
from diagnosis.procedure.next_test import with_next_point
from diagnosis.procedure.recorded import diagnose_recording
from diagnosis.recording.model import Recording
from diagnosis.study.acceptance import checked_recording
from diagnosis.study.map_axes import axis_values, inside
from diagnosis.study.model import Study
from diagnosis.study.prepare import prepare
from diagnosis.study.scaled.levels import levelled
from diagnosis.thresholds import load_thresholds
from diagnosis.verdict.diagnosis import ClaimedEffect, Diagnosis
from diagnosis.verdict.locate import Location
from reynolds.errors import InputError, NotConverged
from system.description.pump import PumpDescription
from system.description.tolerances import tolerances
from system.effects.effect import EffectId, Kind
from system.estimation.fit import Posterior
from system.inputs.faults import InputFaults
from system.pump_file.file import KnownPump, load_known_pump

from .campaigns import campaigns
from .cases import Case, Part
from .expected import of_case, of_folder
from .oracle import oracle
from .outcome import Claimed, Outcome, Ranked, Rival
from .plant.bench import Truth, run
from .plant.machine import Machine, ref90
from .plant.settings import Settings
from .recordings import STEPS, Made, make
from .rig import Rig
from .rivals import rivals
from .store import program
from .worth import worth
from .writing import BENCH, write_recording

KEPT = 60  # explanations of the ranking: a set that holds 95 % together is whole
NINETY = 1.645  # sigma either side of a 90 % interval
SAME = {
    "film_thickness.slipper": "slipper_film", "film_thickness.valve_plate": "plate_film",
    "bulk_modulus": "bulk_modulus", "friction.piston_cylinder": "friction_piston",
    "friction.slipper_swash_plate": "friction_slipper", "friction.piston_slipper_socket": "friction_socket",
    "friction.valve_plate_cylinder": "friction_plate", "friction.ball_guide_retainer": "friction_guide",
    "friction.front_bearing": "friction_front", "friction.rear_bearing": "friction_rear",
    "dead_volume": "dead_volume", "displacement": "stroke", "viscosity": "viscosity",
}  # fmt: skip
"""Parameters with the same meaning in the simulation and in the plant."""


@dataclass(frozen=True)
class Diagnosed:
    """Findings of this diagnosis and of other methods, and their study."""

    found: Diagnosis
    rivals: dict[str, Rival]
    study: Study
    pump: PumpDescription


def try_case(case: Case) -> Outcome:
    """Make a case's recording, diagnose it, and put the finding beside the truth."""
    made, thresholds = make(case), load_thresholds()
    expected = of_case(case, made)
    with tempfile.TemporaryDirectory() as folder:
        write_recording(Path(folder), case.name, made.readings, campaigns()[case.campaign].circuit)
        told, diagnosed = tried(Path(folder), expected)
    if diagnosed is None:
        return told
    found, study = diagnosed.found, diagnosed.study
    return replace(
        told,
        covered=_covered(case, found, made.machine),
        oracle=oracle(study, found, expected, thresholds),
        worth=worth(study, diagnosed.pump, found, _rig(case, made), expected, thresholds),
    )


def try_folder(folder: Path) -> Outcome:
    """The same of a recording that is given with its answer."""
    expected = of_folder(folder)
    told, diagnosed = tried(folder, expected)
    if diagnosed is None:
        return told
    return replace(told, oracle=oracle(diagnosed.study, diagnosed.found, expected, load_thresholds()))


def _rig(case: Case, made: Made) -> Rig:
    def run_at(at: Settings) -> Truth:
        return run(made.machine, at, made.hidden, STEPS)

    return Rig(case.campaign, case.seed, run_at, made.setting, made.faults, made.readings.calibrations)


def tried(
    folder: Path, expected: Outcome, pump: str | Path = BENCH, with_rivals: bool = True
) -> tuple[Outcome, Diagnosed | None]:
    """The finding beside the expected one; a recording without a diagnosis states why."""
    begun = process_time()
    try:
        diagnosed = diagnose_folder(folder, pump, with_rivals)
    except (InputFaults, NotConverged, InputError) as reason:
        spent = process_time() - begun
        return replace(expected, failed=str(reason), status="failed", seconds=spent, program=program()), None
    return _outcome(expected, diagnosed, process_time() - begun), diagnosed


def diagnose_folder(folder: Path, pump: str | Path = BENCH, with_rivals: bool = True) -> Diagnosed:
    """Findings of `swashfilm diagnose PUMP FOLDER` and of other methods on the same study."""
    thresholds = load_thresholds()
    known, recording, prepared = _posed(folder, pump)
    study, found = diagnose_recording(known.pump, recording, prepared, thresholds)
    asked = with_next_point(study, known.pump, found, thresholds)
    return Diagnosed(asked, rivals(study, thresholds) if with_rivals else {}, study, known.pump)


def study_of_folder(folder: Path, pump: str | Path = BENCH) -> Study:
    """The study of a recording, without a finding."""
    _, recording, prepared = _posed(folder, pump)
    return prepared(recording)


def _posed(folder: Path, pump: str | Path) -> tuple[KnownPump, Recording, Callable[[Recording], Study]]:
    """The pump at the level of its recording, the recording, and the maker of its study."""
    known, thresholds = load_known_pump(pump), load_thresholds()
    recording, allowed = checked_recording(folder, known), tolerances(known.pump)[0]
    known = levelled(known, recording, allowed)

    def prepared(usable: Recording) -> Study:
        return prepare(known.pump, usable, allowed, thresholds, scant=known.scant)

    return known, recording, prepared


def _per_reading(fit: Posterior) -> float:
    return float(fit.objective / fit.residual.size)


def _outcome(expected: Outcome, diagnosed: Diagnosed, seconds: float) -> Outcome:
    found = diagnosed.found
    ranked = sorted(found.hypotheses, key=lambda each: -each.probability)
    before, after, noise = found.fit.before, found.fit.after, found.fit.noise
    return replace(
        expected,
        verdict=found.kind.value,
        status=found.status.value,
        claims=tuple(_claimed(one) for one in found.effects),
        ranked=tuple(_ranked(each) for each in ranked[:KEPT]),
        nothing=sum(each.probability for each in ranked if each.hypothesis.kind is Kind.NO_MISMATCH),
        channels=tuple(channel.value for channel in found.location.channels),
        region=_region(diagnosed.study, found.location),
        turn=(found.location.angle.start, found.location.angle.end) if found.location.angle else None,
        heldout={name.value: (before[name], after[name], noise[name]) for name in before},
        chi2=(_per_reading(found.before), _per_reading(found.after)),
        chance=found.detection.chance,
        reasons=found.notes,
        rivals=diagnosed.rivals,
        seconds=seconds,
        program=program(),
    )


def _region(study: Study, location: Location) -> tuple[int, ...] | None:
    """The points of the stated region; all of them where the mismatch is everywhere."""
    if not location.channels:
        return None
    lower, upper = (location.region.lower, location.region.upper) if location.region else ({}, {})
    return tuple(int(point) for point in np.flatnonzero(inside(axis_values(study.recording), lower, upper)))


def _claimed(one: ClaimedEffect) -> Claimed:
    place = one.pair.value if one.pair else _joint(one)
    equivalent, elsewhere = (each.value for each in one.equivalent), (gap.value for gap, _ in one.elsewhere)
    return Claimed(one.effect.value, place, one.probability, tuple(equivalent), tuple(elsewhere))


def _joint(one: ClaimedEffect) -> str | None:
    """Place of a coefficient of friction outside the gaps, by the name of its parameter."""
    return one.parameters[0].name.rpartition(".")[2] if one.effect is EffectId.FRICTION_COEFFICIENT else None


def _ranked(each: Explanation) -> Ranked:
    own = each.hypothesis
    effects = tuple(effect.value for effect in own.effects)
    places = tuple(place.value if place else None for place in own.places)
    return Ranked(effects, places, own.kind.value, each.probability)


def _covered(case: Case, found: Diagnosis, machine: Machine) -> dict[str, bool]:
    """Whether 90 % intervals of common parameters hold the truth; only where the explanation is right."""
    told = {one.effect.value for one in found.effects}
    if told != {one.id for one in case.concealed} or case.part in (Part.UNKNOWN, Part.PAIR):
        return {}
    fit, drawing, inside = found.after, ref90(), {}
    for name, part in SAME.items():
        at = fit.index(name)
        sigma = float(fit.covariance[at, at]) ** 0.5
        relative = name in ("displacement", "viscosity")
        value = getattr(machine, part) / (getattr(drawing, part) if relative else 1.0)
        true = fit.parameters[at].standard(value)
        if isfinite(true):
            inside[name] = bool(abs(true - fit.xi[at]) <= NINETY * sigma)
    return inside
