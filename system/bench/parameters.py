"""The uncertain parameters of a pump, and the pump with given values of them."""

from collections.abc import Mapping
from dataclasses import fields, replace
from math import inf
from typing import Any

import numpy as np

from system.description.drawing import drawn_sigmas
from system.description.gap import Gap
from system.description.pump import FrictionSection, OilSection, PumpDescription
from system.description.tolerances import BOUNDS, FARTHEST, Tolerances
from system.estimation.parameters import Parameter, Role, Scale
from system.inputs.units import Dimension
from system.pump.laws.kinematics import stroke, swash_angle_for_stroke
from system.pump.lumped import full_drive

SLOPE_ABOUT = 323.15
"""Temperature (K) at which viscosity_slope leaves the oil's viscosity unchanged: 50 degC."""
FILM_WARMTH = (INLET_SHARE, THROTTLE_SHARE) = ("inlet_share", "throttle_share")
THROTTLED = (0.4, 0.2)
"""Centre and one sigma of throttle_share: throttled oil warms by 1 - beta T = .8 of dp/(rho c), a film by half."""
HALF_WAY = 0.5
"""Centre of inlet_share where it is uncertain: between films as warm as the case and films of the inlet's oil."""
CONCENTRIC = 0.05
"""Eccentricity ratio below which a piston leaks as a concentric one, within .4 %."""
DISPLACEMENT = "displacement"
GUIDE, BEARINGS = "ball_guide_retainer", ("front_bearing", "rear_bearing")
_THICKNESS = {
    Gap.PISTON: ("piston", "radial_clearance"),
    Gap.SLIPPER: ("slipper", "film_thickness"),
    Gap.VALVE_PLATE: ("valve_plate", "film_thickness"),
}

GROOVE_NAMES = (GROOVE_ADVANCE, GROOVE_AREA) = ("groove_advance", "groove_area")
GROOVE_SPREAD = (np.radians(0.5), 0.1)
"""One sigma of the cut of relief grooves: of their beginning (rad), of their throats' area (relative)."""

FRICTION_PAIRS = tuple(own.name for own in fields(FrictionSection))
FILE_KEYS = {
    **{f"film_thickness.{gap.value}": ".".join(place) for gap, place in _THICKNESS.items()},
    **{f"friction.{pair}": f"friction.{pair}" for pair in FRICTION_PAIRS},
    "eccentricity_ratio": "piston.eccentricity_ratio",
    "stand_out_share": "piston.stand_out_share",
    "bulk_modulus": "oil.bulk_modulus",
    "dead_volume": "pump.dead_volume",
    "flow_coefficient": "ports.flow_coefficient",
}
"""Table and key of a pump file by the name of the parameter with this value."""
BASE_NAMES = frozenset(
    {
        *(f"film_thickness.{gap.value}" for gap in Gap),
        *(f"friction.{pair}" for pair in FRICTION_PAIRS),
        "eccentricity_ratio", "bulk_modulus", "viscosity", "viscosity_slope", DISPLACEMENT, "dead_volume",
        "flow_coefficient", "stand_out_share", *FILM_WARMTH, *GROOVE_NAMES,
    }
)  # fmt: skip
"""Names of all parameters of `base_parameters` and `groove_parameters`."""


