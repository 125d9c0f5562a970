"""A new film case: one of the kinds that come with the program as commented files."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from shlex import quote

from swashfilm.cli.new.file import NewFile
from system.inputs.faults import Fault, nearest_choice

_FILMS = files("swashfilm.cli.new") / "films"


def film_kinds() -> dict[str, str]:
    """Return the kinds of film cases, each with the first line of its file."""
    kinds = sorted(item.name.removesuffix(".toml") for item in _FILMS.iterdir() if item.name.endswith(".toml"))
    return {kind: _text(kind).partition("\n")[0].strip("# ") for kind in kinds}


def new_film(kind: str | None, path: Path, faults: list[Fault]) -> NewFile | None:
    """Return the film case of a kind; None with faults added."""
    known = film_kinds()
    if kind not in known:
        found = "missing" if kind is None else repr(kind)
        nearest = "" if kind is None else nearest_choice(kind.replace("-", "_"), known)
        faults.append(Fault("KIND", found, f"one of {', '.join(known)}", nearest))
    if kind is None or faults:
        return None
    return NewFile(path, "case", _text(kind), (f"next: swashfilm film {quote(str(path))}",))


def _text(kind: str) -> str:
    return _FILMS.joinpath(f"{kind}.toml").read_text("utf-8")
