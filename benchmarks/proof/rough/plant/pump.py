"""A pump of any size with its oil: values of its type plate, and unknown ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
RPM = 2.0 * np.pi / 60.0
TURN = 2.0 * np.pi
MIDDLE, FULL = 20.0e6, 30.0e6  # Pa
VOGEL = 103.0  # degC
GRADES = {32: (32.0, 5.4), 46: (46.0, 6.8), 68: (68.0, 8.7)}  # mm2/s at 40 and 100 degC


@dataclass(frozen=True)
class Pump:
    """SI. plate: displacement as stated; displacement: the true one; dead: dead volume of all chambers over it.

    leak: flow into the case over V p/(2 pi mu); coulomb: torque over V p/(2 pi); viscous: torque over mu w V; fixed: N
    m; unrecovered: share of the compression work that the ports return; grade: ISO VG; viscosity: factor on it, slope:
    1/K on that about 40 degC. Of one make and another: leakage grows with the power 1 + bend of pressure and -1 + slack
    of viscosity, Coulomb torque with 1 + rub of pressure.
    """

    pistons: int
    plate: float
    displacement: float
    dead: float
    speed: float
    leak: float
    coulomb: float
    viscous: float
    fixed: float
    recovered: float
    modulus: float
    grade: int
    viscosity: float
    slope: float
    bend: float
    slack: float
    rub: float
    density: float = 865.0

    def thick(self, celsius: Array) -> Array:
        """Dynamic viscosity (Pa s) by Vogel's law (1921), pole at -103 degC, through 40 and 100 degC."""
        cold, hot = GRADES[self.grade]
        fall = np.log(cold / hot) / (1.0 / (40.0 + VOGEL) - 1.0 / (100.0 + VOGEL))
        nu = cold * np.exp(fall * (1.0 / (celsius + VOGEL) - 1.0 / (40.0 + VOGEL)))
        own = self.viscosity * np.exp(self.slope * (celsius - 40.0))
        return np.asarray(1e-6 * self.density * own * nu)


MAKE = {"slope": 0.0007, "bend": 0.03, "slack": 0.03, "rub": 0.05}
"""One sigma of quantities that differ by an amount from make to make."""


def drawn(rng: np.random.Generator) -> Pump:
    """A pump of 5 to 11 pistons, 10 to 250 cm3 a turn; the larger, the slower its motor."""
    size = float(np.exp(rng.uniform(np.log(10.0), np.log(250.0))))
    plate = round(size) * 1e-6 if size > 20.0 else round(size, 1) * 1e-6
    able = [rpm for rpm in (970.0, 1480.0, 1780.0, 2950.0) if rpm * size ** (1.0 / 3.0) < 8500.0]
    speed = float(rng.choice(able)) * RPM
    grade = int(rng.choice((32, 46, 46, 68)))
    share = float(rng.uniform(0.015, 0.05))  # of the flow that leaks at 24 MPa and 40 degC
    thick = 1e-6 * 865.0 * GRADES[grade][0]
    return Pump(
        pistons=int(rng.choice((5, 7, 9, 11))), plate=plate, displacement=plate * float(np.exp(0.004 * rng.normal())),
        dead=float(rng.uniform(0.4, 0.8)), speed=speed, leak=share * speed * thick / 24.0e6,
        coulomb=float(rng.uniform(0.015, 0.04)), viscous=float(np.exp(rng.normal(np.log(1.2e5), 0.3))),
        fixed=float(rng.uniform(0.5, 1.5)) * (plate / 9e-5), recovered=float(rng.uniform(0.05, 0.2)),
        modulus=1.6e9 * float(np.exp(0.05 * rng.normal())), grade=grade,
        viscosity=float(np.exp(0.03 * rng.normal())), slope=float(0.0005 * rng.normal()),
        **{name: float(sigma * rng.normal()) for name, sigma in MAKE.items() if name != "slope"},
    )  # fmt: skip


UNCERTAIN = {
    "displacement": 0.01, "dead": 0.3, "leak": 0.7, "coulomb": 0.6, "viscous": 0.6, "fixed": 1.0, "recovered": 0.5,
    "modulus": 0.1, "viscosity": 0.05,
}  # fmt: skip
"""One sigma, of the logarithm, of the unknowns of such a pump."""
