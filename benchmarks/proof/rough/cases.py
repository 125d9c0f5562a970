"""Cases of the third plant: effects that one course of pressure can show, singly, in twos and threes, beside faults."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from ..parts import Part
from ..wide.case import Secret, What, WideCase

GRADES = (8.0, 5.0, 15.0, 3.0, 30.0)
SEVERAL = 10.0
NULLS = 120
PAIRS, TRIPLES, BESIDE = 20, 10, 12
COURSES = ("stairs", "ramps", "triangles", "sweep", "speeds")


def _effect(label: str, id: str, size: float, most: float) -> Secret:
    return Secret(What.EFFECT, label, id, None, size, most / size)


EFFECTS = (
    _effect("opening", "elastic_opening", 0.05, 1.0),
    _effect("thickening", "viscosity_pressure", 0.1, 1.2),
    _effect("control", "control_flow", 0.002, 0.05),
    _effect("short_circuit", "port_short_circuit", 0.002, 0.05),
    _effect("cross_leak", "laminar_cross_leak", 0.002, 0.05),
    _effect("heating", "film_heating", 2.0, 40.0),
    _effect("clearance", "thermal_clearance", 0.002, 0.02),
    _effect("droop", "swash_droop", 0.002, 0.05),
    _effect("mixed", "mixed_friction", 0.01, 0.12),
    _effect("compression", "compression_loss", 0.1, 1.0),
    _effect("squeeze", "squeeze_pumping", 0.001, 0.02),
    _effect("churning", "churning", 0.1, 2.0),
)
UNLISTED = (
    _effect("weeping", "", 0.002, 0.1), _effect("softening", "", 0.001, 0.01), _effect("swelling", "", 0.001, 0.05),
    _effect("creeping", "", 0.05, 2.0),
)  # fmt: skip
FAULTS = tuple(
    Secret(What.FAULT, label, id, None, size, most / size)
    for label, size, most, id in (
        ("Q_case.drift", 0.02, 0.3, "Q_case_drift"), ("Q_case.zero", 0.02, 0.3, "Q_case_offset"),
        ("Q_out.gain", 0.003, 0.03, "Q_out_gain"), ("torque.zero", 0.01, 0.15, "torque_offset"),
        ("torque.gain", 0.003, 0.04, "torque_gain"), ("Q_case.gain", 0.02, 0.2, "Q_case_gain"),
        ("T_case.zero", 1.0, 6.0, "T_case_offset"), ("p_out.zero", 1e5, 5e5, "p_out_offset"),
    )
)  # fmt: skip
"""Zero and drift of a flow or a torque: over its median; gain: relative; of p_out and T_case: Pa and K."""
TORQUE = ("mixed", "compression", "droop", "churning", "creeping", "torque.zero", "torque.gain")
"""Secrets that a recording without a torque meter does not show, or not enough."""
SPEEDS = ("squeeze", "churning")
"""Secrets that one speed cannot show."""


def nulls(seed: int) -> Iterator[WideCase]:
    """Nothing concealed, over all courses."""
    for k in range(NULLS):
        yield WideCase(Part.ROUGH_NULL, COURSES[k % len(COURSES)], seed * 1000 + k)


def effects(seed: int) -> Iterator[WideCase]:
    """Effect by effect at its next grade, in five rounds."""
    for turn, (k, one) in product(range(len(GRADES)), enumerate(EFFECTS)):
        grade = GRADES[(turn + k) % len(GRADES)]
        yield _of(Part.ROUGH_EFFECT, (one,), grade, turn + k, seed * 1000 + 200 + len(EFFECTS) * turn + k)


def pairs(seed: int) -> Iterator[WideCase]:
    """Two effects of different ids."""
    yield from _together(Part.ROUGH_PAIR, 2, PAIRS, seed * 1000 + 300)


def triples(seed: int) -> Iterator[WideCase]:
    """Three effects of different ids."""
    yield from _together(Part.ROUGH_TRIPLE, 3, TRIPLES, seed * 1000 + 350)


def sensors(seed: int) -> Iterator[WideCase]:
    """Faults alone, then each beside an effect."""
    for k, (grade, one) in enumerate(product((8.0, 15.0), FAULTS)):
        yield _of(Part.ROUGH_SENSOR, (one,), grade, k, seed * 1000 + 400 + k)
    rng = np.random.default_rng(seed)
    for k in range(BESIDE):
        both = (EFFECTS[rng.integers(len(EFFECTS))], FAULTS[k % len(FAULTS)])
        yield _of(Part.ROUGH_SENSOR, both, SEVERAL, k, seed * 1000 + 450 + k)


def unknowns(seed: int) -> Iterator[WideCase]:
    """Physics in no catalogue."""
    for k, (grade, one) in enumerate(product((8.0, 15.0, 30.0), UNLISTED)):
        yield _of(Part.ROUGH_UNKNOWN, (one,), grade, k, seed * 1000 + 500 + k)


def needs_torque(case: WideCase) -> bool:
    """Whether the case is visible only with measured torque."""
    return any(one.label in TORQUE for one in case.secrets)


def _of(part: Part, secrets: tuple[Secret, ...], grade: float, at: int, seed: int) -> WideCase:
    needs = any(one.label in SPEEDS for one in secrets)
    return WideCase(part, "speeds" if needs else COURSES[at % len(COURSES)], seed, secrets, grade)


def _together(part: Part, count: int, cases: int, first: int) -> Iterator[WideCase]:
    rng = np.random.default_rng(first)
    for k in range(cases):
        chosen = tuple(EFFECTS[at] for at in rng.choice(len(EFFECTS), count, replace=False))
        yield _of(part, chosen, SEVERAL, k, first + k)


MAKERS = {
    Part.ROUGH_NULL: nulls, Part.ROUGH_EFFECT: effects, Part.ROUGH_PAIR: pairs, Part.ROUGH_TRIPLE: triples,
    Part.ROUGH_SENSOR: sensors, Part.ROUGH_UNKNOWN: unknowns,
}  # fmt: skip
