"""A pump whose gaps float, as a run leaves it: summary, tables, results and fields of the three gaps."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gaps.revolution import GapRevolution
from reynolds.export import write_pvd
from swashfilm.fidelity import Fidelity
from swashfilm.pump_data import PICTURED_TURN
from swashfilm.pump_fields import FIELDS, vtu_name
from swashfilm.pump_summary import pump_summary
from swashfilm.revolution_data import revolution_dataset, write_convergence, write_series
from swashfilm.revolution_fields import write_revolution_fields
from swashfilm.revolution_study import RevolutionStudy, revolution_summary
from system.floating import FloatingPoint
from system.floating_gaps import FloatingOptions
from system.floating_heat import all_taken
from system.instants import Rotor
from system.pump_gap import Gap

RESULTS = "results.nc"
_OF_PUMP = ("format", "kind", "name", "gap", "physics_left_out", "assumptions", "warnings")


@dataclass(frozen=True)
class FloatingGap:
    """One gap of a pump that floats as a whole: a `GapCase`."""

    name: str
    gap: Gap
    rotor: Rotor
    options: FloatingOptions


def floating_studies(found: FloatingPoint) -> tuple[RevolutionStudy, ...]:
    """The three gaps, each as if it were a case of its own."""
    gaps: dict[Gap, GapRevolution[Any]] = {
        Gap.PISTON: found.gaps.piston, Gap.SLIPPER: found.gaps.slipper, Gap.VALVE_PLATE: found.gaps.block,
    }  # fmt: skip
    chamber, name = found.drives.piston.chamber_pressure, found.rotor.pump.name
    return tuple(
        RevolutionStudy(
            FloatingGap(name, gap, found.rotor, found.options),
            found.parts,
            revolution,
            np.array([float(chamber(angle)) for angle in revolution.angles]),
            revolution.seconds,
        )
        for gap, revolution in gaps.items()
    )


def floating_summary(found: FloatingPoint, warnings: list[str]) -> dict[str, Any]:
    """The summary of any fidelity's point with the gaps' own, how gaps and chambers agreed, and what was taken.

    `warnings` come before those of the gaps.
    """
    gaps = {study.case.gap.value: revolution_summary(study) for study in floating_studies(found)}
    told = warnings + [
        f"{one['name']}: {gap.replace('_', ' ')}: {one['text']}"
        for gap, own in gaps.items()
        for one in own["warnings"]
    ]
    summary, last = pump_summary(found.rotor.pump, found.pump_point, None, told), found.rounds[-1]
    checks = {
        "coupling_rounds": len(found.rounds),
        "coupling_pressure_change": last.pressure_change,
        "coupling_friction_change": last.friction_change,
        "films_solved": sum(taken.films_solved for taken in found.rounds),
    }
    return summary | {
        "fidelity": Fidelity.FLOATING.value,
        "gaps": {gap: {key: own[key] for key in own if key not in _OF_PUMP} for gap, own in gaps.items()},
        "checks": summary["checks"] | checks,
        "cost": {
            "solve_seconds": sum(taken.seconds for taken in found.rounds),
            "rounds_seconds": [taken.seconds for taken in found.rounds],
        },
        "physics_left_out": [effect.value for effect in found.options.physics.left_out],
        "assumptions": list(map(str, all_taken(found.rotor, found.parts, found.options.physics))),
    }


def write_floating(folder: Path, found: FloatingPoint) -> dict[Path, list[Path]]:
    """Write <gap>.csv, <gap>_convergence.csv, a group <gap> of results.nc, fields/ and PVDs; tell what to draw.

    results.nc must be there with the pump's own series. A gap's PVD follows one piston or slipper over the turn,
    or the block over what repeats; pump.pvd shows all of them. What to draw: a picture, and the fields on it.
    """
    studies = floating_studies(found)
    for study in studies:
        data, gap = revolution_dataset(study), study.case.gap.value
        data.to_netcdf(folder / RESULTS, mode="a", group=gap, engine="h5netcdf")
        write_series(folder / f"{gap}.csv", data)
        write_convergence(folder / f"{gap}_convergence.csv", study)
        write_revolution_fields(folder, study)
    kept = {study.case.gap.value: np.array(list(study.revolution.turn.films)) for study in studies}
    pistons = found.rotor.pump.pump.pistons
    whole = [
        (float(np.degrees(angle)), part, path)
        for angle in kept["piston"]
        for part, path in enumerate(_in_pump(kept, float(angle), pistons))
    ]
    write_pvd(folder / "pump.pvd", whole)
    pictured = 2.0 * np.pi * PICTURED_TURN
    drawings = {folder / f"{gap}.png": [folder / _nearest(gap, angles, pictured)] for gap, angles in kept.items()}
    drawings[folder / "pump.png"] = [folder / path for path in _in_pump(kept, pictured, pistons)]
    return drawings


def _in_pump(kept: dict[str, np.ndarray], shaft_angle: float, pistons: int) -> list[str]:
    """Fields of the block and of all pistons and slippers at a shaft angle (rad), the nearest that are kept."""
    chambers = shaft_angle + 2.0 * np.pi / pistons * np.arange(pistons)
    return [
        _nearest("valve_plate", kept["valve_plate"], shaft_angle),
        *(_nearest(gap, kept[gap], angle) for gap in ("piston", "slipper") for angle in chambers),
    ]


def _nearest(gap: str, angles: np.ndarray, angle: float) -> str:
    """Field of a gap at the kept angle nearest to one, all repeating after the last."""
    away = (angles - angle + 0.5 * angles[-1]) % angles[-1] - 0.5 * angles[-1]
    return f"{FIELDS}/{vtu_name(gap, int(np.argmin(np.abs(away))))}"
