"""Write the schemas of formats, swashfilm/formats/schemas, from run folders that the program has written.

    python tools/formats.py FOLDER ..       widen the schemas by every run folder below
    python tools/formats.py                 write the schemas of input files anew
    python tools/formats.py --release 0.2.0 the versions so far are those of a release: none of them changes any more

A schema describes one version of a kind of run folder: the header (`headers.py`) of each of its files. A key that some
folders lack is optional. `format_rules.py` states which keys are the user's and which entries may be null. The written
version is that of `swashfilm.formats.versions`.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import sys
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import tomli_w
from format_rules import FREE, NULL, STATED
from headers import folder_header

from swashfilm.console.schemas import SCHEMAS, schema_of
from swashfilm.formats.versions import VERSIONS
from swashfilm.output.headline import named

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "swashfilm" / "formats" / "schemas"
FINGERPRINTS = ROOT / "tests" / "interface" / "formats" / "fingerprints.toml"
UNRELEASED = "unreleased"
DRAFT = "https://json-schema.org/draft/2020-12/schema"
_TYPES = {bool: "boolean", int: "integer", float: "number", str: "string", list: "array", type(None): "null"}

Schema = dict[str, Any]


@dataclass(frozen=True)
class Names:
    """The kind of a schema and its version: `run.pump` and 1 of run folders, `pump` and 1 of input files."""

    kind: str
    version: int

    @property
    def key(self) -> str:
        """Name of the schema's file, without its ending."""
        return f"{self.kind}-{self.version}"

    @property
    def path(self) -> Path:
        """File of the schema."""
        return KEPT / f"{self.key}.json"


