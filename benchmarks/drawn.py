"""Films and pumps drawn at random, solved one by one: each ends in balance, or says in words why not.

    python benchmarks/drawn.py                          the cases that are not kept yet
    python benchmarks/drawn.py --kind film --count 100  the first hundred films
    python benchmarks/drawn.py --again                  those anew that broke the promise

The draws of a case depend on its kind and number alone. Outcomes are lines of benchmarks/drawn/outcomes.jsonl as soon
as they are known: Ctrl-C loses the case in hand. A film takes half a second, between elastic bodies a minute; a pump 10
ms by closed laws, ten seconds by fixed films. docs/validation.md has their table.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
ROOT = Path(__file__).resolve().parents[1]


def main() -> int:
    """Solve the missing cases; return 1 where one breaks the promise."""
    sys.path.insert(0, str(ROOT))
    from drawn.kept import KEPT, read_outcomes, write_outcome
    from drawn.trial import KINDS, tried

    options = _options(list(KINDS))
    known = {(one.kind, one.number): one for one in read_outcomes(KEPT)}
    if options.again:
        known = {key: one for key, one in known.items() if one.fate.good}
    try:
        for kind in options.kind or KINDS:
            for number in range(min(KINDS[kind].count, options.count or KINDS[kind].count)):
                if (kind, number) not in known:
                    known[kind, number] = one = tried(kind, number)
                    write_outcome(KEPT, one)
                    if not one.fate.good:
                        print(f"{kind} {number}: {one.fate}: {one.mass:.1e} {one.energy:.1e} {one.told}", flush=True)
    except KeyboardInterrupt:
        print("interrupted; what was finished is kept")
    for kind in KINDS:
        own = [one.fate for (name, _), one in known.items() if name == kind]
        print(f"{kind}: {len(own)};", ", ".join(f"{own.count(fate)} {fate}" for fate in dict.fromkeys(own)))
    return int(any(not one.fate.good for one in known.values()))


def _options(kinds: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kind", action="append", choices=kinds, help="cases of this kind alone; may be repeated")
    parser.add_argument("--count", type=int, metavar="N", help="the first N cases of a kind")
    parser.add_argument("--again", action="store_true", help="those anew that broke the promise")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
