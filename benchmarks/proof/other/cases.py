"""Cases of the second plant: every effect of the catalogue by its own law, singly, in twos and threes, beside faults.

A block that tips is not among them: at no set point of the bench does this drawing's block tip.
"""

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
USUAL = ("map", "ovens", "scattered")


def _effect(label: str, id: str, size: float, most: float, pair: str | None = None) -> Secret:
    return Secret(What.EFFECT, label, id, pair, size, most / size)


EFFECTS = (
    _effect("viscosity_pressure", "viscosity_pressure", 5e-9, 4e-8),
    _effect("churning", "churning", 0.3, 6.0),
    _effect("opening_plate", "elastic_opening", 2e-9, 5e-8, "valve_plate"),
    _effect("short_circuit", "port_short_circuit", 5e-8, 3e-6),
    _effect("film_heating", "film_heating", 0.1, 4.0),
    _effect("mixed_friction", "mixed_friction", 0.01, 0.12),
    _effect("droop", "swash_droop", 5e-4, 0.02),
    _effect("control_flow", "control_flow", 2e-6, 1e-4),
    _effect("squeeze", "squeeze_pumping", 1e-6, 3e-5),
    _effect("opening_slipper", "elastic_opening", 2e-9, 5e-8, "slipper"),
    _effect("cross_leak", "laminar_cross_leak", 1e-15, 1e-12),
    _effect("shear_thinning", "shear_thinning", 2e-5, 2e-4),
    _effect("throttling", "port_throttling", 2e4, 5e5),
    _effect("opening_piston", "elastic_opening", 2e-9, 5e-8, "piston"),
    _effect("thermal_slipper", "thermal_clearance", 1e-3, 2e-2, "slipper"),
    _effect("seal", "seal_drag", 0.5, 5.0),
    _effect("charge_pump", "charge_pump_drag", 1e-6, 4e-5),
    _effect("air", "entrained_air", 1e-3, 0.05),
    _effect("resonance", "line_resonance", 1e-3, 0.03),
    _effect("compression", "compression_loss", 0.05, 1.0),
    _effect("lift", "slipper_lift", 2e-5, 1e-4),
)
STARVED = tuple(_effect("suction", "incomplete_filling", size, 1e5) for size in (5e4, 4e4, 6e4, 3e4, 8e4))
"""Sizes of their own: effects beginning at a knee move a single point by tens of sigma."""
WORN = tuple(_effect("erosion", "notch_erosion", size, 0.2) for size in (0.04, 0.08, 0.12, 0.16))
"""The same: effects visible in traces alone."""
UNLISTED = (
    _effect("weeping", "", 2e-6, 5e-5), _effect("belt", "", 0.5, 10.0), _effect("hot_leak", "", 2e-7, 1e-5),
    _effect("shuttle", "", 2e-6, 1e-4), _effect("pocketing", "", 0.5, 20.0),
)  # fmt: skip
PARTS = tuple(
    Secret(What.PART, part, id, pair, size, 6.0)
    for part, size, id, pair in (
        ("slipper_film", 0.2, "film_thickness", "slipper"), ("plate_film", 0.2, "film_thickness", "valve_plate"),
        ("piston_film", 0.2, "film_thickness", "piston"), ("viscosity", -0.1, "viscosity_grade", None),
        ("bulk_modulus", -0.15, "bulk_modulus", None), ("stroke", -0.01, "displacement", None),
        ("friction_piston", 0.2, "friction_coefficient", "piston"), ("viscosity", 0.1, "viscosity_grade", None),
        ("friction_slipper", 0.2, "friction_coefficient", "slipper"), ("dead_volume", 0.1, "dead_volume", None),
        ("friction_plate", 0.2, "friction_coefficient", "valve_plate"),
        ("slipper_film", -0.2, "film_thickness", "slipper"),
    )
)  # fmt: skip
FAULTS = tuple(
    Secret(What.FAULT, label, id, None, size, np.inf)
    for label, size, id in (
        ("torque.zero", 0.5, "torque_offset"), ("torque.gain", 0.002, "torque_gain"),
        ("Q_out.gain", 0.002, "Q_out_gain"), ("Q_in.gain", -0.002, "Q_in_gain"),
        ("Q_case.zero", 5e-7, "Q_case_offset"), ("Q_case.drift", 5e-7, "Q_case_drift"),
        ("Q_case.gain", 0.02, "Q_case_gain"), ("p_out.zero", 5e4, "p_out_offset"),
        ("T_case.zero", 1.0, "T_case_offset"),
    )
)  # fmt: skip
NEEDS = {
    "thermal_slipper": ("ovens", "scattered"), "charge_pump": ("scattered",), "air": ("scattered",),
    "resonance": ("scattered",), "lift": ("open circuit",), "hot_leak": ("ovens", "scattered"),
}  # fmt: skip
"""Campaigns that show effects hidden in the others."""


