"""The gates of design/diagnosis.md 4.3, column `outstanding`: what is asked, what was found, on how many cases."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from diagnosis.next_point import PROMISED, SETTLED

from .calibration import brier, calibration_error, wilson
from .judged import in_set, is_grave, is_named, is_right, is_wrong_name, rank
from .located import region_overlap, turn_error
from .outcome import Outcome, Worth

PHYSICS, SENSOR, UNKNOWN, NULL = "missing_physics", "sensor_fault", "unknown_physics", "no_mismatch"
PLACED = {"elastic_opening", "thermal_clearance", "film_thickness"}  # ids that act in one gap
KNOWN = ("graded", "pair", "parameter", "sensor")
CLEAR = 7.5  # score from which a case counts as z >= 8: sizes are found to 2 %
TRACED = "map"  # the campaign with chamber traces
Outcomes = Sequence[Outcome]
T = TypeVar("T")


@dataclass(frozen=True)
class Gate:
    """One line: what is asked in words, what was found, how many cases it rests on; None: no case yet."""

    name: str
    asked: str
    found: str
    cases: int
    passed: bool | None


def gates(outcomes: Outcomes) -> tuple[Gate, ...]:
    """All gates, the missed ones first, those without a case last."""
    listed = (*_alarms(outcomes), *_names(outcomes), *_kinds(outcomes), *_places(outcomes), *_fits(outcomes))
    order = {False: 0, True: 1, None: 2}
    return tuple(sorted(listed, key=lambda one: order[one.passed]))


def _alarms(outcomes: Outcomes) -> tuple[Gate, ...]:
    nulls = [one for one in outcomes if one.truth == NULL]
    return (
        _share("false alarm on nulls: something is claimed", nulls, is_named, at_most=0.03),
        _wilson("false alarm on nulls, upper end of Wilson's interval", nulls, is_named, 0.065),
        _share("wrong, P >= 0.9 and unflagged, all cases", outcomes, is_grave, at_most=0.01),
    )


def _names(outcomes: Outcomes) -> tuple[Gate, ...]:
    graded, clear = [one for one in outcomes if one.part == "graded"], _clear(outcomes)
    medium = [one for one in graded if 4.5 <= one.score < CLEAR]
    small = [one for one in graded if one.score < 3.5]
    pairs = [one for one in outcomes if one.part == "pair"]
    return (
        _share("top-1 at z >= 8", clear, lambda one: rank(one) == 1, at_least=0.95),
        _share("truth among the first two at z >= 8", clear, lambda one: (rank(one) or 99) <= 2, at_least=0.99),
        _share("top-1 at z = 5", medium, lambda one: rank(one) == 1, at_least=0.80),
        _share("truth in the 95 % set at z = 5", medium, in_set, at_least=0.95),
        _share("no claim, or a class, at z = 3", small, _abstains, at_least=0.60),
        _share("wrong names at z = 3", small, is_wrong_name, at_most=0.02),
        _share("both of two effects, z = 10 each", pairs, is_right, at_least=0.95),
    )


def _kinds(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Kinds of explanation that are taken for each other, and what is in no catalogue."""
    known = [one for one in outcomes if one.part in KNOWN]
    unknown = [one for one in outcomes if one.truth == UNKNOWN and one.score >= CLEAR]
    sensor, physics = (_seen([one for one in known if one.truth == kind]) for kind in (SENSOR, PHYSICS))
    return (
        _share("sensor called physics", sensor, _is(PHYSICS), at_most=0.03),
        _share("physics called sensor", physics, _is(SENSOR), at_most=0.03),
        _share("unknown physics recognised at z >= 8", unknown, is_right, at_least=0.85),
        _share("unknown physics given a name at z >= 8", unknown, _sure_name, at_most=0.05),
    )


