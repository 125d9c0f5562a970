"""Page of the mutations: number that the default tests notice, and each one that they do not."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path

from proof.calibration import wilson
from proof.markdown import table

from .trial import Fate, Trial

SAME = Path(__file__).with_name("equivalent.toml")
GATE = 0.95
HEAD = """# Mutations of the physics

A single edit of a formula, a sign, a limit or a number is made in a module that computes; the default tests run, and
one of them should fail. Edits are drawn at random from all of `reynolds`, `gaps`, `system` and `diagnosis`: a sign or
an operator exchanged, a term or a factor left out, a comparison reversed, a number doubled, a maximum for a minimum.
Test files run in the order of their imports of the edited module, {near} of them at most; `--whole` runs
all for what survives these. A test that fails without the edit too has noticed nothing. An edit that changes no
result that the program promises is *equivalent*; the reason stands beside it.

Written by `python benchmarks/mutation.py`.

"""


def page_text(trials: Sequence[Trial], near: int, gone: int) -> str:
    """Counts by package and by kind, then the survivors, with reasons; gone: outcomes of lines that are no more."""
    same = equivalents()
    decided = [trial for trial in trials if trial.fate is not Fate.UNDECIDED or trial.name in same]
    parts = [HEAD.format(near=near), _whole(trials, decided, same), _gone(gone)]
    packages = sorted({trial.file.split("/")[0] for trial in trials})
    rows = [_row(name, [one for one in decided if one.file.startswith(f"{name}/")], same) for name in packages]
    kinds = sorted({trial.kind for trial in trials})
    rows += [_row(kind, [one for one in decided if one.kind == kind], same) for kind in kinds]
    parts.append(table(("of", "decided", "noticed", "equivalent", "survived"), rows))
    left = [one for one in decided if _is_unnoticed(one)]
    told = [(_code(one), one.before, one.after, same.get(one.name, "**survived**")) for one in left]
    parts.append("\n## What the tests do not notice\n\n")
    parts.append(table(("place", "line", "edited", "reason"), [(a, f"`{b}`", f"`{c}`", d) for a, b, c, d in told]))
    return "".join(parts)


def equivalents() -> Mapping[str, str]:
    """Reasons of equivalent edits by the name of the edit."""
    return {name: one["reason"] for name, one in tomllib.loads(SAME.read_text("utf-8")).items()}


def missed(trials: Sequence[Trial]) -> list[Trial]:
    """Edits that survived and are not equivalent."""
    same = equivalents()
    return [one for one in trials if one.fate is Fate.SURVIVED and one.name not in same]


def _whole(trials: Sequence[Trial], decided: Sequence[Trial], same: Mapping[str, str]) -> str:
    counted = [one for one in decided if one.name not in same]
    undecided = len(trials) - len(decided)
    fresh = [one.at_first for one in counted if one.at_first is not Fate.UNDECIDED]
    return (
        f"Of {len(trials)} edits {len(decided)} are decided ({undecided} ran out of time). The tests notice "
        f"{_share([one.fate for one in counted])} that are not equivalent; the gate is {GATE:.0%}. A test is written "
        f"for each edit that survives. When these edits were tried for the first time, before such a test, the tests "
        f"noticed {_share(fresh)}: about so many of further edits are noticed.\n\n"
    )


def _gone(count: int) -> str:
    """The sentence on outcomes that do not count; empty without any."""
    return f"{count} more edits are of lines that have changed since; they do not count.\n\n" if count else ""


def _share(fates: Sequence[Fate]) -> str:
    noticed = sum(fate is not Fate.SURVIVED for fate in fates)
    low, high = wilson(noticed, len(fates))
    share = noticed / max(len(fates), 1)
    return f"{noticed} of {len(fates)} ({share:.1%}, Wilson's 95 % interval {low:.0%} to {high:.0%})"


def _row(name: str, trials: Sequence[Trial], same: Mapping[str, str]) -> tuple[str, ...]:
    survived = [one for one in trials if _is_unnoticed(one)]
    alike = sum(one.name in same for one in survived)
    counts = len(trials), len(trials) - len(survived), alike, len(survived) - alike
    return name, *map(str, counts)


def _is_unnoticed(trial: Trial) -> bool:
    return trial.fate in (Fate.SURVIVED, Fate.UNDECIDED)


def _code(trial: Trial) -> str:
    return f"`{trial.file}` `{trial.function}` ({trial.name})"
