"""`swashfilm reproduce`: its run folder, its page in the docs, and what it refuses."""

from __future__ import annotations

import csv
import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import swashfilm as sf
from diagnosis import checked_recording
from swashfilm.__main__ import main
from swashfilm.runs.reproduce.files import claim_rows
from swashfilm.runs.reproduce.plots import panel_pictures
from swashfilm.runs.reproduce.run import ReproduceCase, about, paper_points
from system import FloatingOptions, load_pump
from system.paper.figure import Figure
from system.paper.figures.floating_films import FLOATING_RATIOS, floating_fig8, floating_fig9
from system.paper.figures.pair_losses import fig17
from system.paper.judge import StatementVerdict
from system.paper.points import (
    PRESSURES,
    RATED,
    LossReading,
    PaperFidelity,
    PaperPoints,
    PaperWork,
    Place,
    places_of,
    solve_points,
)
from system.paper.reproduce import Means, reproduce
from system.paper.statements import CLAIMS
from system.pump_file.check import run_checks
from system.pump_file.file import load_known_pump
from system.pump_file.floating import slipper_has_a_wedge
from system.work.kept_results import KeptPoints
from system.work.processes import HERE

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "reproduction.md"
EXAMPLE = ROOT / "examples" / "recordings" / "paper_points"
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
    assert main(["reproduce", "fig11", "--fidelity", "lumped", "-o", str(folder), "--page", str(page)]) == 0
    assert "2 reached" in capsys.readouterr().out
    for name in ("claims.json", "claims.csv", "data/fig11.csv", "plots/fig11-1.svg", "resolved.toml", "report.html"):
        assert (folder / name).is_file(), name
    first, data = next(csv.DictReader((folder / "claims.csv").open())), sf.open(folder).to_xarray()
    assert first["unit"] == "%"
    assert float(first["found low"]) == pytest.approx(100.0 * float(data["found_low"][0]), rel=1e-6)
    row = json.loads((folder / "claims.json").read_text("utf-8"))["claims"][0]
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    docs = (ROOT / "docs" / "files.md").read_text("utf-8")
    part = docs.split("# A reproduction", 1)[1].split("\n## ", 1)[0]
    assert set(row) | set(summary) <= set(re.findall(r"`([^`]+)`", part))
    assert "**fig11.small**" in page.read_text("utf-8")
    report = (folder / "report.html").read_text("utf-8").replace("\u00a0", " ")
    assert report.index("of 2 readings 2 reached") < report.index("<nav>") < report.index("&ldquo;")
    assert main(["report", str(folder)]) == 0


def test_figures_are_listed(capsys):
    assert main(["reproduce", "list"]) == 0
    told = capsys.readouterr().out
    assert all(figure.value in told for figure in Figure)
    assert "co-simulation" in told


def test_what_means_nothing_in_a_fidelity_says_so(tmp_path, capsys):
    assert main(["reproduce", "fig9", "--fidelity", "lumped", "-o", str(tmp_path / "run")]) == 0
    assert "Only --fidelity floating" in capsys.readouterr().out
    summary = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))
    assert "floating" in summary["figures"][0]["remarks"][0]


def test_a_pump_that_is_not_the_papers_is_told_so(tmp_path, capsys):
    pump, folder, page = ROOT / "examples" / "pumps" / "ref90_worn.toml", tmp_path / "run", tmp_path / "page.md"
    assert (
        main(
            ["reproduce", "fig15", "--fidelity", "lumped", "--pump", str(pump), "-o", str(folder), "--page", str(page)]
        )
        == 0
    )
    assert "about the paper's pump" in capsys.readouterr().out
    assert f"--pump {pump}" in page.read_text("utf-8")
    assert "about the paper's pump" in page.read_text("utf-8")
    own = ReproduceCase(load_pump("ref90"), (Figure.FIG2,), PaperFidelity.FLOATING, FloatingOptions())
    assert about(own) == ""
    other = replace(own, pump=load_pump("ref90", {"friction.piston_cylinder": 0.03}))
    assert "For ref90 with other values the verdicts compare two different pumps" in about(other)
    rigid = replace(own, floating=FloatingOptions().rigid)
    assert about(rigid) == "The floating films leave out: pressure viscosity, elastic walls, heat."
    assert about(replace(rigid, fidelity=PaperFidelity.FIXED)) == ""


