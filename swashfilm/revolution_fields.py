"""The kept films of a revolution for ParaView: surfaces in their true place, a series over the shaft angle."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from reynolds.export import write_pvd, write_vtu
from reynolds.mesh import Array
from swashfilm.gap_case import Gap
from swashfilm.pump_fields import FIELDS, vtu_name
from swashfilm.revolution_study import RevolutionStudy
from system.places import face_frame, guide_frame


def write_revolution_fields(folder: Path, study: RevolutionStudy) -> None:
    """Write fields/<gap>_NNN.vtu of every kept film and, over them, <gap>.pvd (time = shaft angle in degrees)."""
    (folder / FIELDS).mkdir(exist_ok=True)
    gap, entries = study.case.gap.value, []
    for k, (angle, film) in enumerate(study.revolution.turn.films.items()):
        name = f"{FIELDS}/{vtu_name(gap, k)}"
        write_vtu(folder / name, film, true_place(study, angle))
        entries.append((float(np.degrees(angle)), 0, name))
    write_pvd(folder / f"{gap}.pvd", entries)


def true_place(study: RevolutionStudy, shaft_angle: float) -> Callable[[Array], Array]:
    """Map of the gap's film plane (n, 2) m to its place in the pump (n, 3) m at a shaft angle (rad)."""
    rotor = study.case.rotor
    match study.case.gap:
        case Gap.PISTON:
            frame = guide_frame(rotor, study.parts.piston.guide_length, shaft_angle)
            return partial(frame.cylinder, radius=0.5 * rotor.pump.pump.piston_diameter)
        case Gap.SLIPPER:
            return face_frame(rotor, study.parts.slipper.ball_height, shaft_angle).plane
        case Gap.VALVE_PLATE:
            return rotor.pump.valve_plate.sphere.in_space
