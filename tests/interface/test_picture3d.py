"""The 3D picture: drawn by a child process, whose death costs the picture and nothing else."""

import sys

import meshio
import numpy as np
import pytest

from swashfilm.picture3d import THICKNESS, draw


@pytest.fixture
def film(tmp_path):
    path = tmp_path / "film.vtu"
    meshio.write_points_cells(
        path,
        np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0.2], [0, 1, 0.2]]) * 1e-2,
        [("quad", np.array([[0, 1, 2, 3]]))],
        point_data={"film_pressure": np.array([0.0, 1e6, 2e6, 1e6]), "film_thickness": np.full(4, 1e-5)},
    )
    return path


def child(program: str) -> list[str]:
    return [sys.executable, "-c", program]


def test_a_picture_is_drawn_or_missed_for_a_reason_with_its_remedy(film, tmp_path):
    """Both are right: a machine without graphics libraries has no picture."""
    picture = draw([film, film], tmp_path / "film.png", THICKNESS)
    if picture.path is None:
        assert "libegl1" in picture.reason
    else:
        assert picture.path.read_bytes().startswith(b"\x89PNG")
        assert picture.reason == ""


def test_a_child_that_dies_is_told_with_its_signal_and_remedy(film, tmp_path):
    half = "import os, signal, sys; open(sys.argv[1], 'wb').write(b'half'); os.kill(os.getpid(), signal.SIGSEGV)"
    picture = draw([film], tmp_path / "film.png", child=child(half))
    assert picture.path is None
    for word in ("SIGSEGV", "libegl1", "libgl1-mesa-dri"):
        assert word in picture.reason
    assert not (tmp_path / "film.png").exists()


def test_a_child_that_hangs_is_ended(film, tmp_path):
    picture = draw([film], tmp_path / "film.png", patience=0.5, child=child("import time; time.sleep(60)"))
    assert picture.path is None
    assert "longer than 0.5 s" in picture.reason


def test_a_child_that_fails_is_quoted(film, tmp_path):
    picture = draw([film], tmp_path / "film.png", child=child("raise SystemExit('no such field')"))
    assert picture.path is None
    assert "no such field" in picture.reason


def test_a_child_that_ends_well_without_a_picture_is_no_success(film, tmp_path):
    assert draw([film], tmp_path / "film.png", child=child("pass")).path is None
