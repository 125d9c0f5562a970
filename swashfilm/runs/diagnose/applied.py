"""The pump of a finding as a file: its origin, the finding, and the fidelities that run it, as comments at its head."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import date

from diagnosis.finding import DiagnosisResult
from diagnosis.report.format import chance
from diagnosis.verdict.diagnosis import Estimate
from system.description.pump import PumpDescription
from system.effects.effect import EffectId
from system.points.film_effects import effects_in_films
from system.pump.chamber_kinds import kinds
from system.pump_file.file import resolved_toml


def applied_toml(found: DiagnosisResult, pump: PumpDescription, day: date) -> str:
    """The pump file of a finding: `pump`, fitted, under a name of its own, with its origin on the day as comments.

    It loads to the pump with that name; [tolerance] holds the fit's own sigmas.
    """
    title = _line(found.study.recording.title)
    named = replace(pump, name=f"{found.pump.name}, fitted to {title}")
    head = [*_origin(found, title, day), *_fidelities(pump)]
    return "\n".join([*(f"# {line}" for line in head), resolved_toml(named)])


def _origin(found: DiagnosisResult, title: str, day: date) -> Iterator[str]:
    finding = found.diagnosis
    points = len(found.study.recording.steady.values)
    yield f"{_line(found.pump.name)} as fitted to the recording {title!r}, {points} points, on {day.isoformat()}."
    yield f"Found: {finding.kind.value.replace('_', ' ')}, {finding.status.value}."
    for claim in finding.effects:
        pair = f" of the {claim.pair.value.replace('_', ' ')}" if claim.pair else ""
        sizes = ", ".join(map(_estimate, claim.parameters))
        yield f"  {claim.effect.value}{pair}, probability {chance(claim.probability)}{f': {sizes}' if sizes else ''}"
    yield "[tolerance] has one sigma of each value after the fit."


def _fidelities(pump: PumpDescription) -> Iterator[str]:
    """Fidelities that run the pump, and the remedy for those that do not."""
    if not kinds(pump).alike:
        yield "Its chambers differ: --fidelity lumped, fixed and floating run it."
    solved, closed = effects_in_films(pump)
    if not solved and not closed:
        if kinds(pump).alike:
            yield "It runs in every fidelity."
        return
    yield "--fidelity lumped has all effects of [physics] as closed-form laws."
    for fidelity, (solved, closed) in (("fixed", effects_in_films(pump)), ("floating", effects_in_films(pump, True))):
        if solved:
            yield f"--fidelity {fidelity} solves {_names(solved)} in the films."
        if closed:
            yield f"--fidelity {fidelity} has {_names(closed)} as closed-form laws."
    if kinds(pump).alike:
        yield "--fidelity table has the films of its points, which swashfilm table solves, and the other laws."


def _names(effects: Sequence[EffectId]) -> str:
    return ", ".join(one.value for one in effects)


def _estimate(one: Estimate) -> str:
    unit = f" {one.dimension.si_unit}" if one.dimension else ""
    return f"{one.name} {one.value:.4g} +- {one.sigma:.2g}{unit}"


def _line(text: str) -> str:
    """A text in one line of characters that a file may have."""
    return "".join(sign if sign.isprintable() else " " for sign in text)
