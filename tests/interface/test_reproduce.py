"""`swashfilm reproduce`: its run folder, its page in the docs, and what it refuses."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from swashfilm.__main__ import main
from swashfilm.reproduce_files import claim_rows
from swashfilm.reproduce_run import paper_points
from system.floating_gaps import FloatingOptions
from system.paper.figures import Figure
from system.paper.reproduce import Means, PaperFidelity, reproduce
from system.paper.statements import CLAIMS
from system.pump_file import load_pump
from system.side_by_side import HERE

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "reproduction.md"
FLOATING = {claim.id for claim in CLAIMS.values() if claim.figure in (Figure.FIG8, Figure.FIG9)}


def _numbers(text):
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?", text)]


def test_the_page_in_the_docs_is_the_program(monkeypatch, tmp_path):
    """Every statement stands on the page with the number and verdict that the program finds now."""
    monkeypatch.setenv("SWASHFILM_CACHE", str(tmp_path))
    means = Means(paper_points(), HERE, FloatingOptions())
    rows = claim_rows(reproduce(load_pump("ref90"), tuple(Figure), PaperFidelity.LUMPED, means), "lumped")
    assert {row["id"] for row in rows} == set(CLAIMS) - FLOATING
    page = PAGE.read_text("utf-8")
    for row in rows:
        part = page.split(f"**{row['id']}** ")[1].split("\n**")[0]
        lead = f"- {row['reading']}: " if row["reading"] else "- "
        found, verdict = re.search(rf"^{re.escape(lead)}(.*?): \*\*(.*?)\*\*", part, re.MULTILINE).groups()
        assert verdict == row["verdict"], row["id"]
        assert _numbers(found) == pytest.approx(_numbers(row["found_text"]), rel=2e-3), row["id"]


def test_a_figure_leaves_a_run_folder(tmp_path, capsys):
    folder, page = tmp_path / "run", tmp_path / "page.md"
    assert main(["reproduce", "fig11", "-o", str(folder), "--page", str(page)]) == 0
    assert "2 reached" in capsys.readouterr().out
    for name in ("claims.json", "claims.csv", "data/fig11.csv", "plots/fig11.png", "resolved.toml", "report.html"):
        assert (folder / name).is_file(), name
    row = json.loads((folder / "claims.json").read_text("utf-8"))["claims"][0]
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    docs = (ROOT / "docs" / "files.md").read_text("utf-8")
    part = docs.split("# A reproduction", 1)[1].split("\n## ", 1)[0]
    assert set(row) | set(summary) <= set(re.findall(r"`([^`]+)`", part))
    assert "**fig11.small**" in page.read_text("utf-8")
    assert main(["report", str(folder)]) == 0


def test_figures_are_listed(capsys):
    assert main(["reproduce", "list"]) == 0
    told = capsys.readouterr().out
    assert all(figure.value in told for figure in Figure)
    assert "co-simulation" in told


def test_what_means_nothing_in_a_fidelity_says_so(tmp_path):
    assert main(["reproduce", "fig9", "-o", str(tmp_path / "run")]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))
    assert "floating" in summary["figures"][0]["remarks"][0]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["fig7"], "a drawing (co-simulation model)"),
        (["fig99"], "'fig99'"),
        (["fig2", "--fidelity", "lumpd"], "lumped"),
        (["fig2", "--workers", "none"], "--workers"),
        (["fig2", "--steps", "36"], "--steps"),
    ],
)
def test_words_that_mean_nothing_are_refused(words, told, tmp_path, capsys):
    assert main(["reproduce", *words, "-o", str(tmp_path / "run")]) == 2
    assert told in capsys.readouterr().err
    assert not (tmp_path / "run").exists()
