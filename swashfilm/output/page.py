"""Page of a run folder, report.html, and the pictures in it."""

from __future__ import annotations

import base64
import json
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reynolds.numerics.files import (
    LARGEST_DATA,
    inside,
    is_file,
    leads_inside,
    read_bounded,
    read_json,
    read_text,
    replaced,
    write_whole,
)
from swashfilm.formats.versions import expect_known
from swashfilm.output.answer import Answer
from swashfilm.output.figures import compact
from swashfilm.output.touch.curves import touchable
from swashfilm.output.touch.explorer import Explorer
from swashfilm.output.touch.library import embedded
from swashfilm.output.touch.picture import Picture
from swashfilm.output.warnings import causes, counted
from system.inputs.faults import Fault, InputFaults

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAGE = "report.html"
PLOTS = "plots"
TOUCH = ".touch"
TOUCHED = '<script type="text/plain" class="touch">'
"""First tag of a figure that a template's picture holds."""
_HEADING = re.compile(r"<h2>(.*?)</h2>", re.DOTALL)
_NUMBER = re.compile(r"[-+<>~]?\d[\d.e+-]*( \+- [\d.e-]+)?( ?[a-zA-Z%/0-9]{1,6}( [a-z/]{1,4})?)?$")
_TIED = re.compile(r"(?<=\d) (?=\S)|(?<=\+-) (?=\d)|(?<=\bN) (?=m\b)|(?<=\bPa) (?=s\b)|(?<=mPa) (?=s\b)")
_BEFORE_UNIT = re.compile("(?<=\\d)\u00a0(?=\\D)")
_PICTURES = {b"\x89PNG": "png", b"RIFF": "webp", b"GIF8": "gif", b"<?xm": "svg+xml"}


def expect_files(folder: Path, names: Sequence[str], whose: str) -> None:
    """Raise InputFaults with every file of `names` that the folder lacks, and every link that leads out of it.

    whose: the expected kind of folder. The page is left out: it is written anew, and no link of its name is followed.
    """
    faults = [Fault(name, "no such file", whose) for name in dict.fromkeys(names) if not is_file(folder / name)]
    faults += [
        Fault(name, "a link that leads out of the folder", whose)
        for name in _links(folder)
        if name != PAGE and not leads_inside(folder, name)
    ]
    if faults:
        raise InputFaults(str(folder), faults)


def _links(folder: Path) -> Iterator[str]:
    """Yield the symbolic links in a folder and the folders in it, by their path from it."""
    for place, folders, files in os.walk(folder):
        for name in (*folders, *files):
            if (path := Path(place, name)).is_symlink():
                yield str(path.relative_to(folder))


def read_summary(folder: Path, needed: Sequence[str] = (), whose: str = "") -> dict[str, Any]:
    """Return the content of a run folder's summary.json.

    Raises InputFaults as `expect_files` where a file of `needed` lacks, for a summary that no run wrote, and as
    `expect_known`.
    """
    expect_files(folder, ("summary.json", *needed), whose or "the folder of a finished run")
    summary = read_kept(folder, "summary.json")
    expect_known(folder / "summary.json", summary)
    return summary


def read_kept(folder: Path, name: str) -> dict[str, Any]:
    """Return the content of a JSON file of a run folder; raise InputFaults for one that no run wrote."""
    try:
        return read_json(inside(folder, name))
    except (OSError, ValueError) as reason:
        fault = Fault(name, f"cannot be read: {reason}", "the file that a run wrote")
        raise InputFaults(str(folder), [fault]) from None


def kept_text(folder: Path, name: str) -> str:
    """Return a text file of a run folder; raise InputFaults for one that cannot be read, or lies outside."""
    try:
        return read_text(inside(folder, name), LARGEST_DATA)
    except (OSError, ValueError) as reason:
        fault = Fault(name, f"cannot be read: {reason}", "the file that a run wrote")
        raise InputFaults(str(folder), [fault]) from None


def write_page(folder: Path, template: str, *, answer: Answer, **content: Any) -> Path:
    """Write report.html, one self-contained file, from a template of this room; return its path.

    The page begins with title, answer and warnings; then come a list of its sections, the sections, and links to the
    folder's files. A symbolic link at report.html is replaced, never followed.
    """
    from jinja2 import Environment, PackageLoader

    environment = Environment(loader=PackageLoader("swashfilm.output"), autoescape=True)
    environment.tests["numeric"] = lambda cell: _NUMBER.match(str(cell)) is not None
    environment.filters |= {"tied": tied, "kept": kept}
    notes = causes(content.get("warnings", content.get("summary", {}).get("warnings", ())))
    page = environment.get_template(f"{template}.html.jinja").render(
        answer=answer, files=_files_of(folder), notes=notes, notes_line=counted(notes) if notes else "", **content
    )
    with replaced(folder / PAGE) as path:
        path.write_text(_with_library(_with_contents(page)), encoding="utf-8")
    return folder / PAGE


