"""Run folders: two runs that want the same one lose nothing."""

import pytest

from swashfilm.run_folder import run_folder
from system.faults import InputFaults


def test_two_runs_into_one_folder_keep_both(tmp_path):
    wanted = tmp_path / "mine"
    with pytest.raises(InputFaults, match="another run has filled") as told, run_folder("one", wanted) as first:
        (first / "summary.json").write_text("first")
        with run_folder("two", wanted) as second:
            (second / "summary.json").write_text("second")
    assert (wanted / "summary.json").read_text() == "second"
    assert (first / "summary.json").read_text() == "first"
    assert str(first) in told.value.faults[0].nearest


def test_an_empty_folder_is_taken(tmp_path):
    wanted = tmp_path / "mine"
    wanted.mkdir()
    with run_folder("one", wanted) as folder:
        (folder / "summary.json").write_text("{}")
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
