"""A diagnosis that was made up and its recording, for all tests of how one is told."""

from __future__ import annotations

import pytest
from made_diagnosis import its_study, named_diagnosis

from diagnosis import Diagnosis, Study


@pytest.fixture(scope="module")
def named() -> Diagnosis:
    return named_diagnosis()


@pytest.fixture(scope="module")
def study(named: Diagnosis) -> Study:
    return its_study(named)
