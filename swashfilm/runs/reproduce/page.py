"""Pages of a reproduction from the files of its run folder: report.html, and the same in Markdown."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from swashfilm.output.answer import Answer, Tile
from swashfilm.output.page import inlined, kept_pictures, kept_text, read_kept, read_summary, write_page
from swashfilm.runs.reproduce.files import CLAIMS
from swashfilm.runs.reproduce.plots import verdict_bars
from system.paper.judge import StatementVerdict

FILES = ("summary.json", CLAIMS, "resolved.toml")
HEAD = """
Each statement of the paper's text is listed with its expected range, the computed number, and the verdict:
reached, missed, or contradicted by physics, which requires a computed impossibility. A printed number is reached
where its last digit agrees; for a word without a number the assumed range is stated. Losses have two readings:
Coulomb coefficients with the films' shear (REF90's loss model), and mixed coefficients alone (the paper's).
Pressures are gauge pressures at the delivery port."""
Row = Mapping[str, Any]


def write_reproduce_page(folder: Path) -> Path:
    """Write report.html of a reproduction; raise InputFaults where one of its files is missing."""
    summary, rows = _read(folder)
    return write_page(
        folder,
        "reproduce",
        answer=reproduce_answer(summary, rows),
        summary=summary,
        claims={figure["name"]: list(statements(rows, figure["name"])) for figure in summary["figures"]},
        pictures={
            figure["name"]: kept_pictures(folder, figure["name"]) for figure in summary["figures"] if figure["picture"]
        },
        resolved=kept_text(folder, "resolved.toml"),
    )


def _read(folder: Path) -> tuple[Row, list[Row]]:
    return read_summary(folder, FILES, "a reproduction's run folder"), read_kept(folder, CLAIMS)["claims"]


def reproduce_answer(summary: Row, rows: Sequence[Row]) -> Answer:
    """Return the answer of a reproduction: number of statements reached, missed or contradicted, by figure."""
    found, count = Counter(row["verdict"] for row in rows), len({row["id"] for row in rows})
    tiles = [Tile(str(found[one.value]), f"{one.value}", f"of {len(rows)} readings") for one in StatementVerdict]
    tiles.append(Tile(str(count), "statements of the paper", f"about {len(summary['figures'])} figures and tables"))
    numbers = ", ".join(f"{found[one.value]} {one.value}" for one in StatementVerdict)
    words = (
        f"The paper makes {count} statements with a number or a trend that {summary['pump']} can be asked for. Some "
        f"have two readings, which are judged separately: of {len(rows)} readings {numbers}. Contradicted means that "
        f"the statement breaks a law of physics, whatever the pump. The pump is solved in the {summary['fidelity']} "
        f"fidelity."
    )
    bars = verdict_bars(verdict_counts(summary, rows))
    return Answer(tuple(tiles), words, inlined(bars), "Verdicts on the statements of each figure and table")


def verdict_counts(summary: Row, rows: Sequence[Row]) -> dict[str, Counter[str]]:
    """Return the number of readings with each verdict, of each figure with any."""
    names = [figure["name"] for figure in summary["figures"]]
    counts = {name: Counter(row["verdict"] for row in rows if row["figure"] == name) for name in names}
    return {name: own for name, own in counts.items() if own}


def statements(rows: Sequence[Row], figure: str) -> Iterator[tuple[Row, list[Row]]]:
    """Yield the statements of a figure, each with its result in each reading."""
    own = (row for row in rows if row["figure"] == figure)
    for _, found in groupby(own, key=lambda row: row["id"]):
        listed = list(found)
        yield listed[0], listed


def verdict_rows(rows: Sequence[Row]) -> Iterator[tuple[str, ...]]:
    """Yield (statement, reading, range of the paper, computed number, verdict) for a terminal."""
    for row in rows:
        yield row["id"], row["reading"], row["expected_text"], row["found_text"], row["verdict"]


def count_words(rows: Sequence[Row]) -> str:
    """Return the number of statements with each verdict, each reading counted separately."""
    found = Counter(row["verdict"] for row in rows)
    return ", ".join(f"{found[verdict.value]} {verdict.value}" for verdict in StatementVerdict)


def why(row: Row) -> str:
    """Return reason and impossibility of a verdict in sentences, each after a space; empty without."""
    impossible = row["impossible"]["text"] if row["impossible"] else ""
    return "".join(f" {text[0].upper()}{text[1:]}." for text in (row["reason"], impossible) if text)


def markdown_page(folder: Path, command: str) -> str:
    """Return the page in Markdown, without pictures; `command` is the command that wrote it."""
    summary, rows = _read(folder)
    lines = [
        f"# Xu, Hu, Zhang and Mao (2017), figure by figure: {summary['pump']}, {summary['fidelity']}",
        "",
        f"Written by `{command}`, not by hand.",
        HEAD,
        *(["", summary["about"]] if summary["about"] else []),
        "",
        f"{count_words(rows)}; each reading counts separately.",
    ]
    for figure in summary["figures"]:
        lines += ["", f"## {figure['name']}: {figure['title']}", ""]
        lines += [remark + "\n" for remark in figure["remarks"]]
        for claim, found in statements(rows, figure["name"]):
            lines += _statement(claim, found)
    drawings = ", ".join(f"{name} ({title})" for name, title in summary["drawings"].items())
    return "\n".join([*lines, "", "## Drawings", "", f"Without numbers, not reproduced: {drawings}."]) + "\n"


def _statement(claim: Row, found: Sequence[Row]) -> Iterator[str]:
    assumed = f" ({claim['taken']})" if claim["taken"] else ""
    yield f'**{claim["id"]}** "{claim["words"]}"'
    yield ""
    yield f"Quantity: {claim['quantity']}. Expected: {claim['expected_text']}{assumed}."
    yield ""
    for row in found:
        reading = f"{row['reading']}: " if row["reading"] else ""
        yield f"- {reading}{row['found_text']}: **{row['verdict']}**.{why(row)}"
    yield ""
