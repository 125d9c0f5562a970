"""docs/files.md names every key of a recording, and no other."""

import re
from pathlib import Path

import pytest

from diagnosis.recording.form import read_form
from swashfilm.__main__ import main
from system import ChannelName
from system.inputs.toml_table import Table

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "files.md"
NAMED = re.compile(r"^\| `([^`]+)`", re.MULTILINE)


def _asked(monkeypatch) -> set[str]:
    """Every key that the program asks of a recording in which every table stands."""
    asked: set[str] = set()
    get = Table.get

    def remembered(table, key):
        asked.add(table.name(key))
        return get(table, key)

    monkeypatch.setattr(Table, "get", remembered)
    one = {"column": "c", "unit": "s", "calibration": {}, "lag": "1 s", "accuracy_class": "A"}
    tables = {
        "steady": {"file": "a", "time": one},
        "series": {"file": "a", "time": one, "steady": {}, "raster": "1 s"},
        "traces": {"angle": one, "p_chamber": one, "encoder_offset": "1 deg"},
        "channel": {"p_out": one},
    }
    for points in ("steady", "series"):
        read_form(
            Table("", {k: v for k, v in tables.items() if k not in {"steady", "series"} - {points}}, []),
            Path(),
            None,
        )
    return asked


def _keys(heading: str) -> set[str]:
    text = PAGE.read_text("utf-8").split(f"{heading}\n", 1)[1]
    return set(NAMED.findall(re.split(r"^#{1,3} ", text, maxsplit=1, flags=re.MULTILINE)[0]))


def test_every_key_is_on_the_page(monkeypatch):
    asked = _asked(monkeypatch)
    tables = {"steady", "series", "traces", "channel"}
    assert _keys("## Recording") == {key for key in asked if "." not in key} - tables
    for name in ("steady", "series", "traces"):
        own = {k.removeprefix(f"{name}.") for k in asked if k.startswith(f"{name}.")}
        own = {k for k in own if not k.startswith(("angle.", "p_chamber."))}
        nested = {k.partition(".")[0] for k in own if "." in k}
        assert _keys(f"### [{name}]") | set(_table_form()) == own - nested | set(_table_form()), name
    channel = {k.removeprefix("channel.p_out.") for k in asked if k.startswith("channel.p_out.")}
    assert _keys("### [channel]") == channel - {"calibration"}
    stated = PAGE.read_text("utf-8").split("### [channel]\n", 1)[1]
    for name in ChannelName:
        assert f"`{name.value}`" in stated, name


def _table_form() -> set[str]:
    return _keys("### Tables of a recording")


def test_the_form_of_a_table_is_on_the_page(monkeypatch):
    asked = {k.removeprefix("steady.") for k in _asked(monkeypatch) if k.startswith("steady.")}
    assert _table_form() <= asked


@pytest.mark.parametrize("name", ["open-01", "open-04", "open-06", "paper_points"])
def test_recordings_to_begin_from_have_no_fault(name, capsys):
    assert main(["check", str(ROOT / "examples" / "recordings" / name)]) == 0
    assert "112 points" in capsys.readouterr().out
