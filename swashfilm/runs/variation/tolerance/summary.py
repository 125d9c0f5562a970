"""Summary of a tolerance's run."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import asdict
from typing import Any

import numpy as np

from swashfilm.formats.versions import headed
from swashfilm.runs.variation.case import VariedCase
from swashfilm.runs.variation.tolerance.drawn import by_reason
from swashfilm.runs.variation.tolerance.files import si_unit
from swashfilm.runs.variation.words import size_text, where
from system.description.drawn import Drawing, Drawn, DrawnFit, pump_sigma
from system.description.keys import pump_keys
from system.description.tolerance import Shape
from system.inputs.shown import ROUND_OFF
from system.maps.plan import point_words
from system.maps.point import TableSolver
from system.points.table.means import GAP_PAIRS
from system.variation.scatter import CONFIDENCE, QUANTILES, Scatter
from system.variation.tolerance import Tolerance

OF_TABLE = {
    "drain_flow": "case_drain",
    "delivery_flow": "delivery_flow",
    "shaft_torque": "shaft_torque",
    **{f"leakage.{gap}": f"{gap}.leakage_flow" for gap in GAP_PAIRS},
}
"""Measures by name, and the numbers of a response table whose held-out error is theirs."""


def tolerance_summary(case: VariedCase, drawing: Drawing, seed: int, found: Tolerance) -> dict[str, Any]:
    """Return the summary: scatter, shares, limits and counts; SI."""
    return {
        **headed("tolerance"),
        "name": case.pump.name,
        **where(case),
        "pumps": {"drawn": found.pumps, "solved": len(found.numbers), "refused": found.refused, "failed": found.failed},
        "seed": seed,
        "confidence": CONFIDENCE,
        "quantiles": list(QUANTILES),
        "dimensions": _dimension_rows(case, drawing),
        "correlation": [{"one": a, "other": b, "coefficient": c} for (a, b), c in drawing.correlation.items()],
        "not_drawn": list(drawing.unused),
        "measures": {
            one.name: {
                "words": one.words,
                "unit": one.unit,
                **_scatter(found.scatters[k]),
                "surface_held_out": float(found.surface.held_out[k]),
                "shares": [asdict(share) | {"names": list(share.names)} for share in found.shares[k]],
            }
            for k, one in enumerate(found.measures)
        },
        "at_points": [
            {"point": point_words(point)} | {one.name: _scatter(own[k]) for k, one in enumerate(found.measures)}
            for point, own in zip(case.work.sites.points, found.at_sites, strict=True)
        ],
        "limits": [
            {"limit": one.limit.text, "measure": one.limit.measure.name, "value": one.limit.value,
             "missing": asdict(one.missing), "missing_at_a_point": asdict(one.anywhere)}
            for one in found.limits
        ],
        "warnings": [*case.input_warnings, *warnings_of(found), *table_warnings(case.work.solver, found)],
        "internal_error": found.internal,
        "cost": {"processor_s": found.seconds},
    }  # fmt: skip


def _scatter(found: Scatter) -> dict[str, Any]:
    return {"mean": found.mean, "deviation": found.deviation, "quantiles": [asdict(one) for one in found.quantiles]}


def _dimension_rows(case: VariedCase, drawing: Drawing) -> list[dict[str, Any]]:
    known, rows = pump_keys(case.pump), []
    for one in drawing.members:
        key = known[one.keys[0]]
        sigma = pump_sigma(one)
        rows.append(
            {
                "name": one.name, "keys": list(one.keys), "value": key.value, "text": key.text,
                "unit": si_unit(key), "shape": one.law,
                "sigma": sigma, "sigma_text": size_text(key, sigma), "words": _words(one, key.shown),
            }
        )  # fmt: skip
    return rows


def _words(one: Drawn | DrawnFit, shown: Callable[[float], str]) -> str:
    """Return the tolerance in words."""
    several = f"; {one.parts} parts of a pump, each its own" if one.parts > 1 else ""
    if isinstance(one, DrawnFit):
        hole, shaft = (f"{shown(part[0])} to {shown(part[1])}" for part in (one.hole, one.shaft))
        sorting = f", paired in {one.classes} classes" if one.classes > 1 else ""
        return f"{one.shape.value}: hole {hole}, shaft {shaft}{sorting}{several}"
    ends = f"{shown(one.least)} to {shown(one.most)}" if np.isfinite(one.least) else ""
    if one.shape is not Shape.NORMAL:
        return f"{one.law}, {ends}{several}"
    within = f", within {ends}" if ends else ""
    together = f"; {', '.join(one.keys[1:])} in proportion" if one.keys[1:] else ""
    return f"{one.law} about {shown(one.middle)}{within}{together}{several}"


def table_warnings(solver: object, found: Tolerance) -> Iterator[str]:
    """Yield the numbers whose scatter is below the error of the response table at its held-out points."""
    if not isinstance(solver, TableSolver) or solver.table.numbers is None:
        return
    largest = solver.table.numbers.largest()
    for one, own in zip(found.measures, found.scatters, strict=True):
        error = largest.get(OF_TABLE.get(one.name, ""), 0.0) * abs(own.mean)
        if own.deviation > ROUND_OFF * abs(own.mean) and error > own.deviation:
            scatter, error_text = (one.change(value).lstrip("+") for value in (own.deviation, error))
            yield (
                f"table_error: {one.words} scatters by a standard deviation of {scatter}, less than the response table "
                f"errs by, {error_text} at most at its held-out points; build a table of more points"
            )


def warnings_of(found: Tolerance) -> list[str]:
    """Return what keeps pumps from a result, and numbers that the surface does not describe."""
    said = []
    if found.refused:
        said.append(
            f"pumps_refused: {sum(found.refused.values())} of {found.pumps} pumps are refused by the geometry and have "
            f"no part in the scatter: {by_reason(found.refused)}; narrow the tolerances of these dimensions"
        )
    if found.failed:
        said.append(
            f"points_failed: {sum(found.failed.values())} of {found.pumps} pumps have no result: "
            f"{by_reason(found.failed)}; narrow the tolerances of these dimensions"
        )
    rough = [
        one.words
        for one, own, part in zip(found.measures, found.scatters, found.surface.held_out, strict=True)
        if part < 0.9 and own.deviation > ROUND_OFF * abs(own.mean)
    ]
    if rough:
        said.append(
            f"shares_uncertain: a quadratic surface explains less than 90 % of {', '.join(rough)}: shares in it are a "
            "guide only; draw more pumps, or look at pumps.csv itself"
        )
    return said
