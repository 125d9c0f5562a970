"""docs/proof.md: gates, pictures, rivals and every case, failures first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from diagnosis.thresholds import load_thresholds

from .again import sentence as tried_again
from .calibration import draw
from .cases import Part, cases
from .expected import given
from .gates import CLEAR, gates
from .judged import is_grave, is_named, is_right, is_wrong_name
from .markdown import table
from .outcome import Outcome
from .parts import Plant, plant_of
from .real import TITLES
from .store import load, name_of_folder, outcomes as kept_outcomes, program
from .told import Told, load_told
from .wide.page import section as on_three_plants

PICTURE = "proof_calibration.png"
HEAD = """# Proof of the diagnosis

Results of `swashfilm diagnose` on recordings of simulated plants. The plant (`benchmarks/proof/plant`) shares nothing
with the program. It has chambers by balance of mass, films integrated along their length, unlike pistons, and another
law for every concealed effect. Its sensors have noise with memory and heavy tails, calibration errors within the stated
class, and steps. Each machine is drawn within the stated tolerances.

The size of a concealed effect is its score z: the length of the shift in the readings, in sigma, that remains after the
uncertain parameters are fitted. The plant alone computes z. Two effects have sizes of their own. A worn groove shows in
chamber traces only. An inlet line with incomplete filling begins at a knee, beyond which a single point moves by tens
of sigma.

    mkdir -p build/proof && tar -xf benchmarks/proof/outcomes.tar.xz -C build/proof    unpacks the outcomes of this page
    python benchmarks/proof.py                 runs the missing cases, then writes this page
    python benchmarks/proof.py --cases 0       writes this page from the outcomes
    python benchmarks/proof.py --record        writes the track record that a diagnosis tells of itself
    python benchmarks/proof.py --write graded 3 FOLDER    one recording, of examples/recordings/bench_pump.toml
    python benchmarks/proof.py --part rough-null          the missing cases of one part

Campaigns:

- `map`: 112 points (4 strokes, 4 speeds, 7 pressures, one temperature), chamber traces at four of them.
- `ovens`: 168 points at three inlet temperatures.
- `scattered`: 90 points over stroke, speed, pressure, temperature, charge and case pressure.
- `short`: 60 such points at one charge pressure that is not measured.
- `open circuit`: 100 points from a tank, the last twenty with the inlet throttled step by step.
- `no inlet meter`: 140 points without `Q_in`.

Unless stated otherwise each campaign measures `Q_out`, `Q_in`, `Q_case` and `torque`.

"""
GATES = """
The gates were set before the program was written. A case without a required number counts as missed.

- Cases of two parts of the first plant may share a seed: their machine and, on the same campaign, their noise. Cases
  of one part have seeds of their own. Intervals take all cases as independent.
- Small sizes: the gate requires a suspicion or a class. At z = 3 a recording is often rightly taken as one without
  mismatch; such verdicts are counted separately.
- Unknown physics counts as recognised where it is the verdict, or in the class of every claim, as an effect does.
- Gap: counts where the truth has a gap, whatever the claim. A suspicion claims nothing and counts as missed.
- Region: the true region is where the first-named channel shifts by at least half of its largest shift.
- Window: the true window holds four fifths of the squared difference of the chamber pressures.
- The truth's own fit has the catalogue's law of the concealed effect, which is not the plant's law. The fit of a right
  name is that fit, so only other names can miss the gate above.
- Readings have tails beyond the stated noise, which no law removes. They are a part of the residual that the stated
  noise does not explain; at z = 8 they are most of it.
- The removed share of all right names together subtracts the residual of nulls of the same campaign and channel,
  because the excess of one case scatters as much as its size.
- An open pair: the recording leaves the odds below 20 to 1, and one of the two is the truth. What the verdict asks for
  may settle it: up to three points, three readings each by the plant's bench, with one meter more where points alone do
  not. The plants read drains of one gap and the uncoupled torque meter by their own laws. The verdict says that a test
  settles the pair where its chance is at least 80 %, whichever of the two is true; otherwise it tells the chance. The
  random points are as many, without a meter.
- Intervals are those of parameters with the same meaning in plant and simulation, under right names. No recording of
  this kind separates clearance of the piston, eccentricity and sealing length; they are not among them.
- Probabilities are those of ids, the gaps of one id together. Where a verdict claims fewer effects than the likeliest
  explanation has, its claims are scored as they are told: by all explanations that hold them.
