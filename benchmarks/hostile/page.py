"""The page of hostile input: outcomes by kind of file, before and after."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from proof.calibration import wilson

from .judged import Outcome
from .trial import Told

FIRST = Path(__file__).with_name("first.json")
"""Outcomes by kind of the cases whose first trial was kept, before the faults that it found were corrected."""
Counts = Mapping[str, Mapping[str, int]]
ORDER = list(Outcome)
HEAD = """# Hostile input

Files of every kind that the program reads, mutated: truncated, bytes changed, numbers, names and texts replaced (NaN,
5000 digits, markup, code, paths), other encodings, deep nesting, long files, links in circles and out of the folder,
devices, pipes, pickles, external links, entity and zip bombs. Each is read by the command that reads such files, in a
process with a limit of {memory:g} GB and {seconds} s of processor time. Promised is a refusal in words that names file
and place (exit 2 or 3), or a whole and finite result.

    python benchmarks/hostile.py                 runs what is not there yet, then writes this page
    python benchmarks/hostile.py --door "pump file" --cases 20

The seed of a case is its door (the file that is mutated, and its command) and its number; case -1 is the good file,
which has to be accepted. Outcomes are kept in `build/hostile/outcomes.jsonl` as they come; Ctrl-C loses the case in
hand. The folder of a case that breaks the promise is left there.

"""
MEANING = """
| outcome | meaning |
|---|---|
| refused in words | exit 2 or 3; the message names the file or the option, what was found and what is expected |
| accepted | exit 0; the mutation leaves a valid file. A run folder that is written is whole, its numbers are finite |
| traceback | an exception that is not caught, or "internal error" |
| no place told | exit 2 or 3 with a message that names no place |
| crash | ended by a signal |
| hang | more than the limit of time |
| memory | more than 1.5 GB, or the limit |
| code run | a text, an object or a link of the file was run |
| markup injected | an element of the page, or a control sign on the terminal, by a text of the file |
| half file | a result that is not whole, or a temporary file left behind |
| outside changed | a file outside the folder was written |
"""


def counted(outcomes: Iterable[Told]) -> dict[str, dict[str, int]]:
    """Return the number of cases by kind of file and outcome."""
    found: dict[str, Counter[str]] = {}
    for one in outcomes:
        found.setdefault(one.kind, Counter())[one.outcome.value] += 1
    return {kind: dict(counts) for kind, counts in sorted(found.items())}


def page_text(now: Counts, memory: float, seconds: float) -> str:
    """Return the page of these outcomes, with those of the first trial below."""
    first = json.loads(FIRST.read_text("utf-8"))
    words = f"\nWhen they were tried first (26 and 27 November 2026), before it was mended, {_broken(first)}:\n\n"
    head = HEAD.format(memory=memory / 1e9, seconds=seconds)
    return f"{head}{_broken(now)}.\n\n{_table(now)}{MEANING}{words}{_table(first)}"


def _broken(counts: Counts) -> str:
    """Words for the number of cases that break the promise."""
    good = [one.value for one in Outcome if one.good]
    cases = sum(sum(row.values()) for row in counts.values())
    broken = cases - sum(row.get(name, 0) for row in counts.values() for name in good)
    low, high = wilson(broken, cases)
    interval = f"Wilson's 95 % interval {low:.2%} to {high:.2%}"
    return f"{broken} of {cases} cases broke the promise ({broken / max(cases, 1):.2%}, {interval})"


def _table(counts: Counts) -> str:
    shown = [one for one in ORDER if one.good or any(one.value in row for row in counts.values())]
    rows = [["kind of file", "cases", *(one.value for one in shown)]]
    for kind, row in counts.items():
        rows.append([kind, str(sum(row.values())), *(_cell(row, one) for one in shown)])
    whole = Counter[str]()
    for row in counts.values():
        whole.update(row)
    rows.append(["all", str(sum(whole.values())), *(_cell(whole, one) for one in shown)])
    return "\n".join([_line(rows[0]), "|" + "---|" * len(rows[0]), *map(_line, rows[1:])]) + "\n"


def _cell(row: Mapping[str, int], outcome: Outcome) -> str:
    return str(row.get(outcome.value, 0) or "")


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"
