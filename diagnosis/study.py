"""A pump and a recording made ready: simulator, readings, linear posterior, and the columns of all candidates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from diagnosis.recording import Recording
from system.components import Component
from system.estimation.evidence import Sign
from system.estimation.observations import Array, Observations
from system.estimation.posterior import Posterior
from system.estimation.simulator import Simulator
from system.physics.extension import Entry, Extension


@dataclass(frozen=True)
class Candidate:
    """One way in which an entry of the catalogue may act: its whitened column (n,) per spread `width`.

    extension is None for sensors and parameters, which are there already; grid: place in the extension's grid.
    """

    entry: Entry
    extension: Extension | None
    grid: int
    column: Array
    width: float
    sign: Sign


@dataclass(frozen=True)
class Study:
    """All that detecting, locating and naming start from.

    base: linear posterior at the prior mean. components: contribution (N, C) of each to the readings, in SI.
    axes: (N, 4), scaled to [-1, 1]: logarithm of speed, delivery pressure, displacement ratio, case temperature.
    """

    recording: Recording
    simulator: Simulator
    observations: Observations
    base: Posterior
    candidates: tuple[Candidate, ...]
    components: Mapping[Component, Array]
    axes: Array
