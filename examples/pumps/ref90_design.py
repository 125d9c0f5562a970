"""Design study of a floating pump: each dimension of the built-in `ref90` varied alone, by the gap that it decides.

    python examples/pumps/ref90_design.py [--pressure "35 MPa"] [--workers 2] [--picture FILE.png] [WORD ..]

A row is a gap over the revolution with all physics (elastic walls, oil over pressure and temperature, cavities,
rough walls), driven by the chamber of the lumped fidelity: film thickness in the mean and at least, power lost in
rubbing and shear, flow into the case, hottest oil; of all pistons or slippers. With words, only rows that contain one
of them. A gap takes 10 to 30 s. The picture shows film and power of each row.
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
from matplotlib.figure import Figure  # noqa: E402
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
FORMS = (".1f", ".2f", ".0f", ".0f", ".3f", ".0f")
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


@dataclass(frozen=True)
class Row:
    """Results of a variant; of all parts of the gap: mean and least film (um), powers (W), leakage (L/min), oil (degC).

    reason: why the gap has no periodic film, else "".
    """

    variant: Variant
    numbers: tuple[float, ...] = ()
    reason: str = ""

    @property
    def cells(self) -> list[str]:
        """The line of the table."""
        shown = [f"{one:{form}}" for one, form in zip(self.numbers, FORMS, strict=True)] if self.numbers else []
        return [self.variant.gap, self.variant.name, *(shown or [self.reason])]


def row(variant: Variant, pressure: str) -> Row:
    """The gap of a variant over a turn."""
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
        return Row(variant, reason=str(reason))
    instants, count = found.turn.instants, 1 if variant.gap == "block" else pump.pump.pistons
    assert found.warmth is not None
    numbers = (
        1e6 * np.mean([at.mean_film for at in instants]),
        1e6 * found.least_film.film_thickness_min,
        count * np.mean([at.passed.heat.rubbing for at in instants]),
        count * np.mean([at.passed.heat.shear for at in instants]),
        6e4 * count * np.mean([at.passed.leakage for at in instants]),
        found.warmth.hottest.max() - KELVIN,
    )
    return Row(variant, tuple(map(float, numbers)))


def picture(rows: list[Row], pressure: str) -> Figure:
    """Film and power of each row that has a film, one below the other."""
    known = [one for one in rows if one.numbers]
    figure = Figure(figsize=(9.0, 1.2 + 0.32 * len(known)), layout="constrained")
    films, powers = figure.subplots(1, 2, sharey=True)
    place = np.arange(len(known))
    mean, least, rub, shear = (np.array([one.numbers[k] for one in known]) for k in range(4))
    films.plot(mean, place, "o", color="C0", label="mean")
    films.plot(least, place, "o", color="C0", fillstyle="none", label="least")
    powers.barh(place, shear, color="C0", label="shear")
    powers.barh(place, rub, left=shear, color="C3", label="rubbing")
    films.set(xlabel="film thickness [um]", yticks=place)
    films.set_xlim(left=0.0)
    films.set_yticklabels([f"{one.variant.gap}: {one.variant.name}" for one in known])
    films.invert_yaxis()
    powers.set(xlabel="power [W]")
    for axes in (films, powers):
        axes.legend(frameon=False, fontsize="small")
    figure.suptitle(f"{PUMP} at {pressure}")
    return figure


def main() -> None:
    """Print the table, row by row as they are found."""
    parser = argparse.ArgumentParser(description="Vary the dimensions of a floating pump, one by one.")
    parser.add_argument("--pressure", default="35 MPa", help="delivery pressure with its unit (35 MPa)")
    parser.add_argument("--workers", type=int, default=2, help="gaps side by side (2)")
    parser.add_argument("--picture", metavar="FILE.png", help="film and power of each row as a picture")
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
        rows = []
        for one in pool.map(row, picked, [asked.pressure] * len(picked)):
            console.log(", ".join(one.cells))
            table.add_row(*one.cells)
            rows.append(one)
    console.print(table)
    if asked.picture:
        picture(rows, asked.pressure).savefig(asked.picture, dpi=120)


if __name__ == "__main__":
    main()
