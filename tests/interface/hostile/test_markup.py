"""Names with markup, formulas and control signs: text in pages, pictures, tables and on the terminal, nothing more."""

import base64
import csv
import gzip
import importlib.util
import json
import re
import shutil
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import quote
from xml.etree import ElementTree

import pytest
from openpyxl import load_workbook

from swashfilm.__main__ import main
from swashfilm.output.answer import Answer
from swashfilm.output.data.files import Column, write_columns
from swashfilm.output.data.workbook import write_workbook
from swashfilm.output.figures import compact, figure_of, png_of
from swashfilm.output.page import inlined, write_page
from swashfilm.output.tables import read_csv, write_csv
from swashfilm.output.touch.curves import touchable
from system import InputFaults, load_pump
from system.inputs.faults import Fault, printable

MARK = "swashfilm-hostile"
NAME = f"</script><img src=x id={MARK} onerror=alert(1)>{{{{7*7}}}} $x^{{ &amp; ]]>"
FORMULAS = (
    "=cmd|'/c calc'!A1",
    "+1+cmd|'/c calc'!A0",
    "-2+3+cmd|' /C calc'!A0",
    "@SUM(1+1)*cmd|' /C calc'!A0",
    "\t=1",
    "\r=1",
)
CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
FILM = """format = 1
[constants]
h = "10 um"
[film]
mesh = { kind = "rectangle", size = ["10 mm", "1 mm"], cells = [8, 2] }
thickness = "h*(2 - x/0.01)"
velocity = ["1 m/s", "0 m/s"]
viscosity = "30 mPa s"
[boundary]
left = { pressure = "0 bar" }
right = { pressure = "0 bar" }
"""


class Elements(HTMLParser):
    """Elements of a page that a file's text may have made, and its pictures."""

    def __init__(self) -> None:
        super().__init__()
        self.made: list[str] = []
        self.pictures: list[str] = []
        self.figures: list[str] = []
        self.text = ""
        self.kind: str | None = ""

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        self.kind = named.get("type") if tag == "script" else None
        self.made += [tag] if named.get("id") == MARK or any(name.startswith("on") for name in named) else []
        self.pictures += [named["src"]] if tag == "img" else []

    def handle_data(self, data):
        if self.kind == "text/plain":
            self.figures.append(data)
        self.text += data


def read(page: Path) -> Elements:
    found = Elements()
    found.feed(page.read_text("utf-8"))
    assert found.made == []
    for address in found.pictures:
        assert address.startswith("data:image/")
        kind, _, content = address.partition(";base64,")
        if kind.endswith("svg+xml"):
            drawn = ElementTree.fromstring(base64.b64decode(content))
            assert not [one for one in drawn.iter() if one.tag.endswith(("}script", "}img")) or one.get("onerror")]
    return found


def unpacked(text: str) -> str:
    letters = text[1:].strip().translate(str.maketrans(",.:", "&<>"))
    return gzip.decompress(base64.b85decode(letters)).decode("utf-8")


def hold_figures(figures) -> None:
    """No text of a figure to touch holds a tag but a line's end: plotly reads tags."""
    for figure in figures:
        for text in re.findall(r'"(?:text|name|title)":"((?:[^"\\]|\\.)*)"', unpacked(figure)):
            assert not re.search(r"<(?!br>|/?b>|/?sub>|/?sup>|extra>)", text), text


@pytest.mark.usefixtures("rendered")
def test_every_text_of_a_page_is_text(tmp_path):
    figure = figure_of(4.0, 3.0)
    axes = figure.add_subplot()
    axes.plot([0.0, 1.0], [1.0, 2.0], label=NAME)
    axes.set_title(NAME)
    axes.set_xlabel(NAME)
    axes.set_xticks([0.0, 1.0], [NAME, "$b$"])
    axes.legend()
    assert touchable(figure) is not None
    (tmp_path / f"{quote(NAME, safe='')}.csv").write_text("a")
    warnings = [f"some_name: {NAME}", {"name": "x", "text": NAME}]
    answer = Answer((), NAME, inlined(figure), NAME)
    found = read(write_page(tmp_path, "page", answer=answer, warnings=[warnings[0]]))
    assert NAME.replace("&amp;", "&amp;") in found.text
    assert found.figures
    hold_figures(found.figures)


def test_a_dollar_sign_in_a_name_is_drawn_and_powers_of_ten_remain(rendered):
    figure = figure_of(4.0, 3.0)
    axes = figure.add_subplot()
    axes.set_title("cost $\\frac{1}{$ of $")
    axes.semilogy([1.0, 2.0], [1e-3, 1e3])
    assert png_of(figure).startswith(b"\x89PNG")
    texts = "".join(ElementTree.fromstring(compact(figure)).itertext())
    assert "mathdefault" not in texts
    assert "$\\frac{1}{$" in texts


