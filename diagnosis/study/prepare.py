"""From a pump and a recording to the study of both."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from diagnosis.checks.check import too_rough, understated
from diagnosis.recording.model import DataNote, NoteKind, Recording
from diagnosis.recording.series.quasi_steady import THERMOMETER
from diagnosis.study.drift_course import course_departures, drift_courses, drift_parameters
from diagnosis.study.felt import felt
from diagnosis.study.films.noise import BALANCED_NAMES, table_noise
from diagnosis.study.inputs import assumed_parameters, bench_points, complete, in_time, measured
from diagnosis.study.map_axes import scaled_axes, smooth_shapes
from diagnosis.study.model import Study, study_of
from diagnosis.study.noise_correlation import noise_correlation, noise_excess, stated_scatter
from diagnosis.study.readings import observations
from diagnosis.study.scaled.null_place import null_place
from diagnosis.study.traces.bench import traced_bench
from diagnosis.study.traces.misfits import port_events, trace_misfits, trace_parameters
from diagnosis.thresholds import FormLimits, Thresholds
from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.bench.components import LEAKAGE
from system.bench.departures import departures
from system.bench.outputs import METERED, SIMULATED, shear_torques
from system.bench.parameters import base_parameters
from system.bench.sensors import LAG_NAMES, drift_parameter, lag_parameter, sensor_parameters, thermometer_parameter
from system.bench.simulator import LumpedBench
from system.description.pump import PumpDescription
from system.description.tolerances import Tolerances
from system.effects.catalogue.entries import CATALOGUE
from system.effects.extension import Entry
from system.estimation.observations import Observations
from system.estimation.parameters import Parameter
from system.estimation.posterior import values_at
from system.inputs.channels import INPUTS, OUTPUTS, ChannelName
from system.inputs.units import TURN
from system.points.table.film_physics import FilmModel

LEAST_ACROSS = 1e6  # Pa
LAG = 1.0  # s, one sigma of a flow meter's lag if not stated
UNTOLD, TOLD = 20.0, 0.3  # one sigma of the thermometer's lag if not stated (s), and over a stated one


def prepare(
    pump: PumpDescription,
    recording: Recording,
    tolerances: Tolerances,
    thresholds: Thresholds,
    catalogue: tuple[Entry, ...] = CATALOGUE,
    scant: bool = False,
    films: FilmModel | None = None,
) -> Study:
    """The study of a recording of a pump, by the lumped fidelity, with the whole catalogue as candidates.

    films: solved ones in place of the lumped law's; physics that they leave out are candidates of the catalogue, and
    the error of their tables is noise of the readings.

    Chamber traces are readings like the steady ones, some tens of numbers each (`TracedBench`). Inputs that the
    recording lacks are assumed, with notes in the study's recording. Raises InputError for a recording without
    a simulated output, NotConverged where a point cannot be simulated.
    """
    usable = in_time(complete(recording))
    channels, inputs = measured(usable, METERED), measured(usable, INPUTS)
    if not channels:
        names = ", ".join(channel.value for channel in SIMULATED)
        raise InputError("recording", "none of the simulated outputs", f"at least one of {names}")
    points, taken = bench_points(usable, pump)
    meters = meter_parameters(usable, channels)
    usable = replace(usable, notes=(*usable.notes, *taken, *_unused_notes(usable), *_lag_notes(usable, meters)))
    parameters = (
        *uncertain_parameters(pump, tolerances, films), *meters,
        *assumed_parameters(usable, pump), *trace_parameters(usable),
    )  # fmt: skip
    bench = LumpedBench(
        pump, points, channels, parameters, inputs=inputs, own_laws=None if films is None else films.own_laws(pump)
    )
    found, axes = observations(usable, channels, inputs), scaled_axes(usable)
    if films is not None:
        found = replace(found, sigma=np.hypot(found.sigma, table_noise(bench, films)))
    if scant:
        bench = _of_another_make(bench, axes, found.sigma, thresholds.form)
    traces = usable.channel(ChannelName.P_CHAMBER) if usable.traces else None
    bare = study_of(usable, bench, found, axes, (), thresholds)
    about = null_place(bare, thresholds) if scant else {}
    bare = study_of(usable, bench, found, axes, (), thresholds, about) if about else bare
    wider, told = _wider_noise(bare, thresholds)
    usable = replace(usable, notes=(*usable.notes, *told))
    found = replace(found, sigma=found.sigma * wider)
    bare = study_of(usable, bench, found, axes, (), thresholds, about) if np.any(wider > 1.0) else bare
    memory = () if found.correlation else noise_correlation(bare, thresholds.mismatch)
    if memory:
        text = f"residuals persist from point to point: noise is assumed correlated by {memory[0]:.2f} in the order"
        usable = replace(usable, notes=(*usable.notes, DataNote(NoteKind.NOTED, None, (), text)))
        found = replace(found, memory=memory)
    if traces:
        traced = traced_bench(bench, usable.traces, traces)
        study = study_of(usable, traced, traced.observations(found), axes, catalogue, thresholds, about)
        study = replace(study, traces=trace_misfits(traced, traces, thresholds.mismatch.pull))
    else:
        study = _of_points(replace(bare, recording=usable), bench, found, catalogue, thresholds)
    return replace(study, events=port_events(pump), scant=scant)


def _of_points(
    bare: Study, bench: LumpedBench, found: Observations, catalogue: tuple[Entry, ...], thresholds: Thresholds
) -> Study:
    """The study of a recording without traces: drifts with courses of their own, and the parameters with influence."""
    courses = drift_courses(bare, thresholds)
    shapes = {channel: course / np.abs(course).max() for channel, course in courses.items()}
    bench = bench.only(felt(bare, thresholds)).with_drifts(shapes, drift_parameters(bare, courses))
    bench = bench.with_departures(course_departures(bare, courses, thresholds.form.drift)) if courses else bench
    usable, about = bare.recording, bare.about
    usable = replace(usable, notes=(*usable.notes, *_drift_notes(courses, usable)))
    if about:  # parameters that are left out had values of their own
        about = null_place(study_of(usable, bench, found, bare.axes, (), thresholds, about), thresholds)
    return study_of(usable, bench, found, bare.axes, catalogue, thresholds, about)


def uncertain_parameters(
    pump: PumpDescription, tolerances: Tolerances, films: FilmModel | None = None
) -> tuple[Parameter, ...]:
    """The pump's uncertain parameters; of films in balance of forces, those that are no results."""
    found = base_parameters(pump, tolerances)
    return found if films is None else tuple(one for one in found if one.name not in BALANCED_NAMES)


