"""Against the world: tilt and film of the block.

The floating block of ref90 with rigid walls and oil of constant viscosity, chamber pressure by the lumped cycle. Of
the machines in the sources no drawing is open, so their numbers are those of comparable machines.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest
from floating_ref90 import COARSE, At, driven
from measured import Measured, Trend, at_least, not_computed, of_mesh, within

from system.points.floating_gaps import block_revolution

pytestmark = pytest.mark.long
FINE = replace(COARSE, steps=72, finer=1.0)
"""Meshes on which the tilt at 35 MPa is 4 % from that of meshes twice finer; twice coarser ones turn a sign."""
MEASURED = "Zhang, Yuan, Song and Zhou 2020, Int. J. Fluid Power, abstract"
CODE = "Lubricants 2024, 12(10), 342, abstract: another code, thermal and elastic, of a double-row pump"
COAXIALITY = (1.65e-4, 4.3e-4)
BALANCE = 1.2e-4
LICENCE = "numbers and words of an abstract, cited as facts"
MESH = 1.25 * 0.04 * 2.0 / (2.0 - 1.0)
"""Grid convergence index over the tilt, of the coarser of two meshes: 4 % between them, ratio 2, order 1."""
SAME_SIZE = 0.5
"""Of the common logarithm: half a decade either way is the same order of magnitude."""
DISCUSSION = f"""\
Zhang, Yuan, Song and Zhou (2020) measure the gap with three eddy current sensors. They attribute a wedge of
{COAXIALITY[0]:.2e} to {COAXIALITY[1]:.2e} rad to the error of coaxiality of shaft and block, and 1.35e-3 rad to worn
plates. The balance of forces alone gives, by their theory, nearly {BALANCE:.1e} rad. The floating block has neither
error nor wear: it is to be compared with the last number, and stays below all measured ones. To meet the measured
range would take that error of coaxiality, which no pump file states.
The trends with swash angle, pressure and speed need no drawing. The films of the block measured by Kim and Jung
(2002, two shapes of plate), Bergada, Watton and Kumar (2008) and Richardson (2019, three probes) have no numbers in
what is openly readable."""


@dataclass(frozen=True)
class Block:
    """Tilt (rad) of the block: largest, and its swing over the turn; mean film and the swing of its middle, um."""

    tilt: float
    tilt_swing: float
    film: float
    film_swing: float


@cache
def block(at: At) -> Block:
    group, parts, drive = driven(at)
    turn = block_revolution(group, parts, drive.block, FINE)
    tilt = np.hypot(*turn.positions[:, 1:].T) / group.pump.valve_plate.land_radius_4
    swing = 1e6 * float(np.ptp(turn.positions[:, 0]))
    return Block(float(tilt.max()), float(np.ptp(tilt)), 1e6 * turn.mean_film, swing)


def test_the_measured_tilt_is_not_that_of_the_balance_of_forces(validation):
    found = block(At()).tilt
    validation(
        case="Tilt of the floating block, ref90 at 35 MPa, 2100 r/min",
        source=f"{MEASURED}, theory",
        quantity="common logarithm of its largest tilt over that of a block by force and torque balance",
        unit="1",
        expected=0.0,
        obtained=np.log10(found / BALANCE),
        tolerance=SAME_SIZE,
        note=f"{found:.2e} against {BALANCE:.1e} rad of a comparable machine; same order of magnitude",
    )
    low, high = COAXIALITY
    validation(
        case="Tilt of the floating block, ref90 at 35 MPa, 2100 r/min",
        source=f"{MEASURED}, three sensors",
        quantity="largest tilt",
        unit="rad",
        expected=0.5 * (low + high),
        obtained=found,
        tolerance=0.5 * (high - low),
        note="tolerance: the measured range, of a comparable machine",
        missed="the source attributes this range to the error of coaxiality of shaft and block, which the floating "
        "block does not have; its own lands lie under the pistons",
        measured=Measured(
            "block tilt",
            LICENCE,
            at_least(within(0.5 * (high - low), "no uncertainty is stated; the measured range")),
            not_computed("neither drawing nor error of coaxiality of the measured machine is given"),
            of_mesh(MESH * found, "meshes twice finer change it by 4 %, order 1"),
        ),
    )


def test_the_tilt_goes_with_the_swash_angle_more_than_with_pressure(validation):
    """Either 3.5 times as large: the swash angle from 28 % displacement, and the pressure."""
    full, small, low = (block(at).tilt for at in (At(), At(ratio=0.28), At(pressure=10.0)))
    for quantity, expected, obtained in (
        ("sign of the change of tilt, 28 to 100 % displacement", 1.0, np.sign(full - small)),
        ("sign of the change of tilt, 10 to 35 MPa", 1.0, np.sign(full - low)),
        ("sign of the first growth less the second", 1.0, np.sign(full / small - full / low)),
    ):
        validation(
            case="Trends of the floating block's tilt, ref90, 2100 r/min",
            source=f"{MEASURED}, three sensors",
            quantity=quantity,
            unit="1",
            expected=expected,
            obtained=obtained,
            tolerance=1e-9,
            note="measured: obviously with the swash angle, slightly with pressure; "
            f"{small:.2e}, {low:.2e}, {full:.2e} rad at 28 %, 10 MPa, both full",
            measured=Trend("block tilt", LICENCE),
        )


RISES = "the tilt of ref90 rises a little with speed; no drawing of the source says what tilts its block"
ALIKE = "it stays the same within the mesh's error"


def test_trends_of_another_code(validation):
    slow, fast, low = block(At(speed=1050.0)), block(At()), block(At(pressure=10.0))
    for what, before, expected in (
        ("1050 to 2100 r/min", slow, ((1.0, ""), (-1.0, ALIKE), (-1.0, RISES), (-1.0, ""))),
        ("10 to 35 MPa", low, ((-1.0, ""), (1.0, ""), (1.0, ""), (1.0, ""))),
    ):
        rows = (
            ("mean film", before.film, fast.film, "um"),
            ("swing of the film", before.film_swing, fast.film_swing, "um"),
            ("largest tilt", before.tilt, fast.tilt, "rad"),
            ("swing of the tilt", before.tilt_swing, fast.tilt_swing, "rad"),
        )
        for (quantity, was, now, unit), (sign, missed) in zip(rows, expected, strict=True):
            validation(
                case="Trends of the floating block with speed and pressure, ref90",
                source=CODE,
                quantity=f"sign of the change of the {quantity}, {what}",
                unit="1",
                expected=sign,
                obtained=np.sign(now - was),
                tolerance=1e-9,
                note=f"{was:.3g} and {now:.3g} {unit}",
                missed=missed,
            )
