"""The three gaps over one revolution at a given chamber pressure: a film solve at every shaft angle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gaps.piston import PistonGap
from gaps.result import GapFilm, PositionSource
from gaps.slipper import SlipperGap, SlipperPosition
from gaps.valve_plate import ValvePlateFilm, ValvePlateGap
from system.chamber_kernel import CAVITY_PRESSURE
from system.instants import (
    Rotor,
    piston_geometry,
    piston_instant,
    slipper_geometry,
    slipper_instant,
    valve_plate_geometry,
    valve_plate_instant,
)
from system.kinematics import Array

Report = Callable[[int, int, str], None]


def silent(done: int, total: int, what: str) -> None:
    """Report progress to nobody."""


@dataclass(frozen=True)
class GapCycle:
    """Films of one piston and one slipper at N shaft angles and of the ring at N/z block angles, SI.

    shaft_angle (N,) rad from inner dead centre; the ring's films stand at the first N/z of them, in which every
    chamber passes through all N. piston_flow, slipper_flow, valve_plate_flow (N,) m3/s leave one chamber at that
    angle for each gap; conductances (N,) m3/(s Pa) are their slopes with the chamber's pressure.
    """

    shaft_angle: Array
    chamber_pressure: Array
    piston: tuple[GapFilm, ...]
    slipper: tuple[GapFilm, ...]
    valve_plate: tuple[ValvePlateFilm, ...]
    valve_plate_flow: Array
    valve_plate_conductance: Array

    @property
    def flow(self) -> Array:
        """Flow out of one chamber into piston, slipper and valve-plate gap, (3, N) m3/s."""
        pairs = (self.piston, self.slipper)
        return np.array([*([g.chamber_flow for g in films] for films in pairs), self.valve_plate_flow])

    @property
    def conductance(self) -> Array:
        """Slope of `flow` with the chamber pressure, (3, N) m3/(s Pa)."""
        pairs = (self.piston, self.slipper)
        return np.array([*([g.conductance for g in films] for films in pairs), self.valve_plate_conductance])


class GapFilms:
    """The three gaps of a pump, meshed once and solved again and again."""

    def __init__(self, rotor: Rotor) -> None:
        self.rotor = rotor
        self._piston = PistonGap(piston_geometry(rotor.pump))
        self._slipper = SlipperGap(slipper_geometry(rotor.pump))
        self._valve_plate = ValvePlateGap(valve_plate_geometry(rotor.pump, rotor.drive.dead_centre_shift))

    def cycle(
        self,
        shaft_angle: Array,
        chamber_pressure: Array,
        before: GapCycle | None = None,
        report: Report = silent,
    ) -> GapCycle:
        """Solve all films at equidistant `shaft_angle` (N,), N a multiple of the pistons, and pressures (N,).

        `before`, a cycle at a nearby pressure, gives the start of each balance; a position that had no balance
        there is not searched again unless its pressure has changed by more than a thousandth.
        """
        # A chamber that cavitates stands within a kilopascal of the cavity's pressure; the films take it as that.
        chamber_pressure = np.maximum(chamber_pressure, CAVITY_PRESSURE)
        pistons: list[GapFilm] = []
        slippers: list[GapFilm] = []
        count = len(shaft_angle)
        positions = count // self.rotor.pump.pump.pistons
        total = 2 * count + positions
        for k in range(count):
            pistons.append(self._piston_at(k, shaft_angle, chamber_pressure, pistons, before))
            report(k + 1, total, "piston films")
        for k in range(count):
            slippers.append(self._slipper_at(k, shaft_angle, chamber_pressure, slippers, before))
            report(count + k + 1, total, "slipper films")
        ring: list[ValvePlateFilm] = []
        flow, conductance = np.empty(count), np.empty(count)
        for k in range(positions):
            chambers = k + positions * np.arange(self.rotor.pump.pump.pistons)
            state, given, press = valve_plate_instant(self.rotor, shaft_angle[k], chamber_pressure[chambers])
            ring.append(self._valve_plate.at(state, given, press))
            flow[chambers], conductance[chambers] = ring[-1].chamber_flows, ring[-1].conductances
            report(2 * count + k + 1, total, "valve-plate films")
        return GapCycle(
            shaft_angle, chamber_pressure, tuple(pistons), tuple(slippers), tuple(ring), flow, conductance
        )

    def _piston_at(
        self, k: int, angle: Array, pressure: Array, done: Sequence[GapFilm], before: GapCycle | None
    ) -> GapFilm:
        state, load, given = piston_instant(self.rotor, angle[k], pressure[k])
        if before is not None and _no_balance_again(before.piston[k], before.chamber_pressure[k], pressure[k]):
            return self._piston.again(before.piston[k], state, load, given)
        near = _near(k, done, before.piston if before else None)
        return self._piston.balanced(state, load, given, near)

    def _slipper_at(
        self, k: int, angle: Array, pressure: Array, done: Sequence[GapFilm], before: GapCycle | None
    ) -> GapFilm:
        state, load, given = slipper_instant(self.rotor, angle[k], pressure[k])
        if before is not None and _no_balance_again(before.slipper[k], before.chamber_pressure[k], pressure[k]):
            return self._slipper.again(before.slipper[k], state, load, given)
        near = _near(k, done, before.slipper if before else None)
        return self._slipper.balanced(state, load, given, None if near is None else SlipperPosition(*near))


def _no_balance_again(film: GapFilm, old: float, new: float) -> bool:
    return film.source is PositionSource.GIVEN and abs(new - old) <= 1e-3 * (abs(old) + 1e5)


def _near(k: int, done: Sequence[GapFilm], before: Sequence[GapFilm] | None) -> Array | None:
    """A balanced position to start from: the same angle's in the cycle before, else the last angle's."""
    candidates = [before[k]] if before else list(done[-1:])
    found = [film.position for film in candidates if film.source is PositionSource.BALANCE]
    return found[0] if found else None