def _unused_notes(recording: Recording) -> Iterator[DataNote]:
    """A note on each output that is recorded and not simulated."""
    for name in measured(recording, OUTPUTS):
        if name not in METERED:
            text = f"{name.value} is recorded, but the simulation does not give it"
            yield DataNote(NoteKind.NOTED, name, (), text)


def _lag_notes(recording: Recording, meters: tuple[Parameter, ...]) -> Iterator[DataNote]:
    """A note on points of which no lag is reckoned, as no time has passed since the point before."""
    at_once = np.flatnonzero(np.diff(recording.steady.hours) == 0.0)
    for one in meters:
        if one.name in LAG_NAMES and at_once.size:
            text = f"{at_once.size} points have the time of the one before: no lag is reckoned of them"
            yield DataNote(NoteKind.NOTED, ChannelName.named(one.name.removesuffix(".lag")), (), text)


def _wider_noise(bare: Study, thresholds: Thresholds) -> tuple[Array, tuple[DataNote, ...]]:
    """Factors (C,) of the channels' noise, at least 1, by the scatter of the readings, with notes that tell it.

    The noise of a series is an estimate, which each channel's scatter corrects; that of points is stated, and corrected
    where all channels contradict it.
    """
    limits = thresholds.mismatch
    if bare.observations.correlation:
        excess = noise_excess(bare, limits)
        return excess, tuple(_excess_notes(bare.channels, excess, limits.told_excess))
    sizes = stated_scatter(bare, limits)
    usual = np.nanmedian(np.where(bare.observations.measured, bare.observations.sigma, np.nan), axis=0)
    scatter = {one: float(size) for one, size in zip(bare.channels, sizes, strict=True) if size > 0.0}
    told = tuple(too_rough(scatter, dict(zip(bare.channels, usual.tolist(), strict=True))))
    return np.maximum(sizes, 1.0) if understated(scatter) else np.ones_like(sizes), told