def _places(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Where: channel, gap, region of the map, shaft angle."""
    clear = _clear(outcomes)
    right = [one for one in clear if is_right(one)]
    placed = [one for one in right if set(one.effects) & PLACED]
    traced = [one for one in outcomes if one.part == "trace"]
    sound = [one for one in outcomes if one.truth == NULL and one.campaign == TRACED]
    return (
        _share("channel at z >= 8, of those that see a mismatch", _seen(clear), _channel, at_least=0.99),
        _share("likeliest gap at z >= 8, of right names that have one", placed, _gap, at_least=0.90),
        _median("region, points in both over points in one, right names at z >= 8", right, region_overlap,
                at_least=0.7),
        _median("shaft angle off, deg, of what shows in traces only", traced, turn_error, at_most=4.0),
        _share("a shaft angle told where nothing is concealed", sound, _turned, at_most=0.05),
    )  # fmt: skip


def _fits(outcomes: Outcomes) -> tuple[Gate, ...]:
    """What the repaired simulation foretells, intervals, probabilities, and what the next point is worth."""
    clear = _clear(outcomes)
    right = [one for one in clear if is_right(one)]
    return (
        _median("held-out residual over noise, right names at z >= 8", right, _left, at_most=1.1),
        _median("held-out residual over that of the truth's own fit, z >= 8", clear, _over_oracle, at_most=1.05),
        _median("removed share of what noise does not explain", right, _removed, at_least=0.90),
        _coverage(outcomes),
        _number("Brier score of the likeliest, on the declared mix", outcomes, brier, 0.06),
        _number("calibration error (ECE) on the declared mix", outcomes, calibration_error, 0.05),
        *_asked(outcomes),
    )


def _clear(outcomes: Outcomes) -> list[Outcome]:
    return [one for one in outcomes if one.part in KNOWN and one.part != "pair" and one.score >= CLEAR]


def _share(
    name: str, cases: Sequence[T], test: Callable[[T], bool], at_most: float = 1.0, at_least: float = 0.0
) -> Gate:
    hits, count = sum(map(bool, map(test, cases))), len(cases)
    asked = f"<= {at_most:.0%}" if at_most < 1.0 else f">= {at_least:.0%}"
    if not count:
        return Gate(name, asked, "-", 0, None)
    low, high = wilson(hits, count)
    found = f"{hits / count:.1%} ({hits} of {count}; {low:.0%} to {high:.0%})"
    return Gate(name, asked, found, count, at_least <= hits / count <= at_most)


def _wilson(name: str, cases: Outcomes, test: Callable[[Outcome], bool], limit: float) -> Gate:
    high = wilson(sum(map(test, cases)), len(cases))[1]
    return Gate(name, f"<= {limit:.1%}", f"{high:.1%}", len(cases), high <= limit if cases else None)


def _median(
    name: str,
    cases: Outcomes,
    value: Callable[[Outcome], float],
    at_most: float = np.inf,
    at_least: float = -np.inf,
) -> Gate:
    values = [each for each in map(value, cases) if np.isfinite(each)]
    asked = f"<= {at_most:g}" if np.isfinite(at_most) else f">= {at_least:g}"
    if not values:
        return Gate(name, asked, "-", 0, None)
    middle = float(np.median(values))
    found = f"{middle:.2f} median, {min(values):.2f} to {max(values):.2f}"
    return Gate(name, asked, found, len(values), at_least <= middle <= at_most)


def _number(name: str, cases: Outcomes, value: Callable[[Outcomes], float], limit: float) -> Gate:
    if not cases:
        return Gate(name, f"<= {limit:g}", "-", 0, None)
    found = value(cases)
    return Gate(name, f"<= {limit:g}", f"{found:.3f}", len(cases), found <= limit)


def _asked(outcomes: Outcomes) -> tuple[Gate, Gate]:
    """Of two explanations that the recording leaves open: whether three more readings settle them.

    Where a point is asked for to settle them; the others are told to be beyond the rig, and are counted beside.
    """
    open_still = [one.worth for one in outcomes if one.worth is not None and abs(one.worth.before) < SETTLED]
    promised = [worth for worth in open_still if worth.promised >= PROMISED]
    beyond = f"{len(open_still) - len(promised)} more told to be settled by no point"
    by_asked = _share(
        "pairs settled by the point asked for, 3 readings", promised, lambda w: _settles(w, w.asked), at_least=0.8
    )
    by_other = _share("the same by a point drawn at random", promised, lambda w: _settles(w, w.other), at_most=0.3)
    return replace(by_asked, found=f"{by_asked.found}; {beyond}"), by_other


def _settles(worth: Worth, told: float) -> bool:
    return worth.before + told >= SETTLED


def _coverage(outcomes: Outcomes) -> Gate:
    inside = [held for one in outcomes for held in one.covered.values()]
    name, asked = "90 % intervals of parameters that hold the truth", "86 % to 94 %"
    if not inside:
        return Gate(name, asked, "-", 0, None)
    share = float(np.mean(inside))
    return Gate(name, asked, f"{share:.1%} of {len(inside)}", len(inside), 0.86 <= share <= 0.94)


def _seen(cases: Outcomes) -> list[Outcome]:
    return [one for one in cases if one.verdict != NULL]


def _is(verdict: str) -> Callable[[Outcome], bool]:
    """Whether a verdict is of a kind, and not by a class that holds the truth."""
    return lambda one: one.verdict == verdict and is_named(one) and not is_right(one)


def _abstains(one: Outcome) -> bool:
    return not is_named(one) or one.status == "class"


def _sure_name(one: Outcome) -> bool:
    return bool(one.claims) and one.status in ("named", "class")


def _channel(one: Outcome) -> bool:
    """The first located channel is one that carries a fifth of the shift at least."""
    return bool(one.channels) and one.shares.get(one.channels[0], 0.0) >= 0.2


def _gap(one: Outcome) -> bool:
    return {claim.pair for claim in one.claims} == set(one.pairs)


def _turned(one: Outcome) -> bool:
    return one.turn is not None


def _left(one: Outcome) -> float:
    """RMS over the channels of what is left on points held out, in its noise; nan where nothing was held out."""
    if not one.heldout:
        return float("nan")
    return float(np.sqrt(np.mean([(after / noise) ** 2 for _, after, noise in one.heldout.values()])))


def _over_oracle(one: Outcome) -> float:
    """Mean square of what is left in the fit shown over that left by the truth's own fit, in noise, as a root."""
    if not one.oracle:
        return float("nan")
    left = [(after / noise) ** 2 for _, after, noise in one.heldout.values()]
    best = [(one.oracle[name] / noise) ** 2 for name, (_, _, noise) in one.heldout.items()]
    return float(np.sqrt(np.sum(left) / np.sum(best)))


def _removed(one: Outcome) -> float:
    """1 - (after^2 - noise^2)/(before^2 - noise^2) over all channels in their noise; nan where none was there."""
    if not one.heldout:
        return float("nan")
    before, after = (sum((each[k] / each[2]) ** 2 - 1.0 for each in one.heldout.values()) for k in (0, 1))
    return 1.0 - max(after, 0.0) / before if before > 0.2 else float("nan")
