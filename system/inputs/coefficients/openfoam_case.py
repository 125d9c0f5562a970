"""The flow through two patches of an OpenFOAM case: a flow coefficient at a Reynolds number.

Incompressible cases have a kinematic pressure p/rho in m2/s2; the `dimensions` of a file `p` state which it contains.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reynolds.numerics.files import LARGEST_DATA, expect_regular, is_file, read_bounded
from system.inputs.coefficients.openfoam_patches import read_patches
from system.inputs.faults import Fault, InputFaults, nearest_choice, nearest_path

_DIMENSIONS = re.compile(r"^\s*dimensions\s*\[([^\]]*)\]", re.MULTILINE)
_WHOLE = re.compile(r"[+-]?\d{1,2}")
KINEMATIC, PRESSURE = (0.0, 2.0, -2.0), (1.0, -1.0, -2.0)
"""Powers of kg, m and s in the dimensions of p."""
IMBALANCE = 0.01
"""Of the flow by which inlet and outlet may differ."""


@dataclass(frozen=True)
class CaseFlow:
    """At the last time of a case: volume flow in at the inlet (m3/s), static pressure drop inlet to outlet (Pa).

    balance_error: outflow less inflow, of the inflow; time in s, or the number of iterations.
    """

    time: float
    flow: float
    pressure_drop: float
    balance_error: float

    def flow_coefficient(self, throat_area: float, density: float) -> float:
        """Cd of q = Cd A sqrt(2 dp/rho), A in m2, rho in kg/m3."""
        return float(self.flow / (throat_area * np.sqrt(2.0 * self.pressure_drop / density)))

    def reynolds(self, throat_area: float, kinematic_viscosity: float) -> float:
        """u d_h/nu in a throat of A m2, d_h = sqrt(4 A/pi), nu in m2/s."""
        return float(self.flow / throat_area * np.sqrt(4.0 * throat_area / np.pi) / kinematic_viscosity)


def read_case_flow(case: Path, inlet: str, outlet: str, density: float) -> CaseFlow:
    """The flow of a case folder between two patches, density in kg/m3 for kinematic pressures.

    Raises InputFaults for a folder that is no case, missing patches and fields, a pressure of other dimensions, a flow
    in the opposite direction, one with an imbalance above IMBALANCE or without a pressure drop.
    """
    control = case / "system" / "controlDict"
    if not is_file(control):
        fault = Fault("case", f"no {control}", "the folder of an OpenFOAM case", nearest_path(control))
        raise InputFaults(str(case), [fault])
    _expect_files(case)
    read = read_patches(case, inlet, outlet)
    faults = [
        Fault("patch", f"'{name}'", f"one of {', '.join(read.names)}", nearest_choice(name, read.names))
        for name in (inlet, outlet)
        if name not in read.names
    ]
    faults += [] if faults else _field_faults(case, read.fields)
    if faults:
        raise InputFaults(str(case), faults)
    scale = density if _pressure_powers(case, read.time) == KINEMATIC else 1.0
    (inflow, before), (outflow, behind) = read.through
    found = CaseFlow(read.time, -inflow, scale * (before - behind), (outflow + inflow) / max(abs(inflow), 1e-300))
    return _held(case, found)


def _expect_files(case: Path) -> None:
    """Raise InputFaults for a mesh or a field that is no file: its reader would never end."""
    faults = []
    for place in sorted([*case.glob("constant/polyMesh/*"), *case.glob("[0-9]*/*")]):
        try:
            if not place.is_dir():
                expect_regular(place, sys.maxsize)
        except OSError as reason:
            faults.append(Fault(str(place.relative_to(case)), str(reason.strerror), "a file of a solved case"))
    if faults:
        raise InputFaults(str(case), faults)


def _field_faults(case: Path, fields: Sequence[str]) -> list[Fault]:
    """Fields that do not exist."""
    return [
        Fault(f"field {name}", "no such field at the last time", "U and p", f"run the solver in {case}")
        for name in ("U", "p")
        if name not in fields
    ]


def _pressure_powers(case: Path, time: float) -> tuple[float, ...]:
    """Powers of kg, m and s in p; raises InputFaults for those of neither pressure."""
    places = [place / "p" for place in case.iterdir() if _is_time(place.name, time) and is_file(place / "p")]
    text = read_bounded(places[0], LARGEST_DATA).decode("latin-1") if places else ""
    found = _DIMENSIONS.search(text)
    powers = tuple(float(word) for word in found[1].split()[:3] if _WHOLE.fullmatch(word)) if found else ()
    if powers not in (KINEMATIC, PRESSURE):
        stated = found[1].strip() if found else "no dimensions"
        fault = Fault("field p", f"dimensions [{stated}]", "[0 2 -2 ..] (kinematic) or [1 -1 -2 ..]")
        raise InputFaults(str(case), [fault])
    return powers


def _is_time(name: str, time: float) -> bool:
    try:
        return abs(float(name) - time) <= 1e-9 * max(abs(time), 1.0)
    except ValueError:
        return False


def _held(case: Path, found: CaseFlow) -> CaseFlow:
    """The flow; raises InputFaults for other flows than one through an orifice."""
    faults = []
    if not found.flow > 0.0:
        faults.append(Fault("inlet", f"{found.flow:.3g} m3/s in", "a flow into the case", "inlet and outlet swapped"))
    elif abs(found.balance_error) > IMBALANCE:
        share = f"outflow {1.0 + found.balance_error:.3f} of the inflow"
        faults.append(
            Fault("outlet", share, f"the inflow to within {IMBALANCE:.0%}", "a converged flow between two patches")
        )
    if not found.pressure_drop > 0.0:
        drop = f"{found.pressure_drop:.4g} Pa from inlet to outlet"
        faults.append(Fault("p", drop, "a pressure that falls along the flow"))
    if faults:
        raise InputFaults(str(case), faults)
    return found
