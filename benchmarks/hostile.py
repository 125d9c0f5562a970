"""Hostile input: mutated files of every kind through every door of the program, and the page that tells.

    python benchmarks/hostile.py                           runs what is not there yet, then writes docs/hostile.md
    python benchmarks/hostile.py --door "pump file" --cases 20
    python benchmarks/hostile.py --again                   runs those anew that broke the promise
    python benchmarks/hostile.py --cases 0                 runs nothing, writes the page from what is there

The seed of a case is its door and number. Each outcome is a line of --results as soon as it is known: Ctrl-C loses only
the case in hand, the next call goes on. A case takes between 0.05 and 20 s; all 2900 take about an hour of one core.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

from hostile.doors import GOOD, Door, doors
from hostile.judged import Outcome
from hostile.page import counted, page_text
from hostile.samples import make_samples
from hostile.trial import MORE_MEMORY, PROCESSOR, Told, tried

ROOT = Path(__file__).resolve().parents[1]


def main() -> int:
    """Run the missing cases and write the page; return 1 where a case breaks the promise."""
    options = _options()
    sys.path.insert(0, str(ROOT))
    options.results.mkdir(parents=True, exist_ok=True)
    place = options.results / "outcomes.jsonl"
    known = {(one.door, one.kind, one.number): one for one in _read(place)}
    if options.again:
        known = {key: one for key, one in known.items() if one.outcome.good}
    chosen = [door for door in doors() if not options.door or door.name in options.door]
    try:
        _run(chosen, options, place, known)
    except KeyboardInterrupt:
        print("interrupted; what was finished is kept")
    found = [one for door in doors() for key, one in known.items() if key[:2] == (door.name, door.kind)]
    _tell(found)
    options.page.write_text(page_text(counted(found), MORE_MEMORY, PROCESSOR), encoding="utf-8")
    return int(any(not one.outcome.good for one in found))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--door", action="append", help="the cases of this door alone; may be repeated")
    parser.add_argument("--cases", type=int, help="at most so many cases of a door")
    parser.add_argument("--again", action="store_true", help="run those anew that broke the promise")
    parser.add_argument("--results", type=Path, default=ROOT / "build" / "hostile")
    parser.add_argument("--page", type=Path, default=ROOT / "docs" / "hostile.md")
    return parser.parse_args()


def _run(chosen: Iterable[Door], options: argparse.Namespace, place: Path, known: dict[tuple, Told]) -> None:
    """Run the cases that are not known; each is written and known as soon as it has ended."""
    samples = options.results / "samples"
    os.environ.update(SWASHFILM_CACHE=str(options.results / "cache"), PYTHONPATH=str(ROOT))
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
        os.environ[name] = "1"
    if options.cases != 0:
        make_samples(samples)
        _load(samples)
    else:
        return
    from reynolds.numerics.files import append_whole

    for door in chosen:
        for number in range(GOOD, min(door.cases, options.cases or door.cases)):
            if (key := (door.name, door.kind, number)) in known:
                continue
            case = options.results / "cases" / f"{door.name}-{number}".replace("/", "-").replace(" ", "_")
            known[key] = one = tried(door, number, samples, case)
            append_whole(place, json.dumps(asdict(one) | {"outcome": one.outcome.value}).encode() + b"\n")
            if number == GOOD and one.outcome is not Outcome.ACCEPTED:
                raise RuntimeError(f"{door.name}: the good file is no good one: {one.outcome.value}, {one.told}")


def _load(samples: Path) -> None:
    """Import what the commands import, and read good files once, so that a child finds modules and units."""
    import importlib
    import io
    from contextlib import chdir, redirect_stdout

    from swashfilm.__main__ import main as command

    for name in (
        "asammdf", "h5py", "matplotlib.pyplot", "meshio", "nptdms", "openpyxl", "pandas", "plotly.graph_objects",
        "pyarrow.parquet", "pyvista", "scipy.io", "swashfilm.api", "swashfilm.cli.app", "xarray", "skfem",
        "skfem.io.meshio", "swashfilm.runs.film.page", "swashfilm.runs.map.page", "swashfilm.runs.pump.page",
        "swashfilm.runs.map.duty.run", "swashfilm.runs.export.write", "swashfilm.runs.pump.run",
        "swashfilm.runs.film.run", "swashfilm.runs.map.run", "diagnosis.recording.reader", "system.pump_file.file",
    ):  # fmt: skip
        importlib.import_module(name)
    for file in ("pump.toml", "scant.toml", "film.toml", "study.toml", "gap.toml", "transient.toml"):
        with chdir(samples / "plain"), redirect_stdout(io.StringIO()):
            command(["check", file])
    with chdir(samples / "recording-csv"), redirect_stdout(io.StringIO()):
        command(["check", "."])


def _read(place: Path) -> Iterable[Told]:
    """Yield the outcomes that are kept; of a case that was run twice the last one counts."""
    from reynolds.numerics.files import json_lines

    for values in json_lines(place):
        yield Told(**values | {"outcome": Outcome(values["outcome"])})


def _tell(found: Iterable[Told]) -> None:
    for one in found:
        if not one.outcome.good:
            print(f"{one.door} {one.number} ({one.how}): {one.outcome.value}: {' '.join(one.told.split())[-220:]}")


if __name__ == "__main__":
    sys.exit(main())
