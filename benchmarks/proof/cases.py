"""The cases: concealed causes, their campaigns, their sizes, and the right verdicts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from .other.cases import MAKERS as OTHER_MAKERS
from .parts import Part
from .plant.hidden import NOTHING, Hidden
from .rough.cases import MAKERS as ROUGH_MAKERS
from .sensors import Fault
from .wide.case import WideCase

GRADES = (8.0, 5.0, 15.0, 3.0, 30.0)
PAIR_SCORE = 10.0
NULLS = 240


VERDICTS = {
    Part.NULL: "no_mismatch", Part.GRADED: "missing_physics", Part.PAIR: "missing_physics",
    Part.PARAMETER: "wrong_parameter", Part.SENSOR: "sensor_fault", Part.UNKNOWN: "unknown_physics",
    Part.TRACE: "missing_physics",
}  # fmt: skip


@dataclass(frozen=True)
class Concealed:
    """One thing at a small size, and the id (with its gap) by which a verdict is to name it; "": in no catalogue.

    wrong: (part of the machine, sign of its change), by e where the size is 1. most: the largest factor on the size
    that such a machine could have; a score that would need more stays below the requested one.
    """

    label: str
    id: str
    pair: str | None = None
    hidden: Hidden = NOTHING
    fault: Fault | None = None
    wrong: tuple[str, float] | None = None
    most: float = np.inf

    @property
    def definition(self) -> tuple[object, ...]:
        """Its definition, as plain values."""
        sizes = [(name, size) for name, size in vars(self.hidden).items() if size != 0.0]
        fault = None if self.fault is None else tuple(vars(self.fault).items())
        return self.label, self.id, self.pair, sizes, fault, self.wrong, self.most


@dataclass(frozen=True)
class Case:
    """One recording: its concealed causes, each at the requested score. Seeds are the recording's draws."""

    part: Part
    campaign: str
    seed: int
    concealed: tuple[Concealed, ...] = ()
    score: float = 0.0

    @property
    def name(self) -> str:
        """The concealed effect, its size and place in one line."""
        told = " + ".join(one.label for one in self.concealed) or "nothing"
        grade = f", z {self.score:g}" if self.score else ""
        return f"{told}{grade}, {self.campaign}, seed {self.seed}"

    @property
    def definition(self) -> tuple[object, ...]:
        """The definition of the case, as plain values."""
        return self.part.value, self.campaign, self.seed, self.score, [one.definition for one in self.concealed]


def _physics(label: str, id: str, size: float, pair: str | None = None, most: float = np.inf) -> Concealed:
    """Physics of a size at factor 1, and the largest size."""
    return Concealed(label, id, pair, Hidden(**{label: size}), most=most / size)


PHYSICS = (
    _physics("viscosity_pressure", "viscosity_pressure", 5e-9, most=4e-8),
    _physics("churning", "churning", 0.5, most=6.0),
    _physics("opening_plate", "elastic_opening", 2e-9, "valve_plate"),
    _physics("short_circuit", "port_short_circuit", 5e-8),
    _physics("film_heating", "film_heating", 0.1),
    _physics("mixed_friction", "mixed_friction", 0.02, most=0.12),
    _physics("droop", "swash_droop", 1e-11),
    _physics("control_flow", "control_flow", 1e-8),
    _physics("squeeze", "squeeze_pumping", 1e-6),
    _physics("opening_slipper", "elastic_opening", 2e-9, "slipper"),
    _physics("cross_leak", "laminar_cross_leak", 1e-15),
    _physics("shear_thinning", "shear_thinning", 0.1, most=0.5),
    _physics("throttling", "port_throttling", 0.3, most=5.0),
    _physics("opening_piston", "elastic_opening", 2e-9, "piston"),
    _physics("thermal_slipper", "thermal_clearance", 1e-3, "slipper"),
    _physics("seal", "seal_drag", 0.5, most=2.0),
    _physics("charge_pump", "charge_pump_drag", 2e-6),
    _physics("air", "entrained_air", 2e-3, most=0.05),
    _physics("resonance", "line_resonance", 1e-3),
    _physics("suction", "incomplete_filling", 2e4),
    _physics("compression", "compression_loss", 0.1, most=1.0),
    _physics("lift", "slipper_lift", 20e-6, most=1e-4),
)
UNLISTED = tuple(
    _physics(label, "", size, most=most)
    for label, size, most in (
        ("stiffening", 0.5, 12.0), ("root_drag", 0.5, np.inf), ("foam", 0.5, np.inf), ("whirl", 0.3, np.inf),
        ("cold_seal", 0.5, np.inf), ("seepage", 5e-13, np.inf), ("windage", 1e-6, np.inf),
        ("spin_leak", 0.03, 0.5),
    )
)  # fmt: skip
PARAMETERS = tuple(
    Concealed(f"{part} {'+' if sign > 0 else '-'}", id, pair, wrong=(part, sign), most=1.2)
    for part, sign, id, pair in (
        ("slipper_film", 1.0, "film_thickness", "slipper"), ("piston_film", 1.0, "film_thickness", "piston"),
        ("plate_film", 1.0, "film_thickness", "valve_plate"), ("viscosity", -1.0, "viscosity_grade", None),
        ("bulk_modulus", -1.0, "bulk_modulus", None), ("dead_volume", 1.0, "dead_volume", None),
        ("friction_piston", 1.0, "friction_coefficient", "piston"),
        ("friction_slipper", 1.0, "friction_coefficient", "slipper"),
        ("friction_plate", 1.0, "friction_coefficient", "valve_plate"), ("stroke", -1.0, "displacement", None),
        ("viscosity", 1.0, "viscosity_grade", None), ("slipper_film", -1.0, "film_thickness", "slipper"),
    )
)  # fmt: skip
SENSORS = tuple(
    Concealed(id, id, fault=fault)
    for id, fault in (
        ("torque_offset", Fault("torque", zero=0.5)), ("torque_gain", Fault("torque", gain=0.002)),
        ("Q_out_gain", Fault("Q_out", gain=0.002)), ("Q_in_gain", Fault("Q_in", gain=-0.002)),
        ("Q_case_offset", Fault("Q_case", zero=5e-7)), ("Q_case_drift", Fault("Q_case", drift=5e-7)),
        ("Q_case_gain", Fault("Q_case", gain=0.02)), ("p_out_offset", Fault("p_out", zero=5e4)),
        ("T_case_offset", Fault("T_case", zero=1.0)),
    )
)  # fmt: skip
NEEDS = {
    "thermal_slipper": ("ovens", "scattered"), "charge_pump": ("scattered",), "air": ("scattered",),
    "resonance": ("scattered",), "suction": ("open circuit",), "lift": ("open circuit",), "whirl": ("scattered",),
    "cold_seal": ("ovens", "scattered"),
    "mixed_friction": ("ovens", "scattered", "map"),
}  # fmt: skip
"""Campaigns that show effects hidden in the others."""
GROSS = {"suction": (5e4, 4e4, 6e4, 2.5e4, 8e4)}
"""Sizes, SI, of effects that begin at a knee and are large at once: scores of 3 to 30 would be one point beyond it."""
USUAL = ("map", "ovens", "scattered")