- Sure is what is stated at a probability of .9 at least, of a claim with its class. The status does not count: a name
  on a pump known by its type plate is told with the probability of the record of such names.
"""


def write_page(results: Path, page: Path, seed: int) -> None:
    """Write the page and its picture from the outcomes in a folder."""
    page.parent.mkdir(parents=True, exist_ok=True)
    planned = [case for part in Part for case in cases(part, seed)]
    outcomes = kept_outcomes(results, planned)
    first = [one for one in outcomes if plant_of(one.part) is Plant.FIRST]
    pieces = [HEAD, _made_of(planned, outcomes, seed, tried_again(results))]
    if first:
        draw(first, page.with_name(PICTURE))
        pieces += [_gates(first), GATES, _calibration()]
    if len(first) < len(outcomes):
        pieces.append(on_three_plants(outcomes))
    if outcomes:
        pieces.append(_grades(outcomes))
    if first:
        pieces.append(_rivals(first))
    known = (load(results, name_of_folder(folder)) for folder in given())
    bench = [one for one in known if one is not None]
    if bench:
        pieces.append("\n## Recordings with known answers\n\n" + _given(bench))
    pieces += [_section(each) for each in map(partial(load_told, results), TITLES) if each is not None]
    if outcomes:
        pieces.append(_cases(outcomes))
    page.write_text("".join(pieces), encoding="utf-8")


def _made_of(planned: Sequence[object], outcomes: Sequence[Outcome], seed: int, again: str) -> str:
    """How many cases there are, by which state of the program; again: a sentence on those tried again."""
    limits = load_thresholds()
    stale = sum(one.program != program() for one in outcomes)
    counts = Counter(one.part for one in outcomes)
    rows = [(part.value, str(len(cases(part, seed))), str(counts[part.value]), _seeds(part, seed)) for part in Part]
    return (
        f"{len(outcomes)} of {len(planned)} cases have been run; {stale} of them by another state of the program "
        f"than this page's ({program()}).\n{again}The first cases of each part are a fair sample of it. Thresholds: "
        f"`diagnosis/thresholds.toml`, sha256 of its values `{limits.digest}`. Seed of the proof {seed}.\n\n"
        + table(("part", "planned", "run", "seeds"), rows)
    )


def _seeds(part: Part, seed: int) -> str:
    used = sorted(case.seed for case in cases(part, seed))
    return f"{used[0]} to {used[-1]}"


def _gates(outcomes: Sequence[Outcome]) -> str:
    words = {True: "held", False: "**missed**", None: "no case yet"}
    rows = [(one.name, one.asked, one.found, words[one.passed]) for one in gates(outcomes)]
    return "\n## Gates\n\n" + table(("gate", "required", "found", ""), rows)


def _calibration() -> str:
    return f"\n## Calibration of the probabilities\n\n![reliability diagram]({PICTURE})\n"


def _grades(outcomes: Sequence[Outcome]) -> str:
    """Shares of mismatches detected, named right and named wrong, by part and score."""
    rows = []
    for part in Part:
        own = [one for one in outcomes if one.part == part.value]
        own_size = "-" if part.value.endswith("null") else "own size"
        for asked in sorted({one.asked for one in own}):
            at = [one for one in own if one.asked == asked]
            seen = sum(map(_sees, at))
            told = sum(one.status == "suspicion" for one in at)
            rows.append((
                part.value, f"{asked:g}" if asked else own_size, str(len(at)), str(seen), str(told),
                str(sum(map(is_right, at))), str(sum(map(is_wrong_name, at))), str(sum(map(is_grave, at))),
            ))  # fmt: skip
    head = ("part", "z", "cases", "mismatch found", "of it suspicion", "right", "wrong name", "wrong and sure")
    return "\n## By size\n\n" + table(head, rows)


def _rivals(outcomes: Sequence[Outcome]) -> str:
    """Other ways and ablations on the same recordings."""
    judged = [one for one in outcomes if one.rivals]
    nulls = [one for one in judged if one.truth == "no_mismatch"]
    clear = [one for one in judged if one.part in ("graded", "parameter", "sensor") and one.score >= CLEAR]
    unknown = [one for one in judged if one.truth == "unknown_physics"]
    rows = [
        (
            name, _of(sum(map(seen, nulls)), nulls), _of(sum(map(seen, clear)), clear),
            _of(sum({claim.effect for claim in one.claims} == set(one.effects) for one in clear), clear),
            _of(sum(bool(one.claims) for one in unknown), unknown),
        )
        for name, seen in (
            ("this diagnosis, claims", is_named), ("this diagnosis, with suspicions", _sees)
        )
    ]  # fmt: skip
    for name in judged[0].rivals if judged else ():
        rows.append((
            WAYS.get(name, name), _of(sum(one.rivals[name].alarm for one in nulls), nulls),
            _of(sum(one.rivals[name].alarm for one in clear), clear),
            _of(sum(set(one.rivals[name].named) == set(one.effects) for one in clear), clear),
            _of(sum(_listed(one.rivals[name].named) for one in unknown), unknown),
        ))  # fmt: skip
    head = (
        "way",
        "alarm on nulls",
        "alarm at z >= 8",
        "the right id at z >= 8",
        "name for an effect outside the catalogue",
    )
    return "\n## Comparison with other methods, and ablations\n\n" + table(head, rows)


WAYS = {
    "screen": "linear screen alone", "no input noise": "screen without noise of the inputs",
    "fluid law held": "screen with the oil's law fixed", "no unknown physics": "screen without unknown physics",
    "no signs": "screen without signs", "largest residual": "largest residual, usual suspect",
    "stepwise BIC": "stepwise by BIC on the catalogue's columns",
    "sparse regression": "sparse regression on textbook terms", "Gaussian process": "Gaussian-process discrepancy",
}  # fmt: skip


def _sees(one: Outcome) -> bool:
    """Whether a mismatch is reported at all, be it as a suspicion."""
    return one.verdict not in ("no_mismatch", "none")


def _listed(named: Sequence[str]) -> bool:
    return bool(named) and tuple(named) != ("unknown_physics",)


def _of(hits: int, among: Sequence[object]) -> str:
    return f"{hits} of {len(among)}" if among else "-"


def _section(each: Told) -> str:
    """A table of other recordings; one that another state of the program made is marked as such."""
    stale = "" if each.program == program() else f"\n\nMade by another state of the program ({each.program})."
    return f"\n## {each.title}\n\n{each.text}{stale}\n\n" + table(each.head, each.rows)


def _given(bench: Sequence[Outcome]) -> str:
    """Verdict and answer side by side, and the residual at points held out."""
    rows = [
        (
            one.name, f"{one.truth}: {_answer(one)}" if one.effects else one.truth, _mark(one), _told(one),
            ", ".join(f"{name} {after / noise:.2f}" for name, (_, after, noise) in one.heldout.items()),
            f"{one.seconds:.0f}",
        )
        for one in sorted(bench, key=_gravity)
    ]  # fmt: skip
    return table(("recording", "answer", "", "verdict", "held out, of the noise", "s"), rows)


def _answer(one: Outcome) -> str:
    pairs = zip(one.effects, one.pairs, strict=True)
    return ", ".join(f"{effect} ({pair})" if pair else effect for effect, pair in pairs)


def _cases(outcomes: Sequence[Outcome]) -> str:
    """Every case, the gravest first."""
    rows = [
        (one.name, f"{one.score:.1f}", _mark(one), _told(one), f"{one.nothing:.2f}", f"{one.seconds:.0f}")
        for one in sorted(outcomes, key=_gravity)
    ]
    head = ("case", "z reached", "", "verdict", "P(nothing)", "s")
    return "\n## Every case\n\n" + table(head, rows)


def _gravity(one: Outcome) -> tuple[object, ...]:
    return -is_grave(one), -is_wrong_name(one), is_right(one), one.part, one.seed, one.name


def _mark(one: Outcome) -> str:
    mark = "**wrong and sure**" if is_grave(one) else "**wrong**" if is_wrong_name(one) else ""
    return mark or ("right" if is_right(one) else "not named")


def _told(one: Outcome) -> str:
    claims = "; ".join(
        f"{each.effect}{f' ({each.pair})' if each.pair else ''} {each.probability:.2f}"
        + (f" or {', '.join(each.equivalent)}" if each.equivalent else "")
        + (f" or at {', '.join(each.elsewhere)}" if each.elsewhere else "")
        for each in one.claims
    )
    text = f"{one.verdict}, {one.status}"
    return f"{text}: {claims or one.failed}" if claims or one.failed else text
