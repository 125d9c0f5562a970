"""The bench after a campaign: the machine still mounted, its sensors unchanged, for further points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .plant.settings import Settings
from .sensors import Calibration, Fault


@dataclass(frozen=True)
class Rig:
    """run: flows and torque of the mounted machine at set points; setting: relative error of strokes; seed: of further
    draws.
    """

    campaign: str
    seed: int
    run: Callable[[Settings], Any]
    setting: float
    faults: tuple[Fault, ...]
    calibrations: dict[str, Calibration]
