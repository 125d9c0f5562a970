"""Contribution of each part of a pump's balance to a bench's readings: possible places of a mismatch."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.chamber_map import other_gaps
from system.bench.outputs import METERED, SIMULATED, Solved, losses, throttling_torque
from system.effects.components import Component
from system.effects.gap_states import bench_state
from system.effects.state import ideal_flow
from system.inputs.channels import ChannelName
from system.pump.chamber.problem import LeakTable
from system.pump.laws.friction_pairs import Pair

UNIT_SHARE = 0.01
"""Share of the rated displacement: size of flows and drag outside the model."""
WARMER = 1.0
"""Rise of the case oil in K that represents the thermal state."""
LEAKAGE = (Component.PISTON_LEAKAGE, Component.SLIPPER_LEAKAGE, Component.PLATE_LEAKAGE)
FRICTION = {
    Component.PISTON_FRICTION: (Pair.PISTON_CYLINDER,),
    Component.SLIPPER_FRICTION: (Pair.SLIPPER_SWASH_PLATE,),
    Component.SOCKET_FRICTION: (Pair.PISTON_SLIPPER_SOCKET,),
    Component.PLATE_FRICTION: (Pair.VALVE_PLATE_CYLINDER,),
    Component.GUIDE_FRICTION: (Pair.BALL_GUIDE_RETAINER,),
    Component.BEARINGS: (Pair.FRONT_BEARING, Pair.REAR_BEARING),
}
SENSORS = {
    ChannelName.Q_OUT: Component.Q_OUT_SENSOR,
    ChannelName.Q_IN: Component.Q_IN_SENSOR,
    ChannelName.Q_CASE: Component.Q_CASE_SENSOR,
    ChannelName.TORQUE: Component.TORQUE_SENSOR,
}
_OUT, _IN, _CASE, _TORQUE = range(len(SIMULATED))


def components(solved: Solved, warmer: Solved, channels: tuple[ChannelName, ...]) -> Mapping[Component, Array]:
    """Contribution of each component to the readings (N, C) of a solved map, SI: a share more of it is a mismatch.

    Leakage by gap, friction by pair, displacement, compression and commutation as the model has them; a sensor's is its
    reading. Flows and drag outside the model have the size UNIT_SHARE: cross flow (delivery to inlet) and drain flow
    (delivery to case) with the root of the pressure difference, drag in the case with the square of speed; the thermal
    state is the change by the viscosity of case oil warmer by WARMER, the map `warmer`.
    """
    whole = solved.truth
    found = {
        **_leakage(solved, whole),
        **_friction(solved),
        **_volume(solved, whole),
        **_absent(solved),
        Component.THERMAL_STATE: warmer.truth - whole,
    }
    columns = [METERED.index(channel) for channel in channels]
    read = {component: added[:, columns] for component, added in found.items()}
    for channel, component in SENSORS.items():
        read[component] = np.where([channel is own for own in channels], whole[:, columns], 0.0)
    return read


def _leakage(solved: Solved, whole: Array) -> dict[Component, Array]:
    found = {}
    problem = solved.setting.problem
    for row, component in enumerate(LEAKAGE):
        left = np.arange(len(LEAKAGE))[:, None] != row
        tight = LeakTable(problem.leaks.conductance * left, problem.leaks.drag_flow * left)
        courses = other_gaps(solved.courses, replace(problem, leaks=tight))
        found[component] = whole - replace(solved, courses=courses).truth
    return found


def _friction(solved: Solved) -> dict[Component, Array]:
    pairs, speed = losses(solved), solved.setting.problem.chamber.shaft_speed
    return {
        component: _one(np.sum([pairs.loss(pair).mean for pair in own], axis=0) / speed, _TORQUE)
        for component, own in FRICTION.items()
    }


def _volume(solved: Solved, whole: Array) -> dict[Component, Array]:
    """Displacement, compression (inlet less delivery and drain, a lack of delivery) and commutation."""
    state = bench_state(solved.setting.pump, solved.setting.point, np.zeros(len(whole)))
    flow = ideal_flow(state)
    displacement = np.zeros_like(whole)
    displacement[:, _OUT] = displacement[:, _IN] = flow
    displacement[:, _TORQUE] = flow * (state.delivery_pressure - state.inlet_pressure) / state.speed
    lost = whole[:, _IN] - whole[:, _OUT] - whole[:, _CASE]
    return {
        Component.DISPLACEMENT: displacement,
        Component.COMPRESSION: _one(-lost, _OUT),
        Component.COMMUTATION: _one(throttling_torque(solved.setting, solved.courses), _TORQUE),
    }


def _absent(solved: Solved) -> dict[Component, Array]:
    part = solved.setting.pump.pump
    state = bench_state(solved.setting.pump, solved.setting.point, np.zeros(len(solved.setting.point.shaft_speed)))
    rated = replace(
        state, speed=np.full_like(state.speed, part.rated_speed), displacement_ratio=np.ones_like(state.speed)
    )
    flow = UNIT_SHARE * ideal_flow(rated)
    across = np.sqrt(np.maximum(state.delivery_pressure - state.inlet_pressure, 0.0) / part.rated_pressure)
    to_case = np.sqrt(np.maximum(state.delivery_pressure - state.case_pressure, 0.0) / part.rated_pressure)
    torque = flow * part.rated_pressure / part.rated_speed * (state.speed / part.rated_speed) ** 2
    return {
        Component.CROSS_FLOW: _one(-flow * across, _OUT) + _one(-flow * across, _IN),
        Component.DRAIN_FLOW: _one(-flow * to_case, _OUT) + _one(flow * to_case, _CASE),
        Component.CASE_DRAG: _one(torque, _TORQUE),
    }


def _one(added: Array, column: int) -> Array:
    found = np.zeros((len(added), len(METERED)))
    found[:, column] = added
    return found
