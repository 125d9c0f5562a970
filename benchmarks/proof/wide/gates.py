"""Gates on all three plants: common requirements, and the results on each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..calibration import calibration_error
from ..gate import Gate, Outcomes, median, number, share
from ..gates import CLEAR, NULL, UNKNOWN, by_asked, is_failed, left, left_open, recognised
from ..judged import in_set, is_named, is_right, is_sure_and_wrong, rank
from ..outcome import Outcome
from ..parts import Part, Plant, plant_of

SINGLE = {Part.GRADED, Part.OTHER_GRADED, Part.ROUGH_EFFECT}
ALONE = SINGLE | {Part.PARAMETER, Part.SENSOR, Part.OTHER_PARAMETER, Part.OTHER_SENSOR, Part.ROUGH_SENSOR}
PAIRS = {Part.PAIR, Part.OTHER_PAIR, Part.ROUGH_PAIR}
BOTH = 9.5  # score from which one of two counts as z >= 10: sizes are found to 2 %


def wide_gates(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Those that all plants have, of the outcomes of one."""
    nulls = [one for one in outcomes if one.truth == NULL]
    clear = [one for one in _of(outcomes, ALONE) if one.score >= CLEAR and not one.beside]
    medium = [one for one in _of(outcomes, SINGLE) if 4.5 <= one.score < CLEAR]
    pairs = [one for one in _of(outcomes, PAIRS) if one.score >= BOTH]
    unknown = [one for one in outcomes if one.truth == UNKNOWN and one.score >= CLEAR]
    right = [one for one in clear if is_right(one)]
    return (
        share("top-1 at z >= 8", clear, lambda one: rank(one) == 1, at_least=0.95),
        share("top-1 at z = 5", medium, lambda one: rank(one) == 1, at_least=0.80),
        share("both of two effects, z >= 10 each", pairs, is_right, at_least=0.90),
        recognised(unknown),
        _worst_grade(_of(outcomes, SINGLE)),
        share("nulls without a claim", nulls, lambda one: not is_named(one), at_least=0.99),
        share("nulls without a suspicion", nulls, lambda one: one.verdict == NULL, at_least=0.95),
        share("wrong and P >= 0.9, flagged or not", outcomes, is_sure_and_wrong, at_most=0.005),
        number("calibration error (ECE)", outcomes, calibration_error, 0.03),
        median("held-out residual over noise, right names at z >= 8", right, left, at_most=1.1),
        share("open pairs settled by what is asked for", left_open(outcomes), by_asked, at_least=0.8),
        share("no diagnosis", outcomes, is_failed, at_most=0.0),
    )


def by_plant(outcomes: Outcomes) -> dict[Plant, tuple[Gate, ...]]:
    """The gates of each plant."""
    return {plant: wide_gates([one for one in outcomes if plant_of(one.part) is plant]) for plant in Plant}


def _of(outcomes: Outcomes, parts: set[Part]) -> list[Outcome]:
    names = {part.value for part in parts}
    return [one for one in outcomes if one.part in names]


def _worst_grade(graded: Sequence[Outcome]) -> Gate:
    """Share in the 95 % set at the size at which it is least."""
    name, found = "truth in the 95 % set, at the worst size", []
    for z in sorted({one.asked for one in graded}):
        own = [one for one in graded if one.asked == z]
        found.append((sum(map(in_set, own)) / len(own), z, share(name, own, in_set, at_least=0.95)))
    if not found:
        return share(name, graded, in_set, at_least=0.95)
    _, z, worst = min(found, key=lambda each: each[:2])
    return replace(worst, found=f"{worst.found} at {f'z = {z:g}' if z else 'sizes of their own'}", cases=len(graded))
