"""A finding as a sentence of the bench, with its sizes in the units and forms that people read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import floor, log10, pi, sqrt
from string import Formatter

from diagnosis.report.format import PLACES, last_word, listed, parameter_unit, sentence_case
from diagnosis.verdict.diagnosis import ClaimedEffect, Diagnosis, Estimate
from system.effects.catalogue.bench_words import BENCH_WORDS
from system.effects.catalogue.entries import entry_of
from system.inputs.units import Dimension

PER_PRESSURE = 1e7
"""Pa: coefficients of pressure are stated as shares per 100 bar."""


@dataclass(frozen=True)
class Size:
    """An estimate that `str.format` shows: plain with its unit, or in the form behind a colon (`FORMS`)."""

    estimate: Estimate

    def __format__(self, form: str) -> str:
        return FORMS[form](self.estimate)


def finding_sentence(claim: ClaimedEffect, diagnosis: Diagnosis) -> str:
    """Process in the pump, with sizes, without a full stop.

    The sentence of the catalogue's entry with all sizes behind a colon where the fit lacks the sizes of the words
    (solved elastic walls, for instance, have a share of the computed opening).
    """
    words = BENCH_WORDS[claim.effect].finding
    known = _fields(claim, diagnosis)
    if {name for _, name, _, _ in Formatter().parse(words) if name} <= known.keys():
        return words.format_map(known)
    sentence = entry_of(claim.effect).sentence
    place = f" at {PLACES[claim.pair]}" if claim.pair else ""
    sizes = listed(f"{last_word(one.name)} {quantity(one)}" for one in claim.parameters)
    return f"{sentence_case(sentence)}{place}{': ' if sizes else ''}{sizes}"


def size_words(claim: ClaimedEffect) -> str:
    """The first size of a claim in the form of its sentence; empty for a sentence without sizes."""
    known = {last_word(one.name).replace(" ", "_"): one for one in claim.parameters}
    asked = [(name, form) for _, name, form, _ in Formatter().parse(BENCH_WORDS[claim.effect].finding) if name]
    first = claim.parameters[0] if claim.parameters else None
    for name, form in asked:
        one = first if name == "size" else known.get(name)
        if one is not None:
            return f"{FORMS[form or ''](one)}{' per 100 bar' if form and form.endswith('per_100_bar') else ''}"
    return quantity(first) if asked and first is not None else ""


def quantity(one: Estimate) -> str:
    """A value with one sigma, to the digits that count: "0.207 +- 0.008 mm2". Temperatures are differences, in K."""
    unit, factor = parameter_unit(one.dimension, one.value)
    return f"{_rounded(one.value * factor, one.sigma * factor)} {unit.removesuffix('1')}".rstrip()


def _fields(claim: ClaimedEffect, diagnosis: Diagnosis) -> dict[str, object]:
    """Values of the fields of the sentence."""
    fields: dict[str, object] = {last_word(one.name).replace(" ", "_"): Size(one) for one in claim.parameters}
    if claim.pair:
        fields["place"] = PLACES[claim.pair]
    if claim.parameters:
        first = claim.parameters[0]
        fields |= {"size": Size(first), "part": f"the {last_word(first.name)}"}
        stated = next((one for one in diagnosis.before.parameters if one.name == first.name), None)
        if stated is not None:
            sure = Estimate(first.name, stated.centre, 0.0, first.dimension)
            fields["stated"] = quantity(sure)
    return fields


def _rounded(value: float, sigma: float) -> str:
    """Value and sigma to one digit of the sigma, to two where that begins with 1; "value" alone without a sigma."""
    if sigma <= 0.0:
        return f"{value:.4g}"
    places = -floor(log10(sigma))
    places += round(sigma, places) * 10.0**places < 2.0
    shown = max(places, 0)
    return f"{round(value, places):.{shown}f} +- {round(sigma, places):.{shown}f}"


def _percent(one: Estimate, factor: float = 100.0) -> str:
    return f"{_rounded(factor * one.value, factor * one.sigma)} %"


def _hole(one: Estimate) -> str:
    """Diameter of a round hole of this area."""
    return f"{1e3 * sqrt(4.0 * one.value / pi):.2g} mm"


def _off(one: Estimate) -> str:
    return f"{quantity(_unsigned(one))} too {'high' if one.value > 0.0 else 'low'}"


def _percent_off(one: Estimate) -> str:
    return f"{_percent(_unsigned(one))} too {'high' if one.value > 0.0 else 'low'}"


def _factor(one: Estimate) -> str:
    """A factor on a stated value as a difference."""
    beyond = Estimate(one.name, one.value - 1.0, one.sigma, None)
    return f"{_percent(_unsigned(beyond))} {'more' if beyond.value > 0.0 else 'less'}"


def _unsigned(one: Estimate) -> Estimate:
    return Estimate(one.name, abs(one.value), one.sigma, one.dimension)


FORMS: Mapping[str, Callable[[Estimate], str]] = {
    "": quantity,
    "percent": _percent,
    "per_100_bar": lambda one: _percent(one, 100.0 * PER_PRESSURE),
    "angle_per_100_bar": lambda one: quantity(
        Estimate(one.name, PER_PRESSURE * one.value, PER_PRESSURE * one.sigma, Dimension.ANGLE)
    ),
    "times": lambda one: f"{_rounded(one.value, one.sigma)} times",
    "hole": _hole,
    "off": _off,
    "percent_off": _percent_off,
    "factor": _factor,
}
"""Forms of a size in a sentence."""
