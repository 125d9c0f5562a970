"""The page of the proof with floating films."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from system.points.table.film_physics import FilmModel

from ..markdown import table
from ..store import program
from .films import HELD_OUT, LEARNT, OFF, off_text
from .plant import set_points
from .trial import SEEDS, VISIBLE, Outcome

GATE, HELD = 0.95, 1.1
"""Goals, set before the run: right of the cases that show, and rms of points held out over the noise."""

HEAD = """# Proof: film physics left out

Results of `swashfilm diagnose --fidelity floating` where the truth is known, written by
`python benchmarks/proof_floating.py`. The plant is the pump `ref90` with floating films of all physics; each of its
{points} points is solved directly. The simulation leaves out one or two parts of the film physics. It and the
hypotheses are response tables of {learnt} points learnt and {held_out} held out, none of them a point of the plant.
Full displacement, oil at the pump's own temperature, 1000 to 2200 r/min, 5 to 25 MPa. Calibrations and noise of the
sensors are drawn {draws} times, class A of ISO 4409, as in the [proof](proof.md); each of these recordings is diagnosed
by every simulation. Plant and simulation share films and meshes: this proves that the physics is told apart, not that
the films are right, for which see the [validation](validation.md).

"""


def page(outcomes: Sequence[Outcome], models: dict[str, FilmModel]) -> str:
    """The whole page."""
    shown = [one for one in outcomes if one.concealed and one.score >= VISIBLE]
    nulls = [one for one in outcomes if not one.concealed]
    right, worst = [one for one in shown if one.is_right], [one.worst for one in outcomes if one.concealed]
    sure = [one for one in outcomes if one.wrong_and_sure]
    head = HEAD.format(points=len(set_points()), learnt=LEARNT, held_out=HELD_OUT, draws=len(SEEDS))
    gates = [
        ("named, of the cases that show by 8 sigma", f"{len(right)} of {len(shown)}", f"{GATE:.0%}"),
        ("nothing named where nothing is left out", f"{sum(one.is_right for one in nulls)} of {len(nulls)}", "all"),
        ("held out over noise after the finding, median of the cases", f"{np.median(worst):.2f}", f"{HELD:g}"),
        ("wrong, and told with a probability of .9 or more", str(len(sure)), "0"),
    ]
    stale = sum(one.program != program() for one in outcomes)
    told = f"\n{stale} of the {len(outcomes)} cases are by another state of the program.\n" if stale else ""
    return head + table(("", "reached", "goal"), gates) + told + _of_sets(outcomes, models) + _of_cases(outcomes)


def _of_sets(outcomes: Sequence[Outcome], models: dict[str, FilmModel]) -> str:
    """Physics that each simulation leaves out, its size, and the error of the tables."""
    rows = []
    for off in OFF:
        name = off_text(off)
        own = [one for one in outcomes if one.name.rpartition("-")[0] == name]
        error = models[name].error
        leaks, rubs = (
            max(value for output, value in error.items() if output.endswith(end)) for end in (".leakage", ".friction")
        )
        shows = f"{np.median([one.score for one in own]):.0f}"
        rows.append((name, shows, f"{sum(one.is_right for one in own)} of {len(own)}", f"{leaks:.1%}", f"{rubs:.1%}"))
    head = ("left out", "shows, sigma", "right", "tables: leakage of a gap, rms", "friction of a gap, rms")
    return "\n## Simulations\n\n" + table(head, rows)


def _of_cases(outcomes: Sequence[Outcome]) -> str:
    head = (
        "case", "concealed", "sigma", "", "verdict", "named, probability (share)",
        "held out over noise: before, after",
        "chi2 per reading", "s",
    )  # fmt: skip
    return "\n## Cases\n\n" + table(head, [_row(one) for one in outcomes])


def _row(one: Outcome) -> tuple[str, ...]:
    claims = (f"{effect} {chance:.2f} ({size or 'no size'})" for effect, chance, size in one.claims)
    held_out = (f"{name} {before:.2f} / {after:.2f}" for name, (before, after) in one.held_out.items())
    return (
        one.name, ", ".join(one.concealed), f"{one.score:.0f}", "right" if one.is_right else "not right",
        f"{one.kind}, {one.status}", "; ".join(claims), ", ".join(held_out),
        " / ".join(f"{value:.2f}" for value in one.chi2), f"{one.seconds:.0f}",
    )  # fmt: skip
