"""The catalogue of effects in films: oil under pressure, heat and shear; faces that touch or separate."""

from system.description.gap import Gap
from system.effects.components import Component
from system.effects.effect import EffectId, Kind
from system.effects.extension import THEORY, Entry, Extension, Law
from system.effects.laws.contact import mixed_friction
from system.effects.laws.film import ElasticOpening, ThermalClearance, film_heating, shear_thinning, viscosity_pressure
from system.effects.laws.flow import squeeze_pumping
from system.effects.laws.tipping import block_tipping, slipper_lift
from system.effects.priors import half, path_of, scale_of, signed
from system.estimation.parameters import Parameter, Role, Scale
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension

LEAKAGE = (Component.PISTON_LEAKAGE, Component.SLIPPER_LEAKAGE, Component.PLATE_LEAKAGE)
FRICTION = (Component.PISTON_FRICTION, Component.SLIPPER_FRICTION, Component.PLATE_FRICTION)
FILM_CHANNELS = (ChannelName.Q_OUT, ChannelName.Q_CASE, ChannelName.TORQUE)
HERSEY_SCALES = (3e-8, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5)
SHEAR_RATES = (1e5, 3e5, 1e6, 3e6)
RETAINER_FORCES = (30.0, 100.0, 300.0, 1000.0)


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


def _one(effect: EffectId, law: Law, *parameters: tuple[str, float, float, Dimension | None, str]) -> Extension:
    own = tuple(half(path_of(effect, key), *prior) for key, *prior in parameters)  # type: ignore[arg-type]
    return Extension(effect, None, law, own)


def _walls(gap: Gap) -> Parameter:
    name, source = path_of(EffectId.FILM_HEATING, gap.value), "6.6e-5 of ref90's films, solved"
    return half(name, 5e-5, 2e-3, Dimension.THERMAL_RESISTANCE, source)


def _carried() -> Parameter:
    name = path_of(EffectId.FILM_HEATING, "carried_share")
    return half(name, 0.1, 1.0, None, "1: walls that take no heat")


def _share(key: str, upper: float, source: str) -> Parameter:
    """A share of which only the range is known."""
    name = path_of(EffectId.FILM_HEATING, key)
    return Parameter(name, Role.EXTENSION, Scale.NORMAL, 0.5, 0.5, 0.0, upper, None, source)


def _falling_off() -> Parameter:
    name, source = path_of(EffectId.MIXED_FRICTION, "exponent"), ".5 to 1.4 of rough pads; Greenwood, Tripp 1970"
    return Parameter(name, Role.EXTENSION, Scale.LOG, 1.0, 0.3, 0.3, 2.5, None, source)


