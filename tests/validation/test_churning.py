"""Churning: measured torque of a cylinder that turns in a housing, over speed.

Donnelly and Simon 1960 evaluate the torques that Wendt, Taylor and Donnelly measured on cylinders turning in cylinders
at rest. Well beyond the speed at which vortices begin the torque goes as a power of speed, for which they state one
exponent for all gaps. The law of `churning` is that of the barrel.
"""

from __future__ import annotations

import numpy as np
import pytest
from bench_pump import BENCH
from measured import Measured, Uncertainty, at_least, within

from reynolds import dynamic_viscosity
from system import BenchState, load_pump
from system.effects.laws.drag import barrel_torque

SPEEDS = (1000.0, 1900.0)
"""r/min between which the barrel of ref90 in oil of 40 to 60 degC has vortices and is below Re 1e4."""


def exponent(kelvin: float) -> float:
    """d ln torque/d ln speed of the barrel in oil of this temperature."""
    pump = load_pump(BENCH)
    ends, ones = np.array(SPEEDS) * np.pi / 30.0, np.ones(2)
    viscosity = dynamic_viscosity(pump.oil.fluid, kelvin) * ones
    state = BenchState(ends, ones, 35e6 * ones, 2.5e6 * ones, 0.0 * ones, viscosity, kelvin * ones, 0.0 * ones, pump)
    low, high = barrel_torque(state)
    return float(np.log(high / low) / np.log(ends[1] / ends[0]))


def test_torque_over_speed(validation):
    assert exponent(313.15) == pytest.approx(exponent(333.15))
    validation(
        case="Cylinder turning in a housing, vortices",
        source="Donnelly and Simon 1960, J. Fluid Mech. 7, 401, abstract: measured by Wendt, Taylor and Donnelly",
        quantity="exponent of speed of the torque",
        unit="1",
        expected=1.51,
        obtained=exponent(323.15),
        tolerance=0.02,
        note="tolerance: the source says approximately; the law has Wendt's exponent, not one of its own",
        measured=Measured(
            "churning",
            "number of an abstract, cited as a fact",
            at_least(within(0.005, "approximately, no uncertainty is stated; 0.01, the last digit")),
            Uncertainty(0.0, "none: below Re 1e4 the exponent depends neither on the oil nor on the gap"),
            Uncertainty(0.0, "closed form"),
        ),
    )
