"""The thresholds of a verdict, read from thresholds.toml beside this file."""

from __future__ import annotations

import json
import tomllib
from dataclasses import dataclass, fields, replace
from functools import cache
from hashlib import sha256
from math import log, radians
from pathlib import Path
from typing import Any

from reynolds.errors import InputError
from system.estimation.trial import FitLimits

FILE = Path(__file__).with_name("thresholds.toml")


@dataclass(frozen=True)
class MismatchLimits:
    """Limits of a mismatch between recording and simulation; thresholds.toml explains each number."""

    chance: float
    null_probability: float
    agreed: float
    suspicion: float
    draws: int
    smooth: float
    memory: float
    memory_apart: float
    memory_pairs: int
    memory_most: float
    memory_clip: float
    excess: float
    told_excess: float
    flag_rate: float
    pull: float


@dataclass(frozen=True)
class LocateLimits:
    """Limits of a place. Windows are in degrees of shaft angle, as in the file."""

    channel_share: float
    region_share: float
    edges: int
    least_points: int
    strong: float
    bound: float
    p_value: float
    narrowest_window: float
    widest_window: float
    trace_memory: float
    ends: int
    draws: int
    multiplier_widths: tuple[float, ...]

    @property
    def windows(self) -> tuple[float, float]:
        """The narrowest and the widest window in rad."""
        return radians(self.narrowest_window), radians(self.widest_window)


@dataclass(frozen=True)
class RefitLimits:
    """Explanations that are refitted, priors of their parameters, and start, end and giving up (nats) of a fit."""

    shortlisted_parameters: int
    additions: int
    most_additions: int
    most_effects: int
    grid_members: int
    gross: float
    tolerated: float
    reach: float
    farther: float
    worth: float
    hopeless: float
    felt: float
    redundant: float
    start_sizes: tuple[float, ...]
    look_sizes: tuple[float, ...]
    beside: tuple[float, ...]
    way: tuple[float, ...]
    change: float
    scant_change: float
    scant_stuck: int
    patience: int
    gross_patience: int
    at_bound: float
    held_out: int


@dataclass(frozen=True)
class NameLimits:
    """Limits of a named effect. Odds are natural logarithms (nats); widths are in spreads of an entry's prior."""

    odds: float
    probability: float
    class_gap: float
    sure: float
    shortlist: int
    shortlist_gap: float
    mixture_widths: tuple[float, ...]
    fault_factor: float
    allowance: float
    temperature: float
    alike: float
    possible: float


@dataclass(frozen=True)
class FormLimits:
    """Errors of form that a right law may have: shares of squares and of nats, powers of a coordinate."""

    true_to: float
    placed_by: float
    slight: float
    second: float
    slack: float
    own: float
    lagging: float
    lag: float
    unmet: float
    material: float
    flat: float
    least_range: float
    other_make: float
    bent: float
    of_ports: float
    sheared: float
    peaks: float
    recovered: float
    drift: float


@dataclass(frozen=True)
class HeldOutLimits:
    """Veto of held-out regions: gain in nats of one, number of negative ones."""

    veto_gain: float
    negative_gain: float
    veto_regions: int
    least_points: int
    open: float
    half: float


@dataclass(frozen=True)
class NextPointLimits:
    """Odds that readings at a proposed point are to reach, and the number of these readings."""

    rival: float
    readings: int
    odds: float
    promised: float
    enough: float
    most_repeats: int
    gauge: float

    @property
    def settled(self) -> float:
        """The odds in nats."""
        return log(self.odds)


@dataclass(frozen=True)
class DataLimits:
    """Single readings that are put aside, and readings too smooth for their noise."""

    outlier: float
    together: float
    rim: float
    explained: float
    leverage: float
    outlier_share: float
    least_chi2: float


@dataclass(frozen=True)
class RecordShares:
    """Findings of a kind whose likeliest explanation was the truth, as shares of all such findings."""

    incomplete: float
    suspicion: float
    type_plate: float


@dataclass(frozen=True)
class PriorMasses:
    """Prior weight of each kind of hypothesis, to be normalised, and the factor for each further effect."""

    none: float
    missing_physics: float
    sensor_fault: float
    wrong_parameter: float
    unknown_physics: float
    pair_penalty: float


@dataclass(frozen=True)
class Seeds:
    """Seeds of random draws."""

    detect: int
    locate: int
    proof: int
    development: int


@dataclass(frozen=True)
class Thresholds:
    """All of thresholds.toml, and the sha256 of its values in `digest`: comments do not count."""

    mismatch: MismatchLimits
    locate: LocateLimits
    fit: RefitLimits
    name: NameLimits
    form: FormLimits
    heldout: HeldOutLimits
    next_point: NextPointLimits
    data: DataLimits
    record: RecordShares
    prior: PriorMasses
    seeds: Seeds
    digest: str

    def fit_limits(self, scant: bool) -> FitLimits:
        """Ends of a fit. scant: of a pump known by its type plate.

        There the last nats are not determined: below the odds of a name they have no effect, and the evidence is that
        of the peak that the slopes predict.
        """
        own, odds = self.fit, self.name.odds
        limits = FitLimits(change=own.change, patience=own.patience, gross=own.gross)
        return replace(limits, change=own.scant_change, stall=2.0 * odds, stuck=own.scant_stuck) if scant else limits


@cache
def load_thresholds(path: Path = FILE) -> Thresholds:
    """The thresholds of a file. Raises InputError for missing and for unused keys."""
    tables = tomllib.loads(path.read_text("utf-8"))

    def read(kind: type, name: str) -> Any:
        return kind(**_table(kind, name, tables, path))

    return Thresholds(
        read(MismatchLimits, "mismatch"),
        read(LocateLimits, "locate"),
        read(RefitLimits, "fit"),
        read(NameLimits, "name"),
        read(FormLimits, "form"),
        read(HeldOutLimits, "heldout"),
        read(NextPointLimits, "next_point"),
        read(DataLimits, "data"),
        read(RecordShares, "record"),
        read(PriorMasses, "prior"),
        read(Seeds, "seeds"),
        sha256(json.dumps(tables, sort_keys=True).encode()).hexdigest(),
    )


def _table(kind: type, name: str, tables: dict[str, Any], path: Path) -> dict[str, Any]:
    found = tables.get(name, {})
    expected = [field.name for field in fields(kind)]
    if sorted(found) != sorted(expected):
        raise InputError(f"{path}: [{name}]", ", ".join(found) or "nothing", ", ".join(expected))
    return {key: tuple(value) if isinstance(value, list) else value for key, value in found.items()}
