"""Films of the tutorial: its cases and commands print what it quotes."""

import math
import re
from pathlib import Path

import pytest

from swashfilm.__main__ import main
from system import load_pump

ROOT = Path(__file__).resolve().parents[3]
TUTORIAL = (ROOT / "docs" / "tutorial.md").read_text("utf-8")
CASES = {
    block.split()[1].removesuffix(":"): block
    for block in re.findall(r"^```toml\n(.*?)^```", TUTORIAL, re.MULTILINE | re.DOTALL)
}
QUOTED = re.compile(r"`([a-z][a-z ]+? (?:-?\d[\d.]* \w+|[a-z]+))`")


@pytest.fixture
def printed(tmp_path, monkeypatch, capsys):
    """What a command prints in a folder with the tutorial's cases: its exit code, output and errors."""
    monkeypatch.chdir(tmp_path)
    for name, block in CASES.items():
        Path(name).write_text(block, encoding="utf-8")

    def run(*words: str) -> tuple[int, str, str]:
        code = main(list(words))
        told = capsys.readouterr()
        return code, " ".join(told.out.split()), told.err

    return run


@pytest.mark.parametrize(
    ("case", "fewest"), [("step.toml", 2), ("slipper.toml", 3), ("examples/films/loaded_pad.toml", 2)]
)
def test_a_case_prints_what_is_quoted(printed, case, fewest):
    """Quotes are those of the sentence behind the command."""
    code, out, _ = printed("film", case if case in CASES else str(ROOT / case), "-o", "run")
    assert code == 0
    sentence = TUTORIAL.split(f"swashfilm film {case}\n```\n\n", 1)[1].partition("closed form")[0]
    quotes = QUOTED.findall(sentence)
    assert len(quotes) >= fewest
    assert [quote for quote in quotes if quote not in out] == []


def test_refined_numbers_are_those_quoted(printed):
    _, out, _ = printed("film", str(ROOT / "examples/films/linear_slider.toml"), "--refine", "3", "-o", "run")
    values, order, limit = re.search(
        r"gives for the load ([\d., ]+) N, order ([\d.]+) and the limit ([\d.]+ \+- [\d.]+) N", TUTORIAL
    ).groups()
    assert f"load [N] {' '.join(values.split(', '))} {order} {limit}" in out


def test_a_flat_and_smooth_slipper_has_the_limit_load_of_the_closed_form(printed):
    code, _, err = printed("film", "flat_slipper.toml", "-o", "run")
    assert code == 3
    pump = load_pump("ref90")
    inner, outer = pump.slipper.land_inner_radius, pump.slipper.land_outer_radius
    area = math.pi * (outer**2 - inner**2) / (2.0 * math.log(outer / inner))
    closed_form = (8e6 - pump.operating.case_pressure) * area
    assert float(re.search(r"supports ([\d.]+) N", err)[1]) == pytest.approx(closed_form, rel=1e-3)
    assert f"at most {closed_form:.0f} N" in TUTORIAL


def test_faults_are_told_as_quoted(printed):
    bad = CASES["step.toml"].replace("\nthickness = ", "\nthicknes = ").replace("\nright = ", "\nrigth = ")
    Path("bad.toml").write_text(bad, encoding="utf-8")
    code, _, err = printed("film", "bad.toml")
    assert code == 2
    assert err in TUTORIAL