def cases(part: Part, seed: int) -> tuple[Case | WideCase, ...]:
    """All cases of a part, in such an order that the first few are a fair sample; `seed` begins their seeds."""
    return tuple(_MAKERS[part](seed))


def _nulls(seed: int) -> Iterator[Case]:
    names = ("map", "scattered", "ovens", "short", "open circuit", "no inlet meter")
    for k in range(NULLS):
        yield Case(Part.NULL, names[k % len(names)], seed * 1000 + k)


def _graded(seed: int) -> Iterator[Case]:
    """Effect by effect, each time at its next grade: ten rounds, two recordings of each effect at each grade."""
    for turn, (k, one) in product(range(2 * len(GRADES)), enumerate(PHYSICS)):
        grade, own_seed = (turn + k) % len(GRADES), seed * 1000 + 100 * turn + k
        if one.label in GROSS:
            size = GROSS[one.label][grade]
            gross = replace(_physics(one.label, one.id, size), label=f"{one.label} {size:g}")
            yield Case(Part.GRADED, NEEDS[one.label][0], own_seed, (gross,))
        else:
            yield _case(Part.GRADED, one, GRADES[grade], turn + k, own_seed)


def _pairs(seed: int) -> Iterator[Case]:
    rng = np.random.default_rng(seed)
    known = [one for one in PHYSICS if one.label not in NEEDS]
    for k in range(20):
        first, second = rng.choice(len(known), 2, replace=False)
        chosen = (known[first], known[second])
        yield Case(Part.PAIR, USUAL[k % 3], seed * 1000 + k, chosen, PAIR_SCORE)


def _parameters(seed: int) -> Iterator[Case]:
    for k, one in enumerate(PARAMETERS):
        yield _case(Part.PARAMETER, one, (8.0, 15.0)[k % 2], k, seed * 1000 + 100 + k)


def _sensors(seed: int) -> Iterator[Case]:
    for k, (grade, one) in enumerate(product((8.0, 15.0), SENSORS)):
        yield _case(Part.SENSOR, one, grade, k, seed * 1000 + 200 + k)


def _unknowns(seed: int) -> Iterator[Case]:
    for k, (grade, one) in enumerate(product((8.0, 15.0, 30.0), UNLISTED)):
        yield _case(Part.UNKNOWN, one, grade, k, seed * 1000 + 300 + k)


def _traces(seed: int) -> Iterator[Case]:
    """Effects that show in chamber traces only, at sizes of its own: a groove that wears away before its beginning."""
    for k, size in enumerate((0.04, 0.08, 0.12, 0.16)):
        worn = Concealed(f"notch_erosion {size:g} rad", "notch_erosion", hidden=Hidden(erosion=size))
        yield Case(Part.TRACE, "map", seed * 1000 + 400 + k, (worn,))


def _case(part: Part, one: Concealed, score: float, at: int, seed: int) -> Case:
    able = NEEDS.get(one.label, USUAL)
    return Case(part, able[at % len(able)], seed, (one,), score)


_MAKERS: Mapping[Part, Callable[[int], Iterator[Case | WideCase]]] = {
    Part.NULL: _nulls, Part.GRADED: _graded, Part.PAIR: _pairs, Part.PARAMETER: _parameters,
    Part.SENSOR: _sensors, Part.UNKNOWN: _unknowns, Part.TRACE: _traces, **OTHER_MAKERS, **ROUGH_MAKERS,
}  # fmt: skip
