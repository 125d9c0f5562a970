"""A diagnosis that was made up and its recording, for all tests of how one is told; pictures without rendering."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import nullcontext
from pathlib import Path

import pytest
from blank_pictures import blank_pictures, rendered_figures
from made_diagnosis import its_study, named_diagnosis
from written_formats import REMEDY, folder_faults

from diagnosis import Diagnosis, Study
from swashfilm.output import run_folder


@pytest.fixture(scope="session", autouse=True)
def short(pytestconfig: pytest.Config) -> Iterator[None]:
    """A picture has one pixel.

    Tests that ask for `rendered`, and all tests where the long ones are among them, have the true figures; 3D
    pictures of pumps are drawn beside the long tests alone, others by test_picture3d.
    """
    with blank_pictures() if pytestconfig.option.markexpr == "not long" else nullcontext():
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
def rendered() -> Iterator[None]:
    """Figures are rendered in full."""
    with rendered_figures():
        yield


@pytest.fixture(scope="module")
def named() -> Diagnosis:
    return named_diagnosis()


@pytest.fixture(scope="module")
def study(named: Diagnosis) -> Study:
    return its_study(named)
