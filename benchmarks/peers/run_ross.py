"""ROSS 3.1: bilinear finite elements of the whole bearing, to be run in its own environment.

Timed is `press`, the pressure of one pad: conductances from the viscosity across the film, matrix in bands, factors,
pressures and their gradients. `PlainJournal` makes mesh and film and calls `press`, whose arguments are taken there:
constant viscosity, no supply, and a pad of a turn less 1e-5, whose two ends have pressure zero. The vapour pressure is
set far below zero, for the full film of the other peers. Velocities are integrated over n layers of the film by the
trapezoidal rule, which errs by 1/n^2 (1 % with the default of 10): here n is half the number of cells round the
bearing, for a third of the error in the plane.
"""

from __future__ import annotations

import warnings
from dataclasses import replace
from importlib.metadata import version
from inspect import signature
from math import pi
from typing import NoReturn

import numpy as np
from peer import asked, least, report
from ross.bearings.fluid_film import pressure
from ross.bearings.lubricants import lubricants_dict
from ross.bearings.plain_journal import PlainJournal

CLEARANCE = 1e-3
NO_RUPTURE = -1e30


class Taken(Exception):
    """The arguments of the first call of `press`."""


def take(*values: object) -> NoReturn:
    """In place of `press`: ends the bearing's own run."""
    raise Taken(dict(zip(signature(solver).parameters, values, strict=True)))


case = asked()
solver, pressure.press = pressure.press, take
oil = lubricants_dict["ISOVG32"] | {"liquid_viscosity1": 1.0, "liquid_viscosity2": 1.0}
warnings.simplefilter("ignore")
try:
    PlainJournal(
        n=0,
        pad_axial_length=2.0,
        journal_diameter=2.0,
        radial_clearance=CLEARANCE,
        n_pads=1,
        pad_arc=2.0 * pi - 1e-5,
        oil_supply_temperature=313.15,
        speed=[1.0],
        fys_load=-1.0,
        lubricant=oil,
        oil_flow_v=1.0,
        thermal_type=None,
        initial_position=(-case.eccentricity, 0.0),
        total_ex_film=case.cells,
        total_ez_film=2 * case.rows,
        total_ey_film=2 * round(case.cells / 4),  # even, or ROSS refuses it
    )
except Taken as taken:
    film = taken.args[0]
film["operating"] = replace(film["operating"], press_cavitate=NO_RUPTURE)
mesh = film["mesh"]
solution, *_ = solver(**film)
seconds = least(lambda: solver(**film), case.repeats)

shape = case.cells + 1, 2 * case.rows + 1
angle, across, found = (np.reshape(field[0], shape) for field in (mesh.x_rad, mesh.z, solution))
line = np.trapezoid(np.maximum(found, 0.0), across, axis=1)
# Pressures go with viscosity x speed x radius / clearance^2.
along, beside = (float(CLEARANCE**2 * np.trapezoid(line * way(angle[:, 0]), angle[:, 0])) for way in (np.cos, np.sin))
report(version("ross-rotordynamics"), found.size, seconds, along, beside)
