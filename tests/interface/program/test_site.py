"""Picture of the rooms, page on the architecture and gallery agree with the program."""

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[3]


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


@pytest.mark.parametrize(
    ("prose", "marked"),
    [
        ("`a_b` and c_d, |x|*", r"\ ``a_b``\  and c\_d, \|x\|\*"),
        ("code `a\nb` over lines", r"code \ ``a b``\  over lines"),
    ],
)
def test_docstrings_become_markup(prose, marked):
    assert _script("docstrings").plain(prose) == marked
