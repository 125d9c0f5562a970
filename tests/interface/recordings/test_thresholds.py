"""The file of thresholds: complete, and read as it stands."""

from __future__ import annotations

from pathlib import Path

import pytest

from diagnosis import load_thresholds
from diagnosis.thresholds import FILE
from reynolds import InputError


def test_the_digest_is_that_of_the_values(tmp_path: Path) -> None:
    """A comment does not change it, a value does."""
    text, digest = FILE.read_text("utf-8"), load_thresholds().digest
    for name, other in (("comment", "# more\n" + text), ("value", text.replace("chance = 0.01 ", "chance = 0.02 "))):
        (tmp_path / name).write_text(other, "utf-8")
    assert load_thresholds(tmp_path / "comment").digest == digest
    assert load_thresholds(tmp_path / "value").digest != digest


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


@pytest.mark.parametrize(
    ("before", "after"),
    [("\nchance = 0.01", ""), ("\nchance = 0.01", "\nchance = 0.01\nchange = 0.02"), ("[heldout]", "[held]")],
)
def test_a_key_that_is_missing_or_not_known_is_refused(before: str, after: str, tmp_path: Path) -> None:
    file = tmp_path / "thresholds.toml"
    file.write_text(FILE.read_text(encoding="utf-8").replace(before, after), encoding="utf-8")
    with pytest.raises(InputError, match=r"mismatch|held"):
        load_thresholds(file)
