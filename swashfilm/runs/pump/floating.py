"""Floating gaps of a run: fields, summary, part of the page."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from gaps.films.physics import Effect
from gaps.revolution.march import GapRevolution, Leg
from swashfilm.case.gap.physics import PHYSICS_HEAD, effect_rows
from swashfilm.console.fidelity import Fidelity
from swashfilm.output.data.files import RESULTS, add_group, read_netcdf
from swashfilm.output.data.gap_names import TITLES, kind_folder
from swashfilm.output.page import inlined
from swashfilm.output.run_folder import FAILED, write_json
from swashfilm.output.tables import read_csv
from swashfilm.runs.film.revolution.data import (
    revolution_dataset,
    write_convergence,
    write_revolution_fields,
    write_series,
)
from swashfilm.runs.film.revolution.explorer import revolution_explorer
from swashfilm.runs.film.revolution.plots import film_text, revolution_plots
from swashfilm.runs.film.revolution.solve import RevolutionStudy, revolution_summary
from swashfilm.runs.pump.data import GAPS
from swashfilm.runs.pump.scene.blocks import Blocks, ChamberKind, Scene, write_pump
from swashfilm.runs.pump.summary import chamber_numbers, effect_lists, pump_summary
from system.description.assumptions import Assumption
from system.description.gap import Gap
from system.films.heat import all_taken
from system.films.rotor import Rotor
from system.inputs.units import LPM
from system.points.film_effects import effects_in_films
from system.points.floating import FloatingKind, FloatingPoint
from system.points.floating_gaps import FloatingOptions
from system.points.floating_solved import GapsOfKind, Round, Solved, SolvedGap

_OF_PUMP = ("format", "kind", "name", "gap", "physics_left_out", "physics_seconds", "assumptions", "warnings")


SHOWN = ("film", "path", "temperature", "contact", "maps")
SHOWN_UNLIKE = ("film", "path")
CAPTIONS = {
    "film": "film and pressure over the shaft angle, the least film with its place, and the limits of the film",
    "path": "position of the part; the colour is the shaft angle",
    "temperature": "temperature of film and walls",
    "contact": "contact, cavitation and the largest film pressure",
    "maps": "films at some of the kept angles",
}
HEAD = (
    "gap", "mean film", "least film", "leakage", "friction power", "of which contact", "largest contact load",
    "turns solved; disturbance left after a turn",
)  # fmt: skip


@dataclass(frozen=True)
class FloatingGap:
    """One gap of a pump with all gaps floating: a `GapOverTurn`."""

    name: str
    gap: Gap
    rotor: Rotor
    options: FloatingOptions


def floating_studies(found: FloatingPoint) -> dict[str, tuple[RevolutionStudy, ...]]:
    """Return the gaps, each as a separate case, by their path in the run folder.

    Path "": piston and slipper of the most common kind of chamber, and the block; chamber_<number>: piston and
    slipper of every other kind, by the number of its first chamber.
    """
    most, *others = found.kinds
    here = (Gap.PISTON, most.gaps.piston), (Gap.SLIPPER, most.gaps.slipper), (Gap.VALVE_PLATE, most.gaps.block)
    studies = {"": tuple(_study_of(found, most, *gap) for gap in here)}
    for kind in others:
        own = (Gap.PISTON, kind.gaps.piston), (Gap.SLIPPER, kind.gaps.slipper)
        studies[kind_folder(kind.chambers)] = tuple(_study_of(found, kind, *gap) for gap in own)
    return studies


def _study_of(found: FloatingPoint, kind: FloatingKind, gap: Gap, revolution: GapRevolution[Any]) -> RevolutionStudy:
    of = GapsOfKind(kind.chambers, kind.rotor, kind.parts, kind.drives)
    options = replace(found.options, physics=getattr(kind.physics, gap.value))
    return _study(found.pump.name, SolvedGap(gap, of, options, revolution, len(found.rounds)))


def _study(name: str, solved: SolvedGap) -> RevolutionStudy:
    """Return a gap of a pump of that name as a separate case."""
    of, revolution = solved.of, solved.revolution
    chamber = of.drives.piston.chamber_pressure
    return RevolutionStudy(
        FloatingGap(name, solved.gap, of.rotor, solved.options),
        of.parts,
        revolution,
        np.array([float(chamber(angle)) for angle in revolution.angles]),
        revolution.seconds,
    )


def floating_summary(found: FloatingPoint, warnings: list[str]) -> dict[str, Any]:
    """Return the summary of the point with those of its gaps, the agreement of gaps and chambers, assumptions.

    `warnings` come before those of the gaps. Key `unlike`: gaps of chambers of the less common kinds.
    """
    studies = floating_studies(found)
    by_place = {
        place: {study.case.gap.value: revolution_summary(study) for study in own} for place, own in studies.items()
    }
    texts = warnings + [
        f"{one['name']}: {' '.join(filter(None, (place, gap))).replace('_', ' ')}: {one['text']}"
        for place, gaps in by_place.items()
        for gap, own in gaps.items()
        for one in own["warnings"]
    ]
    here, *others = (
        {gap: {key: own[key] for key in own if key not in _OF_PUMP} for gap, own in gaps.items()}
        for gaps in by_place.values()
    )
    summary, last = pump_summary(found.pump, found.pump_point, None, texts), found.rounds[-1]
    at, spent = found.kinds[0].rotor, {leg: sum(one.spent[leg] for one in found.rounds) for leg in Leg}
    physics = [getattr(found.kinds[0].physics, gap.value) for gap in Gap]
    checks = {
        "coupling_rounds": len(found.rounds),
        "coupling_pressure_change": last.pressure_change,
        "coupling_friction_change": last.friction_change,
        "coupling_spin_change": last.spin_change,
        "films_solved": sum(one.films_solved for one in found.rounds),
    }
    return summary | {
        "fidelity": Fidelity.FLOATING.value,
        "physics": effect_lists(*effects_in_films(found.pump, floating=True)),
        "gaps": here,
        "spin_ratio": {part: spin / at.point.shaft_speed for part, spin in asdict(at.spins).items()},
        "unlike": {
            kind_folder(kind.chambers): {"chambers": [k + 1 for k in kind.chambers], "gaps": gaps}
            for kind, gaps in zip(found.kinds[1:], others, strict=True)
        },
        "checks": summary["checks"] | checks,
        "cost": {
            "solve_seconds": sum(one.seconds for one in found.rounds),
            "rounds_seconds": [one.seconds for one in found.rounds],
            "physics_seconds": {leg.value: time for leg, time in spent.items() if time > 0.0},
        },
        "physics_left_out": [effect.value for effect in Effect if all(effect in of.left_out for of in physics)],
        "assumptions": list(dict.fromkeys(str(one) for kind in found.kinds for one in _taken(kind))),
    }


def _taken(kind: FloatingKind) -> tuple[Assumption, ...]:
    """Assumptions of a kind's films, those of heat only with solved temperature."""
    warm = next((one for one in (getattr(kind.physics, gap.value) for gap in Gap) if one.heat), kind.physics.piston)
    return all_taken(kind.rotor, kind.parts, warm)