def main(words: list[str]) -> int:
    """Run the tool; the exit code is 1 where a released version would change."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--release", metavar="VERSION")
    asked = parser.parse_args(words)
    prints = read_fingerprints()
    if asked.release:
        return _release(asked.release, prints)
    changed = {names: schema for names, schema in _schemas(asked.folders) if schema_text(schema) != _text(names)}
    refused = [names.key for names in changed if names.key in released(prints)]
    for key in refused:
        print(f"{key} is released and would change: raise its version", file=sys.stderr)
    for names, schema in changed.items():
        if names.key not in refused:
            names.path.write_text(schema_text(schema), encoding="utf-8")
            print(f"{names.path.relative_to(ROOT)} written")
    # Also of schemas that a merge has changed.
    prints[UNRELEASED] = {
        path.stem: fingerprint(path) for path in KEPT.glob("*.json") if path.stem not in released(prints)
    }
    write_fingerprints(prints)
    return 1 if refused else 0


def _release(name: str, prints: dict[str, dict[str, str]]) -> int:
    """State the versions so far under a release; 1 where it has some already, or schemas are not those stated."""
    if name in prints:
        print(f"{name} is released: its versions never change", file=sys.stderr)
        return 1
    stated = {key: one for own in prints.values() for key, one in own.items()}
    if stated != {path.stem: fingerprint(path) for path in KEPT.glob("*.json")}:
        print("schemas are not those of the fingerprints: python tools/formats.py first", file=sys.stderr)
        return 1
    prints[name] = prints.pop(UNRELEASED, {})
    write_fingerprints(prints)
    return 0


def _schemas(folders: list[Path]) -> Iterator[tuple[Names, Schema]]:
    """Yield the schemas of input files, and those of the kinds of run folders below `folders`."""
    yield from ((input_names(kind), schema_of(kind)) for kind in SCHEMAS)
    found: dict[Names, Schema | None] = {}
    for folder in folders:
        for summary in sorted(path for path in folder.rglob("summary.json") if path.is_file()):
            if ".partial" in summary.parent.name:
                continue
            head = json.loads(summary.read_text("utf-8"))
            names = run_names(head["kind"])
            if head["format"] == names.version:
                found[names] = widened(found.get(names) or _loaded(names), folder_header(summary.parent))
    for names, schema in found.items():
        title = f"Run folder of {names.kind.removeprefix('run.')}, format {names.version}: the header of each file"
        yield names, {"$schema": DRAFT, "title": title, **(schema or {})}


def run_names(kind: str) -> Names:
    """Return the names of the schema of a kind of run folder at the version that is written."""
    return Names(f"run.{kind}", VERSIONS[kind])


def input_names(kind: str) -> Names:
    """Return the names of the schema of a kind of input, at the version that its files state."""
    return Names(kind, schema_of(kind)["properties"]["format"]["const"])


def _text(names: Names) -> str:
    return names.path.read_text("utf-8") if names.path.is_file() else ""


def _loaded(names: Names) -> Schema | None:
    return json.loads(_text(names)) if names.path.is_file() else None


def schema_text(schema: Schema) -> str:
    """Return a schema as the text of its file."""
    return json.dumps(schema, indent=1, sort_keys=True, ensure_ascii=False) + "\n"


def widened(schema: Schema | None, value: Any, path: str = "", *, of_input: bool = False) -> Schema:
    """Return the schema that accepts all values of `schema`, and this value; None accepts nothing.

    of_input: the value lies in an object of FREE, where only the types are part of the format.
    """
    found = dict(schema or {"type": []})
    types = {"object" if isinstance(value, Mapping) else _TYPES[type(value)], *_types(found)}
    types |= {one for pattern, other in NULL.items() if fnmatchcase(path, pattern) for one in ("null", other)}
    if "number" in types:
        types.discard("integer")
    found["type"] = sorted(types) if len(types) > 1 else next(iter(types))
    if isinstance(value, Mapping):
        _widen_object(found, value, path, of_input)
    elif isinstance(value, list):
        for one in value:
            found["items"] = widened(found.get("items"), one, f"{path}/*", of_input=of_input)
    elif not of_input and any(fnmatchcase(path, one) for one in STATED):
        found["enum"] = sorted({value, *found.get("enum", [])})
    elif isinstance(value, float) and (unit := named(path.rpartition("/")[2])[1]):
        found["description"] = unit
    return found


def _types(schema: Schema) -> list[str]:
    types = schema["type"]
    return [types] if isinstance(types, str) else list(types)


def _widen_object(found: Schema, value: Mapping[str, Any], path: str, of_input: bool) -> None:
    """Widen an object: its keys, or the values of keys that are the user's."""
    if any(fnmatchcase(path, one) for one in FREE):
        for one in value.values():
            found["additionalProperties"] = widened(found.get("additionalProperties"), one, f"{path}/*", of_input=True)
        return
    keys = dict(found.get("properties", {}))
    found["required"] = sorted(set(found.get("required", value)) & set(value))
    for key, one in value.items():
        keys[key] = widened(keys.get(key), one, f"{path}/{key}".lstrip("/"), of_input=of_input)
    found |= {"properties": keys, "additionalProperties": False}


def fingerprint(path: Path) -> str:
    """Return the first 16 digits of the SHA-256 of a schema's file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def read_fingerprints() -> dict[str, dict[str, str]]:
    """Return the fingerprints of schemas by release and name."""
    return tomllib.loads(FINGERPRINTS.read_text("utf-8")) if FINGERPRINTS.is_file() else {}


def write_fingerprints(prints: Mapping[str, Mapping[str, str]]) -> None:
    """Write the fingerprints of schemas by release and name."""
    ordered = {release: dict(sorted(own.items())) for release, own in prints.items() if own}
    there = {key: one for key, one in ordered.get(UNRELEASED, {}).items() if (KEPT / f"{key}.json").is_file()}
    ordered |= {UNRELEASED: there} if there else {}
    FINGERPRINTS.write_text(tomli_w.dumps(ordered), encoding="utf-8")


def released(prints: Mapping[str, Mapping[str, str]]) -> set[str]:
    """Return the names of the schemas of all releases."""
    return {key for release, own in prints.items() if release != UNRELEASED for key in own}


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
