"""The check of `swashfilm plan`: pairs that a grid of 36 points leaves open, and those that planned readings settle.

    python benchmarks/plan_check.py               runs what is not there yet, then writes docs/plan_check.md
    python benchmarks/plan_check.py --cases 5     only the first 5 of the drawn order
    python benchmarks/plan_check.py --cases 0     runs nothing, writes the page from what is there

A case takes a quarter of a minute of process time, one whose grid leaves pairs open a minute. The grid's diagnosis and
the planned campaigns are files of their own in --results: a changed plan needs the second alone. Those of the page
are in benchmarks/proof/planned/outcomes.
"""

from __future__ import annotations

import argparse
import sys
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
    from proof.planned.kept import kept_grid, kept_trial
    from proof.planned.page import write_page
    from proof.planned.trial import concealed

    options.results.mkdir(parents=True, exist_ok=True)
    for number, one in enumerate(concealed()[: options.cases]):
        grid = kept_grid(options.results, one, number)
        if not grid.open:
            print(f"{number} {grid.name}: no open pair", flush=True)
            continue
        found = kept_trial(options.results, one, number, grid)
        points, meter = found.settled
        told = f"{points} of {len(found.pairs)} open pairs settled by points, {meter} with {found.asked or 'no meter'}"
        print(f"{number} {found.name}: {told}", flush=True)
    print(f"page in {write_page(options.results, options.page)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
