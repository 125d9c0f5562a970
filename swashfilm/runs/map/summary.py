"""Summary of an operating map, summary.json: plan, solved points, best points, displacement, errors."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.formats.versions import headed
from system.description.pump import PumpDescription
from system.films.cycle import PLAIN
from system.films.parts import floating_parts
from system.films.rotor import rotor
from system.maps.data import Best, MapData, best_points, toet_notes, warning_counts
from system.maps.interpolation import MapError
from system.maps.plan import MapAxis, MapInput, MapPlan, point_words, reading_levels
from system.maps.point import LumpedSolver, MapWork, TableSolver
from system.points.film_effects import effects_in_films, film_effects
from system.pump.operating import OperatingPoint, operating_point
from system.pump_file.file import check_pump
from system.work.kept_results import KeptOutcomes
from system.work.tasks import PartOutcome, PartStatus


def map_summary(
    plan: MapPlan,
    work: MapWork,
    data: MapData,
    kept: KeptOutcomes,
    error: MapError | None,
    fresh: Sequence[OperatingPoint],
) -> dict[str, Any]:
    """Return the summary of a map; `kept` holds the outcomes of its points, then those of the `fresh` ones."""
    outcomes, checked = kept.outcomes[: len(plan.points)], kept.outcomes[len(plan.points) :]
    solved = [outcome for outcome in outcomes if outcome.status is PartStatus.SOLVED]
    return {
        **headed("map"),
        "name": plan.pump.name,
        "solver": work.solver.words,
        "stated": dict(work.solver.stated),
        "axes": [_axis(axis) for axis in plan.axes],
        "points": len(outcomes),
        "solved": len(solved),
        "kept": kept.known,
        "checked": len(checked),
        "failed": [
            {"at": point_words(point), "status": outcome.status.value, "reason": outcome.reason}
            for point, outcome in zip(plan.points, outcomes, strict=True)
            if outcome.status is not PartStatus.SOLVED
        ],
        "best": [_best(data, best) for best in best_points(data)],
        "displacement": list(_displacements(data)),
        "displacement_notes": list(toet_notes(data)),
        "loss": _span(data.loss),
        "energy_balance_error_max": _largest(data.values["energy_balance_error"]),
        "interpolation": _interpolation(error, data),
        "table_error": _table_error(work),
        "seconds_a_point": float(np.mean([one.seconds for one in solved])) if solved else None,
        "assumptions": _assumptions(work),
        "warnings": [*_warnings(plan.pump, plan, data), *_unchecked(fresh, checked)],
    }


def _axis(axis: MapAxis) -> dict[str, Any]:
    levels = reading_levels(axis)
    return {
        "input": axis.input.value,
        "words": axis.input.words,
        "values": list(axis.values),
        "unit": axis.input.unit,
        "levels": ", ".join(f"{level:.6g}" for level in levels) + f" {axis.input.shown.symbol}".rstrip(),
    }


def _best(data: MapData, best: Best) -> dict[str, Any]:
    definition = best.definition
    varied = [axis.input for axis in data.axes if len(axis.values) > 1]
    return {
        "definition": definition.value,
        "label": definition.label,
        "formula": definition.formula,
        "overall": best.overall,
        "at": ", ".join(f"{given.words} {given.text(best.inputs[given])}" for given in varied) or "the one point",
        "inputs": {given.value: value for given, value in best.inputs.items()},
    }


def _displacements(data: MapData) -> Iterator[dict[str, Any]]:
    """Yield displacements, geometric, swept and by Toet, at each ratio, temperature and inlet pressure, m3/rev."""
    for index in np.ndindex(*data.shape[2:]):
        here = data.solved[:, :, *index]
        if not np.any(here):
            continue
        derived = data.toet.get(index)
        levels = zip(data.axes[2:], index, strict=True)
        levels_in_words = [
            axis.input.text(axis.values[k])
            for axis, k in levels
            if axis.input is MapInput.RATIO or len(axis.values) > 1
        ]
        yield {
            "at": ", ".join(levels_in_words),
            "geometric_m3_per_rev": float(np.mean(data.values["geometric_displacement"][:, :, *index][here])),
            "swept_m3_per_rev": float(np.mean(data.values["swept_displacement"][:, :, *index][here])),
            "toet_m3_per_rev": derived.value if derived else None,
            "toet_sigma_m3_per_rev": derived.sigma if derived and np.isfinite(derived.sigma) else None,
        }


def _interpolation(error: MapError | None, data: MapData) -> dict[str, Any] | None:
    """Return the errors of the headline numbers between levels, SI, with their largest magnitude."""
    if error is None:
        return None
    names = {"shaft_power": "W", "hydraulic_power": "W", "shaft_torque": "Nm", "delivery_flow": "m3_per_s"}
    return {
        "count": error.count,
        "shown_by": error.shown_by,
        "numbers": {
            f"{name}_{unit}": {
                "rms": error.rms[name],
                "largest": error.largest[name],
                "of": _largest(np.abs(data.values[name])),
            }
            for name, unit in names.items()
        },
    }


def _table_error(work: MapWork) -> Mapping[str, float] | None:
    """Return the errors of runs by the table at its held-out points; None without a table."""
    numbers = work.solver.table.numbers if isinstance(work.solver, TableSolver) else None
    return numbers.largest() if numbers is not None else None


def _assumptions(work: MapWork) -> list[str]:
    if isinstance(work.solver, LumpedSolver):
        return []
    pump, parts = work.pump, floating_parts(work.pump)
    if not pump.physics.on:
        return [str(one) for one in parts.taken]
    solved, laws = (", ".join(one.value for one in ids) or "none" for ids in effects_in_films(pump))
    films = film_effects(rotor(pump, operating_point(pump)), parts, pump, PLAIN)
    return [
        f"[physics]: solved in the films: {solved}; by closed-form laws: {laws}",
        *(str(one) for one in films.parts.taken),
    ]


def _warnings(pump: PumpDescription, plan: MapPlan, data: MapData) -> Iterator[str]:
    """Yield warnings of the plan, of the pump, and of the points with their number of points."""
    own = plan.checked().warnings
    yield from own.values()
    for warning in check_pump(pump).warnings:
        if not warning.path.startswith("operating.") and warning.path not in own:
            yield str(warning)
    for name, (count, text) in warning_counts(data).items():
        yield f"{name}: at {count} of {int(np.sum(data.solved))} points; at the first: {text}"


def _unchecked(fresh: Sequence[OperatingPoint], found: Sequence[PartOutcome]) -> Iterator[str]:
    """Yield a warning of the fresh points without a result: the map's error does not hold what is near them."""
    failed = [(point, one) for point, one in zip(fresh, found, strict=True) if one.status is not PartStatus.SOLVED]
    if failed:
        point, first = failed[0]
        yield (
            f"points_failed: {len(failed)} of {len(found)} fresh points have no result and are left out of the error "
            f"between levels, such as {point_words(point)}: {first.reason}; add levels on both sides of it"
        )


def _span(values: Array) -> dict[str, float] | None:
    finite = values[np.isfinite(values)]
    return {"least_W": float(finite.min()), "largest_W": float(finite.max())} if finite.size else None


def _largest(values: Array) -> float | None:
    finite = values[np.isfinite(values)]
    return float(finite.max()) if finite.size else None
