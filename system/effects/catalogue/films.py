"""The catalogue of effects in films: oil under pressure, heat and shear; faces that touch or separate."""

from system.description.gap import Gap
from system.effects.components import Component
from system.effects.effect import EffectId
from system.effects.extension import THEORY, Extension, Law
from system.effects.laws.contact import mixed_friction
from system.effects.laws.film import ElasticOpening, ThermalClearance, film_heating, shear_thinning, viscosity_pressure
from system.effects.laws.flow import squeeze_pumping
from system.effects.laws.tipping import block_tipping, slipper_lift, slippers_ride_on_a_wedge, slippers_tilt_by_degrees
from system.effects.priors import Form, half, missing_physics, path_of, scale_of, signed, size_of, whole
from system.estimation.parameters import Parameter, Role, Scale
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension

LEAKAGE = (Component.PISTON_LEAKAGE, Component.SLIPPER_LEAKAGE, Component.PLATE_LEAKAGE)
FRICTION = (Component.PISTON_FRICTION, Component.SLIPPER_FRICTION, Component.PLATE_FRICTION)
FILM_CHANNELS = (ChannelName.Q_OUT, ChannelName.Q_CASE, ChannelName.TORQUE)
HERSEY_SCALES = (3e-8, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5)
SHEAR_RATES = (1e5, 3e5, 1e6, 3e6)
RETAINER_FORCES = (30.0, 100.0, 300.0, 1000.0)
HOLDING_FORCES = (50.0, 400.0)


def _opening(gap: Gap) -> Extension:
    name = path_of(EffectId.ELASTIC_OPENING, "opening", gap)
    source = "1 to 5 um at 35 MPa of 8 to 15 um films; Pelosi, Ivantysynova 2012; Lame's thick ring"
    parameter = half(name, 2e-8, 1e-7, Dimension.PRESSURE_COEFFICIENT, source)
    return Extension(EffectId.ELASTIC_OPENING, gap, ElasticOpening(gap), (parameter,))


def _clearance(gap: Gap) -> Extension:
    name = path_of(EffectId.THERMAL_CLEARANCE, "rate", gap)
    source = "7e-6 1/K between bronze and steel on an 11 mm radius, of a 15 um film: .005 1/K"
    parameter = signed(name, 5e-3, 0.02, Dimension.TEMPERATURE_COEFFICIENT, source)
    return Extension(EffectId.THERMAL_CLEARANCE, gap, ThermalClearance(gap), (parameter,))


def _walls(gap: Gap) -> Parameter:
    name, source = path_of(EffectId.FILM_HEATING, gap.value), "6.6e-5 of ref90's films, solved"
    return half(name, 5e-5, 2e-3, Dimension.THERMAL_RESISTANCE, source)


def _share(key: str, upper: float, source: str) -> Parameter:
    """A share of which only the range is known."""
    name = path_of(EffectId.FILM_HEATING, key)
    return Parameter(name, Role.EXTENSION, Scale.NORMAL, 0.5, 0.5, 0.0, upper, None, source)


def _falling_off() -> Parameter:
    name, source = path_of(EffectId.MIXED_FRICTION, "exponent"), ".5 to 1.4 of rough pads; Greenwood, Tripp 1970"
    return Parameter(name, Role.EXTENSION, Scale.LOG, 1.0, 0.3, 0.3, 2.5, None, source)


def _lifted(law: Law, key: str, centre: float, lower: float, upper: float, source: str) -> Form:
    """A form of slipper_lift with an exponent of its own, at two forces of the retainer."""
    name = path_of(EffectId.SLIPPER_LIFT, key)
    exponent = Parameter(name, Role.EXTENSION, Scale.LOG, centre, 0.5, lower, upper, None, source)
    grid = tuple({"retainer_force": force, key: centre} for force in HOLDING_FORCES)
    return Form(
        law, grid, (scale_of(EffectId.SLIPPER_LIFT, "retainer_force", HOLDING_FORCES, Dimension.FORCE), exponent)
    )


