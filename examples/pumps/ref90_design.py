"""Design study of a floating pump: each dimension of the built-in `ref90` varied alone, by the gap that it decides.

    python examples/pumps/ref90_design.py [--pressure "35 MPa"] [--workers 2] [WORD ..]

A row is a gap over the revolution with all physics (elastic walls, oil over pressure and temperature, cavities,
rough walls), driven by the chamber of the lumped fidelity: film thickness in the mean and at least, power lost in
rubbing and shear, flow into the case, hottest oil; of all pistons or slippers. With words, only rows that contain one
of them. A gap takes 10 to 30 s.
"""

from __future__ import annotations

import argparse
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

# Films are small: threads of one cost the others more than they gain. Set before numpy is imported, in every process.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import numpy as np  # noqa: E402
from rich.console import Console  # noqa: E402
from rich.table import Table  # noqa: E402

from gaps import GapRevolution  # noqa: E402
from reynolds import FilmNotConverged  # noqa: E402
from system import (  # noqa: E402
    FloatingOptions,
    block_revolution,
    drives,
    floating_parts,
    load_pump,
    lumped_point,
    no_rubbing,
    operating_point,
    piston_revolution,
    rotor,
    slipper_revolution,
)

PUMP = "ref90"
KELVIN = 273.15


@dataclass(frozen=True)
class Variant:
    """A gap with one dimension changed: what it is called, and the pump file's keys with their new values."""

    gap: str
    name: str
    changes: dict[str, str]


def reliefs(width: str, depth: str) -> dict[str, str]:
    """Run-in edges of piston and bore alike."""
    sizes = {"width": width, "depth": depth}
    return {f"{part}.edge_relief.{key}": size for part in ("piston", "bore") for key, size in sizes.items()}


def lands(inner: str, outer: str) -> dict[str, str]:
    """A slipper's land between two radii."""
    return {"slipper.land_inner_radius": inner, "slipper.land_outer_radius": outer}


HEADS = ("gap", "dimension", "film\num", "least\num", "rub\nW", "shear\nW", "leak\nL/min", "oil\ndegC")
VARIANTS = (
    Variant("piston", "as designed", {}),
    Variant("piston", "60 mm in the bore", {"piston.engaged_length": "60 mm"}),
    Variant("piston", "overhang 12 mm", {"piston.overhang": "12 mm"}),
    Variant("piston", "edges 5 mm, 4 um", reliefs("5 mm", "4 um")),
    Variant("piston", "clearance 12 um", {"piston.radial_clearance": "12 um"}),
    Variant("slipper", "as designed", {}),
    Variant("slipper", "flange 6 mm", {"slipper.flange_thickness": "6 mm"}),
    Variant("slipper", "rim relief 4 um", {"slipper.rim_relief.depth": "4 um"}),
    Variant("slipper", "lands 7.8 to 14.4 mm", lands("7.8 mm", "14.4 mm")),
    Variant("block", "as designed", {}),
    Variant("block", "waves of 2 um", {"valve_plate.waviness.amplitude": "2 um"}),
    Variant("block", "outer land to 52.5 mm", {"valve_plate.land_radius_4": "52.5 mm"}),
    Variant("block", "oil ISO VG 46", {"oil.grade": "ISO VG 46"}),
)  # fmt: skip


def row(variant: Variant, pressure: str) -> list[str]:
    """A line of the table, with the reason where a gap has no periodic film."""
    pump = load_pump(PUMP, {**variant.changes, "operating.pressure": pressure})
    point = operating_point(pump)
    shaft, parts, cycle = rotor(pump, point), floating_parts(pump), lumped_point(pump, point).cycle
    driven = drives(shaft, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(len(cycle.shaft_angle)))
    options = FloatingOptions(steps=180)
    found: GapRevolution
    try:
        if variant.gap == "piston":
            found = piston_revolution(shaft, parts, driven.piston, options)
        elif variant.gap == "slipper":
            found = slipper_revolution(shaft, parts, driven.slipper, options)
        else:
            found = block_revolution(shaft, parts, driven.block, options)
    except FilmNotConverged as reason:
        return [variant.gap, variant.name, str(reason)]
    instants, count = found.turn.instants, 1 if variant.gap == "block" else pump.pump.pistons
    assert found.warmth is not None
    return [
        variant.gap,
        variant.name,
        f"{1e6 * np.mean([at.mean_film for at in instants]):.1f}",
        f"{1e6 * found.least_film.film_thickness_min:.2f}",
        f"{count * np.mean([at.passed.heat.rubbing for at in instants]):.0f}",
        f"{count * np.mean([at.passed.heat.shear for at in instants]):.0f}",
        f"{6e4 * count * np.mean([at.passed.leakage for at in instants]):.3f}",
        f"{found.warmth.hottest.max() - KELVIN:.0f}",
    ]


def main() -> None:
    """Print the table, row by row as they are found."""
    parser = argparse.ArgumentParser(description="Vary the dimensions of a floating pump, one by one.")
    parser.add_argument("--pressure", default="35 MPa", help="delivery pressure with its unit (35 MPa)")
    parser.add_argument("--workers", type=int, default=2, help="gaps side by side (2)")
    parser.add_argument("words", nargs="*", help="only rows that contain one of them")
    asked = parser.parse_args()
    words = asked.words or [""]
    picked = [one for one in VARIANTS if any(word in f"{one.gap} {one.name}" for word in words)]
    if not picked:
        names = "\n  ".join(f"{one.gap} {one.name}" for one in VARIANTS)
        parser.error(f"no row contains {' or '.join(words)}; the rows are\n  {names}")
    table = Table(title=f"{PUMP} at {asked.pressure}")
    for head in HEADS:
        table.add_column(head, justify="left" if head in HEADS[:2] else "right", no_wrap=True)
    console = Console()
    with ProcessPoolExecutor(asked.workers, mp_context=get_context("spawn")) as pool:
        for cells in pool.map(row, picked, [asked.pressure] * len(picked)):
            console.log(", ".join(cells))
            table.add_row(*cells)
    console.print(table)


if __name__ == "__main__":
    main()
