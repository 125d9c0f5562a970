"""The benchmark's folders: recordings of both splits, truths beside them or sealed, a manifest with every hash."""

from __future__ import annotations

import json
import re
import shutil
from hashlib import sha256
from pathlib import Path
from random import Random

from proof.campaigns import campaigns
from proof.cases import Case
from proof.expected import of_case
from proof.outcome import Outcome
from proof.recordings import make
from proof.store import VERSIONS
from proof.wide.case import WideCase
from proof.wide.trial import made as made_wide
from proof.writing import BENCH, write_recording

from . import VERSION
from .chosen import SEEDS, Split, chosen
from .truth import Truth, truth_of, write_truths

MANIFEST, TRUTHS, RECORDINGS, PUMP = "manifest.json", "truths.json", "recordings", "pump.toml"
SEALED = "sealed"
"""Folder of the truths of the test split, to withhold from participants."""
LICENCE = "CC-BY-4.0"
_NAMED = re.compile(r'^(title|name) = ".*"$', re.MULTILINE)


def make_benchmark(folder: Path, recordings: int, seeds: dict[Split, int] | None = None) -> Path:
    """Write both splits with so many recordings each, and the manifest; return its path.

    seeds: in place of the public ones, such as a test that its organiser keeps to himself.
    """
    stated = SEEDS | (seeds or {})
    splits = {}
    for split in Split:
        place = folder / split.value
        truths = _write_split(place / RECORDINGS, split, stated[split], recordings)
        beside = place / TRUTHS if split is Split.DEVELOPMENT else folder / SEALED / f"{split.value}-{TRUTHS}"
        splits[split.value] = {
            "seed": stated[split] if stated[split] == SEEDS[split] else "kept by the organiser",
            "truths_sha256": write_truths(beside, truths),
            "recordings_sha256": {one.recording: _hash(place / RECORDINGS / one.recording) for one in truths},
        }
    about = {
        "format": 1, "benchmark": VERSION, "licence": LICENCE, "recordings": recordings,
        "plants": {plant.value: version for plant, version in VERSIONS.items()}, "splits": splits,
    }  # fmt: skip
    (folder / MANIFEST).write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")
    return folder / MANIFEST


def _write_split(place: Path, split: Split, seed: int, recordings: int) -> list[Truth]:
    """Write the recordings of a split, in a neutral order, and return their truths by name."""
    found = chosen(seed, recordings)
    numbers = list(range(1, len(found) + 1))
    Random(seed).shuffle(numbers)
    truths = []
    for number, case in zip(numbers, found, strict=True):
        name = f"{split.value}-{number:03d}"
        expected = write_case(case, name, place / name)
        truths.append(truth_of(name, case.part.plant.value, expected))
        print(f"{name}: {case.part.value}", flush=True)
    return sorted(truths, key=lambda one: one.recording)


def write_case(case: Case | WideCase, name: str, folder: Path) -> Outcome:
    """Write the recording of a case under a neutral name, with the pump's file; return the truth."""
    folder.mkdir(parents=True)
    if isinstance(case, WideCase):
        made = made_wide(case)
        made.write(folder)
        expected = made.expected
    else:
        own = make(case)
        write_recording(folder, name, own.readings, campaigns()[case.campaign].circuit)
        expected = of_case(case, own)
    named = [folder / "recording.toml", *folder.glob(PUMP)]
    if len(named) == 1:
        shutil.copyfile(BENCH, folder / PUMP)
    for path in named:
        path.write_text(_NAMED.sub(rf'\1 = "{name}"', path.read_text("utf-8"), count=1), encoding="utf-8")
    return expected


def _hash(folder: Path) -> str:
    """Return the SHA-256 of all files of a recording, in the order of their names."""
    return sha256(b"".join(path.read_bytes() for path in sorted(folder.iterdir()))).hexdigest()