def _excess_notes(channels: tuple[ChannelName, ...], excess: Array, least: float) -> Iterator[DataNote]:
    """A note on each channel whose means scatter clearly more than their samples' noise predicts."""
    for channel, factor in zip(channels, excess, strict=True):
        if factor > least:
            text = f"the points scatter {factor:.2g} times as much as the samples' noise allows: this scatter is used"
            yield DataNote(NoteKind.NOTED, channel, (), text)


def _drift_notes(courses: Mapping[ChannelName, Array], recording: Recording) -> Iterator[DataNote]:
    """A note on each meter whose drift has a course of its own."""
    for channel, course in courses.items():
        hours = recording.steady.hours[int(np.argmax(np.abs(course)))]
        text = f"{channel.value} departs smoothly in time, most at {60.0 * hours:.0f} min; no law of the inputs does so"
        yield DataNote(NoteKind.NOTED, channel, (), text)


def _of_another_make(bench: LumpedBench, axes: Array, sigma: Array, form: FormLimits) -> LumpedBench:
    """The bench with departures of its leakage and friction from the simulation's laws.

    Leakage departs by smooth factors and a power of the pressure. While ports change, chambers leak into the case oil
    that delivery does not lack: a share of the drain by itself, and one from the chamber's peaks. Ports return more or
    less of the energy that oil in the dead volumes holds, and films shear over areas that leakage does not determine:
    both change torque alone.
    """
    centre = values_at(bench.parameters, np.zeros(len(bench.parameters)))
    across = np.maximum(bench.points.p_out - bench.points.p_case, LEAST_ACROSS)
    first, second = np.split(smooth_shapes(axes)[:, 1:], [axes.shape[1]], axis=1)
    shapes = np.column_stack([first, form.bent * second, np.log(across / np.median(across))])
    of_ports = np.column_stack([np.full_like(across, form.of_ports), form.peaks / across])
    parts = bench.components(centre)
    is_drain, is_torque = (
        np.array([name is one for name in bench.channels]) for one in (ChannelName.Q_CASE, ChannelName.TORQUE)
    )
    drained = np.sum([parts[part] for part in LEAKAGE], axis=0) * is_drain
    of_torque = np.column_stack(
        [form.recovered * _stored(bench) / TURN, form.sheared * shear_torques(bench.solved(centre))]
    )
    apart = np.dstack([drained[:, :, None] * of_ports[:, None, :], of_torque[:, None, :] * is_torque[:, None]])
    return bench.with_departures(departures(parts, shapes, sigma, form.other_make, apart))


def _stored(bench: LumpedBench) -> Array:
    """Energy (N,) in J that oil in all dead volumes holds at delivery pressure: z V_d dp^2/(2 K), once a turn."""
    pump, across = bench.pump, bench.points.p_out - bench.points.p_in
    return np.asarray(pump.pump.pistons * pump.pump.dead_volume * across**2 / (2.0 * pump.oil.bulk_modulus))


def meter_parameters(recording: Recording, channels: tuple[ChannelName, ...]) -> tuple[Parameter, ...]:
    """Calibrations of outputs and inputs; the drain meter may drift by its zero's sigma, flow meters and the case's
    thermometer lag."""
    known = [channel for channel in recording.channels if channel.name in (*channels, *INPUTS)]
    found = list(sensor_parameters(known))
    drain = recording.channel(ChannelName.Q_CASE)
    if drain is not None and drain.name in channels and drain.zero_sigma > 0:
        found.append(drift_parameter(drain.name, drain.zero_sigma))
    delivery, steady = recording.channel(ChannelName.Q_OUT), recording.steady
    in_time = np.all(np.isfinite(steady.hours)) and np.isnan(steady.errors).all()  # quasi-steady points have no lag
    if delivery is not None and delivery.name in channels and in_time:
        found.append(lag_parameter(delivery.name, delivery.lag or LAG))
    case = recording.channel(ChannelName.T_CASE)
    if case is not None and steady.warming is not None:
        found.append(thermometer_parameter(case.lag or THERMOMETER, TOLD * case.lag or UNTOLD))
    return tuple(found)
