"""Page of the benchmark: the score table of all entries, its explanation, the concealed causes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from proof.judged import is_right
from proof.markdown import table
from proof.parts import Plant

from . import VERSION
from .answer import Answer
from .chosen import Split
from .scoring import NOTHING, Score, judged
from .truth import Truth

HEAD = ("entry", "answered", "false alarms", "missed", "detected", "right", "without classes", "wrong name",
        "wrong and sure", "in the 95 % set", "explanations in it", "errors a recording", "processor s")  # fmt: skip
TEXT = """# Benchmark of concealed physics

Written by `python benchmarks/concealed.py score FOLDER --split {split} --page docs/concealed.md`; do not edit.

Recordings of three pump plants, each with something concealed or nothing, are open to any tool:
[how to enter](../benchmarks/concealed/README.md). This page has the {split} split of version {version} with {count}
recordings, {nulls} of them with nothing concealed. **So few recordings order no tools: the intervals (Wilson, 95 %) say
what they can tell.** [The proof](proof.md) has this diagnosis on some hundreds of recordings of the same plants, with
other draws.

{tables}
- False alarms: of recordings with nothing concealed, those of which a tool says that something is off. Missed: of the
  others, those of which it does not. Detected: neither of both, of all. These are the DX competition's rates of false
  positives and negatives and its detection accuracy.
- Right: of recordings with something concealed, all of it named and nothing else; an id that a tool cannot tell from
  the true one may stand in its class, a fault of a meter beside physics need not be named. Without classes: the same by
  the named ids alone. A tool whose classes hold many ids is right more often, and no more often without them.
- Wrong name: of all, something named that is not there; sure: at a probability of .9 or more, with its class.
- In the 95 % set: of recordings with a ranking, the truth (or that nothing is concealed) is among the likeliest
  explanations that hold 95 % together; beside it the mean number of these.
- Errors a recording: ids named that are not there, and ids there that are not named (unknown physics too), in the mean:
  the DX competition's classification errors.
- There is no time of detection or isolation: what is concealed is there from the first reading to the last.
- The rivals take the study of this program (readings, priors, slopes) and know steady points alone: they have no
  answer to the series of the rough plant, which count as not detected, and of a null as no alarm. `stepwise-bic` adds
  columns of the catalogue by Schwarz' criterion, `sparse-regression` is LASSO on textbook terms, `gaussian-process` a
  smooth discrepancy without a name, `largest-residual` the usual suspect of the channel that is off most.
  `kennedy-ohagan` chooses by Schwarz' criterion among the model, one more effect, a smooth discrepancy and both;
  `localise-and-test` lets one half of the points propose effects and the other test them, with the share of false
  discoveries bounded; `embedded-discrepancy` seeks the parameter that would have to vary from point to point. They
  tell no probabilities: a name of theirs counts as sure. Their time is not counted apart.
"""
CASES = """
## Each recording

z is the length of the concealed shift in sigma that is left once all that is uncertain is fitted. Bold: right.

"""
PLANTS = {Plant.FIRST: "first plant", Plant.OTHER: "other laws", Plant.ROUGH: "rough"}


def score_table(scores: Sequence[Score]) -> str:
    """Return the table of scores as Markdown, a row each entry."""
    rows = []
    for one in scores:
        shares = (one.answered, one.false_positive, one.false_negative, one.detected, one.right, one.right_alone,
                  one.wrong, one.sure_and_wrong, one.in_set)  # fmt: skip
        size, spent = (f"{own:.3g}" if np.isfinite(own) else "-" for own in (one.set_size, one.cpu_s))
        rows.append((one.entry, *(own.text for own in shares), size, f"{one.errors:.2f}", spent))
    return table(HEAD, rows)


def plant_table(scores: Sequence[Score]) -> str:
    """Return the table of right answers by plant as Markdown."""
    rows = [(one.entry, *(one.right_at[plant.value].text for plant in PLANTS)) for one in scores]
    return table(("entry, right", *PLANTS.values()), rows)


def case_table(truths: Sequence[Truth], entries: Mapping[str, Mapping[str, Answer]]) -> str:
    """Return the concealed causes of each recording and the names by each entry, as Markdown."""
    rows = [
        (truth.recording, truth.plant, _concealed(truth), f"{truth.score:.1f}",
         *(_told(truth, answers.get(truth.recording)) for answers in entries.values()))
        for truth in truths
    ]  # fmt: skip
    return table(("recording", "plant", "concealed", "z", *entries), rows)


def _concealed(truth: Truth) -> str:
    placed = [f"{id} ({gap})" if gap else id for id, gap in zip(truth.ids, truth.gaps, strict=True)]
    named = ", ".join([*placed, *truth.beside])
    return named or truth.verdict


def _told(truth: Truth, answer: Answer | None) -> str:
    if answer is None:
        return "-"
    if answer.status == "failed":
        return "failed"
    named = ", ".join(f"{one.id} ({one.gap})" if one.gap else one.id for one in answer.names)
    told = named if answer.status == "named" and named else f"{answer.verdict}, {answer.status}"
    return f"**{told}**" if is_right(judged(truth, answer).outcome) else told


def write_page(
    path: Path | None, split: str, truths: Sequence[Truth], entries: Mapping[str, Mapping[str, Answer]],
    scores: Sequence[Score],
) -> str:  # fmt: skip
    """Return the score tables, and write them into a page; concealed causes are listed for the development split."""
    tables = f"{score_table(scores)}\n{plant_table(scores)}"
    if path is not None:
        told = CASES + case_table(truths, entries) if split == Split.DEVELOPMENT.value else ""
        nulls = sum(one.verdict == NOTHING for one in truths)
        text = TEXT.format(split=split, version=VERSION, count=len(truths), nulls=nulls, tables=tables)
        path.write_text(text + told, "utf-8")
    return tables
