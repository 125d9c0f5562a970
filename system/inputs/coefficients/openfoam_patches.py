"""Patches of an OpenFOAM case, read by VTK in a process of its own, since it ends by a signal on some broken cases."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from system.inputs.faults import Fault, InputFaults, one_line

PATIENCE = 1800.0
"""Seconds after which a case counts as unreadable."""
_VTK_HEAD = re.compile(r"^\s*ERROR: In [^\n]*\n\w+ \(0x[0-9a-f]+\): ")


@dataclass(frozen=True)
class CasePatches:
    """A case at its last time: names of its patches, fields of the inlet, flow out and mean p of inlet and outlet.

    through: (m3/s, unit of p) of both patches; empty where a patch or a field is missing.
    """

    time: float
    names: tuple[str, ...]
    fields: tuple[str, ...]
    through: tuple[tuple[float, float], ...]


def read_patches(case: Path, inlet: str, outlet: str) -> CasePatches:
    """Return the patches of a case folder; raise InputFaults where its files cannot be read."""
    words = [sys.executable, "-m", __name__, str(case.resolve()), inlet, outlet]
    root = Path(__file__).resolve().parents[3]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE, check=False, cwd=root)
    except subprocess.TimeoutExpired:
        raise _fault(case, f"reading took longer than {PATIENCE:g} s") from None
    if done.returncode:
        lines = done.stderr.strip().splitlines()
        raise _fault(case, lines[-1] if lines and done.returncode > 0 else "its reader broke down")
    told = json.loads(done.stdout)
    if "fault" in told:
        raise _fault(case, told["fault"])
    through = tuple((flow, pressure) for flow, pressure in told["through"])
    return CasePatches(told["time"], tuple(told["names"]), tuple(told["fields"]), through)


def _fault(case: Path, words: str) -> InputFaults:
    return InputFaults(str(case), [Fault("case", f"cannot be read: {one_line(words)}", "the files of a solved case")])


def _patches(case: Path, inlet: str, outlet: str) -> CasePatches:
    import pyvista

    reader = pyvista.OpenFOAMReader(str(case / "system" / "controlDict"))
    time = float(reader.time_values[-1])
    reader.set_active_time_value(time)
    reader.cell_to_point_creation = False
    reader.enable_all_patch_arrays()
    boundary = reader.read()["boundary"]
    names = tuple(map(str, boundary.keys()))
    fields = tuple(map(str, boundary[inlet].cell_data)) if inlet in names else ()
    whole = {inlet, outlet} <= set(names) and {"U", "p"} <= set(fields)
    return CasePatches(time, names, fields, tuple(_through(boundary[name]) for name in (inlet, outlet) if whole))


def _through(patch: Any) -> tuple[float, float]:
    """Volume flow out through a patch (m3/s; faces of a boundary look outward), and its mean p."""
    sized = patch.compute_cell_sizes(length=False, volume=False)
    area = np.asarray(sized.cell_data["Area"])
    normals = np.asarray(patch.extract_surface().face_normals)
    out = np.einsum("ij,ij->i", np.asarray(patch.cell_data["U"]), normals)
    return float(out @ area), float(np.asarray(patch.cell_data["p"]) @ area / area.sum())


def _tell(case: Path, inlet: str, outlet: str) -> None:
    """Print the patches, or the fault of a case that VTK or the reader of its arrays does not understand."""
    import pyvista

    try:
        with pyvista.vtk_verbosity("off"), pyvista.VtkErrorCatcher(raise_errors=True, send_to_logging=False):
            told: dict[str, Any] = asdict(_patches(case, inlet, outlet))
    except Exception as reason:
        told = {"fault": _VTK_HEAD.sub("", str(reason)).strip().partition("\n")[0] or type(reason).__name__}
    sys.stdout.write(json.dumps(told))


if __name__ == "__main__":
    _tell(Path(sys.argv[1]), *sys.argv[2:4])
