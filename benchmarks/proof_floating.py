"""The proof with floating films: a plant of all film physics, simulations without one or two parts of it.

    python benchmarks/proof_floating.py               diagnoses the cases that are not there yet, writes the page
    python benchmarks/proof_floating.py --solve       solves the plant first, half an hour to an hour
    python benchmarks/proof_floating.py --workers 2   side by side
    python benchmarks/proof_floating.py --cases N     only the first N cases of each simulation
    python benchmarks/proof_floating.py --write elastic_walls-61 FOLDER    writes a recording, for swashfilm diagnose

Points of the tables are solved where they are not kept, some hours in all: Ctrl-C loses only those under way. Those
behind the page are kept in benchmarks/proof/floating/points.tar.xz: tar -xf it into ~/.cache/swashfilm/tables. A case
takes half a minute of process time.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from proof.floating.trial import Case

    from system.points.table.film_physics import FilmModel

ROOT = Path(__file__).resolve().parents[1]


def main() -> int:
    """Do what the command line asks."""
    options = _options()
    sys.path.insert(0, str(ROOT))
    from proof.floating.films import OFF, model, off_text
    from proof.floating.page import page
    from proof.floating.plant import keep, set_points, truth_row
    from proof.floating.trial import Outcome, all_cases, write_case

    if options.write:
        name, folder = options.write
        write_case(next(case for case in all_cases() if case.name == name), Path(folder))
        return 0
    if options.solve:
        keep([truth_row(row) for row in set_points()])
    outcomes, models = [], {}
    for off in OFF:
        films = models[off_text(off)] = model(off, options.workers, _told)
        cases = [case for case in all_cases() if case.off == off][: options.cases]
        for one in map(Outcome.of_record, _records(cases, films, options)):
            outcomes.append(one)
            mark = "right" if one.is_right else "not right"
            print(f"{mark}: {one.name}, {one.score:.0f} sigma, {one.kind}, {one.status}: {one.claims}", flush=True)
    options.page.write_text(page(outcomes, models), encoding="utf-8")
    return 0


def _records(cases: Sequence[Case], films: FilmModel, options: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """The outcomes of some cases of one simulation, those that are not kept made side by side."""
    from proof.floating.trial import try_case

    from reynolds.numerics.files import replaced

    options.results.mkdir(parents=True, exist_ok=True)
    kept = {case: options.results / f"{case.name}.json" for case in cases}
    missing = [case for case, place in kept.items() if not place.is_file()]
    with ProcessPoolExecutor(options.workers) as pool:
        for case, outcome in zip(missing, pool.map(try_case, missing, [films] * len(missing)), strict=True):
            with replaced(kept[case]) as beside:
                beside.write_text(json.dumps(outcome.record()), encoding="utf-8")
    for place in kept.values():
        yield json.loads(place.read_text("utf-8"))


def _told(done: int, total: int, what: str) -> None:
    if what != "solving":
        print(f"{done}/{total} {what}", file=sys.stderr, flush=True)


def _options() -> argparse.Namespace:
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("--solve", action="store_true", help="solve the plant anew")
    reader.add_argument("--workers", type=int, default=1, metavar="N", help="processes side by side")
    reader.add_argument("--cases", type=int, metavar="N", help="only the first N cases of each simulation")
    reader.add_argument("--results", type=Path, default=ROOT / "build" / "proof_floating", metavar="DIR")
    reader.add_argument("--page", type=Path, default=ROOT / "docs" / "proof_floating.md", metavar="FILE")
    reader.add_argument("--write", nargs=2, metavar=("CASE", "FOLDER"), help="write one recording")
    return reader.parse_args()


if __name__ == "__main__":
    sys.exit(main())
