"""What a finding means for the pump: one point run without it and with it, two run folders and what changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from shutil import rmtree
from typing import Any

import numpy as np

from diagnosis.recording.units import channel_unit, reading
from diagnosis.report.tables import Row, added_by_claim
from diagnosis.study.inputs import bench_points
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.diagnosis import Diagnosis
from diagnosis.verdict.row_numbers import table_rows
from reynolds.errors import FilmInputError
from swashfilm.console.fidelity import Fidelity
from swashfilm.runs.diagnose.films import FilmsTold, films_of_both
from swashfilm.runs.pump.run import PumpCase, solve_pump
from system.bench.calibration.extended_pump import extended_pump, values_by_name
from system.bench.points import operating_at
from system.description.pump import PumpDescription
from system.effects.catalogue.entries import entry_of
from system.effects.effect import Kind
from system.estimation.posterior import values_at
from system.inputs.channels import ChannelName
from system.inputs.errors import NotConverged
from system.inputs.units import LPM
from system.pump.film_thickness import moved_to
from system.pump.operating import OperatingPoint
from system.pump_file.file import resolved_toml
from system.work.progress import Report

WITHOUT, WITH = "without", "with"
"""Run folders within the diagnosis's own."""
SHAFT, HYDRAULIC = "shaft power", "hydraulic power"
PERCENT = 100.0


NO_FILMS = FilmsTold((), "")


@dataclass(frozen=True)
class Told:
    """What the two runs came to: rows of changes.csv; where they stand, or why there are none; their films."""

    rows: tuple[Row, ...]
    text: str
    films: FilmsTold = NO_FILMS


NOTHING = Told((), "")


def claimed_pump(pump: PumpDescription, found: Diagnosis) -> PumpDescription:
    """The pump as the claimed explanation has it: its fit's parameters, its effects switched on."""
    return extended_pump(
        pump, values_by_name(found.after.parameters, found.after.values), found.hypotheses[0].hypothesis.laws
    )


def run_both(
    folder: Path, pump: PumpDescription, study: Study, found: Diagnosis, thresholds: Thresholds, report: Report
) -> Told:
    """Fill `without/` and `with/`: the pump of the claimed fit at the recorded point where the finding adds most.

    Without: its effects off, its wrong values as stated, all else as fitted. Nothing is run where nothing is
    claimed, or a sensor's fault only.
    """
    if not found.effects:
        return NOTHING
    if all(entry_of(claim.effect).verdict is Kind.SENSOR_FAULT for claim in found.effects):
        return replace(NOTHING, text="A sensor's fault changes nothing in the pump.")
    own, added = found.hypotheses[0].hypothesis, added_by_claim(study, found, thresholds)
    at = int(np.argmax(np.nansum((added / found.after.whitening.sigma) ** 2, axis=1)))
    number = table_rows(study.recording)[at]
    point = operating_at(pump, bench_points(study.recording, pump)[0], at)
    closed = np.array([parameter.name in own.open_names for parameter in found.after.parameters])
    stated = values_at(found.after.parameters, np.where(closed, 0.0, found.after.xi))
    fitted = {
        WITHOUT: extended_pump(pump, values_by_name(found.after.parameters, stated), ()),
        WITH: claimed_pump(pump, found),
    }
    try:
        pumps = {name: _at(each, point) for name, each in fitted.items()}
        summaries = {name: _run(each, folder / name, report) for name, each in pumps.items()}
    except (NotConverged, FilmInputError) as reason:
        for name in fitted:
            rmtree(folder / name, ignore_errors=True)
        return Told((), f"Point {number}, where the finding adds most, could not be run: {reason}")
    films = films_of_both(folder, pumps, summaries, {claim.effect for claim in found.effects}, report)
    where = f"Point {number}, where the finding adds most: {_setting(point)}."
    return Told(tuple(_changes(*summaries.values())), where, films)


def _run(pump: PumpDescription, folder: Path, report: Report) -> dict[str, Any]:
    folder.mkdir()
    found = solve_pump(PumpCase(pump, resolved_toml(pump), Fidelity.LUMPED), report)
    found.write(folder)
    return dict(found.summary)


def _at(pump: PumpDescription, point: OperatingPoint) -> PumpDescription:
    """The pump with the point as its own, its films as thick as they are there."""
    stated = {
        "speed": point.shaft_speed, "pressure": point.delivery_pressure, "temperature": point.temperature,
        "displacement_ratio": point.displacement_ratio, "inlet_pressure": point.inlet_pressure,
        "case_pressure": point.case_pressure,
    }  # fmt: skip
    return moved_to(pump, pump.operating.model_copy(update=stated))


def _setting(point: OperatingPoint) -> str:
    speed = reading(ChannelName.SPEED, point.shaft_speed)
    pressure = reading(ChannelName.P_OUT, point.delivery_pressure)
    warm = reading(ChannelName.T_CASE, point.temperature)
    return (
        f"{speed:.4g} {channel_unit(ChannelName.SPEED)}, {pressure:.4g} {channel_unit(ChannelName.P_OUT)}, "
        f"displacement ratio {point.displacement_ratio:.3g}, case at {warm:.3g} {channel_unit(ChannelName.T_CASE)}"
    )


def _changes(without: Mapping[str, Any], found: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of quantity, unit, without, with, change: of what both have, since efficiencies may not be defined."""
    other = {name: value for name, _, value in _numbers(found)}
    for name, unit, value in _numbers(without):
        if name not in other:
            continue
        yield {
            "quantity": name, "unit": unit, WITHOUT: f"{value:.6g}", WITH: f"{other[name]:.6g}",
            "change": f"{other[name] - value:.3g}",
        }  # fmt: skip


def _numbers(summary: Mapping[str, Any]) -> Iterator[tuple[str, str, float]]:
    """(quantity, unit, value) of a run: flows, torque, efficiencies, and where the shaft power goes."""
    for name, words in (("delivery", "delivery flow"), ("inlet", "inlet flow"), ("case", "case drain")):
        yield words, "L/min", LPM * summary["flow"][f"{name}_m3_per_s"]
    yield "shaft torque", "N m", summary["torque"]["shaft_Nm"]
    for name, share in summary["efficiency"]["iso_4409"].items():
        if share is not None:
            yield f"efficiency, {name} (ISO 4409)", "%", PERCENT * share
    power = summary["power_balance"]
    yield SHAFT, "W", power["shaft_W"]
    yield HYDRAULIC, "W", power["hydraulic_W"]
    yield "compression of the oil", "W", power["elastic_W"]
    for name in ("piston", "slipper", "valve_plate"):
        yield f"leakage, {name.replace('_', ' ')}", "W", power[f"leakage_{name}_W"]
    yield "throttling in the ports", "W", power["throttling_delivery_W"] + power["throttling_suction_W"]
    for name, loss in summary["pair_loss"].items():
        yield f"friction, {name.replace('_', ' ')}", "W", loss["total_W"]
    yield "effects beside gaps and pairs", "W", power["extended_W"]
