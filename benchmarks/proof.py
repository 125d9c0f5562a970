"""The proof of the diagnosis: recordings of a plant of another make, each diagnosed, and the page that tells.

    python benchmarks/proof.py                            runs what is not there yet, then writes docs/proof.md
    python benchmarks/proof.py --part null --cases 40     only the first 40 cases of a part
    python benchmarks/proof.py --part rough-null          a part of the third plant; other-...: of the second
    python benchmarks/proof.py --part rig                 a section: ceiling, rig, cycles, tanks, hst, films
    python benchmarks/proof.py --part bench               the ten maps
    python benchmarks/proof.py --workers 2                side by side
    python benchmarks/proof.py --cases 0                  runs nothing, writes the page from what is there
    python benchmarks/proof.py --again 20                 tries cases of an earlier program again, drawn at random
    python benchmarks/proof.py --development --page FILE  other draws, to look at before a mend
    python benchmarks/proof.py --record                   the track record in diagnosis/report, from the outcomes
    python benchmarks/proof.py --write graded 3 FOLDER    writes the recording of a case, for `swashfilm diagnose`

Each case's result is a file of its own in --results: Ctrl-C loses only the case in hand, the next call goes on.
Those behind docs/proof.md are kept in benchmarks/proof/outcomes.tar.xz: tar -xf it into --results.
A null takes some 8 s of process time, a case with something concealed up to 70 s, a rough recording some minutes.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from proof.parts import Part

ROOT = Path(__file__).resolve().parents[1]


def main() -> int:
    """Run the missing cases and write the page."""
    options = _options()
    sys.path.insert(0, str(ROOT))
    from proof.cases import cases
    from proof.expected import GIVEN, given

    from diagnosis.thresholds import load_thresholds

    seeds = load_thresholds().seeds
    seed = seeds.development if options.development else seeds.proof
    if options.write:
        part, number, folder = options.write
        return _write(cases(Part(part), seed)[int(number)], Path(folder))
    if options.record:
        return _record(options.results, seeds.proof)
    parts = [part for part in Part if options.part in (None, part.value)]
    listed = [case for part in parts for case in cases(part, seed)[: options.cases]]
    folders = [] if options.part not in (None, GIVEN) else given()[: options.cases]
    try:
        if options.again:
            _again(listed, options.results, options.again, options.workers)
        else:
            _run(listed, folders, options.results, options.workers)
            _tell(options)
            _summary(listed, options.results)
    except KeyboardInterrupt:
        print("interrupted; what was finished is kept")
    _page(options.results, options.page, seed)
    return 0


def _options() -> argparse.Namespace:
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parts = (*(part.value for part in Part), "bench", "ceiling", "rig", "cycles", "tanks", "hst", "films")
    reader.add_argument("--part", choices=parts, help="only one part")
    reader.add_argument("--cases", type=int, metavar="N", help="only the first N cases of each part")
    reader.add_argument("--again", type=int, metavar="N", help="try N cases of an earlier program again")
    reader.add_argument("--results", type=Path, default=ROOT / "build" / "proof", metavar="DIR")
    reader.add_argument("--page", type=Path, default=ROOT / "docs" / "proof.md", metavar="FILE")
    reader.add_argument("--development", action="store_true", help="the seeds of the development set")
    reader.add_argument("--workers", type=int, default=1, metavar="N", help="processes side by side")
    reader.add_argument("--record", action="store_true", help="write the track record that the package carries")
    reader.add_argument("--write", nargs=3, metavar=("PART", "NUMBER", "FOLDER"), help="write one recording")
    return reader.parse_args()


def _run(listed: list, folders: list[Path], results: Path, workers: int) -> None:
    """Diagnose the cases and the given recordings that have no outcome yet, a line each."""
    from proof.store import keep, load, name_of, name_of_folder
    from proof.trial import try_folder

    wanted = {name_of(case): _task(case) for case in listed}
    wanted |= {name_of_folder(folder): (try_folder, folder) for folder in folders}
    missing = {name: task for name, task in wanted.items() if load(results, name) is None}
    for number, (name, outcome) in enumerate(_outcomes(missing, workers), start=1):
        keep(results, name, outcome)
        print(f"{number}/{len(missing)} {_line(outcome)}", flush=True)


def _again(listed: list, results: Path, count: int, workers: int) -> None:
    """Diagnose some cases of an earlier program again, a line each; their outcomes replace the earlier ones."""
    from proof.again import draw, keep_again, told_alike
    from proof.store import keep, load, name_of

    cases = {name_of(case): case for case in listed}
    earlier = {name: found for name in cases if (found := load(results, name)) is not None}
    drawn = {name: _task(cases[name]) for name in draw(earlier, count)}
    for number, (name, outcome) in enumerate(_outcomes(drawn, workers), start=1):
        same = told_alike(earlier[name], outcome)
        keep_again(results, name, same)
        keep(results, name, outcome)
        print(f"{number}/{len(drawn)} {'as before' if same else 'changed'}: {_line(outcome)}", flush=True)


def _task(case) -> tuple:
    """The function that tries a case, with the case."""
    from proof.trial import try_case
    from proof.wide.case import WideCase
    from proof.wide.trial import try_wide

    return try_wide if isinstance(case, WideCase) else try_case, case


def _line(outcome) -> str:
    told = ", ".join(f"{one.effect} ({one.pair})" if one.pair else one.effect for one in outcome.claims)
    told = f"{outcome.verdict}, {outcome.status}{', ' if told else ''}{told}{outcome.failed}"
    return f"{outcome.name} (z {outcome.score:.1f}): {told}; {outcome.seconds:.0f} s process time"


def _summary(listed: list, results: Path) -> None:
    """A line each of the cases of one part, right or not."""
    from proof.judged import is_right, is_wrong_name
    from proof.store import load, name_of

    for case in listed if len({case.part for case in listed}) == 1 else ():
        outcome = load(results, name_of(case))
        if outcome is not None:
            mark = "right" if is_right(outcome) else "wrong" if is_wrong_name(outcome) else "not named"
            print(f"{mark:9s}  z {outcome.score:5.1f}  {outcome.verdict}, {outcome.status}  {case.name}")


def _tell(options: argparse.Namespace) -> None:
    """Make the page's other sections that are not there yet."""
    from proof.real import sections
    from proof.told import keep_told, load_told

    for name, make in sections().items():
        asked = options.part == name or (options.part is None and not options.development)
        if asked and options.cases != 0 and load_told(options.results, name) is None:
            keep_told(options.results, name, make())
            print(f"section {name}", flush=True)


