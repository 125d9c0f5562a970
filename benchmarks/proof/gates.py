"""The gates of the proof (docs/proof.md): what is asked, what was found, on how many cases."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from diagnosis.thresholds import load_thresholds

from .calibration import brier, calibration_error, wilson
from .judged import in_set, is_grave, is_named, is_right, is_wrong_name, rank
from .located import region_overlap, turn_error
from .outcome import Outcome, Worth
from .removed import LEAST, excess, left_by_nothing, removed, removed_of_all

PHYSICS, SENSOR, UNKNOWN, NULL = "missing_physics", "sensor_fault", "unknown_physics", "no_mismatch"
FAILED = "none"  # the verdict where no diagnosis came about
KNOWN = ("graded", "pair", "parameter", "sensor")
CLEAR = 7.5  # score from which a case counts as z >= 8: sizes are found to 2 %
TRACED = "map"  # the campaign with chamber traces
Outcomes = Sequence[Outcome]
T = TypeVar("T")
LIMITS = load_thresholds().next_point


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
        _share("no diagnosis, all cases", outcomes, _is_failed, at_most=0.0),
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
        _beside(
            _share("a suspicion or a class at z = 3", small, _abstains, at_least=0.60),
            f"{sum(one.verdict == NULL for one in small)} more with the verdict no mismatch",
        ),
        _share("wrong names at z = 3", small, is_wrong_name, at_most=0.02),
        _share("both of two effects, z = 10 each", pairs, is_right, at_least=0.95),
    )


def _kinds(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Kinds of explanation that are taken for each other, and what is in no catalogue."""
    known = [one for one in outcomes if one.part in KNOWN]
    unknown = [one for one in outcomes if one.truth == UNKNOWN and one.score >= CLEAR]
    sensor, physics = (_seen([one for one in known if one.truth == kind]) for kind in (SENSOR, PHYSICS))
    return (
        _share("sensor called physics", sensor, _is(PHYSICS, UNKNOWN), at_most=0.03),
        _share("physics called sensor", physics, _is(SENSOR), at_most=0.03),
        _share("unknown physics recognised at z >= 8", unknown, is_right, at_least=0.85),
        _share("unknown physics given a name at z >= 8", unknown, _sure_name, at_most=0.05),
    )


