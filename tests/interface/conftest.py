"""A diagnosis that was made up and its recording, for all tests of how one is told; pictures without rendering."""

from __future__ import annotations

import functools
import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest
from made_diagnosis import its_study, named_diagnosis
from matplotlib.figure import Figure
from matplotlib.image import imsave
from written_formats import REMEDY, folder_faults

from diagnosis import Diagnosis, Study
from swashfilm.output import run_folder
from swashfilm.output.scenes.picture3d import Frame, Pictures
from swashfilm.runs.pump.scene import views


@pytest.fixture(scope="session", autouse=True)
def blank_pictures(pytestconfig: pytest.Config) -> Iterator[None]:
    """A picture has one pixel: layout and rendering take most of the time of a short run, 3D of a run with films.

    Tests that ask for `rendered`, and all tests where the long ones are among them, have the true figures; 3D
    pictures are drawn by test_picture3d and with the long tests.
    """
    if pytestconfig.option.markexpr != "not long":
        yield
        return
    save, pixel = Figure.savefig, io.BytesIO()
    imsave(pixel, np.ones((1, 1, 3)), format="png")

    @functools.wraps(save)
    def blank(figure: Figure, target: object, **how: object) -> None:
        if how.get("format") == "png" and isinstance(target, io.BytesIO):
            target.write(pixel.getvalue())
        else:
            save(figure, target, **how)

    def drawn(drawings: Mapping[Path, Sequence[Frame]]) -> Pictures:
        for path, frames in drawings.items():
            shown = [file for frame in frames for file in (*frame.films, *(solid.path for solid in frame.solids))]
            assert shown
            assert all(file.is_file() for file in shown)
            path.write_bytes(pixel.getvalue())
        return Pictures(tuple(drawings), "")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", blank)
        patch.setattr(views, "draw", drawn)
        yield


@pytest.fixture(scope="session", autouse=True)
def formats_held() -> Iterator[None]:
    """Every run folder that a command writes in a test has the form that the schema of its kind states."""
    rename = run_folder._give_its_name

    def renamed_and_held(partial: Path, final: Path) -> None:
        rename(partial, final)
        faults = folder_faults(final)
        assert not faults, "\n".join([*faults, REMEDY])

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run_folder, "_give_its_name", renamed_and_held)
        yield


@pytest.fixture
def rendered(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures are rendered in full."""
    monkeypatch.setattr(Figure, "savefig", getattr(Figure.savefig, "__wrapped__", Figure.savefig))


@pytest.fixture(scope="module")
def named() -> Diagnosis:
    return named_diagnosis()


@pytest.fixture(scope="module")
def study(named: Diagnosis) -> Study:
    return its_study(named)
