"""The machine on the bench: its lengths, its oil, and the scatter of each about the drawing."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
MM, UM, DEG, CELSIUS = 1e-3, 1e-6, np.pi / 180.0, 273.15
FILE = Path(__file__).with_name("ref90.toml")


@dataclass(frozen=True)
class Machine:
    """A pump with its oil, SI. Lengths follow ref90.toml; scale_* are factors on values of the drawing.

    clearance: (z,) factor of each piston's clearance; viscosity, slope: factor, and 1/K about 50 degC, on Vogel's
    law; stroke: factor on the displacement.
    """

    pistons: int
    swash: float
    cone: float
    diameter: float
    radius: float
    dead_volume: float
    piston_film: float
    slipper_film: float
    plate_film: float
    engaged: float
    overhang: float
    eccentricity: float
    askew: float
    stand_out_share: float
    slipper_radii: tuple[float, float]
    orifice: tuple[float, float]
    slipper_residual: float
    plate_radii: tuple[float, ...]
    plate_friction_radius: float
    plate_residual: float
    flow_coefficient: float
    port_angles: tuple[float, ...]
    groove: float
    kidney: float
    critical_reynolds: float
    mass: float
    guide: tuple[float, float, float]
    bearing_diameters: tuple[float, float]
    bearing_shares: tuple[float, float]
    joint_radius: float
    friction_piston: float
    friction_slipper: float
    friction_socket: float
    friction_plate: float
    friction_guide: float
    friction_front: float
    friction_rear: float
    vogel: tuple[float, float, float]
    density: float
    bulk_modulus: float
    specific_heat: float
    expansion: float
    viscosity: float = 1.0
    slope: float = 0.0
    stroke: float = 1.0
    clearance: tuple[float, ...] = (1.0,)

    @property
    def area(self) -> float:
        """Of a piston, m2."""
        return 0.25 * np.pi * self.diameter**2


TOLERANCE = {
    "piston_film": 0.08, "slipper_film": 0.08, "plate_film": 0.08, "bulk_modulus": 0.04, "viscosity": 0.02,
    "friction_piston": 0.15, "friction_slipper": 0.15, "friction_socket": 0.15, "friction_plate": 0.15,
    "friction_guide": 0.06, "friction_front": 0.10, "friction_rear": 0.10, "dead_volume": 0.02,
    "flow_coefficient": 0.05, "stroke": 0.001,
}  # fmt: skip
"""One sigma, of the logarithm, of values of the drawing; as stated and assumed by [tolerance] of the pump file."""
ABSOLUTE = {"eccentricity": 0.08, "slope": 0.0005}
"""One sigma of quantities that vary by an amount."""
UNLIKE = 0.03
"""One sigma by which the clearances of one pump's pistons differ."""
NUISANCES = (*TOLERANCE, *ABSOLUTE, "stand_out_share")


def ref90() -> Machine:
    """The machine as drawn."""
    data = tomllib.loads(FILE.read_text("utf-8"))
    film, slipper, plate, ports, oil = (data[name] for name in ("films", "slipper", "plate", "ports", "oil"))
    rubbing, guide = data["friction"], data["guide"]
    return Machine(
        pistons=data["pistons"], swash=data["swash_angle_deg"] * DEG, cone=data["cone_angle_deg"] * DEG,
        diameter=data["piston_diameter_mm"] * MM, radius=data["pitch_radius_mm"] * MM,
        dead_volume=data["dead_volume_cm3"] * 1e-6, piston_film=film["piston_um"] * UM,
        slipper_film=film["slipper_um"] * UM, plate_film=film["plate_um"] * UM, engaged=film["engaged_mm"] * MM,
        overhang=film["overhang_mm"] * MM, eccentricity=film["eccentricity"], askew=film["askew"],
        stand_out_share=film["stand_out_share"],
        slipper_radii=(slipper["inner_radius_mm"] * MM, slipper["outer_radius_mm"] * MM),
        orifice=(slipper["orifice_diameter_mm"] * MM, slipper["orifice_length_mm"] * MM),
        slipper_residual=slipper["residual_load"], plate_radii=tuple(one * MM for one in plate["radii_mm"]),
        plate_friction_radius=plate["friction_radius_mm"] * MM, plate_residual=plate["residual_load"],
        flow_coefficient=ports["flow_coefficient"], port_angles=tuple(one * DEG for one in ports["angle_deg"]),
        groove=ports["groove_mm2"] * 1e-6, kidney=ports["kidney_mm2"] * 1e-6,
        critical_reynolds=ports["critical_reynolds"], mass=data["masses"]["piston_and_slipper_kg"],
        guide=(guide["radius_mm"] * MM, guide["latitude_deg"] * DEG, guide["spring_N"]),
        bearing_diameters=tuple(one * MM for one in data["bearings"]["diameter_mm"]),
        bearing_shares=tuple(data["bearings"]["share"]), joint_radius=data["joint"]["radius_mm"] * MM,
        friction_piston=rubbing["piston"], friction_slipper=rubbing["slipper"], friction_socket=rubbing["socket"],
        friction_plate=rubbing["plate"], friction_guide=rubbing["guide"], friction_front=rubbing["bearings"][0],
        friction_rear=rubbing["bearings"][1], vogel=_vogel(oil["temperature_degC"], oil["viscosity_mPas"]),
        density=oil["density"], bulk_modulus=oil["bulk_modulus_GPa"] * 1e9, specific_heat=oil["specific_heat"],
        expansion=oil["expansion"],
    )  # fmt: skip


def drawn(machine: Machine, rng: np.random.Generator) -> Machine:
    """A machine of the series: everything within its tolerance, different pistons, any sealing length."""
    relative = {name: getattr(machine, name) * np.exp(sigma * rng.normal()) for name, sigma in TOLERANCE.items()}
    absolute = {name: getattr(machine, name) + sigma * rng.normal() for name, sigma in ABSOLUTE.items()}
    absolute["eccentricity"] = float(np.clip(absolute["eccentricity"], 0.3, 0.8))
    clearance = tuple(1.0 + UNLIKE * rng.normal(size=machine.pistons))
    share = float(rng.uniform())
    return replace(machine, **relative, **absolute, clearance=clearance, stand_out_share=share)


def viscosity_at(machine: Machine, temperature: Array) -> Array:
    """Dynamic viscosity in Pa s at temperatures in K: Vogel (1921), with the machine's factor and slope."""
    scale, rise, zero = machine.vogel
    own = machine.viscosity * np.exp(machine.slope * (temperature - CELSIUS - 50.0))
    return np.asarray(own * scale * np.exp(rise / (temperature - zero)))


def _vogel(celsius: list[float], viscosity: list[float]) -> tuple[float, float, float]:
    """a, b, c of a exp(b/(T - c)) through three points: c by bisection, the rest follows."""
    kelvin, level = np.array(celsius) + CELSIUS, np.log(np.array(viscosity) * 1e-3)

    def excess(zero: float) -> float:
        x = 1.0 / (kelvin - zero)
        return float((level[0] - level[1]) / (x[0] - x[1]) - (level[1] - level[2]) / (x[1] - x[2]))

    low, high = 100.0, kelvin[0] - 20.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(low) * excess(middle) > 0.0 else (low, middle)
    rise = (level[0] - level[2]) / (1.0 / (kelvin[0] - low) - 1.0 / (kelvin[2] - low))
    return float(np.exp(level[0] - rise / (kelvin[0] - low))), float(rise), float(low)