def tied(text: object) -> str:
    """Return a text in which no line ends between a number and its unit, or inside a unit."""
    return _TIED.sub("\u00a0", str(text))


def kept(text: object) -> str:
    """Return a text in which no line ends inside a unit; one may end before it, where number and unit are too long."""
    return _BEFORE_UNIT.sub(" ", tied(text))


def _with_contents(page: str) -> str:
    """Return the page with an anchor at each section and the list of all sections in its `nav`."""
    titles: list[str] = []

    def anchored(heading: re.Match[str]) -> str:
        titles.append(heading[1])
        return f'<h2 id="s{len(titles)}">{heading[1]}</h2>'

    body = _HEADING.sub(anchored, page)
    links = "\n".join(f'<a href="#s{number}">{title}</a>' for number, title in enumerate(titles, start=1))
    return body.replace("<nav></nav>", f"<nav>\n{links}\n</nav>" if len(titles) > 1 else "", 1)


def _with_library(page: str) -> str:
    """Return the page with the script for its interactive figures, if any."""
    return page.replace("</body>", f"{embedded()}</body>", 1) if TOUCHED in page else page


def _files_of(folder: Path) -> list[tuple[str, str]]:
    """Return (path, size) of the folder's files; of a folder in it: its page, or its name with a stroke."""
    found = []
    for path in sorted(folder.iterdir()):
        if path.is_dir():
            found.append((f"{path.name}/{PAGE if (path / PAGE).is_file() else ''}", ""))
        elif path.name != PAGE:
            found.append((path.name, f"{path.stat().st_size / 1e3:.3g} kB"))
    return found


def inlined(picture: Figure | bytes, explorer: Explorer | None = None) -> Picture:
    """Return a picture as a page embeds it: figures by `compact`, bytes unchanged.

    Figures are interactive as far as `touchable` translates them; an explorer replaces either.
    """
    content = picture if isinstance(picture, bytes) else compact(picture)
    return Picture(_address(content), _touch(picture, explorer))


def _touch(picture: Figure | bytes, explorer: Explorer | None) -> str:
    """Return the interactive replacement of a drawn picture, packed."""
    if explorer is None and not isinstance(picture, bytes) and (translated := touchable(picture)) is not None:
        explorer = Explorer(translated)
    return "" if explorer is None else explorer.packed()


def _kind(content: bytes) -> str:
    for start, kind in _PICTURES.items():
        if content.startswith(start):
            return kind
    raise ValueError("no picture")


def _address(content: bytes) -> str:
    return f"data:image/{_kind(content)};base64,{base64.b64encode(content).decode('ascii')}"


def keep_pictures(
    folder: Path, stem: str, pictures: Mapping[str, Figure], explorers: Mapping[str, Explorer] | None = None
) -> dict[str, Picture]:
    """Write pictures as plots/STEM-1.svg, .. (.webp, .png, see `compact`) and captions as plots/STEM.json.

    The interactive replacement of a picture is kept beside it, as a page embeds it, as plots/STEM-1.touch. `explorers`:
    those of some pictures, by caption. Return the same as `kept_pictures`.
    """
    (folder / PLOTS).mkdir(exist_ok=True)
    captions = {}
    for number, (caption, figure) in enumerate(pictures.items(), start=1):
        content = compact(figure)
        path = folder / PLOTS / f"{stem}-{number}.{_kind(content).partition('+')[0]}"
        write_whole(path, content)
        captions[path.name] = caption
        if touch := _touch(figure, (explorers or {}).get(caption)):
            write_whole(path.with_suffix(TOUCH), touch.encode("ascii"))
    write_whole(folder / PLOTS / f"{stem}.json", f"{json.dumps(captions, indent=2)}\n".encode())
    return kept_pictures(folder, stem)


def kept_pictures(folder: Path, stem: str) -> dict[str, Picture]:
    """Return the pictures of `keep_pictures` by caption; raise InputFaults if absent."""
    captions = read_kept(folder, f"{PLOTS}/{stem}.json")
    try:
        return {str(caption): _kept(inside(folder / PLOTS, name)) for name, caption in captions.items()}
    except (OSError, ValueError) as reason:
        fault = Fault(f"{PLOTS}/{stem}.json", f"a picture that cannot be read: {reason}", "those that the run drew")
        raise InputFaults(str(folder), [fault]) from None


def _kept(path: Path) -> Picture:
    touch = path.with_suffix(TOUCH)
    return Picture(_address(read_bounded(path, LARGEST_DATA)), touch.read_text("ascii") if touch.is_file() else "")
