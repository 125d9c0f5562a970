"""The public benchmark of concealed physics: makes its recordings, enters this program, scores answers.

    python benchmarks/concealed.py make FOLDER                      both splits, 84 recordings each, with their truths
    python benchmarks/concealed.py make FOLDER --recordings 12      a small one
    python benchmarks/concealed.py make FOLDER --test-seed N        a test split that its organiser keeps to himself
    python benchmarks/concealed.py enter FOLDER --split development  this diagnosis and its rivals; goes on from answers
    python benchmarks/concealed.py score FOLDER --split development [ANSWERS ..]   the table, by default of all entries

FOLDER is described in benchmarks/concealed/README.md. A recording takes seconds to make, a diagnosis a minute or two.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RECORDINGS = 84
ANSWERS = "answers"


def main() -> int:
    """Run the command asked for; 2 with all faults of the input."""
    options = _options()
    sys.path.insert(0, str(ROOT))
    from system.inputs.faults import InputFaults

    try:
        return int({"make": _make, "enter": _enter, "score": _score}[options.what](options))
    except InputFaults as reason:
        print(f"concealed: {reason}", file=sys.stderr)
        return 2


def _options() -> argparse.Namespace:
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("what", choices=("make", "enter", "score"))
    reader.add_argument("folder", type=Path, metavar="FOLDER")
    reader.add_argument("answers", type=Path, nargs="*", metavar="ANSWERS", help="score: folders of answers, one each")
    reader.add_argument("--split", choices=("development", "test"), default="development")
    reader.add_argument("--recordings", type=int, default=RECORDINGS, metavar="N", help="make: of each split")
    reader.add_argument("--test-seed", type=int, metavar="N", help="make: draws of the test split, to keep secret")
    reader.add_argument("--truths", type=Path, metavar="FILE", help="score: truths that lie elsewhere")
    reader.add_argument("--page", type=Path, metavar="FILE", help="score: also write the table into a page")
    return reader.parse_intermixed_args()  # answers may stand behind the options


def _make(options: argparse.Namespace) -> int:
    from concealed.chosen import SEEDS, Split, most
    from concealed.made import make_benchmark

    from system.inputs.faults import Fault, InputFaults

    limit = most(SEEDS[Split.TEST])
    if not 1 <= options.recordings <= limit:
        fault = Fault(
            "--recordings", str(options.recordings), f"1 to {limit}", str(min(max(options.recordings, 1), limit))
        )
        raise InputFaults("command line", [fault])
    if options.test_seed in SEEDS.values():
        told = "a number other than the public ones, whose recordings anybody makes with their truths"
        raise InputFaults("command line", [Fault("--test-seed", str(options.test_seed), told)])
    if options.folder.exists() and any(options.folder.iterdir()):
        raise InputFaults("command line", [Fault("FOLDER", f"'{options.folder}', not empty", "a new folder")])
    seeds = {} if options.test_seed is None else {Split.TEST: options.test_seed}
    print(make_benchmark(options.folder, options.recordings, seeds))
    return 0


def _enter(options: argparse.Namespace) -> int:
    from concealed.entries import enter
    from concealed.made import RECORDINGS as PLACE

    names = _names(options)
    for line in enter(options.folder / options.split / PLACE, options.folder / ANSWERS / options.split, names,
                      with_rivals=True):  # fmt: skip
        print(line, flush=True)
    return 0


def _score(options: argparse.Namespace) -> int:
    from concealed.answer import read_answers
    from concealed.page import write_page
    from concealed.scoring import score

    names, truths = _names(options), _truths(options)
    folders = options.answers or sorted(
        path for path in (options.folder / ANSWERS / options.split).glob("*") if path.is_dir()
    )
    _refuse_namesakes(folders)
    entries = {folder.resolve().name: read_answers(folder, names) for folder in folders}
    scores = [score(name, truths, answers) for name, answers in entries.items()]
    print(write_page(options.page, options.split, truths, entries, scores))
    return 0


def _refuse_namesakes(folders: list[Path]) -> None:
    """Raise InputFaults for folders of one name: an entry has the name of its folder."""
    from system.inputs.faults import Fault, InputFaults

    counts = Counter(folder.resolve().name for folder in folders)
    faults = [Fault("ANSWERS", f"'{name}' {count} times", "one folder a name, that of its entry")
              for name, count in counts.items() if count > 1]  # fmt: skip
    if faults:
        raise InputFaults("command line", faults)


def _names(options: argparse.Namespace) -> list[str]:
    """Return the recordings of the split, by the manifest."""
    return sorted(_split(options)["recordings_sha256"])


def _split(options: argparse.Namespace) -> dict:
    from concealed import VERSION
    from concealed.made import MANIFEST

    from system.inputs.faults import Fault, InputFaults

    path = options.folder / MANIFEST
    if not path.is_file():
        raise InputFaults("command line", [Fault("FOLDER", f"no {path}", "a folder of `concealed.py make`")])
    about = json.loads(path.read_text("utf-8"))
    if about["benchmark"] != VERSION:
        found = f"version {about['benchmark']}"
        raise InputFaults(str(path), [Fault("benchmark", found, f"version {VERSION}, which this program scores")])
    return dict(about["splits"][options.split])


def _truths(options: argparse.Namespace) -> list:
    """Return the truths of the split, whose seal is that of the manifest."""
    from concealed.chosen import Split
    from concealed.made import SEALED, TRUTHS
    from concealed.truth import read_truths, seal

    from system.inputs.faults import Fault, InputFaults

    beside = options.folder / options.split / TRUTHS
    sealed = options.folder / SEALED / f"{options.split}-{TRUTHS}"
    path = options.truths or (beside if options.split == Split.DEVELOPMENT.value else sealed)
    if not path.is_file():
        raise InputFaults(
            "command line", [Fault("--truths", f"no {path}", "the truths of the split, which its organiser has")]
        )
    if seal(path) != _split(options)["truths_sha256"]:
        raise InputFaults(str(path), [Fault("truths_sha256", "another seal", "the file that the manifest seals")])
    return read_truths(path)


if __name__ == "__main__":
    sys.exit(main())
