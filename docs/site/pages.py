"""Sphinx extension: contents of the site, and pages of the API reference from the packages."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from listed import EXAMPLES

PACKAGES = ("reynolds", "gaps", "system", "diagnosis", "swashfilm")
CONTENTS = {
    "Start": ("/README", "tutorial", "gallery", "examples/index", "notebooks/film", "notebooks/pump", "wrong_results"),
    "Reference": ("files", "conventions", "Files of the examples </examples/README>", "/meshes/README",
                  "cluster", "api/index"),
    "Background": ("theory", "architecture", "validation", "measured", "credibility", "proof", "proof_floating",
                   "plan_check", "concealed", "Entering the benchmark </benchmarks/concealed/README>",
                   "hostile", "mutations",
                   "Reproduction <reproduction>",
                   "Reproduction with films <reproduction_fixed>",
                   "Reproduction with floating films <reproduction_floating>", "benchmarks"),
    "Project": ("/CHANGELOG", "/CONTRIBUTING", "/CODE_OF_CONDUCT", "/SECURITY", "/THIRD_PARTY"),
}  # fmt: skip
"""Pages by their place in the menu, relative to docs/; a title in front of <page> stands for the page's own."""
FRONT = '<!doctype html><meta charset="utf-8"><meta http-equiv="refresh" content="0; url=docs/index.html">'


def setup(app: Any) -> dict[str, bool]:
    """Register the API pages before the sources are read, the menu with the index, the front page after all."""
    app.connect("config-inited", write_pages)
    app.connect("source-read", add_contents)
    app.connect("build-finished", write_front)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def add_contents(_app: Any, name: str, source: list[str]) -> None:
    """Append the menu to docs/index.md and to that of the examples, which stay plain Markdown in the repository."""
    if name == "docs/index":
        for caption, pages in CONTENTS.items():
            source[0] += _menu(pages, f":caption: {caption}\n:maxdepth: 1\n")
    if name == "docs/examples/index":
        source[0] += _menu([example.name for example in EXAMPLES])


def _menu(pages: Iterable[str], options: str = "") -> str:
    listed = "\n".join(pages)
    return f"\n```{{toctree}}\n:hidden:\n{options}\n{listed}\n```\n"


def write_front(app: Any, _error: Exception | None) -> None:
    """Write index.html, which leads to docs/index.html."""
    Path(app.outdir, "index.html").write_text(FRONT, encoding="utf-8")


def write_pages(app: Any, _config: Any) -> None:
    """Write docs/api: an index, and one page a package and a room; unchanged pages keep their time."""
    folder = Path(app.srcdir) / "docs" / "api"
    folder.mkdir(exist_ok=True)
    pages = {"index": _index()}
    for name in PACKAGES:
        rooms = _rooms(name)
        pages[name] = _package(name, rooms)
        pages |= {room: _room(room, modules) for room, modules in rooms.items()}
    for old in folder.glob("*.rst"):
        if old.stem not in pages:
            old.unlink()
    for name, text in pages.items():
        path = folder / f"{name}.rst"
        if not path.exists() or path.read_text("utf-8") != text:
            path.write_text(text, encoding="utf-8")


def _index() -> str:
    lines = "\n".join(f"   {name}" for name in PACKAGES)
    return (
        f"{_title('API reference')}\nEach page of a package has the public names first. Deeper modules may move"
        f" without notice.\n\n.. toctree::\n   :maxdepth: 2\n\n{lines}\n"
    )


def _package(name: str, rooms: dict[str, list[str]]) -> str:
    """The page of a package: its purpose, public names, rooms; a name of a package below is in that one's page."""
    listed = "\n".join(f"   {room}" for room in rooms)
    package = importlib.import_module(name)
    homes = {one: getattr(getattr(package, one), "__module__", f"{name}.") for one in package.__all__}
    below = [one for one, home in homes.items() if not home.startswith(f"{name}.")]
    left_out = f"   :exclude-members: {', '.join(below)}\n" if below else ""
    borrowed = f"Also here, from the packages below: {', '.join(f'``{one}``' for one in below)}.\n\n" if below else ""
    return (
        f"{_title(name)}\n.. automodule:: {name}\n   :members:\n{left_out}\n{borrowed}"
        f"{_title('Rooms', '-')}\n.. toctree::\n   :maxdepth: 1\n\n{listed}\n"
    )


def _room(name: str, modules: list[str]) -> str:
    """The page of a room: its purpose, then every module with its documented names."""
    parts = [_title(name)]
    if hasattr(importlib.import_module(name), "__path__"):
        parts.append(f".. automodule:: {name}\n   :no-members:\n")
    for module in modules:
        short = module.removeprefix(f"{name}.")
        parts.append(f"{_title(short, '-')}\n.. automodule:: {module}\n   :members:\n   :show-inheritance:\n")
    return "\n".join(parts)


def _rooms(package: str) -> dict[str, list[str]]:
    """Modules by room; a module that lies in the package itself is a room of its own."""
    found: dict[str, list[str]] = {}
    top = importlib.import_module(package)
    for module in pkgutil.walk_packages(top.__path__, f"{package}."):
        if module.ispkg:
            found.setdefault(module.name, [])
        elif not module.name.endswith("__main__"):
            room = module.name.rpartition(".")[0]
            found.setdefault(module.name if room == package else room, []).append(module.name)
    return dict(sorted(found.items()))


def _title(text: str, rule: str = "=") -> str:
    return f"{text}\n{rule * len(text)}\n"
