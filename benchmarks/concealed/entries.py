"""Entries: the diagnosis of this program and its rivals, each as answers of the public form."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from proof.outcome import Outcome, Rival
from proof.trial import study_of_folder, tried

from system.effects.catalogue.entries import entry_of
from system.effects.effect import EffectId, Kind

from .answer import IDS, Answer, Name, Ranked, write_answer
from .made import PUMP
from .rivals import rivals as statistics

OURS, LAST = "swashfilm", "embedded-discrepancy"
"""Entry of this program, and the last that `rivals` writes."""
SLUGS = {
    "stepwise BIC": "stepwise-bic", "sparse regression": "sparse-regression",
    "Gaussian process": "gaussian-process", "largest residual": "largest-residual",
}  # fmt: skip
"""Rivals of `proof.rivals` that enter, with the folders of their answers; its others are this diagnosis in parts."""


def enter(recordings: Path, answers: Path, names: Sequence[str], *, with_rivals: bool) -> Iterator[str]:
    """Write the answers to each recording that has none yet; yield a line for each of ours.

    with_rivals: also those of SLUGS and of `rivals`, of recordings with steady points: they do not support series.
    """
    for name in names:
        folder = recordings / name
        rivals = with_rivals and (folder / "steady.csv").is_file()
        if rivals and not (answers / LAST / f"{name}.json").exists():
            for slug, rival in statistics(study_of_folder(folder, folder / PUMP)).items():
                write_answer(answers / slug, rival_answer(name, rival))
        if (answers / OURS / f"{name}.json").exists():
            continue
        blank = Outcome(name=name, part="", campaign="", seed=0, asked=0.0, score=0.0, sizes={}, truth="", effects=(),
                        pairs=(), shares={})  # fmt: skip
        found, _ = tried(folder, blank, folder / PUMP, rivals)
        for title, slug in SLUGS.items():
            if title in found.rivals:
                write_answer(answers / slug, rival_answer(name, found.rivals[title]))
        write_answer(answers / OURS, our_answer(name, found))
        yield f"{name}: {found.verdict}, {found.status} {found.failed}, {found.seconds:.0f} s"


def our_answer(recording: str, found: Outcome) -> Answer:
    """Return a verdict of this program as an answer; a class is of ids, an unknown cause beside them is no id."""
    if found.failed:
        return Answer(recording, Kind.NO_MISMATCH.value, "failed", (), (), found.seconds)
    names = tuple(
        Name(one.effect, one.pair or "", one.probability, tuple(other for other in one.equivalent if other in IDS))
        for one in found.claims
        if one.effect in IDS
    )
    ranking = tuple(Ranked(one.effects, tuple(pair or "" for pair in one.pairs), one.probability)
                    for one in found.ranked)  # fmt: skip
    status = "suspicion" if found.status == "suspicion" else "named"
    return Answer(recording, found.verdict, status, names, ranking, found.seconds)


def rival_answer(recording: str, found: Rival) -> Answer:
    """Return the finding of a rival as an answer; one without a name is a suspicion. Rivals have no probabilities."""
    if not found.alarm:
        return Answer(recording, Kind.NO_MISMATCH.value, "named", (), (), float("nan"))
    if not found.named:
        return Answer(recording, Kind.UNKNOWN_PHYSICS.value, "suspicion", (), (), float("nan"))
    kind = entry_of(EffectId(found.named[0])).verdict
    names = tuple(Name(one, "", 1.0, ()) for one in found.named)
    return Answer(recording, kind.value, "named", names, (), float("nan"))
