"""The proof with floating films: a plant of all film physics, simulations without one or two parts of it.

    python benchmarks/proof_floating.py               diagnoses the cases that are not there yet, writes the page
    python benchmarks/proof_floating.py --solve 2     solves plant and tables first, by two processes: some hours
    python benchmarks/proof_floating.py --cases N     only the first N cases of each simulation
    python benchmarks/proof_floating.py --write elastic_walls-61 FOLDER    writes a recording, for swashfilm diagnose

Solved points are kept: Ctrl-C loses only those under way. A case takes a minute of process time.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def main() -> int:
    """Do what the command line asks."""
    options = _options()
    sys.path.insert(0, str(ROOT))
    from proof.floating.films import OFF, model, off_text
    from proof.floating.page import page
    from proof.floating.plant import keep, set_points, truth_row
    from proof.floating.trial import Outcome, all_cases, try_case, write_case

    if options.write:
        name, folder = options.write
        write_case(next(case for case in all_cases() if case.name == name), Path(folder))
        return 0
    if options.solve:
        keep([truth_row(row) for row in set_points()])
    outcomes, models = [], {}
    for off in OFF:
        films = models[off_text(off)] = model(off, max(1, options.solve), _told)
        for case in [case for case in all_cases() if case.off == off][: options.cases]:
            kept = options.results / f"{case.name}.json"
            if not kept.is_file():
                options.results.mkdir(parents=True, exist_ok=True)
                kept.write_text(json.dumps(try_case(case, films).record()), encoding="utf-8")
            outcomes.append(Outcome.of_record(json.loads(kept.read_text("utf-8"))))
            one = outcomes[-1]
            mark = "right" if one.is_right else "not right"
            print(f"{mark}: {one.name}, {one.score:.0f} sigma, {one.kind}, {one.status}: {one.claims}", flush=True)
    options.page.write_text(page(outcomes, models), encoding="utf-8")
    return 0


def _told(done: int, total: int, what: str) -> None:
    if what != "solving":
        print(f"{done}/{total} {what}", file=sys.stderr, flush=True)


def _options() -> argparse.Namespace:
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("--solve", type=int, default=0, metavar="WORKERS", help="solve plant and tables")
    reader.add_argument("--cases", type=int, metavar="N", help="only the first N cases of each simulation")
    reader.add_argument("--results", type=Path, default=ROOT / "build" / "proof_floating", metavar="DIR")
    reader.add_argument("--page", type=Path, default=ROOT / "docs" / "proof_floating.md", metavar="FILE")
    reader.add_argument("--write", nargs=2, metavar=("CASE", "FOLDER"), help="write one recording")
    return reader.parse_args()


if __name__ == "__main__":
    sys.exit(main())
