"""Mutations of the physics, each tried against the default tests; writes docs/mutations.md.

    python benchmarks/mutation.py --count 40              the first 40 of the sample, as far as they are not kept
    python benchmarks/mutation.py --part 1/2              the odd ones: a second process may do --part 2/2
    python benchmarks/mutation.py --whole                 all test files for what survived the nearest ones
    python benchmarks/mutation.py --again NAME            one edit anew, after a test was written
    python benchmarks/mutation.py --again NAME --test F   by one test file; where it survives, the outcome stays
    python benchmarks/mutation.py --count 0               writes the page from what is kept

An edit takes from ten seconds to ten minutes. The edits are made in a copy of the checkout under build/mutation, made
anew by each call. Each
outcome is a file of its own in benchmarks/mutation/outcomes as soon as it is known; Ctrl-C loses the edit in hand.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict, replace
from pathlib import Path

from mutation.nearest import Nearness
from mutation.page import missed, page_text
from mutation.sample import names, sample
from mutation.trial import Copy, Fate, Trial

from reynolds.numerics.files import replaced

ROOT = Path(__file__).resolve().parents[1]
KEPT = Path(__file__).parent / "mutation" / "outcomes"
NEAR = 25
LIMIT = 900.0  # s of a processor
WHOLE_LIMIT = 5400.0  # s of a processor


def main() -> int:
    """Try the missing edits and write the page; return 1 where one survives that is not equivalent."""
    options = _options()
    KEPT.mkdir(exist_ok=True)
    try:
        _run(options)
    except KeyboardInterrupt:
        print("interrupted; what was finished is kept")
    kept, there = _kept(), names(ROOT)
    counted = [one for one in kept if one.name in there]
    options.page.write_text(page_text(counted, NEAR, len(kept) - len(counted)), encoding="utf-8")
    for one in missed(counted):
        print(f"survived: {one.name} {one.file} {one.function}\n    {one.before}\n    {one.after}")
    return int(bool(missed(counted)))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200, metavar="N", help="edits of the sample (200)")
    parser.add_argument("--part", default="1/1", metavar="I/N", help="every Nth of them, beginning with the Ith")
    parser.add_argument("--whole", action="store_true", help="all test files for what survived")
    parser.add_argument("--again", action="append", default=[], metavar="NAME", help="this edit anew")
    parser.add_argument("--test", action="append", default=[], metavar="FILE", help="with --again: by this file alone")
    parser.add_argument("--page", type=Path, default=ROOT / "docs" / "mutations.md", metavar="FILE")
    return parser.parse_args()


def _run(options: argparse.Namespace) -> None:
    if options.count == 0 and not options.again:
        return
    known = {one.name: one for one in _kept()}
    own, of = map(int, options.part.split("/"))
    chosen = sample(ROOT, max(options.count, 200) if options.again else options.count)
    nearness, copy = Nearness(ROOT), Copy(ROOT, ROOT / "build" / "mutation" / f"{own}" / "checkout")
    for edit in chosen[own - 1 :: of]:
        before = known.get(edit.name)
        whole = options.whole and before is not None and before.fate is Fate.SURVIVED
        if not (whole or edit.name in options.again or (before is None and not options.again)):
            continue
        tests = options.test or nearness.order(edit.file)
        trial = copy.tried(edit, tests if whole else tests[:NEAR], WHOLE_LIMIT if whole else LIMIT)
        if options.test and trial.fate is not Fate.KILLED:
            print(f"not noticed: {edit.file} {edit.function}", flush=True)
            continue
        trial = trial if before is None else replace(trial, at_first=before.at_first)
        with replaced(KEPT / f"{edit.name}.json") as beside:
            beside.write_text(json.dumps(asdict(trial), indent=1) + "\n", encoding="utf-8")
        print(f"{trial.fate}: {edit.file} {edit.function}, {trial.seconds:.0f} s {trial.noticed_by}", flush=True)


def _kept() -> list[Trial]:
    texts = [path.read_text("utf-8") for path in sorted(KEPT.glob("*.json"))]
    fates = "fate", "at_first"
    return [Trial(**(one | {key: Fate(one[key]) for key in fates})) for one in map(json.loads, texts)]


if __name__ == "__main__":
    sys.exit(main())
