"""Picture of the rooms, page on the architecture and gallery agree with the program."""

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[3]


@pytest.fixture(autouse=True)
def beside_each_other(monkeypatch):
    """The site's scripts import each other by their names."""
    monkeypatch.syspath_prepend(ROOT / "docs" / "site")


def _script(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, ROOT / "docs" / "site" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def test_picture_of_the_rooms_is_not_stale():
    assert (ROOT / "docs" / "architecture.svg").read_text("utf-8") == _script("house").picture(), (
        "draw it anew: python docs/site/house.py"
    )


def test_architecture_names_rooms_that_exist():
    page = (ROOT / "docs" / "architecture.md").read_text("utf-8")
    packages = "reynolds|gaps|system|diagnosis|swashfilm"
    rooms = [room for room in re.findall(rf"`((?:{packages})(?:\.\w+)+)`", page) if room != "diagnosis.json"]
    files = re.findall(rf"`((?:{packages}|docs)(?:/\w+)+(?:\.\w+)?)`", page)
    places = [ROOT / room.replace(".", "/") for room in rooms] + [ROOT / file for file in files]
    missing = [place for place in places if not place.exists() and not place.with_suffix(".py").exists()]
    assert not [str(place) for place in missing if "NAME" not in place.parts]
    assert len(rooms) > 20


def test_gallery_is_not_stale():
    gallery = _script("gallery")
    pictures = {path.stem for path in (ROOT / "docs" / "gallery").glob("*.png")}
    assert pictures == {example.name for example in gallery.EXAMPLES}, "draw it anew: make gallery"
    assert (ROOT / "docs" / "gallery.md").read_text("utf-8") == gallery.page()


def test_every_example_has_a_page():
    """Cases, recordings and scripts that examples/README.md links or runs, and no others."""
    readme = (ROOT / "examples" / "README.md").read_text("utf-8")
    linked = {name for name in re.findall(r"\]\(([\w/-]+\.toml)\)", readme) if name != "recordings/bench_pump.toml"}
    scripts = set(re.findall(r"^python examples/(\S+\.py)", readme, re.MULTILINE))
    listed = {example.file.removeprefix("examples/") for example in _script("listed").EXAMPLES}
    assert listed == linked | scripts
    cases = {str(path.relative_to(ROOT / "examples")) for path in (ROOT / "examples").rglob("*.toml")}
    assert cases - {"recordings/bench_pump.toml"} == linked
    pages = {path.stem for path in (ROOT / "docs" / "examples").glob("*.md")}
    assert pages == {example.name for example in _script("listed").EXAMPLES} | {"index"}


def test_pages_of_examples_are_not_stale():
    examples = _script("example_pages")
    for example in examples.EXAMPLES:
        text = (ROOT / "docs" / "examples" / f"{example.name}.md").read_text("utf-8")
        head, tail = examples.head(example), examples.tail(example)
        stale = f"write it anew: python docs/site/example_pages.py {example.name}"
        assert text.startswith(head), stale
        assert text.endswith(tail), stale
        assert len(text) > len(head) + len(tail) + 20, stale
    index = (ROOT / "docs" / "examples" / "index.md").read_text("utf-8")
    assert index == examples.index(), "write it anew: make examples"


def test_pages_of_examples_have_the_commands_of_their_readme():
    """A case that stands for others of its folder shows their command, too."""

    def general(command: str) -> str:
        return re.sub(r"(examples/\w+)/[\w-]+(?:\.toml)?(?= |$)", r"\1/*", command)

    blocks = re.findall(
        r"^```sh\n(.*?)^```", (ROOT / "examples" / "README.md").read_text("utf-8"), re.MULTILINE | re.DOTALL
    )
    known = {general(line) for block in blocks for line in block.splitlines()}
    commands = {general(example.command) for example in _script("listed").EXAMPLES}
    assert commands <= known


def test_pictures_of_examples_are_small():
    pictures = list((ROOT / "docs" / "examples").glob("*.png"))
    assert len(pictures) > 20
    assert [path.name for path in pictures if path.stat().st_size > 60_000] == []


def test_answer_of_a_run_page_becomes_markdown():
    report = (
        '<div class="tiles"><div class="tile"><span class="name">load</span><b>47&nbsp;N</b></div>'
        '<div class="tile"><span class="name">a|b</span><b>2</b><span class="note">of 3</span></div></div>'
        '<p class="answer">It carries 47&#160;N &amp; leaks.</p><p><b>note</b></p><nav></nav><b>other</b>'
    )
    assert _script("example_pages").answered(report) == (
        "It carries 47 N & leaks.\n\n| number | value | |\n|---|---|---|\n| load | 47 N |  |\n| a\\|b | 2 | of 3 |\n"
    )
    with pytest.raises(ValueError, match="no answer"):
        _script("example_pages").answered("<p>text</p>")


@pytest.mark.parametrize(
    ("prose", "marked"),
    [
        ("`a_b` and c_d, |x|*", r"\ ``a_b``\  and c\_d, \|x\|\*"),
        ("code `a\nb` over lines", r"code \ ``a b``\  over lines"),
    ],
)
def test_docstrings_become_markup(prose, marked):
    assert _script("docstrings").plain(prose) == marked