E = EffectId
FILM_ENTRIES = (
    missing_physics(
        whole(
            E.FILM_HEATING, film_heating, *(_walls(gap) for gap in Gap),
            size_of(E.FILM_HEATING, "carried_share", 0.1, 1.0, None, "1: walls that take no heat"),
            grid=({"throttled_share": 0.5, "carry_over": 0.5},),
            scales=(
                _share("throttled_share", 1.0, "1: oil that comes as warm as the case"),
                _share("carry_over", 0.95, ".7 to .9 of pads; Ettles 1969"),
            ),
        ),
        (*LEAKAGE, *FRICTION, Component.THERMAL_STATE), FILM_CHANNELS,
        (E.ELASTIC_OPENING, E.SHEAR_THINNING, E.Q_CASE_DRIFT), "high speed, and high pressure",
        "films are warmer than the case: shear and throttling heat them and thin the oil", "Nahme 1940",
    ),
    missing_physics(
        whole(
            E.VISCOSITY_PRESSURE, viscosity_pressure,
            size_of(E.VISCOSITY_PRESSURE, "coefficient", 2e-8, 4e-8, Dimension.PRESSURE_COEFFICIENT,
                    "1.3e-8 to 2.4e-8 1/Pa; Stachowiak"),
        ),
        (*LEAKAGE, *FRICTION), FILM_CHANNELS, (E.ELASTIC_OPENING, E.CONTROL_FLOW, E.Q_CASE_OFFSET),
        "high pressure, every speed", "the oil thickens under pressure", "Barus 1893",
    ),
    missing_physics(
        whole(
            E.SHEAR_THINNING, shear_thinning,
            size_of(E.SHEAR_THINNING, "drop", 0.15, 0.4, None, "10 to 40 % of multigrade oils"),
            grid=tuple({"rate": rate} for rate in SHEAR_RATES),
            scales=(scale_of(E.SHEAR_THINNING, "rate", SHEAR_RATES, Dimension.SHEAR_RATE),),
        ),
        FRICTION, (ChannelName.TORQUE,), (E.CHURNING, E.VISCOSITY_GRADE),
        "high speed, every pressure", "the oil thins where it is sheared fast", "Cross 1965",
    ),
    missing_physics(
        whole(
            E.MIXED_FRICTION, mixed_friction,
            *(size_of(E.MIXED_FRICTION, gap.value, 0.05, 0.12, None, ".08 to .12 of bare layers") for gap in Gap),
            grid=tuple({"hersey_scale": scale, "exponent": 1.0} for scale in HERSEY_SCALES),
            scales=(scale_of(E.MIXED_FRICTION, "hersey_scale", HERSEY_SCALES, None), _falling_off()),
        ),
        FRICTION, (ChannelName.TORQUE,), (E.FRICTION_COEFFICIENT, E.TORQUE_GAIN),
        "low speed, high pressure, hot oil", "faces touch where speed and viscosity are too low to part them",
        "Stribeck 1902",
    ),
    missing_physics(
        tuple(_opening(gap) for gap in Gap),
        (*LEAKAGE, *FRICTION), FILM_CHANNELS, (E.FILM_HEATING, E.VISCOSITY_PRESSURE),
        "high pressure, every speed and temperature alike", "a film opens under pressure", THEORY,
    ),
    missing_physics(
        tuple(_clearance(gap) for gap in Gap),
        (*LEAKAGE, *FRICTION), FILM_CHANNELS, (E.VISCOSITY_GRADE, E.T_CASE_OFFSET),
        "temperatures far from the pump's own", "a clearance changes with temperature, as its walls expand unlike",
        THEORY,
    ),
    missing_physics(
        whole(
            E.SQUEEZE_PUMPING, squeeze_pumping,
            size_of(E.SQUEEZE_PUMPING, "stroke", 5e-6, 30e-6, Dimension.LENGTH,
                    "3 um in the film, 10 to 20 um from plate to retainer"),
        ),
        (Component.DRAIN_FLOW,), (ChannelName.Q_CASE, ChannelName.Q_IN),
        (E.Q_CASE_DRIFT, E.CONTROL_FLOW, E.Q_CASE_OFFSET),
        "every pressure, in proportion to speed", "slippers that rise and fall each turn pump oil into the case",
        THEORY,
    ),
    missing_physics(
        whole(
            E.SLIPPER_LIFT, slipper_lift,
            size_of(E.SLIPPER_LIFT, "ride_height", 20e-6, 100e-6, Dimension.LENGTH,
                    "20 to 100 um, up to the retainer's clearance"),
            grid=tuple({"retainer_force": force} for force in RETAINER_FORCES),
            scales=(scale_of(E.SLIPPER_LIFT, "retainer_force", RETAINER_FORCES, Dimension.FORCE),),
            forms=(
                _lifted(slippers_tilt_by_degrees, "sharpness", 6.0, 2.0, 30.0, "of the onset; Harris et al. 1996"),
                _lifted(slippers_ride_on_a_wedge, "wedge_exponent", 0.5, 0.3, 1.2, "1/2 to 1; Hooke, Li 1988"),
            ),
        ),
        (Component.SLIPPER_LEAKAGE,), (ChannelName.Q_CASE, ChannelName.Q_IN),
        (E.INCOMPLETE_FILLING, E.BLOCK_TIPPING),
        "high speed and low inlet pressure", "slippers ride higher or tip off the swash plate", THEORY,
    ),
    missing_physics(
        whole(
            E.BLOCK_TIPPING, block_tipping,
            size_of(E.BLOCK_TIPPING, "wedge", 1e-5, 20e-6, Dimension.LENGTH,
                    "1.2e-4 rad by balance of forces, across a plate of 80 to 110 mm; Zhang et al. 2020"),
        ),
        (Component.PLATE_LEAKAGE, Component.CROSS_FLOW), FILM_CHANNELS, (E.INCOMPLETE_FILLING, E.SLIPPER_LIFT),
        "high speed and low pressure", "the block tips on the valve plate", "Manring 2000",
    ),
)  # fmt: skip