def write_floating(folder: Path, found: FloatingPoint) -> tuple[Blocks, ...]:
    """Write <gap>.csv, <gap>_convergence.csv, a group <gap> of results.nc, fields/, and PVDs of gaps and pump.

    results.nc must exist with the pump's series. A gap's PVD follows one piston or slipper over the turn, or the
    block over one period. Chambers of the less common kinds have the same files in chamber_<number>. Returns the
    blocks of the whole pump at each angle (`write_pump`).
    """
    for place, studies in floating_studies(found).items():
        for study in studies:
            _write_gap(folder, Path(place) / study.case.gap.value, study)
            write_revolution_fields(folder / place, study)
    return write_pump(folder, scene_of(found))


def scene_of(found: FloatingPoint) -> Scene:
    """Return the pump over the turn, at the angles whose films are kept."""
    (first, *others), block = found.kinds, found.kinds[0].gaps.block
    if not others:
        first = replace(first, chambers=tuple(range(found.pump.pump.pistons)))
    kinds = _chambers(first, ""), *(_chambers(kind, kind_folder(kind.chambers)) for kind in others)
    return Scene(kinds, np.array(list(block.turn.films)), float(block.angles[-1]))


def _chambers(kind: FloatingKind, place: str) -> ChamberKind:
    """Return the chambers of a kind with the shaft angles of their kept films."""
    pressure = kind.drives.piston.chamber_pressure
    piston, slipper = (np.array(list(gap.turn.films)) for gap in (kind.gaps.piston, kind.gaps.slipper))
    return ChamberKind(
        place, kind.chambers, kind.rotor, kind.parts, piston, slipper, lambda angle: float(pressure(angle))
    )


def _write_gap(folder: Path, path: Path, study: RevolutionStudy) -> None:
    """Write series, kept films and turns of one gap to folder/path and its group of results.nc."""
    data = revolution_dataset(study)
    add_group(data, folder / RESULTS, path.as_posix())
    (folder / path.parent).mkdir(exist_ok=True)
    write_series(folder / f"{path}.csv", data)
    write_convergence(folder / f"{path}_convergence.csv", study)