def nulls(seed: int) -> Iterator[WideCase]:
    """Nothing concealed, over all campaigns."""
    names = ("map", "scattered", "ovens", "short", "open circuit", "no inlet meter")
    for k in range(NULLS):
        yield WideCase(Part.OTHER_NULL, names[k % len(names)], seed * 1000 + k)


def graded(seed: int) -> Iterator[WideCase]:
    """Effect by effect at its next grade, in five rounds; then those with sizes of their own."""
    for turn, (k, one) in product(range(len(GRADES)), enumerate(EFFECTS)):
        grade = GRADES[(turn + k) % len(GRADES)]
        yield _single(Part.OTHER_GRADED, one, grade, turn + k, seed * 1000 + 200 + len(EFFECTS) * turn + k)
    for k, one in enumerate((*STARVED, *WORN)):
        where = "map" if one in WORN else "open circuit"
        yield WideCase(Part.OTHER_GRADED, where, seed * 1000 + 350 + k, (one,))


def pairs(seed: int) -> Iterator[WideCase]:
    """Two effects of different ids."""
    yield from _together(Part.OTHER_PAIR, 2, PAIRS, seed * 1000 + 400)


def triples(seed: int) -> Iterator[WideCase]:
    """Three effects of different ids."""
    yield from _together(Part.OTHER_TRIPLE, 3, TRIPLES, seed * 1000 + 450)


def parameters(seed: int) -> Iterator[WideCase]:
    """A part of the machine beyond its tolerance."""
    for k, one in enumerate(PARTS):
        yield _single(Part.OTHER_PARAMETER, one, (8.0, 15.0)[k % 2], k, seed * 1000 + 500 + k)


def sensors(seed: int) -> Iterator[WideCase]:
    """Faults alone, then each beside an effect."""
    for k, (grade, one) in enumerate(product((8.0, 15.0), FAULTS)):
        yield _single(Part.OTHER_SENSOR, one, grade, k, seed * 1000 + 550 + k)
    rng = np.random.default_rng(seed)
    free = [one for one in EFFECTS if one.label not in NEEDS]
    for k in range(BESIDE):
        both = (free[rng.integers(len(free))], FAULTS[k % len(FAULTS)])
        yield WideCase(Part.OTHER_SENSOR, USUAL[k % 3], seed * 1000 + 600 + k, both, SEVERAL)


def unknowns(seed: int) -> Iterator[WideCase]:
    """Physics in no catalogue."""
    for k, (grade, one) in enumerate(product((8.0, 15.0, 30.0), UNLISTED)):
        yield _single(Part.OTHER_UNKNOWN, one, grade, k, seed * 1000 + 700 + k)


def _single(part: Part, one: Secret, grade: float, at: int, seed: int) -> WideCase:
    able = NEEDS.get(one.label, USUAL)
    return WideCase(part, able[at % len(able)], seed, (one,), grade)


def _together(part: Part, count: int, cases: int, first: int) -> Iterator[WideCase]:
    rng = np.random.default_rng(first)
    free = [one for one in EFFECTS if one.label not in NEEDS]
    for k in range(cases):
        chosen: list[Secret] = []
        while len(chosen) < count:
            one = free[rng.integers(len(free))]
            chosen += [one] if one.id not in {each.id for each in chosen} else []
        yield WideCase(part, USUAL[k % 3], first + k, tuple(chosen), SEVERAL)


MAKERS = {
    Part.OTHER_NULL: nulls, Part.OTHER_GRADED: graded, Part.OTHER_PAIR: pairs, Part.OTHER_TRIPLE: triples,
    Part.OTHER_PARAMETER: parameters, Part.OTHER_SENSOR: sensors, Part.OTHER_UNKNOWN: unknowns,
}  # fmt: skip
