"""Write docs/credibility.md: how far results may be believed, from the last run of the tests and the proofs.

    python docs/site/credibility.py

Reads docs/measured.json, which the tests write, and the tables of docs/proof.md and docs/proof_floating.md.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
sys.path.append(str(ROOT / "tests" / "support"))

from credibility_evidence import Evidence, read_evidence  # noqa: E402

PAGE = DOCS / "credibility.md"
OPENING = """\
Written by `python docs/site/credibility.py` from the last run of the tests ([measured parts](measured.md),
[validation](validation.md)) and from the [proof](proof.md) and the [proof of film physics](proof_floating.md); do not
edit. Levels of NASA-STD-7009 (2008) run from 0 to 4. They are the project's own claims; nobody outside it has reviewed
them. The overall level is the lowest one."""
FORBIDDEN = """\
## What the program must not be used for

- Release of a part for strength, life or safety. Wear is an input, not a result; fatigue, seizure, life and erosion by
  cavitation are not computed.
- Guaranteed efficiency, flow or drain of a pump that nobody has measured. The one measured machine loses twice as much
  as the program finds.
- A replacement of an acceptance test, of ISO 4409 or of a customer.
- Automatic action on a machine: shutdown, control, or exchange of a part, without a person who judges the finding.
- A charge against a supplier or a part on a diagnosis alone. The test point that the diagnosis requests comes first.
- Turbulent films, films in which the oil's inertia counts, and oils beyond their stated range of temperature.
- Starts, stops and dry running, where asperities bear most of the load: measured friction is overestimated there.
- Machines other than swash-plate axial piston pumps and motors; of other machines only single films.
- Flight, vehicle steering or braking, or any use in which a wrong number can hurt somebody, unless others verify it."""


@dataclass(frozen=True)
class Factor:
    """A credibility factor of NASA-STD-7009: the level claimed, evidence for it, and what the next level lacks."""

    name: str
    level: int
    evidence: str
    lacks: str


@dataclass(frozen=True)
class Criterion:
    """Evidence that a use requires, evidence found, and whether that suffices."""

    asked: str
    found: str
    met: bool


@dataclass(frozen=True)
class Context:
    """A context of use of ASME V&V 40."""

    name: str
    question: str
    influence: str
    consequence: str
    evidence: str
    criteria: tuple[Criterion, ...]
    use: str


def factors(found: Evidence) -> tuple[Factor, ...]:
    """The eight factors."""
    return (*_of_development(found), *_of_operation(found), *SUPPORTING)


def _of_development(found: Evidence) -> tuple[Factor, ...]:
    """Levels by rule: they fall with the results."""
    rows = found.summary
    return (
        Factor(
            "verification",
            3 if rows.ordered else 2,
            f"{rows.rows} rows of [validation](validation.md) against closed forms, published tables and manufactured "
            f"solutions, in a run all of whose tests passed; {rows.ordered} with an observed order of convergence; "
            "grid convergence index of a user's own case by `--refine`; balances of mass and energy in every result",
            f"{rows.missed} rows lie outside their tolerance, each with its reason; the error of a floating pump is "
            "estimated only where `--refine` is asked for",
        ),
        Factor(
            "validation",
            validation_level(found),
            f"{len(found.within())} of {len(rows.numbers)} measured numbers within k u_val, {found.met_trends()} "
            "measured trends ([measured parts](measured.md)); other codes and published tables",
            "a pump with known drawing, films, flows and torques, measured by others, which the readable literature "
            "lacks; level 2 is claimed where most measured numbers of single films lie within k u_val",
        ),
    )


def _of_operation(found: Evidence) -> tuple[Factor, ...]:
    return (
        Factor(
            "input pedigree",
            1,
            "every key of a pump file has its source or is listed as assumed ([files](files.md)); `ref90` follows a "
            "paper whose table of dimensions is lost ([reproduction](reproduction.md))",
            "a drawing and an oil certificate of a pump; measured roughness and clearances",
        ),
        Factor(
            "results uncertainty",
            2,
            "numerical error by `--refine`; scatter by `swashfilm tolerance`; 90 % intervals of fitted parameters, "
            f"which contain the truth in {found.coverage()} ([proof](proof.md))",
            "a result states no uncertainty of its inputs unless one of these commands is used",
        ),
        Factor(
            "results robustness",
            2,
            "share of each dimension in the scatter (`swashfilm tolerance`), slopes of films by thickness (adjoint), "
            "widths of inputs in [measured parts](measured.md)",
            "sensitivities of floating films to all inputs",
        ),
    )


SUPPORTING = (
    Factor(
        "use history",
        1,
        "examples and statements of one publication ([reproduction](reproduction.md)); three open recordings of real "
        "rigs ([proof](proof.md))",
        "a prediction that a later measurement confirmed; users outside the project",
    ),
    Factor(
        "M&S management",
        1,
        "one repository, locked packages, tests of style, types and imports, changelog, pages written by tests",
        "a release, a process of review by others, records of users' faults",
    ),
    Factor(
        "people qualifications",
        0,
        "none: nobody's training or experience is on record",
        "named authors and users with their qualification",
    ),
)


def validation_level(found: Evidence) -> int:
    """3: every measured number within the noise; 2: most of those of single films; 1: fewer."""
    films = found.of("film temperature", "mixed friction", "churning")
    if len(found.within()) == len(found.summary.numbers):
        return 3
    return 2 if 2 * len(found.within(films)) > len(films) else 1


def contexts(found: Evidence) -> tuple[Context, ...]:
    """The four contexts of use."""
    return (_film_study(found), _comparison(found), _diagnosis(found), _tolerances(found))


def _film_study(found: Evidence) -> Context:
    films = found.of("film temperature", "mixed friction")
    return Context(
        "Film study of a gap",
        "How do load, leakage, friction and temperature of one film change with its shape, oil and motion?",
        "medium: it stands beside a hand calculation or a rig",
        "low: a variant is studied in vain",
        "[validation](validation.md), chapters *Film equation*; [measured parts](measured.md)",
        (
            Criterion("numerical error known: observed orders of convergence", f"{found.summary.ordered} rows with one",
                      found.summary.ordered > 0),
            found.all_within("measured numbers of film temperature and mixed friction", films, Criterion),
        ),
        "with `--refine`; not for friction where asperities bear a tenth of the load or more",
    )  # fmt: skip


def _comparison(found: Evidence) -> Context:
    right, trends = found.trends()
    return Context(
        "Comparison of pump designs",
        "Which of two designs of a like pump leaks less, or loses less?",
        "medium: it chooses the prototype, which is then measured",
        "medium: a prototype is built in vain",
        "[measured parts](measured.md), *Trends* and *Pump*; [reproduction](reproduction.md)",
        (
            Criterion("all measured trends of slipper and block", f"{right} of {trends}", right == trends),
            found.all_within("measured numbers of a pump", found.of("pump"), Criterion),
        ),
        "for the order of variants of one pump, with the same oil and meshes; not for absolute losses",
    )


def _diagnosis(found: Evidence) -> Context:
    (named, goal), held, gates = found.named, found.held(), len(found.gates)
    return Context(
        "Diagnosis on the test bench",
        "What explains the mismatch of a recording: left-out physics, a sensor, a parameter?",
        "high: it names a cause that nobody has seen",
        "medium: the wrong part is opened or changed",
        "[proof](proof.md), [proof of film physics](proof_floating.md), *Rig* in [measured parts](measured.md)",
        (
            Criterion("all gates of the proof", f"{held} of {gates} held", held == gates),
            Criterion("film physics named as often as asked", f"{named}, asked {goal}", found.named_met()),
        ),
        "as a ranked list of causes and a next test point; a cause counts after that test",
    )  # fmt: skip


def _tolerances(found: Evidence) -> Context:
    return Context(
        "Tolerance study",
        "How far does a series of pumps scatter, and by which dimension?",
        "medium: it moves cost from one tolerance to another",
        "medium: scrap, or tolerances that cost in vain",
        "chapter *Volumetric efficiency of a hydrostatic transmission* in [validation](validation.md)",
        (
            found.all_within(
                "measured scatter of units",
                tuple(row for row in found.of("pump") if "deviation" in row.quantity or "spread" in row.quantity),
                Criterion,
            ),
        ),
        "for the shares of dimensions in the scatter that they cause; not for the scatter of a whole series",
    )


def page(found: Evidence) -> str:
    """The page as Markdown."""
    listed = factors(found)
    lowest = min(factor.level for factor in listed)
    worst = ", ".join(factor.name for factor in listed if factor.level == lowest)
    met = [context.name for context in contexts(found) if all(one.met for one in context.criteria)]
    answer = (
        f"Overall level {lowest} ({worst}). Uses whose acceptance is met in full: {', '.join(met) or 'none'}. "
        "The limited use that the evidence does carry stands with each context."
    )
    table = ["| factor | level | evidence | what lacks |", "|---|---|---|---|"]
    table += [f"| {one.name} | {one.level} | {one.evidence} | {one.lacks} |" for one in listed]
    blocks = [
        "# Credibility",
        answer,
        OPENING,
        "## Factors of NASA-STD-7009",
        "\n".join(table),
        "## Contexts of use (ASME V&V 40)",
    ]
    return "\n\n".join([*blocks, *map(_context, contexts(found)), FORBIDDEN]) + "\n"


def _context(context: Context) -> str:
    lines = [
        f"### {context.name}", "", "| | |", "|---|---|", f"| question of interest | {context.question} |",
        f"| influence of the model | {context.influence} |",
        f"| consequence of a wrong decision | {context.consequence} |", f"| evidence | {context.evidence} |",
    ]  # fmt: skip
    lines += [
        f"| acceptance: {one.asked} | {'met' if one.met else '**not met**'}: {one.found} |" for one in context.criteria
    ]
    return "\n".join([*lines, f"| use that the evidence carries | {context.use} |"])


if __name__ == "__main__":
    PAGE.write_text(page(read_evidence(DOCS)), encoding="utf-8")
