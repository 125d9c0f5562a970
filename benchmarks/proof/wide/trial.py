"""Diagnosis of one case of the second or third plant as by a user: a folder, a pump, and the verdict."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

from diagnosis.thresholds import load_thresholds

from ..other.recordings import make as make_other
from ..outcome import Outcome
from ..parts import Plant
from ..rough.recordings import make as make_rough
from ..trial import tried
from ..worth import worth
from .case import WideCase
from .made import WideMade


def made(case: WideCase) -> WideMade:
    """The recording of a case, by its plant."""
    return make_other(case) if case.part.plant is Plant.OTHER else make_rough(case)


def try_wide(case: WideCase) -> Outcome:
    """Make a case's recording, diagnose it, and put the finding beside the truth."""
    own = made(case)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        own.write(folder)
        known = folder / own.pump
        told, diagnosed = tried(folder, own.expected, known if known.is_file() else own.pump, with_rivals=False)
    if diagnosed is None or own.rig is None:
        return told
    thresholds = load_thresholds()
    return replace(told, worth=worth(
        diagnosed.study, diagnosed.pump, diagnosed.found, own.rig, own.expected, thresholds
    ))  # fmt: skip