FILM_ENTRIES = (
    Entry(
        id=EffectId.FILM_HEATING,
        verdict=Kind.MISSING_PHYSICS,
        extensions=(
            Extension(
                EffectId.FILM_HEATING,
                None,
                film_heating,
                (*(_walls(gap) for gap in Gap), _carried()),
                ({"throttled_share": 0.5, "carry_over": 0.5},),
                (
                    _share("throttled_share", 1.0, "1: oil that comes as warm as the case"),
                    _share("carry_over", 0.95, ".7 to .9 of pads; Ettles 1969"),
                ),
            ),
        ),
        components=(*LEAKAGE, *FRICTION, Component.THERMAL_STATE),
        channels=FILM_CHANNELS,
        regime="high speed, and high pressure",
        twins=(EffectId.ELASTIC_OPENING, EffectId.SHEAR_THINNING, EffectId.Q_CASE_DRIFT),
        sentence="films are warmer than the case: shear and throttling heat them and thin the oil",
        source="Nahme 1940",
    ),
    Entry(
        id=EffectId.VISCOSITY_PRESSURE,
        verdict=Kind.MISSING_PHYSICS,
        extensions=(
            _one(
                EffectId.VISCOSITY_PRESSURE,
                viscosity_pressure,
                ("coefficient", 2e-8, 4e-8, Dimension.PRESSURE_COEFFICIENT, "1.3e-8 to 2.4e-8 1/Pa; Stachowiak"),
            ),
        ),
        components=(*LEAKAGE, *FRICTION),
        channels=FILM_CHANNELS,
        regime="high pressure, every speed",
        twins=(EffectId.ELASTIC_OPENING, EffectId.CONTROL_FLOW, EffectId.Q_CASE_OFFSET),
        sentence="the oil thickens under pressure",
        source="Barus 1893",
    ),
    Entry(
        id=EffectId.SHEAR_THINNING,
        verdict=Kind.MISSING_PHYSICS,
        extensions=(
            Extension(
                EffectId.SHEAR_THINNING,
                None,
                shear_thinning,
                (half(path_of(EffectId.SHEAR_THINNING, "drop"), 0.15, 0.4, None, "10 to 40 % of multigrade oils"),),
                tuple({"rate": rate} for rate in SHEAR_RATES),
                (scale_of(EffectId.SHEAR_THINNING, "rate", SHEAR_RATES, Dimension.SHEAR_RATE),),
            ),
        ),
        components=FRICTION,
        channels=(ChannelName.TORQUE,),
        regime="high speed, every pressure",
        twins=(EffectId.CHURNING, EffectId.VISCOSITY_GRADE),
        sentence="the oil thins where it is sheared fast",
        source="Cross 1965",
    ),
    Entry(
        id=EffectId.MIXED_FRICTION,
        verdict=Kind.MISSING_PHYSICS,
        extensions=(
            Extension(
                EffectId.MIXED_FRICTION,
                None,
                mixed_friction,
                tuple(
                    half(path_of(EffectId.MIXED_FRICTION, gap.value), 0.05, 0.12, None, ".08 to .12 of bare layers")
                    for gap in Gap
                ),
                tuple({"hersey_scale": scale, "exponent": 1.0} for scale in HERSEY_SCALES),
                (scale_of(EffectId.MIXED_FRICTION, "hersey_scale", HERSEY_SCALES, None), _falling_off()),
            ),
        ),
        components=FRICTION,
        channels=(ChannelName.TORQUE,),
        regime="low speed, high pressure, hot oil",
        twins=(EffectId.FRICTION_COEFFICIENT, EffectId.TORQUE_GAIN),
        sentence="faces touch where speed and viscosity are too low to part them",
        source="Stribeck 1902",
    ),
    Entry(
        id=EffectId.ELASTIC_OPENING,
        verdict=Kind.MISSING_PHYSICS,
        extensions=tuple(_opening(gap) for gap in Gap),
        components=(*LEAKAGE, *FRICTION),
        channels=FILM_CHANNELS,
        regime="high pressure, every speed and temperature alike",
        twins=(EffectId.FILM_HEATING, EffectId.VISCOSITY_PRESSURE),
        sentence="a film opens under pressure",
        source=THEORY,
    ),
    Entry(
        id=EffectId.THERMAL_CLEARANCE,
        verdict=Kind.MISSING_PHYSICS,
        extensions=tuple(_clearance(gap) for gap in Gap),
        components=(*LEAKAGE, *FRICTION),
        channels=FILM_CHANNELS,
        regime="temperatures far from the pump's own",
        twins=(EffectId.VISCOSITY_GRADE, EffectId.T_CASE_OFFSET),
        sentence="a clearance changes with temperature, as its walls expand unlike",
        source=THEORY,
    ),
    Entry(
        id=EffectId.SQUEEZE_PUMPING,
        verdict=Kind.MISSING_PHYSICS,
        extensions=(
            _one(
                EffectId.SQUEEZE_PUMPING,
                squeeze_pumping,
                ("stroke", 5e-6, 30e-6, Dimension.LENGTH, "3 um in the film, 10 to 20 um from plate to retainer"),
            ),
        ),
        components=(Component.DRAIN_FLOW,),
        channels=(ChannelName.Q_CASE, ChannelName.Q_IN),
        regime="every pressure, in proportion to speed",
        twins=(EffectId.Q_CASE_DRIFT, EffectId.CONTROL_FLOW, EffectId.Q_CASE_OFFSET),
        sentence="slippers that rise and fall each turn pump oil into the case",
        source=THEORY,
    ),
    Entry(
        id=EffectId.SLIPPER_LIFT,
        verdict=Kind.MISSING_PHYSICS,
        extensions=(
            Extension(
                EffectId.SLIPPER_LIFT,
                None,
                slipper_lift,
                (
                    half(
                        path_of(EffectId.SLIPPER_LIFT, "ride_height"),
                        20e-6,
                        100e-6,
                        Dimension.LENGTH,
                        "20 to 100 um, up to the retainer's clearance",
                    ),
                ),
                tuple({"retainer_force": force} for force in RETAINER_FORCES),
                (scale_of(EffectId.SLIPPER_LIFT, "retainer_force", RETAINER_FORCES, Dimension.FORCE),),
            ),
        ),
        components=(Component.SLIPPER_LEAKAGE,),
        channels=(ChannelName.Q_CASE, ChannelName.Q_IN),
        regime="high speed and low inlet pressure",
        twins=(EffectId.INCOMPLETE_FILLING, EffectId.BLOCK_TIPPING),
        sentence="slippers tip off the swash plate on the suction side",
        source=THEORY,
    ),
    Entry(
        id=EffectId.BLOCK_TIPPING,
        verdict=Kind.MISSING_PHYSICS,
        extensions=(
            _one(
                EffectId.BLOCK_TIPPING,
                block_tipping,
                ("wedge", 5e-6, 20e-6, Dimension.LENGTH, "1.2e-4 to 4.3e-4 rad over the plate's radius"),
            ),
        ),
        components=(Component.PLATE_LEAKAGE, Component.CROSS_FLOW),
        channels=FILM_CHANNELS,
        regime="high speed and low pressure",
        twins=(EffectId.INCOMPLETE_FILLING, EffectId.SLIPPER_LIFT),
        sentence="the block tips on the valve plate",
        source="Manring 2000",
    ),
)
