"""Tolerances of a pump before any measurement: one sigma of each uncertain parameter."""

from collections.abc import Mapping
from dataclasses import dataclass, fields

from system.description.assumptions import Assumption
from system.description.pump import PumpDescription

FARTHEST = 10.0
"""A value with a relative sigma lies between a tenth and ten times the stated one."""
BOUNDS: Mapping[str, tuple[float, float]] = {
    "flow_coefficient": (0.0, 1.0),
    "eccentricity_ratio": (0.0, 0.95),
    "stand_out_share": (0.0, 1.2),
}
"""Least and largest value of a parameter that no pump has beyond them, by its key of [tolerance]."""


@dataclass(frozen=True)
class Tolerances:
    """One sigma of a pump's parameters, relative to the stated value unless said otherwise.

    A relative one is that of the logarithm, since the value is positive.

    film_thickness: each gap's; eccentricity_ratio: absolute; viscosity_slope in 1/K: of the logarithm of viscosity
    over temperature, about 50 degC; friction, guide_friction, bearing_friction: coefficients of the pairs, of ball
    guide and retainer, of the shaft bearings; flow_coefficient: of the ports; stand_out_share: absolute; inlet_share:
    of the inlet's oil in the temperature of the films, absolute.
    """

    film_thickness: float
    eccentricity_ratio: float
    bulk_modulus: float
    viscosity: float
    viscosity_slope: float
    friction: float
    guide_friction: float
    bearing_friction: float
    displacement: float
    dead_volume: float
    flow_coefficient: float
    stand_out_share: float
    inlet_share: float


_USUAL = {
    "film_thickness": (0.08, "clearances of the class, ref90"),
    "eccentricity_ratio": (0.08, "ref90"),
    "bulk_modulus": (0.04, "spread of mineral oils, ref90"),
    "viscosity": (0.05, "ISO 3448 lets a grade vary by 10 %"),
    "viscosity_slope": (0.0005, "1/K: viscosity index +- 5, 1 % over 20 K"),
    "friction": (0.15, "ref90"),
    "guide_friction": (0.06, "ref90"),
    "bearing_friction": (0.10, "ref90"),
    "displacement": (0.001, "stop of the swash plate, bores"),
    "dead_volume": (0.02, "castings"),
    "flow_coefficient": (0.05, "sharp-edged ports"),
    "stand_out_share": (0.5, "no drawing shows where the plate pivots"),
    "inlet_share": (0.0, "films as warm as the case"),
}
"""Assumed value and its reason for each key that [tolerance] leaves out."""


def tolerances(pump: PumpDescription) -> tuple[Tolerances, tuple[Assumption, ...]]:
    """The pump's tolerances: those of its [tolerance] table, else assumed ones, with a list of the assumed."""
    stated = {field.name: getattr(pump.tolerance, field.name) for field in fields(Tolerances)}
    values = {name: _USUAL[name][0] if value is None else value for name, value in stated.items()}
    assumed = [
        Assumption(f"tolerance.{name}", f"{_USUAL[name][0]:g}", _USUAL[name][1])
        for name, value in stated.items()
        if value is None
    ]
    return Tolerances(**values), tuple(assumed)
