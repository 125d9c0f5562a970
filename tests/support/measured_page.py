"""docs/measured.md and its picture: every row against measurement, by part, with E beside u_val."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from matplotlib.figure import Figure
from measured import COVERAGE, PARTS, Measured, Trend, Uncertainty, Verdict
from validation_rows import Row, Summary

COLOURS = {Verdict.NOISE: "#2d7d32", Verdict.MODEL: "#b5523b", Verdict.OPEN: "#888888"}
PICTURE = "measured.png"
INTRODUCTION = f"""\
Written with [validation](validation.md) by `python -m pytest -m '' --validation-page=docs/validation.md`; do not edit.

D is the measured number, S what the program finds, E = S - D. Beside it stands the validation uncertainty of ASME V&V
20-2009, u_val^2 = u_num^2 + u_input^2 + u_D^2: standard uncertainties of the numerical solution, of the inputs and of
the data. A width +-w within which a value lies counts as w/sqrt(3), a grid convergence index as half of it.
k = {COVERAGE:g}.

- **{Verdict.NOISE.value}**: |E| <= k u_val. The comparison does not tell the model's error from the noise. It is no
  proof that the model is right: a large u_val hides a large error.
- **{Verdict.MODEL.value}**: |E| > k u_val and every part of u_val is computed. The model's error is about E +- k u_val;
  where a part is a lower bound (>=), some of it may be in what the source leaves unstated.
- **{Verdict.OPEN.value}**: |E| > k u_val, but a part of u_val is not computed (-). The difference may come from there.

Where a source states no uncertainty, the text says so, and u_D is a lower bound by the width of the digitisation, of
the last digit, or of the scatter. u_input is a lower bound where widths of some inputs are not stated."""
LACKING = """\
## What the readable literature does not give

- Film temperature: fields in a gap of a pump. The bush of Ferron, Frene and Boncompain (1983) has tables that are not
  openly readable.
- Churning: drag of a pump's barrel in its case. Energies 2017, 10(5), 662 and Micromachines 2021, 12(4), 398 are open
  (CC BY 4.0), but their torques are curves, whose values could not be read for this page.
- Piston friction: forces over the turn of the tribo pump (Lasaar, Ivantysynova) and of bushings at Aachen (IFAS 2005)
  come without forces and sizes. The trends of Manring 1999 at high pressure, all met in validation, are computed.
- Slipper: film thickness and leakage. The tables of Hooke, Kakoullis, Koc and Li, of Bergada and of Manring are not
  open; J. Tribol. 147(12), 121706 states a mean error of 0.1 um without the slipper.
- Block tilt: Kim and Jung 2002, Bergada, Watton and Kumar 2008 and Richardson 2019 have no numbers in what is open.
- Pump: flows and torques of a pump with known films or clearances. The measured transmission has drawn clearances, one
  operating point and no torque."""


def write_measured(summary: Summary, folder: Path) -> None:
    """Write measured.md and its picture into the folder."""
    (folder / "measured.md").write_text(page(summary), encoding="utf-8")
    picture(summary).savefig(folder / PICTURE, dpi=110)


def page(summary: Summary) -> str:
    """The page as Markdown."""
    blocks = ["# Measured parts", _answer(summary), f"![E over k u_val of every row]({PICTURE})", INTRODUCTION]
    for part in PARTS:
        numbers = [row for row, reference in summary.numbers if reference.part == part]
        if numbers:
            blocks.append(f"## {part.capitalize()}")
            for case in dict.fromkeys(row.case for row in numbers):
                blocks += [f"**{case}**", _table([row for row in numbers if row.case == case])]
            blocks.append(_found(numbers))
    blocks += ["## Trends", TRENDS, _trends(row for row, _ in summary.trends), LACKING]
    return "\n\n".join(blocks) + "\n"


TRENDS = """\
Directions that were measured, where the source's numbers or its drawing are not readable. A sign has no u_val."""


def counted(summary: Summary) -> Counter[Verdict]:
    """Rows by verdict."""
    return Counter(reference.verdict(row.error) for row, reference in summary.numbers)


