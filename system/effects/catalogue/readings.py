"""The catalogue of causes that are no missing physics: faulty meters, parameters with wrong stated values."""

from system.effects.catalogue.films import FILM_CHANNELS, FRICTION, LEAKAGE
from system.effects.components import Component
from system.effects.effect import EffectId, Kind
from system.effects.extension import Entry
from system.inputs.channels import ChannelName

E = EffectId
C = Component
N = ChannelName


def _sensor(
    effect: EffectId, channel: ChannelName, at: Component, twins: tuple[EffectId, ...], regime: str, sentence: str
) -> Entry:
    source = "docs/theory.md, Readings and parameters"
    return Entry(effect, Kind.SENSOR_FAULT, (), (at,), (channel,), regime, twins, sentence, source)


def _wrong(
    effect: EffectId,
    at: tuple[Component, ...],
    channels: tuple[ChannelName, ...],
    twins: tuple[EffectId, ...],
    sentence: str,
) -> Entry:
    source = "tolerances of the pump's description"
    return Entry(effect, Kind.WRONG_PARAMETER, (), at, channels, "everywhere", twins, sentence, source)


SENSOR_ENTRIES = (
    _sensor(E.TORQUE_OFFSET, N.TORQUE, C.TORQUE_SENSOR, (E.SEAL_DRAG, E.CHARGE_PUMP_DRAG),
            "everywhere alike", "the torque meter's zero is off"),
    _sensor(E.TORQUE_GAIN, N.TORQUE, C.TORQUE_SENSOR, (E.FRICTION_COEFFICIENT, E.MIXED_FRICTION),
            "in proportion to torque", "the torque meter's gain is off"),
    _sensor(E.Q_OUT_GAIN, N.Q_OUT, C.Q_OUT_SENSOR, (E.DISPLACEMENT, E.ENTRAINED_AIR),
            "in proportion to the delivery flow", "the delivery meter's gain is off"),
    _sensor(E.Q_IN_GAIN, N.Q_IN, C.Q_IN_SENSOR, (E.DISPLACEMENT, E.ENTRAINED_AIR),
            "in proportion to the inlet flow", "the inlet meter's gain is off"),
    _sensor(E.Q_CASE_OFFSET, N.Q_CASE, C.Q_CASE_SENSOR, (E.CONTROL_FLOW, E.SQUEEZE_PUMPING),
            "everywhere alike", "the drain meter's zero is off"),
    _sensor(E.Q_CASE_DRIFT, N.Q_CASE, C.Q_CASE_SENSOR, (E.SQUEEZE_PUMPING, E.FILM_HEATING),
            "growing from point to point", "the drain meter drifts"),
    _sensor(E.Q_CASE_GAIN, N.Q_CASE, C.Q_CASE_SENSOR, (E.FILM_THICKNESS,),
            "in proportion to the drain flow", "the drain meter's gain is off"),
    _sensor(E.FLOW_LAG, N.Q_OUT, C.Q_OUT_SENSOR, (), "while the flow changes", "the delivery meter lags"),
    _sensor(E.P_OUT_OFFSET, N.P_OUT, C.DISPLACEMENT, (E.TORQUE_OFFSET,),
            "everywhere alike, most at low pressure", "the delivery pressure gauge's zero is off"),
    _sensor(E.T_CASE_OFFSET, N.T_CASE, C.THERMAL_STATE, (E.VISCOSITY_GRADE,),
            "all that goes with viscosity", "the case thermometer is off"),
    _sensor(E.T_IN_OFFSET, N.T_IN, C.T_OUT_SENSOR, (), "the outlet's temperature", "the inlet thermometer is off"),
)  # fmt: skip
PARAMETER_ENTRIES = (
    _wrong(E.FILM_THICKNESS, (*LEAKAGE, *FRICTION), FILM_CHANNELS, (E.Q_CASE_GAIN,),
           "a film is not as thick as stated"),
    _wrong(E.VISCOSITY_GRADE, (*LEAKAGE, *FRICTION), FILM_CHANNELS, (E.T_CASE_OFFSET,),
           "the oil is thicker or thinner than stated"),
    _wrong(E.BULK_MODULUS, (C.COMPRESSION,), (N.Q_OUT, N.TORQUE), (E.DEAD_VOLUME,),
           "the oil is stiffer or softer than stated"),
    _wrong(E.DEAD_VOLUME, (C.COMPRESSION,), (N.Q_OUT, N.TORQUE), (E.BULK_MODULUS,),
           "the dead volume is not as stated"),
    _wrong(E.FRICTION_COEFFICIENT, FRICTION, (N.TORQUE,), (E.TORQUE_GAIN, E.MIXED_FRICTION),
           "a pair's friction is not as stated"),
    _wrong(E.DISPLACEMENT, (C.DISPLACEMENT,), (N.Q_OUT, N.Q_IN, N.TORQUE), (E.Q_OUT_GAIN, E.Q_IN_GAIN),
           "the displacement is not as stated"),
)  # fmt: skip
