"""Page of a run folder, report.html, and the pictures in it."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swashfilm.output.figures import png_of
from system.inputs.faults import Fault, InputFaults

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAGE = "report.html"
PLOTS = "plots"


def expect_files(folder: Path, names: Sequence[str], whose: str) -> None:
    """Raise InputFaults with every file of `names` that the folder lacks; `whose`: the expected kind of folder."""
    missing = [name for name in names if not (folder / name).is_file()]
    if missing:
        raise InputFaults(str(folder), [Fault(name, "no such file", whose) for name in missing])


def read_summary(folder: Path, needed: Sequence[str] = (), whose: str = "") -> dict[str, Any]:
    """Return the content of a run folder's summary.json; raise as `expect_files` where a file of `needed` lacks."""
    expect_files(folder, needed, whose)
    return json.loads((folder / "summary.json").read_text("utf-8"))


def write_page(folder: Path, template: str, **content: Any) -> Path:
    """Write report.html, one self-contained file, from a template of this room; return its path.

    A symbolic link at report.html is replaced, never followed.
    """
    from jinja2 import Environment, PackageLoader

    loader = PackageLoader("swashfilm.output")
    page = Environment(loader=loader, autoescape=True).get_template(f"{template}.html.jinja").render(**content)
    path = folder / PAGE
    path.unlink(missing_ok=True)
    path.write_text(page, encoding="utf-8")
    return path


def inlined(picture: Figure | bytes) -> str:
    """Return a picture (bytes: a PNG) as a page embeds it: PNG in base64."""
    png = picture if isinstance(picture, bytes) else png_of(picture)
    return base64.b64encode(png).decode("ascii")


def keep_pictures(folder: Path, stem: str, pictures: Mapping[str, Figure]) -> dict[str, str]:
    """Write pictures as plots/STEM-1.png, plots/STEM-2.png, .. and captions as plots/STEM.json.

    Return the same as `kept_pictures`.
    """
    (folder / PLOTS).mkdir(exist_ok=True)
    captions = {}
    for number, (caption, figure) in enumerate(pictures.items(), start=1):
        name = f"{stem}-{number}.png"
        (folder / PLOTS / name).write_bytes(png_of(figure))
        captions[name] = caption
    (folder / PLOTS / f"{stem}.json").write_text(json.dumps(captions, indent=2) + "\n", encoding="utf-8")
    return kept_pictures(folder, stem)


def kept_pictures(folder: Path, stem: str) -> dict[str, str]:
    """Return the pictures of `keep_pictures`, by caption, in base64; raise OSError where there are none."""
    captions = json.loads((folder / PLOTS / f"{stem}.json").read_text("utf-8"))
    return {caption: inlined((folder / PLOTS / name).read_bytes()) for name, caption in captions.items()}
