"""[physics] by closed laws and by films that solve it: factors on leakage and shear of a gap.

    python benchmarks/film_effects.py

REF90 at its own point; films as a diagnosis solves them (half the usual cells, 18 shaft angles). Two minutes; the
first time some more, for the bodies of the parts.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Any

from system.inputs.sections.reader import section_of

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from system.description.effects import PhysicsSection
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.friction import OF_GAP
from system.points.films import films_point
from system.points.lumped import lumped_point
from system.pump.assembly import PumpPoint
from system.pump.operating import OperatingPoint, operating_point
from system.pump_file.file import load_pump

CASES: Mapping[str, Mapping[str, Any]] = {
    "viscosity_pressure 20 1/GPa": {"viscosity_pressure": {"coefficient": 2e-8}},
    **{
        f"elastic_opening.{gap.value} opening 20 1/GPa": {"elastic_opening": {gap.value: {"opening": 2e-8}}}
        for gap in Gap
    },
    **{
        f"elastic_opening.{gap.value} compliance 1": {"elastic_opening": {gap.value: {"compliance": 1.0}}}
        for gap in Gap
    },
    "film_heating 6.6e-05 m2 K/W": {"film_heating": dict.fromkeys((gap.value for gap in Gap), 6.6e-5)},
}


def numbers(point: PumpPoint) -> dict[Gap, tuple[float, float]]:
    """Leakage (m3/s) and shear (W) of each gap."""
    return {
        gap: (getattr(point.leakage_flow, gap.value), point.pairs.loss(pair).mean_viscous)
        for gap, pair in OF_GAP.items()
    }


def coarse_films(pump: PumpDescription, at: OperatingPoint[float]) -> PumpPoint:
    """The point by films on half the usual cells, at two places a pitch."""
    return films_point(pump, at, positions_per_pitch=2, finer=0.5, tolerance=0.05).pump_point


def main() -> None:
    """Print the table, without gaps that an effect does not change."""
    pump = load_pump("ref90")
    at = operating_point(pump)
    plain = numbers(lumped_point(pump, at)), numbers(coarse_films(pump, at))
    print("| effect | gap | leakage, law | films | shear, law | films | films took s |\n" + "|---" * 7 + "|")
    for name, stated in CASES.items():
        extended = replace(pump, physics=section_of(PhysicsSection, stated))
        law = numbers(lumped_point(extended, at))
        began = perf_counter()
        films = numbers(coarse_films(extended, at))
        took = perf_counter() - began
        for gap in Gap:
            told = [
                f"{found[gap][k] / before[gap][k]:.3f}"
                for k in (0, 1)
                for found, before in zip((law, films), plain, strict=True)
            ]
            if abs(float(told[0]) - 1.0) > 0.01:
                shown = gap.value.replace("_", " ")
                print(f"| {name} | {shown} | {' | '.join(told)} | {took:.1f} |", flush=True)


if __name__ == "__main__":
    main()
