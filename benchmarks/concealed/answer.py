"""An answer of a tool on one recording, as a JSON file; every fault of it with its place."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reynolds.numerics.files import replaced
from system.description.gap import Gap
from system.effects.effect import EffectId, Kind
from system.inputs.faults import Fault, InputFaults, nearest_choice, stated

FORMAT = 1
VERDICTS = tuple(one.value for one in Kind)
STATUSES = ("named", "suspicion", "failed")
IDS = tuple(one.value for one in EffectId if one is not EffectId.UNKNOWN_PHYSICS)
GAPS = (*(one.value for one in Gap), "piston_slipper_socket", "ball_guide_retainer", "front_bearing", "rear_bearing")
"""Places of a name: a gap, or of friction_coefficient a joint."""
KEYS = {"format": int, "recording": str, "verdict": str, "status": str, "names": list, "ranking": list, "cpu_s": float}
NAME_KEYS = {"id": str, "gap": str, "probability": float, "or": list}
RANKED_KEYS = {"ids": list, "gaps": list, "probability": float}
MOST = 1.0 + 1e-6
"""Sum of the probabilities of a ranking at most: one, and round-off."""
_WORDS = {int: "a whole number", str: "a text", list: "a list", float: "a number"}


@dataclass(frozen=True)
class Name:
    """One named cause: its id, its gap ("": not stated), its probability, ids inseparable from it."""

    id: str
    gap: str
    probability: float
    equivalent: tuple[str, ...]


@dataclass(frozen=True)
class Ranked:
    """An explanation in the comparison: ids with their gaps, "" for no gap, and its probability; no id: nothing."""

    ids: tuple[str, ...]
    gaps: tuple[str, ...]
    probability: float


@dataclass(frozen=True)
class Answer:
    """Answer of a tool on a recording; cpu_s: processor time, nan where it is not stated."""

    recording: str
    verdict: str
    status: str
    names: tuple[Name, ...]
    ranking: tuple[Ranked, ...]
    cpu_s: float


def read_answers(folder: Path, recordings: Sequence[str]) -> dict[str, Answer]:
    """Return the answers of a folder by recording; a recording without a file has none.

    Raises InputFaults with every fault of every file.
    """
    if not folder.is_dir():
        raise InputFaults("answers", [Fault(str(folder), "no folder", "a folder of JSON files, one a recording")])
    faults: list[Fault] = []
    found = {}
    for path in sorted(folder.glob("*.json")):
        answer = _read(path, recordings, faults)
        if answer is not None and answer.recording in found:
            faults.append(Fault(f"{path.name}: recording", f"'{answer.recording}' a second time", "one answer each"))
        elif answer is not None:
            found[answer.recording] = answer
    if faults:
        raise InputFaults(str(folder), faults)
    return found


def write_answer(folder: Path, answer: Answer) -> None:
    """Write an answer as a file of its recording's name."""
    rows = {
        "format": FORMAT, "recording": answer.recording, "verdict": answer.verdict, "status": answer.status,
        "names": [{"id": one.id, "gap": one.gap, "probability": one.probability, "or": [*one.equivalent]}
                  for one in answer.names],
        "ranking": [{"ids": [*one.ids], "gaps": [*one.gaps], "probability": one.probability}
                    for one in answer.ranking],
        "cpu_s": answer.cpu_s,
    }  # fmt: skip
    folder.mkdir(parents=True, exist_ok=True)
    with replaced(folder / f"{answer.recording}.json") as beside:
        beside.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


def _read(path: Path, recordings: Sequence[str], faults: list[Fault]) -> Answer | None:
    """Return the answer of a file; None with its faults listed."""
    try:
        raw = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as reason:
        faults.append(Fault(path.name, str(reason), "a JSON object"))
        return None
    own = [*_faults(raw, recordings)]
    faults += [Fault(f"{path.name}: {one.path}", one.found, one.expected, one.nearest) for one in own]
    if own:
        return None
    names = (Name(one["id"], one.get("gap", ""), float(one.get("probability", 1.0)), tuple(one.get("or", ())))
             for one in raw.get("names", ()))  # fmt: skip
    ranking = (Ranked(tuple(one["ids"]), tuple(one.get("gaps", [""] * len(one["ids"]))), float(one["probability"]))
               for one in raw.get("ranking", ()))  # fmt: skip
    return Answer(raw["recording"], raw["verdict"], raw.get("status", "named"), tuple(names), tuple(ranking),
                  float(raw.get("cpu_s", "nan")))  # fmt: skip