def _outcomes(missing: dict, workers: int) -> Iterator[tuple]:
    """The outcome of each task with its name, as soon as it is there."""
    if workers == 1:
        yield from ((name, attempt(task)) for name, (attempt, task) in missing.items())
        return
    pool = ProcessPoolExecutor(workers)
    try:
        begun = {pool.submit(attempt, task): name for name, (attempt, task) in missing.items()}
        for done in as_completed(begun):
            yield begun[done], done.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _write(case, folder: Path) -> int:
    """The recording of one case as a folder that any diagnosis can read."""
    from proof.campaigns import campaigns
    from proof.recordings import make
    from proof.wide.case import WideCase
    from proof.wide.trial import made as made_wide
    from proof.writing import write_recording

    folder.mkdir(parents=True, exist_ok=True)
    if isinstance(case, WideCase):
        wide = made_wide(case)
        wide.write(folder)
        print(f"{case.name}: score {wide.expected.score:.1f}, sizes {wide.expected.sizes}, in {folder}")
        return 0
    made = make(case)
    write_recording(folder, case.name, made.readings, campaigns()[case.campaign].circuit)
    print(f"{case.name}: score {made.score:.1f}, sizes {made.sizes}, in {folder}")
    return 0


def _record(results: Path, seed: int) -> int:
    """Write the track record from the outcomes of the proof's cases that are there; 1 where there is none."""
    from proof.cases import cases
    from proof.record import write_record
    from proof.store import outcomes

    known = outcomes(results, (case for part in Part for case in cases(part, seed)))
    if not known:
        print(f"no outcome in {results}")
        return 1
    path = ROOT / "diagnosis" / "report" / "track_record.json"
    write_record(known, path)
    print(f"{len(known)} outcomes, record in {path}")
    return 0


def _page(results: Path, page: Path, seed: int) -> None:
    from proof.page import write_page

    write_page(results, page, seed)
    print(f"page in {page}")


if __name__ == "__main__":
    sys.exit(main())
