"""The catalogue of effects outside the films: filling, drag, other paths, ports, swash plate."""

from system.effects.components import Component
from system.effects.effect import EffectId
from system.effects.extension import THEORY
from system.effects.laws import (
    air as air_laws,
    drag as drag_laws,
    filling as filling_laws,
    flow as flow_laws,
    port as port_laws,
)
from system.effects.priors import Form, missing_physics, path_of, share_of, signed, size_of, whole
from system.estimation.parameters import Parameter, Role, Scale
from system.inputs.channels import ChannelName
from system.inputs.units import RPM, Dimension

FLOWS = (ChannelName.Q_OUT, ChannelName.Q_IN)
CASE_SEALS = (0.0, 1.5e-6)
RESONANCES = tuple(RPM * speed for speed in (600.0, 900.0, 1200.0, 1500.0, 1800.0, 2100.0, 2400.0, 2700.0, 3000.0))


def _polytropic() -> Parameter:
    name, source = path_of(EffectId.ENTRAINED_AIR, "polytropic"), "slow (1) to fast (1.4) compression"
    return Parameter(name, Role.EXTENSION, Scale.NORMAL, 1.2, 0.15, 1.0, 1.4, None, source)


def _growth() -> Parameter:
    name, source = path_of(EffectId.INCOMPLETE_FILLING, "growth"), "cavities by the square of the excess of speed"
    return Parameter(name, Role.EXTENSION, Scale.LOG, 2.0, 1.0, 0.1, 30.0, None, source)


