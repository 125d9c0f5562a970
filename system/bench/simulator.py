"""A bench map simulated by the lumped fidelity, all points at once: a `Simulator` of parameters with priors."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from reynolds.errors import InputError, NotConverged
from reynolds.numerics.arrays import Array
from system.bench.chamber_map import Courses, MapProblem, beside, other_gaps, solve_map
from system.bench.components import WARMER, components
from system.bench.departures import FORM, departure_parameters
from system.bench.outputs import METERED, Solved
from system.bench.parameters import BASE_NAMES
from system.bench.points import BenchPoints
from system.bench.sensors import LAG_NAMES, READING_NAMES, SENSOR_NAMES, TRACE_NAMES, read, read_turns
from system.bench.setting import Setting, affected, setting
from system.description.pump import PumpDescription
from system.effects.applied import effects_at
from system.effects.components import Component
from system.effects.extension import Extension, Law, Values
from system.effects.switched import stated_laws
from system.estimation.parameters import Parameter, Role, Scale
from system.inputs.channels import INPUTS, ChannelName
from system.pump.chamber_kinds import kinds

SAMPLES_PER_PITCH = 10
"""Shaft angles a piston pitch: torque within .07 sigma of a class A bench, flows within 5e-4."""
TOLERANCE = 1e-5
TRACE_SAMPLES_PER_PITCH = 80
STEP = 0.03
"""Of slopes by difference, in spreads of the parameter."""
LAW_STEP = 0.005
"""The same of laws, whose sizes readings determine far better than priors: a knee seldom lies within the step."""
LAG_STEP, LAG_FELT = 1.0, 0.1
"""The same of the lag of a meter, up to a lag of `LAG_FELT` spreads: readings have no slope there."""
LOG_STEP = 1e-3
"""The largest, of the value, on a logarithmic scale: leakage goes with the cube of a film."""
SQUARE_STEP = 0.02
"""The largest, of the value, on a scale of squares."""
KEPT = 8
"""Number of last courses of a map that are kept."""
INPUT_STEPS = {
    ChannelName.SPEED: 1.0,
    ChannelName.DISPLACEMENT_RATIO: -2e-3,
    ChannelName.P_OUT: 1e5,
    ChannelName.P_IN: 2e4,
    ChannelName.P_CASE: 1e4,
    ChannelName.T_IN: 1.0,
    ChannelName.T_CASE: 0.2,
}
"""Steps of slopes by input, SI: some ten times the accuracy of a sensor."""


class LumpedBench:
    """The readings of a bench at N points, by the lumped fidelity; a `system.estimation.simulator.Simulator`.

    channels: the C outputs of METERED that are read, inputs: the M measured inputs, both in the order of the
    observations. Parameters: of `base_parameters`, `sensor_parameters` and those of the extensions in `physics` that
    are not among them. All other values are the pump's own, its [physics] too, unless `own_laws` replace it (those of
    solved films), which have all parameters by name. Ports are held at their mean pressures: lines behind them and
    their ripple are neglected. Raises InputError for an unknown channel or parameter, chambers that differ, and points
    at which the oil's law is not valid. departures: (N, C, k) of its laws and meters; drifts: course (N,) of a meter's
    drift, even in time for meters without one.
    """

    def __init__(
        self,
        pump: PumpDescription,
        points: BenchPoints,
        channels: tuple[ChannelName, ...],
        parameters: tuple[Parameter, ...],
        physics: tuple[Extension, ...] = (),
        inputs: tuple[ChannelName, ...] = INPUTS,
        samples_per_pitch: int = SAMPLES_PER_PITCH,
        tolerance: float = TOLERANCE,
        departures: Array | None = None,
        drifts: Mapping[ChannelName, Array] | None = None,
        own_laws: tuple[tuple[Law, Values], ...] | None = None,
    ) -> None:
        for channel in channels:
            if channel not in METERED:
                names = ", ".join(known.value for known in METERED)
                raise InputError("bench.channels", channel.value, f"one of {names}")
        if not kinds(pump).alike:
            raise InputError("bench.pump", "single pistons or slippers", "chambers that are alike")
        self.pump, self.points, self.channels, self.inputs = pump, points, channels, inputs
        self.physics, self.samples_per_pitch, self.tolerance = physics, samples_per_pitch, tolerance
        self.departures, self.drifts = departures, drifts or {}
        own = {parameter.name for parameter in parameters}
        joining = [one for law in physics for one in law.free if one.name not in own]
        self._parameters = (*parameters, *joining)
        _hold_known(self._parameters, physics)
        self._columns = [METERED.index(channel) for channel in channels]
        setting(pump, points, {}, samples_per_pitch)
        self._kept: deque[tuple[MapProblem, Courses]] = deque(maxlen=KEPT)
        self.own_laws = stated_laws(pump) if own_laws is None else own_laws

    def __getstate__(self) -> dict[str, object]:
        """State for another process: without the kept courses."""
        return {**vars(self), "_kept": deque(maxlen=KEPT)}

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """All parameters with their priors; the order of every vector of values."""
        return self._parameters

    def predict(self, values: Array) -> Array:
        """Readings (N, C) in SI at the values (k,). Raises NotConverged."""
        return self._read(self.solved(values), values, self.points)

    def difference(self, values: Array, other: Array) -> Array:
        """Readings (N, C) at `other` values less those at `values`, by `other_gaps` where gaps alone differ.

        Friction and sensors are exact; leakage and its effect on the ports are accurate to 1 % of their change.
        Chambers that differ in anything else are solved `beside` those at `values`.
        """
        solved = self.solved(values)
        near = self._near(solved, other, self.points)
        return self._read(near, other, self.points) - self._read(solved, values, self.points)

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        """d readings / d value of the named parameters, (N, C, len(names)), by `difference` over `step_of`."""
        solved, columns = self.solved(values), []
        before = self._read(solved, values, self.points)
        for name in names:
            index = [parameter.name for parameter in self.parameters].index(name)
            step = self.step_of(name, values)
            moved = np.array(values, dtype=float)
            moved[index] += step
            direct = name in READING_NAMES | TRACE_NAMES or name.startswith(FORM)
            near = solved if direct else self._near(solved, moved, self.points)
            columns.append((self._read(near, moved, self.points) - before) / step)
        return np.stack(columns, axis=-1) if columns else np.zeros((*self._shape, 0))

    def input_slopes(self, values: Array) -> Array:
        """d readings / d input, (N, C, M), in SI per SI."""
        solved, columns = self.solved(values), []
        before = self._read(solved, values, self.points)
        for channel in self.inputs:
            step = INPUT_STEPS[channel]
            moved = replace(self.points, **{channel.value: getattr(self.points, channel.value) + step})
            near = self._near(solved, values, moved)
            columns.append((self._read(near, values, moved) - before) / step)
        return np.stack(columns, axis=-1) if columns else np.zeros((*self._shape, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> LumpedBench:
        """The same bench with these parameters: replaced where a name is there already, added where not."""
        return self._with(parameters, self.physics)

    def with_extensions(self, extensions: tuple[Extension, ...]) -> LumpedBench:
        """The same bench with these laws, each of its own parameters, beside those it has."""
        joining = tuple(parameter for extension in extensions for parameter in extension.free)
        return self._with(joining, (*self.physics, *extensions))

    def with_departures(self, columns: Array) -> LumpedBench:
        """The same bench with further departures (N, C, k) of its laws or meters, and their parameters."""
        known = np.zeros((*self._shape, 0)) if self.departures is None else self.departures
        own = (*self.parameters, *departure_parameters(columns.shape[-1], known.shape[-1] + 1))
        return self._like(parameters=own, departures=np.concatenate((known, columns), axis=2))

    def with_drifts(self, courses: Mapping[ChannelName, Array], parameters: tuple[Parameter, ...]) -> LumpedBench:
        """The same bench with courses (N,) of the drifts of some meters and with their parameters."""
        own = {parameter.name for parameter in self.parameters}
        joining = tuple(parameter for parameter in parameters if parameter.name not in own)
        return self._like(parameters=(*self.parameters, *joining), drifts={**self.drifts, **courses})

    def with_own_laws(self, laws: tuple[tuple[Law, Values], ...]) -> LumpedBench:
        """The same bench with other laws of its own."""
        return self._like(own_laws=laws)

    def only(self, parameters: tuple[Parameter, ...]) -> LumpedBench:
        """The same bench with these parameters alone; the pump states the others."""
        return self._like(parameters=parameters)

    def elsewhere(self, points: BenchPoints) -> LumpedBench:
        """The same pump with the same parameters and laws at other points."""
        return self._like(points=points, departures=None, drifts=None)

    def reading(self, channels: tuple[ChannelName, ...]) -> LumpedBench:
        """The same bench with other outputs read."""
        return self._like(channels=channels, departures=None)

    def traces(self, values: Array, points: tuple[int, ...], angles: Array) -> Array:
        """Chamber pressure (len(points), K) in Pa gauge at shaft angles (K,) rad, as `turns` of a finer bench."""
        return self.finely(points).turns(values, angles)

    def finely(self, points: tuple[int, ...]) -> LumpedBench:
        """The same bench at some of its points, with as many shaft angles as a trace requires."""
        chosen = list(points)
        some = replace(self.points, **{name: getattr(self.points, name)[chosen] for name in vars(self.points)})
        return self._like(points=some, samples_per_pitch=TRACE_SAMPLES_PER_PITCH, departures=None, drifts=None)

    def turns(self, values: Array, angles: Array) -> Array:
        """Chamber pressure (N, K) in Pa gauge at shaft angles (K,) rad, as encoder and transducer read it."""
        pressure = self.solved(values).courses.pressure
        return read_turns(pressure, self.points.speed, angles, self._named(values))

    def courses(self, values: Array) -> Courses:
        """Chamber pressure over the turn at all points, and the totals of a turn."""
        return self.solved(values).courses

    def solved(self, values: Array) -> Solved:
        """The map at the values (k,): the origin of readings, components and traces."""
        plain = self._setting(values, self.points)
        return self._complete(plain, cache(lambda: self._solve(plain)), values, self._solve)

    def components(self, values: Array) -> Mapping[Component, Array]:
        """Contribution of each component of the pump's balance to the readings (N, C), SI (`components`)."""
        solved = self.solved(values)
        warm = replace(self.points, T_case=self.points.T_case + WARMER)
        return components(solved, self._near(solved, values, warm), self.channels)

    def _named(self, values: Array) -> dict[str, float]:
        return {parameter.name: float(value) for parameter, value in zip(self.parameters, values, strict=True)}

    @property
    def _shape(self) -> tuple[int, int]:
        return len(self.points.speed), len(self.channels)

    def _setting(self, values: Array, points: BenchPoints) -> Setting:
        """The pump at the points; values without a possible pump are a fit's step that is too long."""
        try:
            return setting(self.pump, points, self._named(values), self.samples_per_pitch)
        except ValueError as void:
            raise NotConverged(f"bench map: no pump has these values: {void}") from void

    def _solve(self, at: Setting) -> Courses:
        """The courses of a setting, kept by all their inputs."""
        for problem, courses in self._kept:
            if problem.is_that_of(at.problem):
                return courses
        found = solve_map(self.pump, at.problem, self.tolerance)
        self._kept.append((at.problem, found))
        return found

    def _near(self, solved: Solved, values: Array, points: BenchPoints) -> Solved:
        """A map beside a solved one: its chambers along the steps of that, or at its pressures."""
        plain = self._setting(values, points)
        courses = cache(lambda: self._moved(solved.plain, solved.plain_courses(), plain))
        return self._complete(
            plain, courses, values, lambda changed: self._moved(solved.setting, solved.courses, changed)
        )

    def _moved(self, before: Setting, courses: Courses, after: Setting) -> Courses:
        """Courses of a setting beside a solved one, those of that where the chambers are the same."""
        if before.problem.is_that_of(after.problem):
            return courses
        if before.problem.differs_in_gaps_alone(after.problem):
            return other_gaps(courses, after.problem)
        if before.problem.has_ports_of(after.problem):
            return beside(self.pump, courses, after.problem, self.tolerance)
        return self._solve(after)

    def _complete(
        self, plain: Setting, courses: Callable[[], Courses], values: Array, solve: Callable[[Setting], Courses]
    ) -> Solved:
        """Laws at the pressures of chambers without them, then chambers with them: leakage moves these little."""
        if not (self.physics or self.own_laws):
            return Solved(plain, courses, plain, courses(), None)
        named = self._named(values)
        laws = (
            *((law, {**own, **named}) for law, own in self.own_laws),
            *((one.law, one.stated(named)) for one in self.physics),
        )
        found = effects_at(plain.pump, plain.point, plain.motion, courses, laws, self.points.hours)
        changed = affected(plain, found.effects)
        return Solved(plain, courses, changed, solve(changed), found)

    def _read(self, solved: Solved, values: Array, points: BenchPoints) -> Array:
        found, named = solved.truth[:, self._columns], self._named(values)
        if self.departures is not None:
            found = found + self.departures @ [
                named.get(f"{FORM}{k + 1}", 0.0) for k in range(self.departures.shape[-1])
            ]
        return read(found, self.channels, points, named, self.drifts)

    def step_of(self, name: str, values: Array) -> float:
        """The step in SI of a slope by the named parameter, away from its nearer bound."""
        index = [parameter.name for parameter in self.parameters].index(name)
        parameter, value = self.parameters[index], float(values[index])
        share = LAW_STEP if parameter.role is Role.EXTENSION else STEP
        if name in LAG_NAMES and value < LAG_FELT * parameter.spread:
            share = LAG_STEP
        step = share * parameter.stretch(parameter.standard(value))
        if parameter.scale is Scale.LOG:
            step = min(step, LOG_STEP * value)
        if parameter.scale is Scale.SQUARE:
            step = min(step, SQUARE_STEP * value)
        return -step if value + step > parameter.upper else step

    def _like(self, **changed: Any) -> LumpedBench:
        """The same bench with some of its arguments changed."""
        names = (
            "pump",
            "points",
            "channels",
            "parameters",
            "physics",
            "inputs",
            "samples_per_pitch",
            "tolerance",
            "departures",
            "drifts",
            "own_laws",
        )
        return LumpedBench(**{name: getattr(self, name) for name in names} | changed)

    def _with(self, parameters: tuple[Parameter, ...], physics: tuple[Extension, ...]) -> LumpedBench:
        new = {parameter.name: parameter for parameter in parameters}
        own = tuple(new.pop(parameter.name, parameter) for parameter in self.parameters)
        bench = self._like(parameters=(*own, *new.values()), physics=physics)
        bench._kept = self._kept
        return bench


def _hold_known(parameters: tuple[Parameter, ...], physics: tuple[Extension, ...]) -> None:
    """Raise InputError for a parameter without effect."""
    laws = {parameter.name for law in physics for parameter in law.free}
    for parameter in parameters:
        if parameter.name not in BASE_NAMES | laws | SENSOR_NAMES and not parameter.name.startswith(FORM):
            raise InputError(
                "bench.parameters", parameter.name, "a parameter of the pump, of its sensors or of a law switched on"
            )
