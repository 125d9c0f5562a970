"""docs/files.md names every key of a recording, and no other."""

import re
from pathlib import Path

import pytest

from diagnosis.recording.form import RecordingSection
from swashfilm.__main__ import main
from system import ChannelName
from system.inputs.sections.fields import fields_of

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "files.md"
NAMED = re.compile(r"^\| `([^`]+)`", re.MULTILINE)


def _stated(model, above="") -> set[str]:
    """Keys of a section and of the tables in it, by path."""
    found = set()
    for key, own in fields_of(model).items():
        found |= _stated(own.table, f"{above}{key}.") if own.table else {above + key}
    return found


def _keys(heading: str) -> set[str]:
    text = PAGE.read_text("utf-8").split(f"{heading}\n", 1)[1]
    return set(NAMED.findall(re.split(r"^#{1,3} ", text, maxsplit=1, flags=re.MULTILINE)[0]))


def test_every_key_is_on_the_page():
    stated = _stated(RecordingSection)
    assert _keys("## Recording") == {key for key in stated if "." not in key}
    form = _keys("### Tables of a recording")
    for name in ("steady", "series", "traces"):
        own = {key.removeprefix(f"{name}.") for key in stated if key.startswith(f"{name}.")}
        own = {key.partition(".")[0] if key.startswith(("angle.", "p_chamber.")) else key for key in own}
        assert form <= own, name
        assert _keys(f"### [{name}]") == own - form, name
    channel = {key.removeprefix("channel.p_out.") for key in stated if key.startswith("channel.p_out.")}
    assert _keys("### [channel]") == channel
    page = PAGE.read_text("utf-8").split("### [channel]\n", 1)[1]
    for name in ChannelName:
        assert f"`{name.value}`" in page, name


@pytest.mark.parametrize("name", ["open-01", "open-04", "open-06", "paper_points"])
def test_recordings_to_begin_from_have_no_fault(name, capsys):
    assert main(["check", str(ROOT / "examples" / "recordings" / name)]) == 0
    assert "112 points" in capsys.readouterr().out