def base_parameters(pump: PumpDescription, tolerances: Tolerances) -> tuple[Parameter, ...]:
    """Uncertain parameters of a pump without missing physics, each with its prior about the stated value.

    film_thickness.GAP in m, eccentricity_ratio, friction.PAIR, dead_volume in m3, flow_coefficient, bulk_modulus
    in Pa; factors on viscosity and displacement; viscosity_slope in 1/K; stand_out_share about 0.5 where not
    stated. A friction coefficient of 0 stays 0. inlet_share: of the inlet's oil in the
    temperature of the films, where that may differ from the case's. A tolerance of the drawing
    ([[tolerance.dimension]], [[tolerance.fit]]) stands in place of the sigma of `tolerances`.
    """
    sigmas = drawn_sigmas(pump)
    whole = (
        *(_thickness(pump, gap, tolerances) for gap in Gap),
        _eccentricity(pump.piston.eccentricity_ratio, tolerances.eccentricity_ratio),
        *_fluid(pump, tolerances),
        *_frictions(pump, tolerances),
        _absolute(DISPLACEMENT, 1.0, tolerances.displacement, 0.5, 1.5),
        replace(_relative("dead_volume", pump.pump.dead_volume, tolerances.dead_volume, Dimension.VOLUME), power=1.0),
        _relative(
            "flow_coefficient",
            pump.ports.flow_coefficient,
            tolerances.flow_coefficient,
            None,
            upper=BOUNDS["flow_coefficient"][1],
        ),
        _absolute("stand_out_share", _share(pump), tolerances.stand_out_share, *BOUNDS["stand_out_share"]),
        *_warmth(tolerances),
    )
    return tuple(_by_drawing(one, sigmas.get(FILE_KEYS.get(one.name, ""))) for one in whole)


def _by_drawing(parameter: Parameter, sigma: float | None) -> Parameter:
    """Return the parameter with a sigma (SI) of the drawing, itself without one."""
    if sigma is None:
        return parameter
    return replace(parameter, spread=sigma / parameter.centre if parameter.scale is Scale.LOG else sigma)


def groove_parameters() -> tuple[Parameter, ...]:
    """Cut of the relief grooves ahead of the kidneys: groove_advance in rad sooner, groove_area a factor.

    Steady readings hardly show it: for benches with traces.
    """
    advance, area = GROOVE_SPREAD
    return (
        Parameter(GROOVE_ADVANCE, Role.BASE, Scale.NORMAL, 0.0, advance, -0.1, 0.1, Dimension.ANGLE, "cut of grooves"),
        replace(_relative(GROOVE_AREA, 1.0, area, None), source="cut of grooves"),
    )


def pump_with(pump: PumpDescription, values: Mapping[str, float]) -> PumpDescription:
    """The pump with values of `base_parameters` by name; other values stay, other names do not matter.

    displacement moves the swash plate's stop; viscosity and viscosity_slope multiply the oil's two viscosities by
    factor exp(slope (T - 50 degC)) at 40 and 100 degC, with Walther's law between them.
    """
    changed: dict[str, Any] = {}
    for gap, (section, key) in _THICKNESS.items():
        _set(changed, pump, section, key, values.get(f"film_thickness.{gap.value}"))
    _set(changed, pump, "piston", "eccentricity_ratio", values.get("eccentricity_ratio"))
    _set(changed, pump, "piston", "stand_out_share", values.get("stand_out_share"))
    for pair in FRICTION_PAIRS:
        _set(changed, pump, "friction", pair, values.get(f"friction.{pair}"))
    _set(changed, pump, "pump", "dead_volume", values.get("dead_volume"))
    factor = values.get(DISPLACEMENT, 1.0)
    _set(changed, pump, "pump", "swash_angle_max", _swash_angle(pump, factor))
    if pump.pump.displacement is not None:
        _set(changed, pump, "pump", DISPLACEMENT, factor * pump.pump.displacement)
    _set(changed, pump, "ports", "flow_coefficient", values.get("flow_coefficient"))
    _set(changed, pump, "oil", "bulk_modulus", values.get("bulk_modulus"))
    thicker, slope = values.get("viscosity", 1.0), values.get("viscosity_slope", 0.0)
    for key, kelvin in (("kinematic_viscosity_40C", 313.15), ("kinematic_viscosity_100C", 373.15)):
        _set(changed, pump, "oil", key, getattr(pump.oil, key) * thicker * np.exp(slope * (kelvin - SLOPE_ABOUT)))
    return replace(pump, **changed)


def _set(changed: dict[str, Any], pump: PumpDescription, section: str, key: str, value: float | None) -> None:
    if value is not None:
        changed[section] = replace(changed.get(section, getattr(pump, section)), **{key: float(value)})


