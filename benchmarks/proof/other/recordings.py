"""From a case of the second plant to its recording, by campaigns and sensors of the bench."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from ..campaigns import campaigns, held
from ..plant.settings import Settings
from ..recordings import moved_turn
from ..rig import Rig
from ..sensors import Readings, read, set_in_truth
from ..wide.case import What, WideCase
from ..wide.made import WideMade, expected
from ..writing import BENCH, write_recording
from .plant.hidden import NOTHING, Hidden
from .plant.points import Points
from .plant.pump import Pump, drawn
from .plant.rig import Readout, run
from .sizing import concealed, repeatability, shift, sized


def make(case: WideCase) -> WideMade:
    """The recording of a case: the same for the same case."""
    rng = np.random.default_rng(case.seed)
    factors, scores = sized(case)
    hidden, faults, drawing = concealed(case.secrets, factors)
    sound = drawn(rng)
    wrong = {one.label: getattr(drawing, one.label) for one in case.secrets if one.what is What.PART}
    pump, campaign = replace(sound, **wrong), campaigns()[case.campaign]
    at = held(campaign, rng)
    there = set_in_truth(at, rng)
    truth = _run(pump, hidden, there)
    readings = read(campaign, at, truth, faults, rng)
    moved = shift(case.campaign, case.secrets, factors) / repeatability(case.campaign)
    told = expected(case, factors, scores, dict(zip(campaign.outputs, (moved**2).sum(axis=0), strict=True)))
    turn = moved_turn(truth, _run(sound, NOTHING, there), campaign.traces) if campaign.traces else None
    rig = Rig(case.campaign, case.seed, partial(_run, pump, hidden), float(there.ratio[0] - at.ratio[0]), faults,
              readings.calibrations)  # fmt: skip
    told = replace(told, true_turn=turn, shift=dict(zip(campaign.outputs, map(_rounded, moved.T), strict=True)))
    return WideMade(told, partial(_write, case, readings), str(BENCH), rig)


def _run(pump: Pump, hidden: Hidden, at: Settings) -> Readout:
    return run(pump, Points(**vars(at)), hidden)


def _write(case: WideCase, readings: Readings, folder: Path) -> None:
    write_recording(folder, case.name, readings, campaigns()[case.campaign].circuit)


def _rounded(moved: np.ndarray) -> tuple[float, ...]:
    return tuple(round(float(one), 3) for one in moved)