def _places(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Where: channel, gap, region of the map, shaft angle."""
    clear = _clear(outcomes)
    right = [one for one in clear if is_right(one)]
    placed = [one for one in _seen(clear) if any(one.pairs)]
    traced = [one for one in outcomes if one.part == "trace"]
    sound = [one for one in outcomes if one.truth == NULL and one.campaign == TRACED]
    return (
        _share("channel at z >= 8, of cases with a mismatch found", _seen(clear), _channel, at_least=0.99),
        _share("gap claimed at z >= 8, of cases with a mismatch found and a gap", placed, _gap, at_least=0.90),
        _median("region, points in both over points in one, right names at z >= 8", right, region_overlap,
                at_least=0.7),
        _median("error of the shaft angle, deg, of effects in traces only", traced, turn_error, at_most=4.0),
        _share("a shaft angle named where nothing is concealed", sound, _turned, at_most=0.05),
    )  # fmt: skip


def _fits(outcomes: Outcomes) -> tuple[Gate, ...]:
    """What the repaired simulation foretells, intervals, probabilities, and what the next point is worth."""
    clear = _clear(outcomes)
    right = [one for one in clear if is_right(one)]
    over = _median("held-out residual over that of the truth's own fit, z >= 8", clear, _over_oracle, at_most=1.05)
    to_remove = [one for one in right if excess(one)[0] > LEAST]
    return (
        _median("held-out residual over noise, right names at z >= 8", right, _left, at_most=1.1),
        _beside(over, f"the right name's fit is the truth's own in {sum(map(_is_own, clear))}"),
        _median("removed share of the residual beyond the stated noise", to_remove, removed, at_least=0.90),
        _removed_of_all(right, [one for one in outcomes if one.truth == NULL]),
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
    name: str, cases: Outcomes, value: Callable[[Outcome], float], at_most: float = np.inf, at_least: float = -np.inf
) -> Gate:
    asked = f"<= {at_most:g}" if np.isfinite(at_most) else f">= {at_least:g}"
    told = np.array([value(one) for one in cases])
    known = told[np.isfinite(told)]
    if not known.size:
        return Gate(name, asked, "-", len(cases), False if len(cases) else None)
    worst = np.inf if np.isfinite(at_most) else -np.inf
    middle = float(np.median(np.where(np.isfinite(told), told, worst)))
    missing = f"; {told.size - known.size} without, counted as missed" if known.size < told.size else ""
    found = f"{middle:.2f} median of {told.size}, {known.min():.2f} to {known.max():.2f}{missing}"
    return Gate(name, asked, found, told.size, at_least <= middle <= at_most)


def _beside(gate: Gate, text: str) -> Gate:
    """The gate with something told beside what was found."""
    return replace(gate, found=f"{gate.found}; {text}") if gate.cases else gate


def _number(name: str, cases: Outcomes, value: Callable[[Outcomes], float], limit: float) -> Gate:
    if not cases:
        return Gate(name, f"<= {limit:g}", "-", 0, None)
    found = value(cases)
    return Gate(name, f"<= {limit:g}", f"{found:.3f}", len(cases), found <= limit)


def _asked(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Of two explanations that the recording leaves open: whether three more readings settle them.

    By the point asked for, by one drawn at random; and by the point where the verdict says that it will.
    """
    left_open = [one.worth for one in outcomes if one.worth is not None and abs(one.worth.before) < LIMITS.settled]
    promised = [worth for worth in left_open if worth.promised >= LIMITS.promised]
    return (
        _share("open pairs settled by the requested point, 3 readings", left_open, _by_asked, at_least=0.8),
        _share("open pairs settled where the verdict says so", promised, _by_asked, at_least=0.8),
        _share("open pairs settled by a random point", left_open, _by_other, at_most=0.3),
    )


def _by_asked(worth: Worth) -> bool:
    return _settles(worth, worth.asked)


def _by_other(worth: Worth) -> bool:
    return _settles(worth, worth.other)


def _settles(worth: Worth, told: float) -> bool:
    return worth.before + told >= LIMITS.settled


def _removed_of_all(right: Outcomes, nulls: Outcomes) -> Gate:
    name, asked = ("removed share, all right names together, of the residual beyond that of nulls", ">= 0.9")
    floor = left_by_nothing(nulls)
    known = [one for one in right if all((one.campaign, channel) in floor for channel in one.heldout)]
    if not known:
        return Gate(name, asked, "-", 0, None)
    share, low, high = removed_of_all(known, floor)
    return Gate(name, asked, f"{share:.2f} of {len(known)} ({low:.2f} to {high:.2f})", len(known), share >= 0.9)


def _coverage(outcomes: Outcomes) -> Gate:
    name, asked = "90 % intervals of parameters that contain the truth", "86 % to 94 %"
    parts = dict.fromkeys(one.part for one in outcomes if one.covered)
    held = {part: [inside for one in outcomes if one.part == part for inside in one.covered.values()] for part in parts}
    inside = [one for part in held.values() for one in part]
    if not inside:
        return Gate(name, asked, "-", 0, None)
    share = float(np.mean(inside))
    by_part = ", ".join(f"{part} {np.mean(own):.0%} of {len(own)}" for part, own in held.items())
    return Gate(name, asked, f"{share:.1%} of {len(inside)}: {by_part}", len(inside), 0.86 <= share <= 0.94)


def _seen(cases: Outcomes) -> list[Outcome]:
    return [one for one in cases if one.verdict not in (NULL, FAILED)]


def _is_failed(one: Outcome) -> bool:
    return one.verdict == FAILED


def _is(*verdicts: str) -> Callable[[Outcome], bool]:
    """Whether a verdict is of some kinds, and not by a class that holds the truth."""
    return lambda one: one.verdict in verdicts and is_named(one) and not is_right(one)


def _abstains(one: Outcome) -> bool:
    return one.status in ("suspicion", "class")


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


def _is_own(one: Outcome) -> bool:
    """Whether the fit shown is that of the truth's own law: what a right name shows is."""
    return is_right(one) and bool(one.oracle)