def _swash_angle(pump: PumpDescription, factor: float) -> float:
    """The largest swash angle (rad) at which the full stroke is `factor` times the pump's; a cross angle stays."""
    full = full_drive(pump)
    whole = swash_angle_for_stroke(factor * stroke(full), full.pitch_radius, full.bore_cone_angle)
    cross = np.tan(pump.pump.cross_angle or 0.0)
    return float(np.arctan(np.sqrt(np.tan(whole) ** 2 - cross**2)))


def _share(pump: PumpDescription) -> float:
    return 0.5 if pump.piston.stand_out_share is None else pump.piston.stand_out_share


def _thickness(pump: PumpDescription, gap: Gap, tolerances: Tolerances) -> Parameter:
    section, key = _THICKNESS[gap]
    centre = getattr(getattr(pump, section), key)
    film = _relative(f"film_thickness.{gap.value}", centre, tolerances.film_thickness, Dimension.LENGTH)
    return replace(film, power=3.0)  # leakage


def _warmth(tolerances: Tolerances) -> tuple[Parameter, ...]:
    """Share of the inlet's oil in the temperature of the films; none where the films have the case's temperature."""
    spread = tolerances.inlet_share
    if spread == 0.0:
        return ()
    return _absolute(INLET_SHARE, HALF_WAY, spread, 0.0, 1.25), _absolute(THROTTLE_SHARE, *THROTTLED, 0.0, 2.0)


def _fluid(pump: PumpDescription, tolerances: Tolerances) -> tuple[Parameter, ...]:
    oil: OilSection = pump.oil
    slope = tolerances.viscosity_slope
    stiffness = _relative("bulk_modulus", oil.bulk_modulus, tolerances.bulk_modulus, Dimension.MODULUS, Role.FLUID)
    return (
        replace(stiffness, power=-1.0),  # compression
        replace(_relative("viscosity", 1.0, tolerances.viscosity, None, Role.FLUID), power=-1.0),  # leakage
        Parameter(
            "viscosity_slope", Role.FLUID, Scale.NORMAL, 0.0, slope, -0.02, 0.015,
            Dimension.TEMPERATURE_COEFFICIENT, "[tolerance]",
        ),
    )  # fmt: skip


def friction_key(pair: str) -> str:
    """The key of [tolerance] with one sigma of a pair's friction coefficient."""
    return "guide_friction" if pair == GUIDE else "bearing_friction" if pair in BEARINGS else "friction"


def _frictions(pump: PumpDescription, tolerances: Tolerances) -> tuple[Parameter, ...]:
    found = []
    for pair in FRICTION_PAIRS:
        spread = getattr(tolerances, friction_key(pair))
        if (centre := getattr(pump.friction, pair)) > 0.0:
            found.append(replace(_relative(f"friction.{pair}", centre, spread, None), power=1.0))
    return tuple(found)


def _relative(
    name: str, centre: float, spread: float, dimension: Dimension | None, role: Role = Role.BASE, upper: float = inf
) -> Parameter:
    """One whose logarithm has the spread, at most FARTHEST times and at least 1/FARTHEST of its centre."""
    lower, most = centre / FARTHEST, min(FARTHEST * centre, upper)
    return Parameter(name, role, Scale.LOG, centre, spread, lower, most, dimension, "[tolerance]")


def _eccentricity(centre: float, spread: float) -> Parameter:
    """Leakage grows with its square, so that a scale of its own would end where that has no slope."""
    least, most = BOUNDS["eccentricity_ratio"]
    scale, lower = (Scale.SQUARE, CONCENTRIC) if centre > CONCENTRIC else (Scale.NORMAL, least)
    return Parameter("eccentricity_ratio", Role.BASE, scale, centre, spread, lower, most, None, "[tolerance]")


def _absolute(name: str, centre: float, spread: float, lower: float, upper: float) -> Parameter:
    return Parameter(name, Role.BASE, Scale.NORMAL, centre, spread, lower, upper, None, "[tolerance]")
