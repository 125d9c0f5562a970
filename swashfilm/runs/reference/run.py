"""Run of `swashfilm reference`: flows solved, coefficients written with their range of validity."""

from collections.abc import Iterator, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.formats.versions import headed
from swashfilm.output.figures import png_of
from swashfilm.output.run_folder import write_json
from swashfilm.runs.reference.case import FEWEST_CELLS, ReferenceCase, ReferenceKind
from swashfilm.runs.reference.passages import Passage, SolvedPassage
from system.inputs.csv_table import write_table
from system.work.progress import Report

OF_PORTS = (ReferenceKind.ORIFICE, ReferenceKind.SLOT)
FILES = {kind: "port_coefficient.csv" if kind in OF_PORTS else "loss_factor.csv" for kind in ReferenceKind}
"""Name of the coefficient table of each kind."""
LIMITS = {
    ReferenceKind.STEP: "plane, laminar, steady flow; walls at rest; films developed on either side",
    ReferenceKind.GROOVE: "plane, laminar, steady flow across; walls at rest; films developed on either side",
    ReferenceKind.ORIFICE: "laminar, steady, symmetric flow (jets oscillate above Re of some 100); sharp edges",
    ReferenceKind.SLOT: "plane, laminar, steady, symmetric flow (jets bend above Re of some tens); sharp edges",
}
"""Flow for which the numbers are valid."""


def run_reference(case: ReferenceCase, folder: Path, report: Report) -> dict[str, Any]:
    """Solve every passage and write input.toml, its table of coefficients, summary.json and report.html.

    Returns the summary. Raises FilmNotConverged where Newton's method finds no steady flow.
    """
    (folder / "input.toml").write_text(case.text, encoding="utf-8")
    solved = []
    for number, passage in enumerate(case.passages):
        report(number, len(case.passages), f"solving {passage.words}")
        solved.append(_solved(case, passage))
    write_coefficients(folder / FILES[case.kind], case, solved)
    summary = reference_summary(case, solved)
    write_json(folder / "summary.json", summary)
    from swashfilm.runs.reference.page import write_reference_page
    from swashfilm.runs.reference.plots import flow_plots

    for name, figure in flow_plots(solved).items():
        (folder / name).write_bytes(png_of(figure))
    write_reference_page(folder)
    report(len(case.passages), len(case.passages), "done")
    return summary


def _solved(case: ReferenceCase, passage: Passage) -> SolvedPassage:
    halved = passage.solve(case.reynolds, max(FEWEST_CELLS, case.cells // 2))
    fine = passage.solve(case.reynolds, case.cells)
    size = fine.resistance * (fine.length + fine.extra_length) + 0.5 * np.abs(fine.loss_factor) * fine.reynolds
    return SolvedPassage(passage, fine, np.abs(halved.drop - fine.drop) / size)


def write_coefficients(path: Path, case: ReferenceCase, solved: Sequence[SolvedPassage]) -> None:
    """Write the table for pump files, headed by its source and its range of validity.

    Tables of ports have no row at Re = 0, where the coefficient is zero.
    """
    columns: dict[str, list[float]] = {}
    for row in _rows(case, solved):
        for head, value in row.items():
            columns.setdefault(head, []).append(value)
    comments = {
        "source": f"swashfilm {version('swashfilm')} reference {case.name}: Navier-Stokes by Taylor-Hood elements",
        "of": "; ".join(one.passage.words for one in solved),
        "holds for": LIMITS[case.kind],
        "mesh error": f"{100.0 * max(one.mesh_error.max() for one in solved):.2g} % of the pressure drop at most",
    }
    write_table(path, comments, {head: np.array(values) for head, values in columns.items()})


def _rows(case: ReferenceCase, solved: Sequence[SolvedPassage]) -> Iterator[dict[str, float]]:
    for one in solved:
        found = one.correction
        for k, number in enumerate(found.reynolds):
            row = one.passage.sizes | {"reynolds [1]": one.passage.scale * float(number)}
            if case.kind not in OF_PORTS:
                yield row | {"extra_length [1]": found.extra_length, "loss_factor [1]": float(found.loss_factor[k])}
            elif number > 0.0:
                yield row | {"flow_coefficient [1]": float(found.flow_coefficient[k])}


def reference_summary(case: ReferenceCase, solved: Sequence[SolvedPassage]) -> dict[str, Any]:
    """Return all results: sizes, extra length, and rows over the Reynolds number of each passage."""
    return {
        **headed("reference"),
        "name": case.name,
        "passage": case.kind.value,
        "holds_for": LIMITS[case.kind],
        "cells": case.cells,
        "table": FILES[case.kind],
        "passages": [_passage_record(one, case.kind in OF_PORTS) for one in solved],
        "warnings": [],
    }


def _passage_record(one: SolvedPassage, of_port: bool) -> dict[str, Any]:
    found = one.correction
    drops, film = found.drop, found.resistance * found.length
    return {
        "words": one.passage.words,
        "unknowns": found.flow.problem.space.size,
        "length_ratio": found.length,
        "extra_length": found.extra_length,
        "rows": [
            {
                "reynolds": float(found.reynolds[k]),
                "loss_factor": float(found.loss_factor[k]),
                "flow_coefficient": float(found.flow_coefficient[k]) if of_port else None,
                "pressure_drop_over_film_equation": float(drops[k] / film) if film > 0.0 else None,
                "whole_extra_length": float(drops[k] / found.resistance - found.length),
                "mesh_error": float(one.mesh_error[k]),
            }
            for k in range(found.reynolds.size)
        ],
    }
