"""The file of thresholds: complete, and read as it stands."""

from __future__ import annotations

import tomllib
from hashlib import sha256
from pathlib import Path

import pytest

from diagnosis import load_thresholds
from diagnosis.thresholds import FILE
from reynolds import InputError


def test_the_digest_is_that_of_the_file() -> None:
    assert load_thresholds().digest == sha256(FILE.read_bytes()).hexdigest()


def test_what_decides_is_consistent() -> None:
    limits = load_thresholds()
    assert 0 < limits.mismatch.chance <= limits.mismatch.suspicion <= limits.mismatch.null_probability
    assert limits.mismatch.null_probability < 1 - limits.name.probability
    assert limits.locate.windows[0] < limits.locate.windows[1]
    assert list(limits.name.mixture_widths) == sorted(limits.name.mixture_widths)
    assert limits.heldout.veto_gain < 0
    assert limits.form.true_to <= limits.form.slight <= limits.form.placed_by <= limits.form.second
    assert limits.fit.additions <= limits.fit.most_additions <= limits.name.shortlist
    assert limits.next_point.settled < limits.next_point.enough
    assert limits.name.possible < 1 - limits.name.probability


def test_the_head_of_the_file_names_numbers_that_are_there() -> None:
    """Each name of the list of added numbers is a key of its table."""
    head, tables = (FILE.read_text(encoding="utf-8").partition("# Sources")[0], tomllib.loads(FILE.read_text("utf-8")))
    listed = head.replace("\n#", "").partition("run with: ")[2].partition("; all of")[0]
    for part in listed.split("; "):
        table, _, names = part.partition("] ")
        assert set(names.split(", ")) <= set(tables[table.strip("[")])


@pytest.mark.parametrize(
    ("before", "after"),
    [("\nchance = 0.01", ""), ("\nchance = 0.01", "\nchance = 0.01\nchange = 0.02"), ("[heldout]", "[held]")],
)
def test_a_key_that_is_missing_or_not_known_is_refused(before: str, after: str, tmp_path: Path) -> None:
    file = tmp_path / "thresholds.toml"
    file.write_text(FILE.read_text(encoding="utf-8").replace(before, after), encoding="utf-8")
    with pytest.raises(InputError, match=r"mismatch|held"):
        load_thresholds(file)