E = EffectId
FILLING_ENTRIES = (
    missing_physics(
        whole(
            E.ENTRAINED_AIR, air_laws.entrained_air,
            size_of(E.ENTRAINED_AIR, "void", 0.01, 0.05, None, "up to 5 % behind a poor tank"),
            forms=(Form(air_laws.air_in_chambers, ({"polytropic": 1.2},), (_polytropic(),)),),
        ),
        (Component.DISPLACEMENT,), (*FLOWS, ChannelName.P_CHAMBER), (E.DISPLACEMENT, E.Q_OUT_GAIN, E.Q_IN_GAIN),
        "low inlet pressure, every speed", "bubbles of air take the place of oil in the chambers",
        "Nykaenen et al. 2000",
    ),
    missing_physics(
        whole(
            E.INCOMPLETE_FILLING, filling_laws.starved_kidneys,
            size_of(E.INCOMPLETE_FILLING, "inlet_loss", 1.0, 10.0, None, "1: as much again as the kidneys"),
            forms=(
                Form(
                    filling_laws.starved_line, ({"laminar": 0.0},),
                    (share_of(E.INCOMPLETE_FILLING, "laminar", 0.0, "1: a line of laminar flow alone"),),
                ),
                Form(filling_laws.starved_beyond_onset, ({"growth": 2.0},), (_growth(),)),
            ),
        ),
        (Component.DISPLACEMENT,), (*FLOWS, ChannelName.TORQUE),
        (E.SLIPPER_LIFT, E.BLOCK_TIPPING, E.ENTRAINED_AIR),
        "above a speed that goes with the root of the inlet pressure", "chambers no longer fill at suction",
        THEORY,
    ),
)  # fmt: skip
DRAG_ENTRIES = (
    missing_physics(
        whole(
            E.CHURNING, drag_laws.churning,
            size_of(E.CHURNING, "factor", 1.0, 3.0, None, "1: Wendt's drum and the pistons' drag, +-50 %"),
        ),
        (Component.CASE_DRAG,), (ChannelName.TORQUE,), (E.SHEAR_THINNING, E.PORT_THROTTLING),
        "high speed, every pressure", "the rotating group churns the oil in the case", "Wendt 1933",
    ),
    missing_physics(
        whole(
            E.SEAL_DRAG, drag_laws.seal_drag,
            size_of(E.SEAL_DRAG, "torque", 1.0, 5.0, Dimension.TORQUE, ".3 to 1 N m of a lip seal"),
            grid=tuple({"per_case_pressure": rise} for rise in CASE_SEALS),
        ),
        (Component.CASE_DRAG,), (ChannelName.TORQUE,), (E.TORQUE_OFFSET, E.CHARGE_PUMP_DRAG),
        "everywhere alike", "the shaft's seal drags", THEORY,
    ),
    missing_physics(
        whole(
            E.CHARGE_PUMP_DRAG, drag_laws.charge_pump_drag,
            size_of(E.CHARGE_PUMP_DRAG, "volume", 20e-6, 40e-6, Dimension.DISPLACEMENT, "a fifth of the pump's own"),
        ),
        (Component.CASE_DRAG,), (ChannelName.TORQUE,), (E.SEAL_DRAG, E.TORQUE_OFFSET),
        "in proportion to the inlet pressure", "the shaft drives a charge pump too", THEORY,
    ),
    missing_physics(
        whole(
            E.PORT_THROTTLING, drag_laws.port_throttling,
            size_of(E.PORT_THROTTLING, "factor", 1.0, 5.0, None, "1: a kidney each way"),
        ),
        (Component.COMMUTATION,), (ChannelName.TORQUE,), (E.CHURNING,),
        "high speed and large displacement", "passages behind the ports throttle the flow",
        "Schlosser 1961",
    ),
    missing_physics(
        whole(
            E.COMPRESSION_LOSS, drag_laws.compression_loss,
            size_of(E.COMPRESSION_LOSS, "share", 1.0, 5.0, None,
                    "1: dead volumes without relief grooves; V/(z V_d) more: strokes too, filled in a jump"),
        ),
        (Component.COMPRESSION, Component.COMMUTATION), (ChannelName.TORQUE,),
        (E.FRICTION_COEFFICIENT, E.CHARGE_PUMP_DRAG, E.TORQUE_GAIN),
        "high pressure and small displacement, every speed", "the energy of compressed oil is lost at the ports",
        THEORY,
    ),
)  # fmt: skip
FLOW_ENTRIES = (
    missing_physics(
        whole(
            E.PORT_SHORT_CIRCUIT, flow_laws.port_short_circuit,
            size_of(E.PORT_SHORT_CIRCUIT, "area", 2e-7, 3e-6, Dimension.AREA, ".06 mm2 is .7 L/min at 35 MPa"),
        ),
        (Component.CROSS_FLOW,), FLOWS, (E.LAMINAR_CROSS_LEAK, E.DISPLACEMENT, E.Q_OUT_GAIN),
        "every speed and temperature, with the root of pressure", "an orifice joins delivery and inlet",
        THEORY,
    ),
    missing_physics(
        whole(
            E.LAMINAR_CROSS_LEAK, flow_laws.laminar_cross_leak,
            size_of(E.LAMINAR_CROSS_LEAK, "conductance", 1.2e-14, 1.2e-12, Dimension.VOLUME,
                    "1 L/min at 35 MPa and 25 mPa s"),
        ),
        (Component.CROSS_FLOW,), FLOWS, (E.PORT_SHORT_CIRCUIT,),
        "every speed, more when hot, in proportion to pressure", "a narrow gap joins delivery and inlet",
        "catalogue of ids",
    ),
    missing_physics(
        whole(
            E.CONTROL_FLOW, flow_laws.control_flow,
            size_of(E.CONTROL_FLOW, "area", 2e-7, 2e-6, Dimension.AREA, "bleeds of .6 to 1 mm at reduced pressure"),
            grid=({"laminar": 0.0}, {"laminar": 1.0}),
            scales=(share_of(E.CONTROL_FLOW, "laminar", 0.0, "between an orifice and a clearance alone"),),
        ),
        (Component.DRAIN_FLOW,), (ChannelName.Q_CASE, ChannelName.Q_OUT), (E.Q_CASE_OFFSET, E.SQUEEZE_PUMPING),
        "every speed and displacement", "the control draws oil from delivery into the case", THEORY,
    ),
)  # fmt: skip
PORT_ENTRIES = (
    missing_physics(
        whole(
            E.NOTCH_EROSION, port_laws.notch_erosion,
            size_of(E.NOTCH_EROSION, "advance", 0.03, 0.15, Dimension.ANGLE, "up to 5 deg"),
            size_of(E.NOTCH_EROSION, "widening", 0.3, 3.0, None, ".5 mm2 of a 4 mm2 throat is little"),
        ),
        (Component.COMMUTATION,), (ChannelName.P_CHAMBER, *FLOWS, ChannelName.TORQUE),
        (E.PORT_SHORT_CIRCUIT, E.COMPRESSION_LOSS),
        "shaft angles where ports begin to open", "relief grooves are worn: ports open sooner", THEORY,
    ),
    missing_physics(
        whole(
            E.SWASH_DROOP, port_laws.swash_droop,
            size_of(E.SWASH_DROOP, "rate", 5e-11, 3e-10, Dimension.ANGLE_COMPLIANCE, ".05 to .15 deg at 35 MPa"),
            size_of(E.SWASH_DROOP, "play", 1e-3, 3e-3, Dimension.ANGLE, ".05 to .15 deg"),
        ),
        (Component.DISPLACEMENT,), (*FLOWS, ChannelName.TORQUE), (E.DISPLACEMENT, E.TORQUE_GAIN),
        "high pressure and small displacement, every speed, flow and torque alike",
        "the swash plate deflects under load", THEORY,
    ),
    missing_physics(
        whole(
            E.LINE_RESONANCE, port_laws.line_resonance,
            signed(path_of(E.LINE_RESONANCE, "height"), 0.01, 0.03, None, ".5 to 3 % of turbine meters"),
            grid=tuple({"speed": speed} for speed in RESONANCES),
        ),
        (Component.Q_OUT_SENSOR,), (ChannelName.Q_OUT,), (E.Q_OUT_GAIN,),
        "one speed", "the delivery line resonates, and its meter reads wrong there", THEORY,
    ),
)  # fmt: skip
PUMP_ENTRIES = (*FILLING_ENTRIES, *DRAG_ENTRIES, *FLOW_ENTRIES, *PORT_ENTRIES)
