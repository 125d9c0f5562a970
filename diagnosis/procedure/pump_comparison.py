"""A pump without and with the effects that a diagnosis claims: an operating point of both, lumped and by films."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import fields, replace

import numpy as np

from diagnosis.procedure.compared import (
    NO_COMPARISON,
    WITH,
    WITHOUT,
    Change,
    FilmChange,
    FilmComparison,
    PumpComparison,
)
from diagnosis.procedure.floating_comparison import compare_floating, varied_pump
from diagnosis.recording.units import channel_unit, reading
from diagnosis.report.format import setting_text
from diagnosis.report.tables import added_by_claim
from diagnosis.study.inputs import bench_points
from diagnosis.study.model import Study
from diagnosis.verdict.diagnosis import Diagnosis
from diagnosis.verdict.row_numbers import table_rows
from reynolds.errors import InputError, NotConverged
from system.bench.calibration.extended_pump import calibrated_pump, extended_pump, values_by_name
from system.bench.points import operating_at
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.catalogue.entries import entry_of
from system.effects.effect import EffectId, Kind
from system.effects.friction import OF_GAP
from system.estimation.posterior import values_at
from system.inputs.channels import ChannelName
from system.inputs.units import LPM
from system.points.film_effects import SOLVED
from system.points.films import FilmsPoint, films_point
from system.points.lumped import lumped_point
from system.points.table.film_physics import FilmModel, Parts
from system.pump.assembly import PumpPoint
from system.pump.film_thickness import moved_to
from system.pump.laws.friction_pairs import Pair
from system.pump.operating import OperatingPoint, operating_point
from system.work.progress import Report

OF_FILMS = (*SOLVED, EffectId.FILM_THICKNESS, EffectId.VISCOSITY_GRADE)
"""Effects that change the films themselves."""
POSITIONS, FINER, AGREED = 2, 0.5, 0.05
"""Film angles a piston pitch, times the usual cells, part of the pressure difference to which chambers agree.

