"""Write the pages of the examples: run each, keep a picture of its result, write docs/examples/NAME.md and the index.

    python docs/site/example_pages.py [NAME ..]

With names, only these examples are run; the others keep their pages. `listed.py` lists the examples. A script whose
data are not part of the repository is not run: draw its picture with the data and `--picture docs/examples/NAME.png`.
"""

from __future__ import annotations

import html
import re
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path

from listed import DRAWS, EXAMPLES, GROUPS, Example, title
from pictures import DOCS, ROOT, picture, ran, write_thumbnail

PAGES = DOCS / "examples"
WIDTH, ACROSS = 720, 3
PARTS = ("name", "b", "note")
"""Class or tag of the three texts of a number."""
LANGUAGES = {".toml": "toml", ".py": "python"}


class AnswerReader(HTMLParser):
    """Reads what a run's page says first: its headline numbers as (name, value, note), and its words."""

    def __init__(self) -> None:
        super().__init__()
        self.numbers: list[list[str]] = []
        self.words = ""
        self._inside = ""
        self._in_tile = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Begin a number, or one of its three texts, or the words."""
        kind = dict(attrs).get("class") or tag
        if kind == "tile":
            self.numbers.append(["", "", ""])
            self._in_tile = True
        if kind == "answer" or (self._in_tile and kind in PARTS):
            self._inside = kind

    def handle_endtag(self, tag: str) -> None:
        """End a number, a text of it, or the words."""
        if tag in ("span", "b", "p"):
            self._inside = ""
        self._in_tile = self._in_tile and tag != "div"

    def handle_data(self, data: str) -> None:
        """Take a text to where it belongs."""
        if self._inside == "answer":
            self.words += data
        elif self._inside:
            self.numbers[-1][PARTS.index(self._inside)] += data


def main(names: list[str]) -> int:
    """Write the pages of the named examples, or of all, and the index."""
    PAGES.mkdir(exist_ok=True)
    for example in EXAMPLES:
        if not names or example.name in names:
            (PAGES / f"{example.name}.md").write_text(page(example, found(example)), encoding="utf-8")
    (PAGES / "index.md").write_text(index(), encoding="utf-8")
    return 0


def found(example: Example) -> str:
    """Run an example, leave its picture beside its page, and return what it finds as Markdown."""
    if example.needs:
        return f"{example.needs} [Examples](../../examples/README.md) tells what comes out.\n"
    program, _, words = example.command.partition(" ")
    if program == "python":
        return _printed(example, words.removesuffix(example.left_out))
    with ran(words) as folder:
        write_thumbnail(picture(folder, example.picture), PAGES / f"{example.name}.png", WIDTH)
        return answered((folder / "report.html").read_text("utf-8"))


def _printed(example: Example, words: str) -> str:
    """Run a script, leave its picture, and return what it prints."""
    with tempfile.TemporaryDirectory() as place:
        drawn = Path(place) / "picture.png"
        drawing = [DRAWS, str(drawn)] if example.picture == DRAWS else []
        command = [sys.executable, *words.split(), *drawing]
        done = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
        if drawing:
            write_thumbnail(drawn.read_bytes(), PAGES / f"{example.name}.png", WIDTH)
    left_out = example.left_out
    without = f"Without `{left_out}`, which is not part of this repository, it prints" if left_out else "It prints"
    return f"{without}\n\n```text\n{done.stdout.rstrip()}\n```\n"


def answered(report: str) -> str:
    """Return the answer of a run's page as Markdown: its words, and its headline numbers as a table."""
    reader = AnswerReader()
    reader.feed(report.partition("<nav>")[0])
    if not reader.words:
        raise ValueError("the run's page begins with no answer")
    rows = ["| " + " | ".join(_cell(text) for text in number) + " |" for number in reader.numbers]
    return "\n".join([_cell(reader.words), "", "| number | value | |", "|---|---|---|", *rows]) + "\n"


def _cell(text: str) -> str:
    return html.unescape(text).replace("\u00a0", " ").replace("|", "\\|").replace("*", "\\*").strip()


def page(example: Example, answer: str) -> str:
    """The page of an example, with what it finds."""
    return f"{head(example)}{answer}\n{tail(example)}"


def head(example: Example) -> str:
    """The page up to the answer: title, picture, what the file says of itself, command."""
    shown = f"![{title(example)}]({example.shown})\n\n" if example.shown else ""
    return f"# {title(example)}\n\n{shown}{told(example)}```sh\n{example.command}\n```\n\n"


def tail(example: Example) -> str:
    """The page from the answer on: the file, folded, and links."""
    path = ROOT / example.file
    fence = f"```{LANGUAGES[path.suffix]}\n{path.read_text('utf-8').rstrip()}\n```"
    return (
        f"<details>\n<summary>The file</summary>\n\n{fence}\n\n</details>\n\n"
        f"The file is [{example.file}](../../{example.file}).\n\n"
        f"Other [examples](index.md); [keys](../files.md) of every file.\n"
    )


def told(example: Example) -> str:
    """The file's own description beyond the page's title: a paragraph, of a script literal text."""
    if example.opening.rstrip(".").lower() == title(example).lower():
        return ""
    if example.file.endswith(".py"):
        return f"```text\n{example.opening}\n```\n\n"
    return re.sub(r"([*_|<])", r"\\\1", example.opening) + "\n\n"


def index() -> str:
    """The list of all examples by group, each with its picture."""
    lines = ["# Examples", "", "Each page shows the command, its result and the file. "
             "`make examples` runs all of them and writes these pages; "
             "[examples](../../examples/README.md) tells what each shows.", ""]  # fmt: skip
    for group in GROUPS:
        lines += [f"## {group.title}", "", "| " + " | ".join(" " for _ in range(ACROSS)) + " |", "|" + "---|" * ACROSS]
        for start in range(0, len(group.examples), ACROSS):
            row = group.examples[start : start + ACROSS]
            lines.append("| " + " | ".join(_entry(example) for example in row) + " |")
        lines.append("")
    return "\n".join(lines)


def _entry(example: Example) -> str:
    shown = f"[![{title(example)}]({example.shown})]({example.name}.md)<br>" if example.shown else ""
    return f"{shown}[{title(example)}]({example.name}.md)"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
