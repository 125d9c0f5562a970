"""The drawing of the bench pump in the second plant, and machines of the series."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from .oil import Oil

MM, UM = 1e-3, 1e-6


@dataclass(frozen=True)
class Pump:
    """Lengths in m, angles in rad, coefficients; films and clearances as mounted.

    stroke: factor on the displacement; held_out: share of the retracted stroke that shortens the piston's guide.
    """

    pistons: int = 9
    tilt: float = np.radians(16.2)
    cone: float = np.radians(5.0)
    bore: float = 22.0 * MM
    pitch: float = 45.0 * MM
    dead_volume: float = 6.0e-6
    piston_film: float = 15.0 * UM
    slipper_film: float = 10.0 * UM
    plate_film: float = 8.0 * UM
    guide: float = 45.0 * MM
    overhang: float = 18.0 * MM
    eccentricity: float = 0.6
    held_out: float = 0.5
    pocket: float = 8.2 * MM
    pad: float = 14.0 * MM
    orifice: float = 0.9 * MM
    orifice_length: float = 5.0 * MM
    lands: tuple[float, float, float, float] = (26.5 * MM, 31.5 * MM, 40.5 * MM, 45.7 * MM)
    plate_radius: float = 36.0 * MM
    clamping: float = 0.15
    groove: float = 4.0e-6
    kidney: float = 152.0e-6
    flow_coefficient: float = 0.7
    mass: float = 0.21
    ball: float = 8.0 * MM
    ring: float = 22.0 * MM
    latitude: float = np.radians(30.0)
    spring: float = 1080.0
    shafts: tuple[float, float] = (60.0 * MM, 45.0 * MM)
    shares: tuple[float, float] = (0.62, 0.38)
    friction_piston: float = 0.026
    friction_slipper: float = 0.0062
    friction_socket: float = 0.02
    friction_plate: float = 0.01
    friction_guide: float = 0.12
    friction_front: float = 0.001
    friction_rear: float = 0.001
    viscosity: float = 1.0
    slope: float = 0.0
    bulk_modulus: float = 1.6e9
    stroke: float = 1.0

    @property
    def area(self) -> float:
        """Of a piston, m2."""
        return 0.25 * np.pi * self.bore**2

    def oil(self, air: float) -> Oil:
        """The oil in this machine, with bubbles."""
        return Oil(modulus=self.bulk_modulus, viscosity=self.viscosity, slope=self.slope, air=air)


TOLERANCE = {
    "piston_film": 0.08, "slipper_film": 0.08, "plate_film": 0.08, "bulk_modulus": 0.04, "viscosity": 0.02,
    "friction_piston": 0.15, "friction_slipper": 0.15, "friction_socket": 0.15, "friction_plate": 0.15,
    "friction_guide": 0.06, "friction_front": 0.10, "friction_rear": 0.10, "dead_volume": 0.02,
    "flow_coefficient": 0.05, "stroke": 0.001,
}  # fmt: skip
"""One sigma of the logarithm, as stated in the pump file or assumed."""
SPREAD = {"eccentricity": 0.08, "slope": 0.0005, "held_out": 0.5}
"""One sigma of quantities that vary by an amount."""


def drawn(rng: np.random.Generator) -> Pump:
    """A machine of the series: all within its tolerance, eccentricity from .3 to .8."""
    pump = Pump()
    near = {name: getattr(pump, name) * np.exp(sigma * rng.normal()) for name, sigma in TOLERANCE.items()}
    eccentric = float(np.clip(pump.eccentricity + SPREAD["eccentricity"] * rng.normal(), 0.3, 0.8))
    slope = SPREAD["slope"] * rng.normal()
    return replace(pump, **near, eccentricity=eccentric, slope=slope, held_out=float(rng.uniform()))


def varied(pump: Pump, name: str, sigmas: float) -> Pump:
    """The machine with one of its uncertain parts wrong by some sigma of its tolerance."""
    value = getattr(pump, name)
    if name in TOLERANCE:
        return replace(pump, **{name: value * float(np.exp(sigmas * TOLERANCE[name]))})
    return replace(pump, **{name: value + sigmas * SPREAD[name]})


UNCERTAIN = tuple(one.name for one in fields(Pump) if one.name in TOLERANCE or one.name in SPREAD)
