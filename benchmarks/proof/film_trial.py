"""Diagnosis of a recording of the film simulation, whose simulation is the lumped one."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable
from pathlib import Path
from time import process_time

from diagnosis.finding import diagnose
from diagnosis.verdict.diagnosis import ClaimedEffect, Diagnosis
from system.effects.catalogue.entries import CATALOGUE, with_films_solved
from system.pump_file.file import load_known_pump

from .film_plant import FilmPlant, readings
from .writing import BENCH, write_recording

HEAD = ("plant", "concealed", "said", "status", "size", "held out: before / after, of the noise", "chi2", "s")
SEED = 3  # of calibrations and noise


def write_film_recording(plant: FilmPlant, folder: Path, seed: int) -> None:
    """Write a plant's recording into a folder, created if absent."""
    folder.mkdir(parents=True, exist_ok=True)
    campaign, read = readings(plant, seed)
    write_recording(folder, f"film plant {plant.case.value}", read, campaign.circuit)


def diagnosed(plant: FilmPlant, seed: int = SEED, film_tables: bool = False) -> tuple[str, ...]:
    """A row of HEAD: the verdict of `swashfilm diagnose` on a plant's recording."""
    known, begun = load_known_pump(BENCH), process_time()
    with tempfile.TemporaryDirectory() as folder:
        write_film_recording(plant, Path(folder), seed)
        catalogue = with_films_solved(known.pump) if film_tables else CATALOGUE
        found = diagnose(known, Path(folder), catalogue=catalogue).diagnosis
    spent = f"{process_time() - begun:.0f}"
    return plant.case.value, _effects(plant.concealed) or "nothing", *_row(found), spent


def _effects(listed: Iterable[tuple[str, str | None]]) -> str:
    return ", ".join(f"{effect} ({pair})" if pair else effect for effect, pair in listed)


def _gaps(claim: ClaimedEffect) -> str | None:
    """The likeliest gap, and those inseparable from it."""
    if claim.pair is None:
        return None
    return " or ".join([claim.pair.value, *(gap.value for gap, _ in claim.elsewhere)])


def _row(found: Diagnosis) -> tuple[str, ...]:
    said = _effects((one.effect.value, _gaps(one)) for one in found.effects)
    sizes = "; ".join(
        f"{size.name} {size.value:.3g} +- {size.sigma:.2g}" for one in found.effects for size in one.parameters
    )
    fit = found.fit
    ratios = ", ".join(
        f"{name.value} {fit.before[name] / fit.noise[name]:.2f} / {fit.after[name] / fit.noise[name]:.2f}"
        for name in fit.before
    )
    chi2 = " / ".join(f"{one.objective / one.residual.size:.2f}" for one in (found.before, found.after))
    return said or found.kind.value, found.status.value, sizes, ratios, chi2