For pictures of the fields: closer agreement changes leakage by a thousandth."""
PERCENT = 100.0
SHAFT, HYDRAULIC = "shaft power", "hydraulic power"


def claimed_pump(pump: PumpDescription, found: Diagnosis, films: FilmModel | None = None) -> PumpDescription:
    """The pump with the parameters of the claimed explanation's fit, their sigmas as tolerances, its effects on.

    films: those of a diagnosis by floating films, whose variants change the pump.
    """
    own = pump if films is None else varied_pump(pump, films.task, _parts(found, films))
    return calibrated_pump(own, found.after, found.hypotheses[0].hypothesis.laws)


def compare_pumps(
    pump: PumpDescription, study: Study, found: Diagnosis, report: Report, films: FilmModel | None = None
) -> PumpComparison:
    """Both pumps of the claimed fit, solved at the recorded point where the claim adds most to the readings.

    Without: its effects off, its wrong values as stated, other parameters as fitted. films: floating ones, by which
    both are solved. Nothing is solved without a claim, or for a sensor's fault only.
    """
    if not found.effects:
        return NO_COMPARISON
    if all(entry_of(claim.effect).verdict is Kind.SENSOR_FAULT for claim in found.effects):
        return replace(NO_COMPARISON, text="A meter's fault costs the pump nothing: only the readings are wrong.")
    own, added = found.hypotheses[0].hypothesis, added_by_claim(study, found)
    at = int(np.argmax(np.nansum((added / found.after.whitening.sigma) ** 2, axis=1)))
    number = table_rows(study.recording)[at]
    point = operating_at(pump, bench_points(study.recording, pump)[0], at)
    closed = np.array([parameter.name in own.open_names for parameter in found.after.parameters])
    stated = values_at(found.after.parameters, np.where(closed, 0.0, found.after.xi))
    fitted = {
        WITHOUT: extended_pump(pump, values_by_name(found.after.parameters, stated), ()),
        WITH: claimed_pump(pump, found, films),
    }
    where = f"Point {number}, where the finding adds most: {_setting(point)}."
    if films is not None:
        pumps = {name: _at(each, point) for name, each in fitted.items()}
        by_films = compare_floating(films, pumps, _parts(found, films), report)
        own_points = {name: one.pump_point for name, one in by_films.floating.items()}
        return PumpComparison(pumps, own_points, tuple(_changes(own_points)) if own_points else (), where, by_films)
    try:
        pumps = {name: _at(each, point) for name, each in fitted.items()}
        points = {name: lumped_point(each, operating_point(each)) for name, each in pumps.items()}
    except (NotConverged, InputError) as reason:
        text = f"Point {number}, where the finding adds most, could not be run: {reason}"
        return replace(NO_COMPARISON, text=text)
    by_films = compare_films(pumps, points, {claim.effect for claim in found.effects}, report)
    return PumpComparison(pumps, points, tuple(_changes(points)), where, by_films)


def _parts(found: Diagnosis, films: FilmModel) -> Parts:
    """The parts of the film physics among the claimed effects."""
    return frozenset(claim.effect for claim in found.effects if claim.effect in films.law.single)


def compare_films(
    pumps: Mapping[str, PumpDescription], points: Mapping[str, PumpPoint], found: Collection[EffectId], report: Report
) -> FilmComparison:
    """The films of both pumps at their own operating points, beside their lumped `points`.

    Nothing is solved for effects that do not change the films; the text gives the reason, and the reason why films have
    no solution.
    """
    if not any(effect in OF_FILMS for effect in found):
        return FilmComparison(text="The finding does not act on the films: their fields are unchanged.")
    solved = {}
    try:
        for name, pump in pumps.items():
            solved[name] = films_point(
                pump, operating_point(pump), positions_per_pitch=POSITIONS, finer=FINER, tolerance=AGREED,
                report=_of(report, name),
            )  # fmt: skip
    except (InputError, NotConverged) as reason:
        return FilmComparison(text=f"The films could not be solved: {reason}")
    return FilmComparison(solved, changes=tuple(_film_changes(points, solved)), text=_accuracy(solved))


def _of(report: Report, name: str) -> Report:
    return lambda done, total, what: report(done, total, f"{what} {name} the finding")


def _at(pump: PumpDescription, point: OperatingPoint) -> PumpDescription:
    """The pump with the point as its own operating point, and its film thicknesses there."""
    stated = {
        "speed": point.shaft_speed, "pressure": point.delivery_pressure, "temperature": point.temperature,
        "displacement_ratio": point.displacement_ratio, "inlet_pressure": point.inlet_pressure,
        "case_pressure": point.case_pressure,
    }  # fmt: skip
    return moved_to(pump, replace(pump.operating, **stated))


def _setting(point: OperatingPoint) -> str:
    warm = reading(ChannelName.T_CASE, point.temperature)
    setting = setting_text(point.shaft_speed, point.delivery_pressure, point.displacement_ratio)
    return f"{setting}, case at {warm:.3g} {channel_unit(ChannelName.T_CASE)}"


def _changes(points: Mapping[str, PumpPoint]) -> Iterator[Change]:
    """Quantities that both points have: an efficiency may not be defined."""
    other = {name: value for name, _, value in _numbers(points[WITH])}
    for name, unit, value in _numbers(points[WITHOUT]):
        if name in other:
            yield Change(name, unit, value, other[name])


def _numbers(point: PumpPoint) -> Iterator[tuple[str, str, float]]:
    """(quantity, unit, value) of a point: flows, torque, efficiencies, and the parts of the shaft power."""
    yield "delivery flow", "L/min", LPM * point.bench.delivery_flow
    yield "inlet flow", "L/min", LPM * point.bench.inlet_flow
    yield "case drain", "L/min", LPM * point.bench.drain_flow
    yield "shaft torque", "N m", point.bench.shaft_torque
    efficiency = point.iso_efficiency
    for part in fields(efficiency) if efficiency else ():
        yield f"efficiency, {part.name} (ISO 4409)", "%", PERCENT * getattr(efficiency, part.name)
    power = point.power
    yield SHAFT, "W", power.shaft
    yield HYDRAULIC, "W", power.hydraulic
    yield "compression of the oil", "W", power.elastic
    for gap in Gap:
        yield f"leakage, {_words(gap.value)}", "W", getattr(power.leakage, gap.value)
    yield "throttling in the ports", "W", power.throttling_delivery + power.throttling_suction
    for pair in Pair:
        yield f"friction, {_words(pair.value)}", "W", point.pairs.loss(pair).mean
    yield "effects beside gaps and pairs", "W", power.extended


def _film_changes(points: Mapping[str, PumpPoint], solved: Mapping[str, FilmsPoint]) -> Iterator[FilmChange]:
    """Leakage and shear of each gap by closed laws and by the films."""
    by_films = {name: films.pump_point for name, films in solved.items()}
    for gap, pair in OF_GAP.items():
        leaks = (_leakages(each, gap) for each in (points, by_films))
        yield FilmChange(f"leakage, {_words(gap.value)}", "L/min", *leaks)
        shear = ({name: one.pairs.loss(pair).mean_viscous for name, one in each.items()}
                 for each in (points, by_films))  # fmt: skip
        yield FilmChange(f"shear, {_words(gap.value)}", "W", *shear)


def _leakages(points: Mapping[str, PumpPoint], gap: Gap) -> dict[str, float]:
    return {name: LPM * getattr(one.leakage_flow, gap.value) for name, one in points.items()}


def _accuracy(solved: Mapping[str, FilmsPoint]) -> str:
    films = list(solved.values())
    angles, change = len(films[0].gaps.shaft_angle), max(one.pressure_change for one in films)
    sampled = max(one.sampling_error for one in films)
    return (
        f"Films at the positions of the pump file, {FINER:g} of the usual cells in each direction, {angles} "
        f"shaft angles; chamber pressure changes by {change * 1e-6:.2g} MPa in a further round, leakage by "
        f"{100.0 * sampled:.2g} % with half the angles."
    )


def _words(name: str) -> str:
    return name.replace("_", " ")