def _faults(raw: object, recordings: Sequence[str]) -> Iterator[Fault]:
    """Yield the faults of an answer."""
    wrong = [*_shape("", raw, KEYS, ("format", "recording", "verdict"))]
    yield from wrong
    if wrong or not isinstance(raw, dict):
        return
    if raw["format"] != FORMAT:
        yield Fault("format", stated(raw["format"]), f"{FORMAT}", f"{FORMAT}")
    yield from _choice("recording", raw["recording"], recordings, "a recording of the split")
    yield from _choice("verdict", raw["verdict"], VERDICTS, f"one of {', '.join(VERDICTS)}")
    yield from _choice("status", raw.get("status", "named"), STATUSES, f"one of {', '.join(STATUSES)}")
    for number, one in enumerate(raw.get("names", ()), start=1):
        yield from _named(f"names.{number}", one)
    weighed = 0.0
    for number, one in enumerate(raw.get("ranking", ()), start=1):
        wrong = [*_ranked(f"ranking.{number}", one)]
        yield from wrong
        weighed += 0.0 if wrong else one["probability"]
    if weighed > MOST:
        yield Fault("ranking", f"{weighed:.3g} together", "probabilities that add up to 1 at most")
    if raw.get("names") and raw["verdict"] == Kind.NO_MISMATCH.value:
        yield Fault("names", f"{len(raw['names'])} beside no_mismatch", "no name, or another verdict")


def _named(where: str, raw: object) -> Iterator[Fault]:
    wrong = [*_shape(f"{where}.", raw, NAME_KEYS, ("id",), where)]
    yield from wrong
    if wrong or not isinstance(raw, dict):
        return
    yield from _choice(f"{where}.id", raw["id"], IDS, "an id of the list in README.md")
    yield from _choice(f"{where}.gap", raw.get("gap", ""), ("", *GAPS), f'one of {", ".join(GAPS)}, or ""')
    yield from _probability(f"{where}.probability", raw.get("probability", 1.0))
    for one in raw.get("or", ()):
        yield from _choice(f"{where}.or", one, IDS, "an id of the list in README.md")


def _ranked(where: str, raw: object) -> Iterator[Fault]:
    wrong = [*_shape(f"{where}.", raw, RANKED_KEYS, ("ids", "probability"), where)]
    yield from wrong
    if wrong or not isinstance(raw, dict):
        return
    for one in raw["ids"]:
        yield from _choice(f"{where}.ids", one, (*IDS, Kind.UNKNOWN_PHYSICS.value), "an id of the list in README.md")
    for one in raw.get("gaps", ()):
        yield from _choice(f"{where}.gaps", one, ("", *GAPS), f'one of {", ".join(GAPS)}, or ""')
    if "gaps" in raw and len(raw["gaps"]) != len(raw["ids"]):
        yield Fault(f"{where}.gaps", f"{len(raw['gaps'])} for {len(raw['ids'])} ids", 'one each, "" for none')
    yield from _probability(f"{where}.probability", raw["probability"])


def _shape(
    before: str, raw: object, keys: Mapping[str, type], needed: Sequence[str], where: str = "the file"
) -> Iterator[Fault]:
    """Yield the faults of a JSON object's keys and of the types of their values."""
    if not isinstance(raw, dict):
        yield Fault(where, stated(raw), f"an object with {', '.join(keys)}")
        return
    for key in needed:
        if key not in raw:
            yield Fault(before + key, "missing", _WORDS[keys[key]])
    for key, value in raw.items():
        if key not in keys:
            yield Fault(before + key, "an unknown key", f"one of {', '.join(keys)}", nearest_choice(key, tuple(keys)))
        elif not _is(value, keys[key]):
            yield Fault(before + key, stated(value), _WORDS[keys[key]])


def _is(value: Any, kind: type) -> bool:
    if kind in (int, float):
        return isinstance(value, int if kind is int else (int, float)) and not isinstance(value, bool)
    return isinstance(value, kind)


def _choice(where: str, value: object, known: Sequence[str], expected: str) -> Iterator[Fault]:
    if value not in known:
        near = nearest_choice(value, known) if isinstance(value, str) else ""
        yield Fault(where, stated(value), expected, near)


def _probability(where: str, value: float) -> Iterator[Fault]:
    if not 0.0 <= value <= 1.0:
        yield Fault(where, f"{value:g}", "a probability, 0 to 1")
