"""Write new_piston.csv and worn_piston.csv: synthetic traces, as a profilometer gives them along a piston.

    python examples/films/make_worn_traces.py

Heights every 0.02 mm from the chamber's end, with roughness (0.15 um by one reading, alike in both), and with the
offset and tilt of a part that does not lie level. The worn piston has lost 9 um at the chamber's edge over 8 mm and
2 um at the case end of its engaged length; from 14 to 30 mm it is as new.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent
STEP, LENGTH = 0.02, 46.0  # mm
ROUGHNESS, GRINDING = 0.15, 0.1  # um, of one reading and of waves
SEED = 7


def wear(place: np.ndarray) -> np.ndarray:
    """Material taken off (um) at places (mm) from the chamber's end."""
    at_edge = 9.0 * np.clip(1.0 - place / 8.0, 0.0, None) ** 2
    at_case = 2.0 * np.clip((place - 32.0) / 13.0, 0.0, None) ** 2
    return np.asarray(at_edge + at_case)


def main() -> None:
    """Write both files."""
    place = np.arange(0.0, LENGTH + 0.5 * STEP, STEP)
    noise = ROUGHNESS * np.random.default_rng(SEED).standard_normal(len(place))
    surface = noise + GRINDING * np.cos(2.0 * np.pi * place / 0.25)
    for name, taken_off, offset, tilt in (("new", 0.0 * place, 31.0, -0.21), ("worn", wear(place), -12.0, 0.34)):
        height = offset + tilt * place - taken_off + surface
        rows = [f"{at:.2f}, {value:.2f}" for at, value in zip(place, height, strict=True)]
        head = "# synthetic, written by make_worn_traces.py\nplace [mm], height [um]\n"
        (FOLDER / f"{name}_piston.csv").write_text(head + "\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
