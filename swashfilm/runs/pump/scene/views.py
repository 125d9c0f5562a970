"""Pictures of the whole pump: its blocks as films in colours between translucent solids."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from swashfilm.output.data.gap_names import FIELDS, vtu_name
from swashfilm.output.scenes.picture3d import Frame, Solid
from swashfilm.runs.pump.data import PICTURED_TURN
from swashfilm.runs.pump.scene.blocks import OIL, Blocks, Scene, nearest
from swashfilm.runs.pump.scene.surfaces import TURN

PICTURE, TURNING = "pump.png", "pump.webp"
FILM = " film"
LOOKS = {
    "piston": ("#7d8b96", 0.45), "slipper": ("#c49a3a", 0.4), "block": ("#9aa4ab", 0.13),
    "swash plate": ("#9aa4ab", 0.22), "valve plate": ("#c49a3a", 0.35), "shaft": ("#5b6770", 0.35),
    OIL: ("#3c7a8c", 0.3),
}  # fmt: skip
"""Colour and opacity of each part."""


def frame_of(folder: Path, blocks: Blocks, degrees: float) -> Frame:
    """Return the view of the pump at a shaft angle, with the numbers of the chambers at the slippers."""
    films = [folder / path for name, path in blocks if name.endswith(FILM)]
    solids = [Solid(folder / path, *LOOKS[part_of(name)]) for name, path in blocks if not name.endswith(FILM)]
    slippers = {name.removesuffix(FILM): folder / path for name, path in blocks if name.endswith(FILM)}
    marks = [(name.split()[1], path) for name, path in slippers.items() if part_of(name) == "slipper"]
    return Frame(films, solids, marks, f"shaft angle {degrees:.0f} deg")


def part_of(name: str) -> str:
    """Return the part that a block shows: its name without the chamber's number."""
    return name.removesuffix(FILM).rstrip("0123456789").strip()


def pump_drawings(folder: Path, scene: Scene, blocks: Sequence[Blocks]) -> dict[Path, Sequence[Frame]]:
    """Return the drawings pump.png, pump.webp over the turn, and <gap>.png of the films of each kind of chambers.

    blocks: those of the scene's times; a picture has the one nearest to PICTURED_TURN, a turn all of them.
    """
    pictured, degrees = TURN * PICTURED_TURN, np.degrees(scene.times)
    films = {("", "valve_plate"): nearest(scene.block_angles, scene.block_period, pictured)}
    for kind in scene.kinds:
        films[kind.place, "piston"] = nearest(kind.piston_angles, TURN, pictured)
        films[kind.place, "slipper"] = nearest(kind.slipper_angles, TURN, pictured)
    drawings: dict[Path, Sequence[Frame]] = {
        folder / place / f"{gap}.png": [Frame([folder / place / FIELDS / vtu_name(gap, k)])]
        for (place, gap), k in films.items()
    }
    frames = [frame_of(folder, one, float(at)) for one, at in zip(blocks, degrees, strict=True)]
    drawings[folder / PICTURE] = [frames[nearest(scene.times, TURN, pictured)]]
    drawings[folder / TURNING] = frames
    return drawings