def test_floating_films_are_drawn(tmp_path):
    """A slipper whose film falls with displacement, a piston tilted across its bore: both figures, all reached."""
    pump, angle, points = load_pump("ref90"), np.linspace(0.0, 2.0 * np.pi, 9), {}
    lumped = PaperWork(pump, PaperFidelity.LUMPED).solved(Place(RATED, PRESSURES[-1], 1.0))
    for ratio, film in zip(FLOATING_RATIOS, (9e-6, 8.7e-6, 8.4e-6, 8.2e-6), strict=True):
        piston = {
            "mean": 15.2e-6, "least": -1e-6, "contact": 3e3, "angle": angle.tolist(), "shown": 4.7,
            "eccentricity": [[1.2e-5] * 9, [0.9e-5] * 9],
            "field": [[0.0, 3.0, 6.0], [0.0, 1.0], [[1e-6, 15e-6, 29e-6], [29e-6, 15e-6, 1e-6]]],
        }  # fmt: skip
        films = {"slipper": {"mean": film, "least": 2e-6, "contact": 0.0}, "piston": piston}
        for pressure in (PRESSURES[0], PRESSURES[-1]):
            points[Place(RATED, pressure, ratio)] = replace(lumped, films=films)
    solved = PaperPoints(pump, PaperFidelity.FLOATING, points)
    figures = (floating_fig8(solved), floating_fig9(solved))
    verdicts = {one.claim.id: one.verdict for figure in figures for one in figure.judged}
    assert set(verdicts) == FLOATING
    assert set(verdicts.values()) == {StatementVerdict.REACHED}
    for figure in figures:
        assert len(panel_pictures(figure.panels)) == len(figure.panels)
    assert "at the film's inner end" in figures[0].remarks[0]
    assert not run_checks((slipper_has_a_wedge,), pump).warnings


def test_losses_of_floating_films_are_read_once(tmp_path):
    """Without coefficients there is one reading; a share's reason names shear and contact in place of them."""
    points = solve_points(
        PaperWork(load_pump("ref90"), PaperFidelity.LUMPED),
        places_of(load_pump("ref90"), (Figure.FIG17,)),
        KeptPoints(tmp_path),
        HERE,
    )
    found = fig17(replace(points, fidelity=PaperFidelity.FLOATING))
    assert {one.reading for one in found.judged} == {LossReading.WITH_SHEAR}
    assert any("No coefficient is fitted" in one.reason for one in found.judged)


def test_the_example_recording_is_whole():
    recording = checked_recording(EXAMPLE, load_known_pump("ref90"))
    assert len(recording.steady.values) == 112


def test_a_recording_that_lacks_what_the_loss_is_made_of_is_refused(tmp_path, capsys):
    lacking = tmp_path / "lacking"
    shutil.copytree(EXAMPLE, lacking)
    head = lacking / "recording.toml"
    kept = [line for line in head.read_text("utf-8").splitlines() if not line.startswith("torque")]
    head.write_text("\n".join(kept), encoding="utf-8")
    assert main(["reproduce", "fig13", "--recording", str(lacking), "-o", str(tmp_path / "run")]) == 2
    assert "no torque" in capsys.readouterr().err


@pytest.mark.slow
def test_coefficients_are_tuned_to_a_recording(tmp_path):
    """The example's planted coefficients within 4 sigma; one speed and displacement tell 2 or 3 of 7 apart."""
    folder = tmp_path / "run"
    assert main(["reproduce", "fig13", "--recording", str(EXAMPLE), "-o", str(folder)]) == 0
    rows = json.loads((folder / "claims.json").read_text("utf-8"))["claims"]
    solved = next(row for row in rows if row["id"] == "fig13.solved")
    assert solved["verdict"] == "contradicted by physics"
    assert solved["found"][1] < 4.0
    told = " ".join(json.loads((folder / "summary.json").read_text("utf-8"))["figures"][0]["remarks"])
    whole = told.split("Fit of all 112 points, with shear", 1)[1]
    prior = 0.5 * np.log(0.03 / 0.008)
    planted = {"piston cylinder": 0.030, "slipper swash plate": 0.0070, "valve plate cylinder": 0.013}
    for name, true in planted.items():
        found, width = re.search(rf"{name} ([\d.]+) \((\d+) %\)", whole).groups()
        assert abs(np.log(float(found) / true)) < 4.0 * float(width) / 100.0 * prior


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["fig2", "--recording", str(EXAMPLE)], "fig13 or all"),
        (["fig13", "--fidelity", "fixed", "--recording", str(EXAMPLE)], "--fidelity lumped"),
        (["fig13", "--recording", "no_such_folder"], "no_such_folder"),
        (["fig2", "--pump", "ref9"], "ref90"),
        (["fig7"], "a drawing (co-simulation model)"),
        (["fig99"], "'fig99'"),
        (["fig2,fig99"], "'fig99'"),
        (["fig2,all"], "'all'"),
        (["fig2", "--fidelity", "lumpd"], "lumped"),
        (["fig2", "--workers", "none"], "--workers"),
        (["fig2", "--fidelity", "lumped", "--steps", "36"], "--steps"),
    ],
)
def test_words_that_mean_nothing_are_refused(words, told, tmp_path, capsys):
    assert main(["reproduce", *words, "-o", str(tmp_path / "run")]) == 2
    assert told in capsys.readouterr().err
    assert not (tmp_path / "run").exists()