def write_unfinished(folder: Path, name: str, solved: Solved, reason: BaseException) -> None:
    """Write the solved part of a point that stopped: failed.json, and of each gap its CSVs and group of results.nc.

    failed.json: `state` (failed, or interrupted by Ctrl-C), `error`, the complete `rounds`, and `gaps` with the
    number of the round that solved them and their summary.
    """
    gaps = {}
    for (kind, gap), one in solved.gaps.items():
        path = Path(kind_folder(one.of.chambers) if kind else "") / gap.value
        study = _study(name, one)
        _write_gap(folder, path, study)
        gaps[path.as_posix()] = {"round": one.number} | revolution_summary(study)
    stopped = isinstance(reason, KeyboardInterrupt)
    failed = {
        "format": 1,
        "kind": "pump_unfinished",
        "name": name,
        "state": "interrupted" if stopped else "failed",
        "error": "interrupted" if stopped else f"{reason}",
        "rounds": [_round(one) for one in solved.rounds],
        "gaps": gaps,
    }
    write_json(folder / FAILED, failed)


def _round(one: Round) -> dict[str, Any]:
    spent = {leg.value: time for leg, time in one.spent.items() if time > 0.0}
    return {
        "pressure_change": one.pressure_change,
        "friction_change": one.friction_change,
        "spin_change": one.spin_change,
        "settled": one.settled,
        "films_solved": one.films_solved,
        "seconds": one.seconds,
        "physics_seconds": spent,
    }


def floating_view(folder: Path, summary: Mapping[str, Any]) -> dict[str, Any]:
    """Return the floating gaps for the template: rows with their head, pictures with captions, turns."""
    pictures = []
    shown: list[tuple[str, str, tuple[str, ...]]] = [(gap, TITLES[gap], SHOWN) for gap in GAPS]
    for place, kind in summary["unlike"].items():
        shown += [(f"{place}/{gap}", f"{TITLES[gap]}, {chamber_numbers(kind)}", SHOWN_UNLIKE) for gap in kind["gaps"]]
    for group, title, names in shown:
        data = read_netcdf(folder / RESULTS, group)
        drawn, explorers = revolution_plots(data), {"maps": revolution_explorer(data)}
        pictures += [
            (inlined(drawn[name], explorers.get(name)), f"{title}: {CAPTIONS[name]}") for name in names if name in drawn
        ]
    turns = {TITLES[gap]: read_csv(folder / f"{gap}_convergence.csv") for gap in GAPS}
    return {
        "head": HEAD, "rows": floating_rows(summary), "backward": backward(summary),
        "pictures": pictures, "turns": turns, "physics_head": PHYSICS_HEAD,
        "physics": effect_rows(summary["physics_left_out"], summary["cost"]["physics_seconds"]),
    }  # fmt: skip


def backward(summary: Mapping[str, Any]) -> list[str]:
    """Return the names of the gaps into which on balance oil flows from the case."""
    return [TITLES[gap] for gap, of in summary["gaps"].items() if of["leakage_flow_m3_per_s"] < 0.0]


def floating_rows(summary: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Return a row per gap: films, leakage, friction, contact, convergence; then those of differing chambers.

    Of pistons and slippers it is one, where the tables of the whole pump have the sum of all.
    """
    named = [(_one(gap), of) for gap, of in summary["gaps"].items()]
    for kind in summary["unlike"].values():
        named += [(f"{_one(gap)}, {chamber_numbers(kind)}", of) for gap, of in kind["gaps"].items()]
    return [
        (
            name,
            f"{of['film_thickness_mean_m'] * 1e6:.2f} um",
            f"{film_text(of['film_thickness_min_m'] * 1e6)} at {of['film_thickness_min_at_deg']:.0f} deg",
            f"{of['leakage_flow_m3_per_s'] * LPM:.4f} L/min",
            f"{of['friction_power_W']:.1f} W",
            f"{of['rubbing_power_W']:.1f} W",
            f"{of['contact_load_max_N']:.0f} N",
            f"{of['turns']}; {100.0 * of['largest_multiplier']:.2g} %",
        )
        for name, of in named
    ]


def _one(gap: str) -> str:
    """Return the name of a gap whose numbers are those of one part: `one piston-cylinder`; the block is one."""
    return TITLES[gap] if gap == Gap.VALVE_PLATE.value else f"one {TITLES[gap]}"
