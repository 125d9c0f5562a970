"""The layout: rooms of at most a dozen files, each with its purpose; names that do not repeat; no circles."""

import ast
from pathlib import Path

import grimp
import pytest

ROOT = Path(__file__).parents[3]
PACKAGES = ("reynolds", "gaps", "system", "diagnosis", "swashfilm")
MOST = 14
ROOMS = sorted(path.parent for package in PACKAGES for path in (ROOT / package).rglob("__init__.py"))


def name_of(room):
    return ".".join(room.relative_to(ROOT).parts)


@pytest.mark.parametrize("room", ROOMS, ids=name_of)
def test_a_room_has_a_purpose_and_few_entries(room):
    text = (room / "__init__.py").read_text("utf-8")
    assert ast.get_docstring(ast.parse(text))
    entries = [path for path in room.iterdir() if path.name not in ("__pycache__", "__init__.py", "py.typed")]
    assert len([path for path in entries if path.suffix != ".pyi"]) <= MOST


@pytest.mark.parametrize("room", ROOMS, ids=name_of)
def test_names_do_not_repeat_their_room(room):
    names = [path.stem for path in room.glob("*.py") if path.name != "__init__.py"]
    assert not [name for name in names if name == room.name or name.startswith(f"{room.name}_")]


@pytest.mark.parametrize("package", PACKAGES)
def test_public_names_are_there_and_no_submodule_shadows_them(package):
    module = __import__(package)
    assert module.__all__
    assert all(getattr(module, name) is not None for name in module.__all__)
    submodules = {path.stem for path in (ROOT / package).iterdir() if path.suffix == ".py" or path.is_dir()}
    assert not set(module.__all__) & submodules  # else the first import of the submodule would shadow the name


def test_files_form_no_circle():
    graph = grimp.build_graph(*PACKAGES, cache_dir=None)
    below: dict[str, set[str]] = {name: graph.find_modules_directly_imported_by(name) for name in graph.modules}
    while free := {name for name, needs in below.items() if not needs}:
        below = {name: needs - free for name, needs in below.items() if name not in free}
    assert not below
