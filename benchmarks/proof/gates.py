"""The gates of the proof (docs/proof.md): requirements, results, numbers of cases."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from diagnosis.thresholds import load_thresholds

from .calibration import brier, calibration_error
from .gate import Gate, Outcomes, beside, median, number, share, wilson_end
from .judged import in_set, is_grave, is_named, is_open, is_right, is_wrong_name, rank
from .located import region_overlap, turn_error
from .outcome import Outcome, Worth
from .removed import LEAST, excess, left_by_nothing, removed, removed_of_all

PHYSICS, SENSOR, UNKNOWN, NULL = "missing_physics", "sensor_fault", "unknown_physics", "no_mismatch"
FAILED = "none"  # the verdict without a diagnosis
KNOWN = ("graded", "pair", "parameter", "sensor")
CLEAR = 7.5  # score from which a case counts as z >= 8: sizes are found to 2 %
TRACED = "map"  # the campaign with chamber traces
LIMITS = load_thresholds().next_point


def gates(outcomes: Outcomes) -> tuple[Gate, ...]:
    """All gates, the missed ones first, those without a case last."""
    listed = (*_alarms(outcomes), *_names(outcomes), *_kinds(outcomes), *_places(outcomes), *_fits(outcomes))
    order = {False: 0, True: 1, None: 2}
    return tuple(sorted(listed, key=lambda one: order[one.passed]))


def _alarms(outcomes: Outcomes) -> tuple[Gate, ...]:
    nulls = [one for one in outcomes if one.truth == NULL]
    return (
        share("false alarm on nulls: something is claimed", nulls, is_named, at_most=0.03),
        wilson_end("false alarm on nulls, upper end of Wilson's interval", nulls, is_named, 0.065),
        share("wrong, P >= 0.9 and unflagged, all cases", outcomes, is_grave, at_most=0.01),
        share("no diagnosis, all cases", outcomes, is_failed, at_most=0.0),
    )


def _names(outcomes: Outcomes) -> tuple[Gate, ...]:
    graded, clear = [one for one in outcomes if one.part == "graded"], _clear(outcomes)
    medium = [one for one in graded if 4.5 <= one.score < CLEAR]
    small = [one for one in graded if one.score < 3.5]
    pairs = [one for one in outcomes if one.part == "pair"]
    return (
        share("top-1 at z >= 8", clear, lambda one: rank(one) == 1, at_least=0.95),
        share("truth among the first two at z >= 8", clear, lambda one: (rank(one) or 99) <= 2, at_least=0.99),
        share("top-1 at z = 5", medium, lambda one: rank(one) == 1, at_least=0.80),
        share("truth in the 95 % set at z = 5", medium, in_set, at_least=0.95),
        beside(
            share("a suspicion or a class at z = 3", small, _abstains, at_least=0.60),
            f"{sum(one.verdict == NULL for one in small)} more with the verdict no mismatch",
        ),
        share("wrong names at z = 3", small, is_wrong_name, at_most=0.02),
        share("both of two effects, z = 10 each", pairs, is_right, at_least=0.95),
    )


def _kinds(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Kinds of explanation that are confused with each other, and physics in no catalogue."""
    known = [one for one in outcomes if one.part in KNOWN]
    unknown = [one for one in outcomes if one.truth == UNKNOWN and one.score >= CLEAR]
    sensor, physics = (_seen([one for one in known if one.truth == kind]) for kind in (SENSOR, PHYSICS))
    return (
        share("sensor called physics", sensor, _is(PHYSICS, UNKNOWN), at_most=0.03),
        share("physics called sensor", physics, _is(SENSOR), at_most=0.03),
        recognised(unknown),
        share("unknown physics given a name at z >= 8", unknown, _sure_name, at_most=0.05),
    )


