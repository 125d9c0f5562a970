"""Compiled code of earlier sources, discarded before it is loaded.

Numba keeps a compiled function until its own file changes. The functions and constants that it uses from other files
are compiled into it: a change of those alone, as by an update of the program, would leave it as it was.
"""

import json
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from hashlib import sha1, sha256
from pathlib import Path

from platformdirs import user_cache_path

PACKAGES = ("reynolds", "gaps", "system")
"""The packages with compiled functions, beside each other."""
STAMP = "kernel_sources.json"
_IMPORT = re.compile(rb"^from ([\w.]+) import (\([^)]*\)|[^\n]*)", re.MULTILINE)


def discard_stale(root: Path, packages: Iterable[str] = PACKAGES) -> list[str]:
    """Modules below `root` with compiled functions that have changed, or use what has; their kept code is removed then.

    A module uses those that it imports from, and what these use where they have compiled functions too. A stamp beside
    the kept code holds the sources of which it is. Without write access to that place numba keeps nothing there either.
    """
    packages = tuple(packages)
    sources = {path: text for path in _files(root, packages) if b"numba" in (text := path.read_bytes())}
    uses = {path: tuple(_imported(root, text)) for path, text in sources.items()}
    now = {path.relative_to(root).as_posix(): _digest(root, _used(path, uses)) for path in sources}
    stamp = kept_in(root / packages[0]) / STAMP
    before = _read(stamp)
    changed = [name for name, own in now.items() if before.get(name) != own]
    if changed:
        with suppress(OSError):
            for name in changed:
                _discard(root / name)
            _write(stamp, now)
    return changed


def kept_in(folder: Path) -> Path:
    """Folder in which numba keeps the compiled code of a folder's modules."""
    own = os.environ.get("NUMBA_CACHE_DIR")
    if not own and os.access(folder, os.W_OK):
        return folder / "__pycache__"
    home = Path(own) if own else user_cache_path("numba", appauthor=False)
    return home / f"{folder.name}_{sha1(str(folder).encode()).hexdigest()}"


def _files(root: Path, packages: Iterable[str]) -> Iterator[Path]:
    return (path for package in packages for path in (root / package).rglob("*.py"))


def _imported(root: Path, text: bytes) -> Iterator[Path]:
    """Files below `root` from which a source imports: modules, or names of a package that are modules."""
    for module, names in _IMPORT.findall(text):
        place = root.joinpath(*module.decode().split("."))
        within = [place / name for name in re.findall(r"\w+", names.decode())]
        yield from (path for one in (place, *within) if (path := one.with_name(f"{one.name}.py")).is_file())


def _used(path: Path, uses: Mapping[Path, tuple[Path, ...]]) -> list[Path]:
    """A file with all that it uses, sorted."""
    found, left = {path}, [path]
    while left:
        new = set(uses.get(left.pop(), ())) - found
        found |= new
        left += new
    return sorted(found)


def _digest(root: Path, files: Iterable[Path]) -> str:
    parts = (f"{path.relative_to(root).as_posix()} {sha256(path.read_bytes()).hexdigest()}" for path in files)
    return sha256("\n".join(parts).encode()).hexdigest()


def _discard(module: Path) -> None:
    for kept in kept_in(module.parent).glob(f"{module.stem}.*.nb[ci]"):
        kept.unlink(missing_ok=True)


def _read(stamp: Path) -> Mapping[str, str]:
    try:
        found = json.loads(stamp.read_bytes())
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def _write(stamp: Path, now: Mapping[str, str]) -> None:
    """Write the stamp whole: another process reads the earlier one or this."""
    stamp.parent.mkdir(parents=True, exist_ok=True)
    part = stamp.with_name(f"{STAMP}.{os.getpid()}")
    part.write_text(json.dumps(now), encoding="utf-8")
    part.replace(stamp)
