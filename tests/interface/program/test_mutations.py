"""Page of the mutations: edits of lines that are no more do not count."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest


@pytest.fixture
def mutation(proof: SimpleNamespace) -> SimpleNamespace:
    """Modules of the mutations by their names."""
    assert proof is not None
    return SimpleNamespace(**{name: import_module(f"mutation.{name}") for name in ("page", "sample", "trial")})


def test_edits_of_a_changed_line_are_gone(mutation: SimpleNamespace, tmp_path: Path) -> None:
    """The other line keeps its edits."""
    source = tmp_path / "reynolds" / "law.py"
    source.parent.mkdir()
    source.write_text("def law(p, h):\n    a = p + h\n    return a * p\n")
    before = mutation.sample.names(tmp_path)
    source.write_text("def law(p, h):\n    a = p + h\n    return a * h\n")
    after = mutation.sample.names(tmp_path)
    assert len(before) == len(after) == 4
    assert len(before & after) == 2


def test_the_page_tells_how_many_do_not_count(mutation: SimpleNamespace) -> None:
    killed = mutation.trial.Fate.KILLED
    one = mutation.trial.Trial("a", "reynolds/law.py", "law", "sign", "p + h", "p - h", killed, "t", 1, 1.0, killed)
    assert "2 more edits are of lines that have changed since" in mutation.page.page_text([one], 25, 2)
    assert "more edits" not in mutation.page.page_text([one], 25, 0)