def _places(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Where: channel, gap, region of the map, shaft angle."""
    clear = _clear(outcomes)
    right = [one for one in clear if is_right(one)]
    placed = [one for one in _seen(clear) if any(one.pairs)]
    traced = [one for one in outcomes if one.part == "trace"]
    sound = [one for one in outcomes if one.truth == NULL and one.campaign == TRACED]
    return (
        share("channel at z >= 8, of cases with a mismatch found", _seen(clear), _channel, at_least=0.99),
        share("gap claimed at z >= 8, of cases with a mismatch found and a gap", placed, _gap, at_least=0.90),
        median("region, points in both over points in one, right names at z >= 8", right, region_overlap,
                at_least=0.7),
        median("error of the shaft angle, deg, of effects in traces only", traced, turn_error, at_most=4.0),
        share("a shaft angle named where nothing is concealed", sound, _turned, at_most=0.05),
    )  # fmt: skip


def _fits(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Gates of the repaired simulation, of intervals and probabilities, and of the next test."""
    clear = _clear(outcomes)
    right = [one for one in clear if is_right(one)]
    over = median("held-out residual over that of the truth's own fit, z >= 8", clear, _over_oracle, at_most=1.05)
    to_remove = [one for one in right if excess(one)[0] > LEAST]
    return (
        median("held-out residual over noise, right names at z >= 8", right, left, at_most=1.1),
        beside(over, f"the right name's fit is the truth's own in {sum(map(_is_own, clear))}"),
        median("removed share of the residual beyond the stated noise", to_remove, removed, at_least=0.90),
        _removed_of_all(right, [one for one in outcomes if one.truth == NULL]),
        _coverage(outcomes),
        number("Brier score of the likeliest, on the declared mix", outcomes, brier, 0.06),
        number("calibration error (ECE) on the declared mix", outcomes, calibration_error, 0.05),
        *_asked(outcomes),
    )


def recognised(unknown: Outcomes) -> Gate:
    """Unknown physics reported as such, or in the class of every claim."""
    gate = share("unknown physics recognised at z >= 8", unknown, is_right, at_least=0.85)
    return beside(gate, f"{sum(is_open(one) and is_right(one) for one in unknown)} of them in the class of a name")


def _clear(outcomes: Outcomes) -> list[Outcome]:
    return [one for one in outcomes if one.part in KNOWN and one.part != "pair" and one.score >= CLEAR]


def _asked(outcomes: Outcomes) -> tuple[Gate, ...]:
    """Of two explanations that the recording leaves open: whether the next test of the verdict decides between them.

    By up to three points or one meter, by as many points drawn at random; and where the verdict predicts it.
    """
    open_pairs = left_open(outcomes)
    promised = [worth for worth in open_pairs if worth.promised >= LIMITS.promised]
    return (
        share("open pairs settled by what is asked for", open_pairs, by_asked, at_least=0.8),
        share("open pairs settled where the verdict says so", promised, by_asked, at_least=0.8),
        share("open pairs settled by random points", open_pairs, _by_other, at_most=0.3),
    )


def left_open(outcomes: Outcomes) -> list[Worth]:
    """Pairs of explanations, one of them the truth, that recordings leave open."""
    return [one.worth for one in outcomes if one.worth is not None and abs(one.worth.before) < LIMITS.settled]


def by_asked(worth: Worth) -> bool:
    """Whether the proposed point decides a pair."""
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
    taken, low, high = removed_of_all(known, floor)
    return Gate(name, asked, f"{taken:.2f} of {len(known)} ({low:.2f} to {high:.2f})", len(known), taken >= 0.9)


def _coverage(outcomes: Outcomes) -> Gate:
    name, asked = "90 % intervals of parameters that contain the truth", "86 % to 94 %"
    parts = dict.fromkeys(one.part for one in outcomes if one.covered)
    held = {part: [inside for one in outcomes if one.part == part for inside in one.covered.values()] for part in parts}
    inside = [one for part in held.values() for one in part]
    if not inside:
        return Gate(name, asked, "-", 0, None)
    held_share = float(np.mean(inside))
    by_part = ", ".join(f"{part} {np.mean(own):.0%} of {len(own)}" for part, own in held.items())
    return Gate(name, asked, f"{held_share:.1%} of {len(inside)}: {by_part}", len(inside), 0.86 <= held_share <= 0.94)


def _seen(cases: Outcomes) -> list[Outcome]:
    return [one for one in cases if one.verdict not in (NULL, FAILED)]


def is_failed(one: Outcome) -> bool:
    """Whether there is no diagnosis."""
    return one.verdict == FAILED


def _is(*verdicts: str) -> Callable[[Outcome], bool]:
    """Whether a verdict is of some kinds, and not by a class that holds the truth."""
    return lambda one: one.verdict in verdicts and is_named(one) and not is_right(one)


def _abstains(one: Outcome) -> bool:
    return one.status in ("suspicion", "class")


def _sure_name(one: Outcome) -> bool:
    return bool(one.claims) and one.status in ("named", "class") and not is_right(one)


def _channel(one: Outcome) -> bool:
    """The first located channel has a fifth of the shift at least."""
    return bool(one.channels) and one.shares.get(one.channels[0], 0.0) >= 0.2


def _gap(one: Outcome) -> bool:
    return {claim.pair for claim in one.claims} == set(one.pairs)


def _turned(one: Outcome) -> bool:
    return one.turn is not None


def left(one: Outcome) -> float:
    """RMS over the channels of the residual at points held out, in its noise; nan without such points."""
    if not one.heldout:
        return float("nan")
    return float(np.sqrt(np.mean([(after / noise) ** 2 for _, after, noise in one.heldout.values()])))


def _over_oracle(one: Outcome) -> float:
    """Root of the mean square residual of the fit shown over that of the truth's own fit, in noise."""
    if not one.oracle:
        return float("nan")
    left = [(after / noise) ** 2 for _, after, noise in one.heldout.values()]
    best = [(one.oracle[name] / noise) ** 2 for name, (_, _, noise) in one.heldout.items()]
    return float(np.sqrt(np.sum(left) / np.sum(best)))


def _is_own(one: Outcome) -> bool:
    """Whether the fit shown is that of the truth's own law, as for a right name."""
    return is_right(one) and bool(one.oracle)
