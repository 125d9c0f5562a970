"""The steady points of a test bench, as arrays: what a simulator of a whole map is asked for."""

from __future__ import annotations

from dataclasses import dataclass

from system.kinematics import Array


@dataclass(frozen=True)
class BenchPoints:
    """N steady points: speed in rad/s, pressures in Pa gauge, temperatures in K, hours run in h; arrays (N,).

    `order` is the place of a point in the sequence in which the points were taken, from 0.
    """

    speed: Array
    displacement_ratio: Array
    p_out: Array
    p_in: Array
    p_case: Array
    T_case: Array
    T_in: Array
    hours: Array
    order: Array