def met(summary: Summary) -> tuple[int, int]:
    """Measured trends that the program has, and all."""
    return sum(not row.missed for row, _ in summary.trends), len(summary.trends)


def _answer(summary: Summary) -> str:
    number, (right, trends) = counted(summary), met(summary)
    return (
        f"Of {len(summary.numbers)} measured numbers {number[Verdict.NOISE]} are {Verdict.NOISE.value}, "
        f"{number[Verdict.MODEL]} show a {Verdict.MODEL.value}, {number[Verdict.OPEN]} are {Verdict.OPEN.value}. "
        f"Of {trends} measured trends {right} are met."
    )


def _table(rows: Sequence[Row]) -> str:
    head = "| quantity | unit | D | S | E | u_D | u_input | u_num | u_val | verdict |\n" + "|---" * 10 + "|"
    return "\n".join([head, *map(_line, rows)])


def _line(row: Row) -> str:
    reference = row.measured
    assert isinstance(reference, Measured)
    verdict = reference.verdict(row.error)
    told = f"{verdict.value}"
    if verdict is Verdict.MODEL:
        told += f", {row.error:.2g} +- {COVERAGE * reference.uncertainty:.2g}"
    if verdict is Verdict.OPEN:
        told += f": {', '.join(reference.lacking)} not computed"
    sizes = [reference.data, reference.inputs, reference.numerical]
    cells = [
        row.quantity, row.unit, f"{row.expected:.4g}", f"{row.obtained:.4g}", f"{row.error:.2g}",
        *map(_size, sizes), f"{reference.uncertainty:.2g}", told,
    ]  # fmt: skip
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _size(part: Uncertainty) -> str:
    return "-" if part.size is None else f"{'>= ' if part.lower_bound else ''}{part.size:.2g}"


def _found(rows: Sequence[Row]) -> str:
    """Sources, licences and how the uncertainties were found, each once."""
    lines = [f"- Source: {row.source}. Licence: {_reference(row).licence}." for row in rows]
    for symbol, name in (("u_D", "data"), ("u_input", "inputs"), ("u_num", "numerical")):
        lines += [f"- {symbol}: {getattr(_reference(row), name).how}." for row in rows]
    for reason in dict.fromkeys(row.missed for row in rows if row.missed):
        missed = "; ".join(row.quantity for row in rows if row.missed == reason)
        lines.append(f"- Out of tolerance in validation ({missed}): {reason}.")
    return "\n".join(dict.fromkeys(lines))


def _reference(row: Row) -> Measured:
    assert isinstance(row.measured, Measured)
    return row.measured


def _trends(rows: Iterable[Row]) -> str:
    lines = ["| part | case, quantity | found | source | licence |", "|---|---|---|---|---|"]
    for row in rows:
        assert isinstance(row.measured, Trend)
        found = f"missed: {row.missed}" if row.missed else "met"
        lines.append(
            f"| {row.measured.part} | {row.case}: {row.quantity} | {found} | {row.source} | {row.measured.licence} |"
        )
    return "\n".join(lines)


def picture(summary: Summary) -> Figure:
    """E over k u_val, a line for each measured number, by part: bars of one that cross zero are within the noise."""
    rows = [row for part in PARTS for row, reference in summary.numbers if reference.part == part]
    figure = Figure(figsize=(9.0, 1.2 + 0.24 * len(rows)), layout="constrained")
    axes = figure.subplots()
    for place, row in enumerate(rows):
        reference = _reference(row)
        axes.errorbar(
            row.error / (COVERAGE * reference.uncertainty), place, xerr=1.0, fmt="o", markersize=4, capsize=2,
            color=COLOURS[reference.verdict(row.error)],
        )  # fmt: skip
    axes.axvline(0.0, color="black", linewidth=0.8)
    axes.set_yticks(range(len(rows)), [f"{_reference(row).part}: {row.quantity}" for row in rows], fontsize=7)
    axes.set(xlabel="E/(k u_val), with bars of one: (S - D)/(k u_val)", ylim=(len(rows) - 0.4, -0.6))
    for verdict, colour in COLOURS.items():
        axes.plot([], [], "o", color=colour, label=verdict.value)
    axes.legend(fontsize=8)
    return figure
