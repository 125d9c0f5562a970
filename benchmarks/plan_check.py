"""The check of `swashfilm plan`: pairs that a grid of 36 points leaves open, and those that planned readings settle.

    python benchmarks/plan_check.py               runs what is not there yet, then writes docs/plan_check.md
    python benchmarks/plan_check.py --cases 5     only the first 5 of the drawn order
    python benchmarks/plan_check.py --cases 0     runs nothing, writes the page from what is there

Each case takes a minute of process time; its result is a file of its own in --results, those of the page in
benchmarks/proof/planned/outcomes.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
KEPT = Path(__file__).parent / "proof" / "planned" / "outcomes"


def main() -> int:
    """Run the missing cases and write the page."""
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("--cases", type=int, metavar="N", help="only the first N")
    reader.add_argument("--results", type=Path, default=KEPT, metavar="DIR")
    reader.add_argument("--page", type=Path, default=ROOT / "docs" / "plan_check.md", metavar="FILE")
    options = reader.parse_args()
    sys.path.insert(0, str(ROOT))
    from proof.planned.page import write_page
    from proof.planned.trial import concealed, tried

    options.results.mkdir(parents=True, exist_ok=True)
    for number, one in enumerate(concealed()[: options.cases]):
        path = options.results / f"{number:03d}.json"
        if path.exists():
            continue
        found = tried(one, number)
        path.write_text(json.dumps(asdict(found), indent=1), encoding="utf-8")
        settled = sum(pair.odds_planned >= 20.0 for pair in found.pairs)
        print(
            f"{number} {found.name}: {settled} of {len(found.pairs)} open pairs settled, {found.seconds:.0f} s",
            flush=True,
        )
    print(f"page in {write_page(options.results, options.page)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
