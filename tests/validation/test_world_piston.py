"""Against the world: friction of the piston.

The floating piston of ref90 at 35 MPa with rigid walls and oil of constant viscosity, chamber pressure by the lumped
cycle. Motoring: the ports' pressures change places. Friction: mean size of the force along the bore over the half turn
at high pressure.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest
from floating_ref90 import COARSE, At, driven

from system.points.floating_gaps import piston_revolution

pytestmark = pytest.mark.long
MANRING = "Manring 1999, J. Dyn. Sys., Meas., Control 121, 531, abstract: Stribeck law, numerical at high pressure"
SPEEDS = (300.0, 1050.0, 2100.0)
DISCUSSION = """\
The friction of the tribo pump (Lasaar, Ivantysynova) and of the bushings at Aachen (IFAS, Int. J. Fluid Power 2005)
was measured as a force over the turn. Neither forces nor sizes are in what is openly readable. What Manring found for
a pump's and a motor's piston at high pressure are trends, and the floating piston has each of them. Between rigid
walls it rubs at the ends of its bore at every one of these speeds, the less the faster it runs."""


@dataclass(frozen=True)
class Rubbed:
    """Friction of a piston in its pressed half turn, and mean load of its asperities, N."""

    friction: float
    contact: float


@cache
def rubbed(speed: float, motoring: bool) -> Rubbed:
    group, parts, drive = driven(At(speed=speed), motoring=motoring)
    turn = piston_revolution(group, parts, drive.piston, replace(COARSE, steps=72))
    reports = [instant.report for instant in turn.turn.instants]
    force = np.array([report.friction.force for report in reports])
    pressed = turn.angles < np.pi if motoring else turn.angles > np.pi
    return Rubbed(float(np.abs(force[pressed]).mean()), float(np.mean([report.contact_load for report in reports])))


def test_friction_of_pumping_and_motoring_pistons(validation):
    pumping = [rubbed(speed, motoring=False).friction for speed in SPEEDS]
    motoring = [rubbed(speed, motoring=True).friction for speed in SPEEDS]
    note = ", ".join(f"{p:.0f} and {m:.0f} N" for p, m in zip(pumping, motoring, strict=True))
    note = f"pumping and motoring at {', '.join(f'{s:g}' for s in SPEEDS)} r/min: {note}"
    for quantity, obtained in (
        ("least sign of friction, pumping less motoring", min(np.sign(np.subtract(pumping, motoring)))),
        ("largest sign of the change with speed, pumping", max(np.sign(np.diff(pumping)))),
        ("sign of the fall of friction with speed, motoring over pumping", np.sign(fall(motoring) - fall(pumping))),
    ):
        validation(
            case="Friction of the floating piston, ref90 at 35 MPa",
            source=MANRING,
            quantity=quantity,
            unit="1",
            expected=-1.0 if "change" in quantity else 1.0,
            obtained=obtained,
            tolerance=1e-9,
            note=note,
        )


def fall(forces: list[float]) -> float:
    """Ratio of the friction at the lowest to that at the highest speed."""
    return forces[0] / forces[-1]


def test_contact_falls_with_speed():
    for motoring in (False, True):
        contact = [rubbed(speed, motoring).contact for speed in SPEEDS]
        assert contact == sorted(contact, reverse=True)
        assert contact[-1] > 0.0
