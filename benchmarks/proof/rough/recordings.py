"""From a case of the third plant to its recording: pump, course, meters and statements drawn by its seed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from ..outcome import Outcome
from ..wide.case import WideCase
from ..wide.made import WideMade, expected
from .cases import needs_torque
from .plant.course import course
from .plant.folder import write_folder
from .plant.meters import Meters, drawn_meters, read
from .plant.model import flows
from .plant.pump import Array, Pump, drawn
from .sizing import Bench, concealed, sized

PUMP = "pump.toml"
TORQUE, COMMAS = 0.5, 0.4  # shares of recordings with a torque meter, with decimal commas


@dataclass(frozen=True)
class RoughRecording:
    """Columns of a recording with its folder's statements on pump and meters."""

    pump: Pump
    meters: Meters
    columns: dict[str, Array]
    commas: bool


def make(case: WideCase) -> WideMade:
    """The recording of a case: the same for the same case."""
    found, told = recorded(case)
    return WideMade(told, partial(_write, f"rough-{case.seed}", found), PUMP)


def recorded(case: WideCase) -> tuple[RoughRecording, Outcome]:
    """The recording, and the outcome that is expected of it."""
    rng = np.random.default_rng(case.seed)
    bench, commas = drawn_bench(case, rng)
    factors, scores, strength = sized(case, bench)
    hidden, meters = concealed(bench, case.secrets, factors)
    columns = read(meters, bench.course, flows(bench.pump, bench.course.state, hidden), rng)
    return RoughRecording(bench.pump, meters, columns, commas), expected(case, factors, scores, strength)


def drawn_bench(case: WideCase, rng: np.random.Generator) -> tuple[Bench, bool]:
    """Pump, course and meters of a case; whether the recording has decimal commas."""
    pump = drawn(rng)
    run = course(pump, case.campaign, rng)
    with_torque, commas = bool(rng.uniform() < TORQUE) or needs_torque(case), bool(rng.uniform() < COMMAS)
    return Bench(pump, run, drawn_meters(pump, run, flows(pump, run.state), with_torque, rng)), commas


def _write(title: str, found: RoughRecording, folder: Path) -> None:
    write_folder(folder, title, found.pump, found.meters, found.columns, found.commas)
