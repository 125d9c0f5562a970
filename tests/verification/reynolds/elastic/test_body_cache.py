"""Body operators kept on disk."""

from __future__ import annotations

import logging
from dataclasses import replace

import numpy as np
import pytest

from reynolds import Body, Elastic, FilmInputError, Plane, Supports, block, body_wall, film_space, rectangle
from reynolds.numerics.cache import CacheOrigin, cache_folder, content_key, kept

BODY = Body(block((1.0, 1.0, 0.5), (1, 1, 1)), Elastic(210e9, 0.3), Supports(), "top",
            Plane((0.0, 0.0, 1.0), (0.0, 0.0, 0.5)))  # fmt: skip


def test_a_body_is_computed_once(tmp_path):
    coarse, fine = (film_space(rectangle((1.0, 1.0), (n, n))) for n in (2, 5))
    first = body_wall(BODY, coarse, folder=tmp_path)
    again = body_wall(BODY, coarse, folder=tmp_path)
    assert (first.origin, again.origin) == (CacheOrigin.COMPUTED, CacheOrigin.CACHE)
    assert np.array_equal(first.matrix, again.matrix)
    assert body_wall(BODY, fine, folder=tmp_path).origin is CacheOrigin.CACHE  # a film of another mesh
    for other in (
        replace(BODY, elastic=Elastic(210e9, 0.29)),
        replace(BODY, supports=Supports(clamped=("bottom",))),
        replace(BODY, mesh=block((1.0, 1.0, 0.5), (1, 1, 2))),
        replace(BODY, mesh=block((1.0, 1.0, 0.5), (1, 1, 1), origin=(0.0, 0.0, 1e-12))),
    ):
        assert body_wall(other, coarse, folder=tmp_path).origin is CacheOrigin.COMPUTED


@pytest.mark.parametrize("left", [b"", b"not a file of arrays", None])
def test_a_broken_file_is_computed_anew(left, tmp_path, caplog):
    made = {"matrix": np.arange(6.0).reshape(2, 3)}
    kept("key", lambda: made, tmp_path)
    place = tmp_path / "key.npz"
    place.write_bytes(place.read_bytes()[:-30] if left is None else left)
    with caplog.at_level(logging.WARNING):
        found = kept("key", lambda: made, tmp_path)
    assert found.origin is CacheOrigin.RECOMPUTED
    assert "broken" in caplog.text
    assert kept("key", lambda: {}, tmp_path).origin is CacheOrigin.CACHE
    assert [path.name for path in tmp_path.iterdir()] == ["key.npz"]


def test_folders(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    monkeypatch.delenv("SWASHFILM_CACHE", raising=False)
    assert cache_folder() == tmp_path / "xdg" / "swashfilm"
    monkeypatch.setenv("SWASHFILM_CACHE", str(tmp_path / "own"))
    assert cache_folder() == tmp_path / "own"
    assert cache_folder(tmp_path / "given") == tmp_path / "given"
    monkeypatch.delenv("SWASHFILM_CACHE")
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert cache_folder().parts[-2:] == (".cache", "swashfilm")


def test_a_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(FilmInputError, match="SWASHFILM_CACHE"):
        kept("key", dict, tmp_path / "file")


def test_keys():
    a, b = np.zeros(4), np.zeros((2, 2))
    assert content_key(a) == content_key(np.zeros(4))
    assert len({content_key(a), content_key(b), content_key(a, 0), content_key("a"), content_key("a", "")}) == 5
