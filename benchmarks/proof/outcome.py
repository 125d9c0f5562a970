"""Outcome of a case: the truth beside the verdict, as plain values that a file keeps."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(frozen=True)
class Ranked:
    """One explanation in the comparison."""

    effects: tuple[str, ...]
    pairs: tuple[str | None, ...]
    kind: str
    probability: float


@dataclass(frozen=True)
class Claimed:
    """One effect that was claimed, ids inseparable from it, and gaps inseparable from `pair`."""

    effect: str
    pair: str | None
    probability: float
    equivalent: tuple[str, ...]
    elsewhere: tuple[str, ...] = ()


@dataclass(frozen=True)
class Rival:
    """Finding of another method on the same recording: whether it finds a mismatch, and its name."""

    alarm: bool
    named: tuple[str, ...]


@dataclass(frozen=True)
class Worth:
    """Evidence of readings recorded after the diagnosis for two explanations, one of them the truth, in nats for it.

    before: by the recording; asked: three more readings at each of the proposed points; other: at as many points drawn
    from the same box; foretold: predicted gain of the proposed test. promised: the chance of odds of 20 to 1 stated
    with the test. points: the proposed ones; meter: channel of the proposed meter, empty without one.
    """

    before: float
    asked: float
    other: float
    promised: float
    foretold: float = 0.0
    points: int = 1
    meter: str = ""


@dataclass(frozen=True)
class Outcome:
    """The truth and the verdict on it.

    score: reached; effects, pairs: of the truth; beside: ids of faults beside it, which may be named too; shares: of
    the channels in the square of the truth's shift, which is in sigma of a reading. true_turn, turn: shaft angles in
    rad between which pressure differs, in truth and as stated; region: stated points, all of them for the whole map,
    None without a channel; oracle: channel -> rms held out by the fit of the truth's own law. heldout: channel ->
    (before, after, noise), SI; covered: parameter -> whether its 90 % interval holds the truth; program: digest of the
    diagnosing program; failed: reason of a missing verdict.
    """

    name: str
    part: str
    campaign: str
    seed: int
    asked: float
    score: float
    sizes: dict[str, float]
    truth: str
    effects: tuple[str, ...]
    pairs: tuple[str | None, ...]
    shares: dict[str, float]
    beside: tuple[str, ...] = ()
    shift: dict[str, tuple[float, ...]] = field(default_factory=dict)
    true_turn: tuple[float, float] | None = None
    verdict: str = "none"
    status: str = "none"
    claims: tuple[Claimed, ...] = ()
    ranked: tuple[Ranked, ...] = ()
    nothing: float = 0.0
    channels: tuple[str, ...] = ()
    region: tuple[int, ...] | None = None
    turn: tuple[float, float] | None = None
    heldout: dict[str, tuple[float, float, float]] = field(default_factory=dict)
    oracle: dict[str, float] = field(default_factory=dict)
    worth: Worth | None = None
    covered: dict[str, bool] = field(default_factory=dict)
    chi2: tuple[float, float] = (0.0, 0.0)
    chance: float = 1.0
    reasons: tuple[str, ...] = ()
    rivals: dict[str, Rival] = field(default_factory=dict)
    seconds: float = 0.0
    program: str = ""
    failed: str = ""


def as_plain(outcome: Outcome) -> dict[str, Any]:
    """For a JSON file."""
    return asdict(outcome)


def from_plain(data: dict[str, Any]) -> Outcome:
    """The inverse of `as_plain` after JSON."""
    kept = dict(data)
    kept["claims"] = tuple(
        Claimed(**{**one, **{name: tuple(one[name]) for name in ("equivalent", "elsewhere")}}) for one in data["claims"]
    )
    kept["ranked"] = tuple(
        Ranked(tuple(one["effects"]), tuple(one["pairs"]), one["kind"], one["probability"]) for one in data["ranked"]
    )
    kept["rivals"] = {name: Rival(one["alarm"], tuple(one["named"])) for name, one in data["rivals"].items()}
    kept["heldout"] = {name: tuple(one) for name, one in data["heldout"].items()}
    kept["shift"] = {name: tuple(one) for name, one in data["shift"].items()}
    kept["worth"] = Worth(**data["worth"]) if data["worth"] else None
    kept.setdefault("beside", ())
    for name in ("effects", "pairs", "beside", "channels", "chi2", "reasons", "true_turn", "region", "turn"):
        kept[name] = None if kept[name] is None else tuple(kept[name])
    return Outcome(**kept)
