"""The 3D picture: drawn by a child process, whose death costs the picture and nothing else."""

import os
import sys
import time
from pathlib import Path

import meshio
import numpy as np
import pytest
from PIL import Image

from swashfilm.output.scenes.picture3d import Frame, Pictures, Solid, draw, painter, picture_field


@pytest.fixture
def film(tmp_path):
    path = tmp_path / "film.vtu"
    meshio.write_points_cells(
        path,
        np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0.2], [0, 1, 0.2]]) * 1e-2,
        [("quad", np.array([[0, 1, 2, 3]]))],
        point_data={"film_pressure [Pa]": np.array([0.0, 1e6, 2e6, 1e6]), "film_thickness [m]": np.full(4, 1e-5)},
    )
    return path


def drawn_by(program: str, path: Path, film: Path, patience: float = 60.0) -> Pictures:
    with painter(child=[sys.executable, "-c", program], patience=patience) as one:
        one.begin({path: [Frame([film])]})
        return one.pictures()


def test_a_picture_is_drawn_or_missed_for_a_reason_with_its_remedy(film, tmp_path):
    """Both are right: a machine without graphics libraries has no picture."""
    turn = [Frame([film], [Solid(film, "#9aa4ab", 0.3)], [("1", film)], f"{angle} deg") for angle in (0, 10)]
    wanted = {
        tmp_path / "one.png": [Frame([film])], tmp_path / "two.png": [Frame([film, film])],
        tmp_path / "turn.webp": turn,
    }  # fmt: skip
    pictures = draw(wanted, picture_field("film thickness", "m"))
    if not pictures.paths:
        assert "libegl1" in pictures.reason
    else:
        assert pictures.paths == tuple(wanted)
        assert all(path.read_bytes().startswith(b"\x89PNG") for path in wanted if path.suffix == ".png")
        assert Image.open(tmp_path / "turn.webp").n_frames == 2
        assert pictures.reason == ""


def test_a_child_that_dies_is_told_with_its_signal_and_remedy(film, tmp_path):
    half = (
        "import json, os, signal, sys; open(list(json.load(sys.stdin))[0], 'wb').write(b'half'); "
        "os.kill(os.getpid(), signal.SIGSEGV)"
    )
    picture = drawn_by(half, tmp_path / "film.png", film)
    assert picture.paths == ()
    for word in ("SIGSEGV", "libegl1", "libgl1-mesa-dri"):
        assert word in picture.reason
    assert not (tmp_path / "film.png").exists()


def test_a_child_that_hangs_is_ended(film, tmp_path):
    picture = drawn_by("import time; time.sleep(60)", tmp_path / "film.png", film, patience=0.5)
    assert picture.paths == ()
    assert "longer than 0.5 s" in picture.reason


def test_a_child_that_fails_is_quoted(film, tmp_path):
    picture = drawn_by("raise SystemExit('no such field')", tmp_path / "film.png", film)
    assert picture.paths == ()
    assert "no such field" in picture.reason


def test_a_child_that_ends_well_without_a_picture_is_no_success(film, tmp_path):
    assert drawn_by("pass", tmp_path / "film.png", film).paths == ()


def test_a_painter_draws_while_this_process_goes_on(film, tmp_path):
    program = "import json, sys; [open(path, 'wb').close() for path in json.load(sys.stdin)]; sys.stdin.close()"
    with painter(child=[sys.executable, "-c", program]) as one:
        one.begin({tmp_path / "a.png": [Frame([film])], tmp_path / "b.png": [Frame([film])]})
        assert one.pictures() == Pictures((tmp_path / "a.png", tmp_path / "b.png"), "")


@pytest.mark.parametrize("begun", [False, True])
def test_an_error_meanwhile_ends_the_painter(film, tmp_path, begun):
    told = tmp_path / "pid"
    program = f"import os, time; open({str(told)!r}, 'w').write(str(os.getpid())); time.sleep(600)"

    def interrupted() -> None:
        with painter(child=[sys.executable, "-c", program]) as one:
            if begun:
                one.begin({tmp_path / "film.png": [Frame([film])]})
            while not told.is_file() or not told.read_text():
                time.sleep(0.01)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    with pytest.raises(ProcessLookupError):
        os.kill(int(told.read_text()), 0)
