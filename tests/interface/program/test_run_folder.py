"""Run folders: two runs that want the same one lose nothing."""

import pytest

from swashfilm.output.run_folder import run_folder
from system import InputFaults


def test_two_runs_into_one_folder_keep_both(tmp_path):
    wanted = tmp_path / "mine"
    places = []

    def two_runs() -> None:
        with run_folder("one", wanted) as first:
            places.append(first)
            (first / "numbers.txt").write_text("first")
            with run_folder("two", wanted) as second:
                (second / "numbers.txt").write_text("second")

    with pytest.raises(InputFaults, match="another run has filled") as told:
        two_runs()
    assert (wanted / "numbers.txt").read_text() == "second"
    assert (places[0] / "numbers.txt").read_text() == "first"
    assert str(places[0]) in told.value.faults[0].nearest


def test_an_empty_folder_is_taken(tmp_path):
    wanted = tmp_path / "mine"
    wanted.mkdir()
    with run_folder("one", wanted) as folder:
        (folder / "numbers.txt").write_text("{}")
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
