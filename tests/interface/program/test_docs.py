"""README and docs/ say what the program does: snippets run, commands parse, keys and links exist."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

from diagnosis import read_recording
from swashfilm.case.file import load_case
from swashfilm.case.study import load_film
from swashfilm.cli.app import build_parser, run_command
from swashfilm.console.fidelity import Fidelity
from swashfilm.runs.film.run import solve_film
from swashfilm.runs.film.solve.gap import GapStudy, PositionSource, gap_warnings
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_dataset, film_summary
from swashfilm.runs.pump.data import films_dataset, point_dataset
from swashfilm.runs.pump.page import headline_rows
from swashfilm.runs.pump.run import PumpCase, solve_pump
from swashfilm.runs.pump.summary import pump_summary
from swashfilm.runs.table.gap_case import load_gap_table
from system import FilmsPoint, Gap, Pair, PointWarning, films_point, floating_point, load_pump, operating_point
from system.inputs.sections.fields import fields_of
from system.inputs.sections.values import units_shown
from system.pump_file.file import builtin_pumps
from system.pump_file.schema import section_models

ROOT = Path(__file__).parents[3]
PAGES = [
    *sorted(ROOT.glob("*.md")),
    ROOT / "examples" / "README.md",
    ROOT / "meshes" / "README.md",
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted((ROOT / "docs" / "examples").glob("*.md")),
]
FILES = ROOT / "docs" / "files.md"
LINK = re.compile(r"\[[^\]]+\]\(([^)\s]+)\)")
CODE = re.compile(r"`([^`]+)`")
COMMAND = re.compile(r"^(?:\.venv/bin/)?(swashfilm|make|cp)\b.*$", re.MULTILINE)
GAPS = "|".join(gap.value for gap in Gap)
PAIRS = "|".join(pair.value for pair in Pair)


def _code_words(page: Path) -> set[str]:
    """Everything in backquotes outside fenced blocks."""
    return set(CODE.findall(re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.MULTILINE | re.DOTALL)))


def _relative(page: Path) -> str:
    return str(page.relative_to(ROOT))


def _blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text("utf-8"), re.MULTILINE | re.DOTALL)


def _part(heading: str) -> str:
    """The text of files.md under a heading, up to the next one of its rank or above."""
    text = FILES.read_text("utf-8")
    rank = heading.index(" ")
    return re.split(rf"^#{{1,{rank}}} ", text.split(f"{heading}\n", 1)[1], maxsplit=1, flags=re.MULTILINE)[0]


def _first_column(part: str) -> set[str]:
    """All code words of the first column of the tables in a part of files.md."""
    rows = [line.split("|")[1] for line in part.splitlines() if line.startswith("| `")]
    return {word for row in rows for word in CODE.findall(row)}


def _anchors(page: Path) -> set[str]:
    """Anchors of a page's headings, as git hosts make them."""
    headings = re.findall(r"^#+ (.+)$", page.read_text("utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=_relative)
def test_links_lead_somewhere(page):
    inner = [target for target in LINK.findall(page.read_text("utf-8")) if "://" not in target]
    for target in inner:
        name, _, anchor = target.partition("#")
        linked = (page.parent / name).resolve() if name else page
        assert linked.exists(), f"{_relative(page)}: no {target}"
        assert not anchor or anchor in _anchors(linked), f"{_relative(page)}: no heading for {target}"


@pytest.mark.parametrize("page", [ROOT / "README.md", ROOT / "docs" / "tutorial.md"], ids=_relative)
def test_python_snippets_run_and_print_what_the_page_shows(page, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    text = page.read_text("utf-8")
    for snippet in _blocks(page, "python"):
        if 'fidelity="table"' in snippet:  # needs the response table of the command before it
            continue
        exec(compile(snippet, page.name, "exec"), names)
        shown = re.match(
            r"\s*(?:prints\s+)?```text\n(.*?)^```", text.split(f"{snippet}```", 1)[1], re.DOTALL | re.MULTILINE
        )
        printed = capsys.readouterr().out
        assert not printed or (shown and printed == shown[1]), printed


def test_documents_and_examples_import_public_names():
    deep = re.compile(r"^\W*(?:from|import) (?:reynolds|gaps|system|diagnosis|swashfilm)\.", re.MULTILINE)
    examples = [*(ROOT / "examples").rglob("*.py"), *(ROOT / "docs" / "notebooks").glob("*.ipynb")]
    assert [_relative(page) for page in (*PAGES, *examples) if deep.search(page.read_text("utf-8"))] == []


@pytest.mark.parametrize("page", [page for page in PAGES if "```sh" in page.read_text("utf-8")], ids=_relative)
def test_commands_parse(page):
    known = set(re.findall(r"^# (\S+\.toml):", "\n".join(_blocks(page, "toml")), re.MULTILINE))
    targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE)
    for block in _blocks(page, "sh"):
        for command in COMMAND.finditer(block):
            program, *words = shlex.split(command[0], comments=True)
            if program == "make":
                assert set(words) <= set(targets), command[0]
            elif program == "cp":
                known.add(words[-1])
            else:
                _check_words(words, known)
                written = ("--apply", "-o") if words[0] == "new" else ("--apply",)
                known.update(words[at + 1] for at, word in enumerate(words) if word in written)


def _check_words(words: list[str], known: set[str]) -> None:
    options = build_parser().parse_args(words)
    for name in ("pump", "case", "file"):
        asked = str(getattr(options, name, None) or "ref90")
        assert asked in builtin_pumps() or asked in known or (ROOT / asked).is_file(), asked


def test_commands_in_prose_are_commands():
    prose = {text for page in PAGES for text in _code_words(page)}
    commands = {text.split()[1] for text in prose if text.startswith("swashfilm ")}
    assert {"run", "film", "check", "report", "doctor"} <= commands
    for command in commands:
        with pytest.raises(SystemExit) as end:
            run_command([command, "--help"])
        assert end.value.code == 0, command


def test_documented_cases_load(tmp_path):
    blocks = _blocks(ROOT / "docs" / "tutorial.md", "toml")
    assert blocks
    for block in blocks:
        path = tmp_path / block.split()[1].removesuffix(":")
        path.write_text(block, encoding="utf-8")
        if path.name == "recording.toml":
            (tmp_path / "steady.csv").write_text(
                ",".join(re.findall(r'column = "(\w+)"', block)) + "\n" + "1,1,1,1,1\n"
            )
            assert read_recording(tmp_path).pump == "ref90"
            continue
        load = load_pump if "[pump]" in block else load_gap_table if "[table]" in block else load_film
        assert load(path).name == path.stem


@pytest.mark.parametrize(("section", "model"), list(section_models()), ids=[name for name, _ in section_models()])
def test_pump_file_tables_are_the_description(section, model):
    section = re.sub(r"^\w+\.(body|profile)$", r"PART.\1", section).replace("ports.delivery.grooves", "ports.grooves")
    section = re.sub(rf"^(physics\.\w+)\.({GAPS})$", r"\1.GAP", section)
    heading = re.sub(r"^materials\..*", "materials.PART", re.sub(r"^surfaces\..*", "surfaces.PAIR", section))
    rows = [[cell.strip() for cell in line.split("|")[1:4]] for line in _part(f"### [{heading}]").splitlines()
            if line.startswith("| `")]  # fmt: skip
    documented = {key.strip("`"): unit for key, unit, _ in rows}
    described = {key: units_shown(field) for key, field in fields_of(model).items()}
    assert documented == described
    assert all(meaning for *_, meaning in rows)


@pytest.fixture(scope="module")
def films() -> FilmsPoint:
    pump = load_pump("ref90")
    return films_point(pump, operating_point(pump))


@pytest.mark.long
def test_readme_shows_what_the_run_prints():
    """Lines of the first run as the command prints them, numbers within 2 % of those shown."""
    pump = load_pump("ref90")
    found = floating_point(pump, operating_point(pump), side_by_side=True).pump_point
    printed = dict(headline_rows(pump_summary(pump, found, None, [])))
    whole_pump = _blocks(ROOT / "README.md", "text")[0].partition("Floating gaps")[0]
    shown = re.findall(r"^  (\w.+?) {2,}([-\d.]+) (.+)$", whole_pump, re.MULTILINE)
    assert shown
    for what, number, unit in shown:
        value, _, its_unit = printed[what].partition(" ")
        assert its_unit == unit, what
        assert float(number) == pytest.approx(float(value), rel=0.02), what


def test_pump_summary_keys_are_documented(films):
    summary = pump_summary(films.rotor.pump, films.pump_point, films, [])
    written = {_general(path) for path in _paths(summary)}
    of_films, _, _floating = _part("## summary.json of a pump").partition("With `--fidelity floating`")
    assert _first_column(of_films) == written


def _general(path: str) -> str:
    path = re.sub(rf"\b({PAIRS})\b", "PAIR", path)
    path = re.sub(r"\b(paper|iso_4409)\b", "NORM", path)
    path = re.sub(rf"leakage\.({GAPS})_", "leakage.GAP_", path)
    path = re.sub(rf"leakage_({GAPS})_", "leakage_GAP_", path)
    return re.sub(rf"^gaps\.({GAPS})\b", "gaps.GAP", path)


def _paths(values: dict[str, object], above: str = "") -> Iterator[str]:
    for key, value in values.items():
        if isinstance(value, dict):
            yield from _paths(value, f"{above}{key}.")
        else:
            yield above + key


def test_film_summary_keys_are_documented():
    free = set(film_summary(solve_case(load_case(ROOT / "examples" / "films" / "step_pad.toml"))))
    gap = set(film_summary(solve_case(load_case(ROOT / "examples" / "films" / "ref90_piston.toml"))))
    part = _part("## summary.json of a film")
    switched: set[str] = set()
    every_switch = "warm_slider soft_channel mixed_slider oscillating_squeeze loaded_pad warming_film journal_bearing"
    for name in every_switch.split():
        switched |= set(film_summary(solve_case(load_case(ROOT / "examples" / "films" / f"{name}.toml"))))
    every, added, switches = re.split("A gap adds:|Switches add:", part)
    assert _first_column(every) == free
    assert _first_column(added) == gap - free - switched
    assert _first_column(switches) == switched - free | {"refinement", "sensitivity"}


def test_results_variables_are_documented(films):
    data = point_dataset(films.pump_point, "ref90").merge(films_dataset(films))
    study = solve_case(load_case(ROOT / "examples" / "films" / "step_pad.toml"))
    written = {
        re.sub(rf"^({GAPS})_(?!leakage$)", "GAP_", str(name))
        for kind in (data, film_dataset(study))
        for name in kind.variables
    }
    assert written <= set(CODE.findall(_part("## results.nc")))


def test_run_folder_files_are_documented(tmp_path):
    documented = _first_column(_part("## Run folder"))
    pump = load_pump("ref90")
    for name, fill in (
        ("pump", solve_pump(PumpCase(pump, "", Fidelity.LUMPED)).write),
        ("film", solve_film(load_case(ROOT / "examples/films/step_pad.toml")).write),
    ):
        folder = tmp_path / name
        folder.mkdir()
        fill(folder)
        assert {path.name for path in folder.iterdir()} <= documented


def test_warnings_are_explained(films):
    explained = _code_words(ROOT / "docs" / "wrong_results.md")
    assert {warning.value for warning in PointWarning} <= explained
    stands = GapStudy(films.gaps.valve_plate[0], PositionSource.GIVEN, ())
    assert {warning["name"] for warning in gap_warnings(stands)} <= explained
    sources = "".join(
        (ROOT / name).read_text("utf-8")
        for name in ("swashfilm/runs/film/checks/validity.py", "swashfilm/runs/film/solve/gap.py")
    )
    assert set(re.findall(r'"name": "(\w+)"', sources)) <= explained
    checks = "".join(
        (ROOT / "system" / "pump_file" / f"{of}.py").read_text("utf-8") for of in ("geometry", "ports", "operating")
    )
    assert set(re.findall(r'CheckWarning\(\s*"([\w.]+)"', checks)) <= explained
