"""Rows against measurement: arithmetic of V&V 20, docs/measured.md, docs/credibility.md."""

from __future__ import annotations

import importlib
from dataclasses import replace
from math import sqrt
from pathlib import Path
from types import ModuleType

import pytest
from credibility_evidence import Evidence, Gate, gates, read_evidence
from measured import Measured, Trend, Uncertainty, Verdict, at_least, by_differences, not_computed, of_mesh, within
from measured_page import page, picture, write_measured
from validation_rows import Row, Summary, read_summary, summary_of, write_summary

DOCS = Path(__file__).resolve().parents[3] / "docs"
KNOWN = Measured("pump", "MIT", Uncertainty(0.3, "stated"), Uncertainty(0.4, "widths"), Uncertainty(0.0, "closed form"))


def row(**changes: object) -> Row:
    made = Row(7, "Chapter", "case", "source", "flow", "L/min", 10.0, 10.9, 2.0, None, "", "", "long text", KNOWN)
    return replace(made, **changes)


def summary(*rows: Row) -> Summary:
    return summary_of(rows)


@pytest.fixture
def credibility(monkeypatch) -> ModuleType:
    monkeypatch.syspath_prepend(DOCS / "site")
    return importlib.import_module("credibility")


@pytest.mark.parametrize(
    ("error", "verdict"), [(0.99, Verdict.NOISE), (-0.99, Verdict.NOISE), (1.01, Verdict.MODEL), (-1.01, Verdict.MODEL)]
)
def test_verdict_at_twice_the_root_of_the_squares(error, verdict):
    assert KNOWN.uncertainty == pytest.approx(0.5)
    assert KNOWN.verdict(error) is verdict


def test_what_is_not_computed_leaves_a_large_error_open():
    part = replace(KNOWN, inputs=not_computed("no drawing"))
    assert part.lacking == ("u_input",)
    assert part.uncertainty == pytest.approx(0.3)
    assert [part.verdict(error) for error in (0.59, 0.61)] == [Verdict.NOISE, Verdict.OPEN]


def test_standard_uncertainties():
    assert within(-0.6, "read").size == pytest.approx(0.6 / sqrt(3.0))
    assert of_mesh(-0.2, "order 2").size == pytest.approx(0.1)
    assert at_least(within(0.6, "read")) == Uncertainty(within(0.6, "read").size, "read", lower_bound=True)


def test_inputs_by_differences():
    """x^2 y about (2, 3): 12 and 4 times the half widths, as squares are odd about the middle."""
    found = by_differences(lambda at: at["x"] ** 2 * at["y"], {"x": (1.9, 2.1), "y": (2.5, 3.5)}, "widths")
    assert found.size == pytest.approx(sqrt((1.2**2 + 2.0**2) / 3.0))


@pytest.mark.parametrize(
    ("part", "licence", "how", "fault"),
    [("wing", "MIT", "x", "expected one of"), ("pump", "", "x", "licence"), ("pump", "MIT", "", "data found")],
)
def test_a_row_without_part_licence_or_reason_is_refused(part, licence, how, fault):
    with pytest.raises(ValueError, match=fault):
        Measured(part, licence, Uncertainty(1.0, how), KNOWN.inputs, KNOWN.numerical)


def test_a_summary_comes_back_from_its_file(tmp_path):
    trend = row(measured=Trend("slipper", "cited"), missed="reason", order=2.0)
    made = summary(row(), row(measured=None), trend)
    assert (made.rows, made.ordered, made.missed, made.chapters, len(made.measured)) == (3, 1, 1, 1, 2)
    write_summary(made, tmp_path / "measured.json")
    assert read_summary(tmp_path / "measured.json") == made
    assert [one.discussion for one in made.measured] == ["", ""]


def test_page_and_picture():
    made = summary(
        row(), row(obtained=11.5), row(obtained=20.0, measured=replace(KNOWN, data=not_computed("no sensor"))),
        row(quantity="sign", measured=Trend("slipper", "cited"), missed="loaded otherwise"),
    )  # fmt: skip
    text = page(made)
    assert "Of 3 measured numbers 1 are within the noise, 1 show a model error, 1 are open" in text
    assert "1.5 +- 1 |" in text
    assert "open: u_D not computed |" in text
    assert "- Source: source. Licence: MIT." in text
    assert "| slipper | case: sign | missed: loaded otherwise | source | cited |" in text
    assert len(picture(made).axes[0].get_yticks()) == 3


def test_committed_pages_are_those_of_their_data(tmp_path, credibility, request):
    if request.config.getoption("validation_page"):
        pytest.skip("the pages are being written")
    write_measured(read_summary(DOCS / "measured.json"), tmp_path)
    written = "write it anew: python -m pytest -m '' --validation-page=docs/validation.md"
    assert (DOCS / "measured.md").read_text("utf-8") == (tmp_path / "measured.md").read_text("utf-8"), written
    found = credibility.page(read_evidence(DOCS))
    assert credibility.PAGE.read_text("utf-8") == found, "write it anew: python docs/site/credibility.py"


def test_every_measured_row_has_source_and_licence(request):
    """And every row of the validation page whose source says that it was measured is among them."""
    if request.config.getoption("validation_page"):
        pytest.skip("the pages are being written")
    listed = read_summary(DOCS / "measured.json").measured
    assert all(one.source.strip() and one.measured.licence.strip() for one in listed)
    table = [line.split(" | ") for line in (DOCS / "validation.md").read_text("utf-8").splitlines() if line[:2] == "| "]
    of_page = {(cells[0].removeprefix("| "), cells[1]): cells[8] for cells in table if len(cells) == 10}
    told = {key for key, source in of_page.items() if any(word in source for word in ("measured", "sensors", "units"))}
    assert told
    assert told <= {(one.case, one.quantity) for one in listed} <= set(of_page)


PROOF = """\
# Proof

## Gates

| gate | required | found |  |
| --- | --- | --- | --- |
| alarms | <= 3% | 5% | **missed** |
| 90 % intervals of parameters | 86 % | 91 % of 7: null 90% | held |

## Gates on three plants

| gate | required | first plant | rough |
"""


def evidence(*rows: Row) -> Evidence:
    return Evidence(summary(*rows), gates(PROOF), ("8 of 15", "95%"))


def test_gates_of_the_proof():
    alarms, intervals = gates(PROOF)
    assert alarms == Gate("alarms", "<= 3%", "5%", held=False)
    assert intervals.held
    assert (evidence().coverage(), evidence().named_met()) == ("91 % of 7", False)


def test_credibility_follows_the_results(credibility):
    """The level of validation and the acceptance of a use fall with the rows that they rest on."""
    film = replace(KNOWN, part="film temperature")
    good, bad = (row(obtained=obtained, measured=film, order=2.0) for obtained in (10.1, 14.0))
    assert [credibility.validation_level(evidence(*rows)) for rows in ((good,), (good, good, bad), (good, bad))] == [
        3, 2, 1,
    ]  # fmt: skip
    texts = [credibility.page(evidence(one)) for one in (good, bad)]
    assert "Film study of a gap. " in texts[0]
    assert "is met in full: none." in texts[1]
    assert "**not met**: 1 of 2 held" in texts[0]
