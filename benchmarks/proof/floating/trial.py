"""Diagnosis of a recording of the plant, by a simulation without a part of the film physics."""

from __future__ import annotations

import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from diagnosis.procedure.recorded import diagnose_recording
from diagnosis.recording.model import Recording
from diagnosis.study.acceptance import checked_recording
from diagnosis.study.model import Study
from diagnosis.study.prepare import prepare
from diagnosis.thresholds import Thresholds, load_thresholds
from diagnosis.verdict.diagnosis import Diagnosis
from gaps.films.physics import Effect
from system.description.tolerances import tolerances
from system.estimation.posterior import values_at
from system.points.table.film_law import share_name
from system.points.table.film_physics import NAMED, FilmModel
from system.pump_file.file import known_pump

from ..store import program
from ..writing import write_recording
from .films import OFF, off_text, pump
from .plant import readings

SEEDS = (61, 62, 63, 64, 65)
SURE = 0.9
VISIBLE = 8.0
"""Sigma from which a case counts: of the concealed physics, less the part that the pump's own tolerances absorb."""


@dataclass(frozen=True)
class Case:
    """A simulation without `off`, and the draw of calibrations and noise."""

    off: tuple[Effect, ...]
    seed: int

    @property
    def name(self) -> str:
        """Name of its file."""
        return f"{off_text(self.off)}-{self.seed}"

    @property
    def concealed(self) -> list[str]:
        """The effects to be named."""
        return sorted(NAMED[one].value for one in self.off)


@dataclass(frozen=True)
class Outcome:
    """The finding of a case.

    claims: effect, probability, share with its sigma (none of effects outside the films); score: sigma of the concealed
    physics; chi2: per reading, before and after; held_out: rms over noise by channel, before and after; program: digest
    of the diagnosing program.
    """

    name: str
    concealed: list[str]
    kind: str
    status: str
    claims: list[tuple[str, float, str]]
    score: float
    chi2: tuple[float, float]
    held_out: dict[str, tuple[float, float]]
    seconds: float
    program: str = ""

    @property
    def is_right(self) -> bool:
        """True if exactly the concealed effects are named."""
        return sorted(effect for effect, *_ in self.claims) == self.concealed

    @property
    def wrong_and_sure(self) -> bool:
        """True if an effect that is not concealed is named with a probability of .9 or more."""
        return any(effect not in self.concealed and chance >= SURE for effect, chance, _ in self.claims)

    @property
    def worst(self) -> float:
        """The largest held-out rms over noise after the finding."""
        return max(after for _, after in self.held_out.values())

    def record(self) -> dict[str, object]:
        """As JSON."""
        return asdict(self)

    @staticmethod
    def of_record(record: dict[str, Any]) -> Outcome:
        """The outcome of a record."""
        return Outcome(**record)


def all_cases() -> list[Case]:
    """Forty: eight simulations, five draws each; and five of a complete simulation."""
    return [Case(off, seed) for off in OFF for seed in SEEDS]


def try_case(case: Case, films: FilmModel) -> Outcome:
    """The diagnosis of a case by the films of its simulation."""
    begun, thresholds = process_time(), load_thresholds()
    allowed, _ = tolerances(pump())

    def prepared(usable: Recording) -> Study:
        return prepare(pump(), usable, allowed, thresholds, films.catalogue, films=films)

    with tempfile.TemporaryDirectory() as folder:
        write_case(case, Path(folder))
        recording = checked_recording(Path(folder), known_pump(pump()))
    _, found = diagnose_recording(pump(), recording, prepared, thresholds)
    return _outcome(case, found, score(prepared(recording), films, thresholds), process_time() - begun)


def write_case(case: Case, folder: Path) -> None:
    """Write the recording of a case into a folder, created if absent."""
    folder.mkdir(parents=True, exist_ok=True)
    campaign, read = readings(case.seed)
    write_recording(folder, case.name, read, campaign.circuit)


def score(study: Study, films: FilmModel, thresholds: Thresholds) -> float:
    """Sigma of all concealed parts together, at their whole size, beyond the part that the parameters absorb."""
    extended = study.simulator.with_extensions(tuple(entry.extensions[0] for entry in films.entries))
    names = [parameter.name for parameter in extended.parameters]
    off = values_at(extended.parameters, np.zeros(len(names)))
    on = off.copy()
    for part in films.law.single:
        on[names.index(share_name(part))] = 1.0
    change = study.base.whitening.whiten(extended.predict(on) - extended.predict(off))
    slopes = study.base.slopes
    taken = slopes.T @ change
    return float(np.sqrt(change @ change - taken @ np.linalg.solve(np.eye(len(taken)) + slopes.T @ slopes, taken)))


def _outcome(case: Case, found: Diagnosis, reached: float, seconds: float) -> Outcome:
    claims = [
        (
            one.effect.value,
            one.probability,
            ", ".join(f"{size.value:.2f} +- {size.sigma:.2f}" for size in one.parameters),
        )
        for one in found.effects
    ]
    fit = found.fit
    return Outcome(
        case.name, case.concealed, found.kind.value, found.status.value, claims, reached,
        (found.before.objective / found.before.residual.size, found.after.objective / found.after.residual.size),
        {name.value: (fit.before[name] / fit.noise[name], fit.after[name] / fit.noise[name]) for name in fit.before},
        seconds, program(),
    )  # fmt: skip