def test_tables_hold_no_formula(tmp_path):
    names = [*FORMULAS, "plain", "-12.5 L/min", "+0.3 +- 0.1", "-"]
    write_csv(tmp_path / "a.csv", ["=head", "number"], [[name, -1.5] for name in names])
    head, *rows = list(csv.reader((tmp_path / "a.csv").open(newline="", encoding="utf-8")))
    assert head[0] == "'=head"
    assert [row[0] for row in rows[:4]] == [f"'{name}" for name in FORMULAS[:4]]
    assert not any(row[0][0] in "=+-@\t\r" for row in rows[:6])
    assert [row[0] for row in rows[6:]] == names[6:]
    assert all(row[1] == "-1.5" for row in rows)
    write_columns(tmp_path / "b.csv", [Column("name", [FORMULAS[0]]), Column("speed", [-1.0], "rad/s")])
    assert read_csv(tmp_path / "b.csv")[1][0] == f"'{FORMULAS[0]}"
    (tmp_path / "summary.json").write_text(json.dumps({"format": 1, "kind": "film", "name": FORMULAS[0], "x_m": 1.0}))
    write_workbook(tmp_path, tmp_path / "c.xlsx")
    cells = [cell for sheet in load_workbook(tmp_path / "c.xlsx") for row in sheet.iter_rows() for cell in row]
    assert all(cell.data_type != "f" for cell in cells)


def test_the_terminal_gets_no_control_signs(tmp_path, capsys):
    path = tmp_path / "a.toml"
    path.write_text(f'format = 1\nname = "a\\u001b]0;{MARK}\\u0007b"\n[pump]\n"\\u001b[31m" = 1\n', "utf-8")
    assert main(["check", str(path)]) == 2
    told = capsys.readouterr()
    assert "\x1b" not in told.err + told.out
    assert "\\x1b" in told.err
    assert printable("a\x1bb\u202ec\nd\te") == "a\\x1bb\\u202ec\nd\te"
    assert "\x07" not in printable(str(InputFaults("a", [Fault("b", "c\x07", "d")])))


def test_long_texts_are_told_in_short(tmp_path):
    told = str(InputFaults("a", [Fault("b", "x" * 100_000, "d")]))
    assert len(told) < 1000
    assert "(100000 characters)" in told


def test_a_name_with_control_signs_is_refused(tmp_path):
    path = tmp_path / "a.toml"
    text = own_pump(tmp_path).read_text("utf-8").replace(json.dumps(NAME), '"a\\u001b[31mb"')
    path.write_text(text, "utf-8")
    with pytest.raises(InputFaults, match="one line of text"):
        load_pump(path)


def own_pump(folder: Path) -> Path:
    path = folder / "own.toml"
    path.write_text(
        f"name = {json.dumps(NAME)}\nformat = 1\n[pump]\npistons = 7\ndisplacement = '45 cm3/rev'\n"
        "[oil]\ngrade = 'ISO VG 46'\n[operating]\nspeed = '1500 rpm'\npressure = '28 MPa'\n",
        "utf-8",
    )
    return path


@pytest.mark.slow
def test_a_films_file_is_text_on_its_page(tmp_path):
    case = tmp_path / f"{NAME.replace('/', '|')}.toml"
    case.write_text(FILM + f"# {NAME}\n", "utf-8")
    assert main(["film", str(case), "-o", str(tmp_path / "r")]) == 0
    found = read(tmp_path / "r" / "report.html")
    hold_figures(found.figures)


@pytest.mark.long
def test_a_pumps_name_is_text_on_every_page(tmp_path):
    pump, levels = str(own_pump(tmp_path)), ("--speeds", "1000,1500rpm", "--pressures", "10,20MPa", "--check", "2")
    lumped = ("--fidelity", "lumped")
    (tmp_path / "cycle.csv").write_text("time [s],speed [rpm],pressure [bar]\n0,1000,150\n5,1500,180\n", "utf-8")
    places = {name: str(tmp_path / name) for name in ("run", "map", "duty", "compare", "costs", "vary")}
    point = ("--speeds", "1500rpm", "--pressures", "20MPa")
    for words in (
        ("run", pump, *lumped, "-o", places["run"]),
        ("map", pump, *lumped, *levels, "--displacements", "1.0", "--workers", "1", "-o", places["map"]),
        ("duty", places["map"], str(tmp_path / "cycle.csv"), "-o", places["duty"]),
        ("compare", places["map"], places["map"], "-o", places["compare"]),
        ("sensitivity", pump, *point, "--keys", "piston.radial_clearance", "--workers", "1", "-o", places["costs"]),
        ("run", pump, *lumped, "--vary", "operating.pressure=10..20MPa:2", "-o", places["vary"]),
        ("report", places["run"]),
    ):  # fmt: skip
        assert main(list(words)) == 0, words
    for place in places.values():
        found = read(Path(place) / "report.html")
        hold_figures(found.figures)
    assert "onerror" in read(Path(places["run"]) / "report.html").text


@pytest.mark.long
@pytest.mark.skipif(CHROMIUM is None or importlib.util.find_spec("playwright") is None, reason="no browser here")
def test_a_browser_runs_nothing_of_a_name(tmp_path):
    from playwright.sync_api import sync_playwright

    pump = own_pump(tmp_path)
    words = ["run", str(pump), "--fidelity", "lumped", "--vary", "operating.pressure=10..20MPa:2"]
    assert main([*words, "-o", str(tmp_path / "r")]) == 0
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page, told = browser.new_page(), []
        page.on("dialog", lambda dialog: (told.append(dialog.message), dialog.dismiss()))
        page.goto((tmp_path / "r" / "report.html").as_uri())
        page.wait_for_timeout(4000)
        assert page.evaluate(f"document.getElementById('{MARK}')") is None
        assert page.evaluate("document.querySelectorAll('[onerror], [onmouseover]').length") == 0
        assert told == []
        browser.close()
