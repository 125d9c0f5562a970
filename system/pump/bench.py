"""Losses and efficiencies from bench readings.

Eqs. (1)-(5) of Xu, Hu, Zhang and Mao (2017), ISO 4391/4409, and an energy-exact split."""

from dataclasses import dataclass, fields
from typing import Generic

import numpy as np

from system.pump.laws.kinematics import Number


@dataclass(frozen=True)
class BenchReading(Generic[Number]):
    """One steady reading: shaft_speed in rad/s, shaft_torque in N m, pressures in Pa gauge, flows in m3/s.

    Each flow is the volume at its own port's pressure, positive in the pump's sense: delivery and drain out of it,
    inlet into it. BenchReading[Array]: N readings, arrays (N,).
    """

    shaft_speed: Number
    shaft_torque: Number
    delivery_pressure: Number
    inlet_pressure: Number
    drain_pressure: Number
    delivery_flow: Number
    inlet_flow: Number
    drain_flow: Number

    @property
    def shaft_power(self) -> Number:
        """2 pi n T in W."""
        return self.shaft_speed * self.shaft_torque

    @property
    def ports(self) -> tuple[tuple[Number, Number], ...]:
        """Flow out of the pump and pressure, of delivery, inlet and drain."""
        return (
            (self.delivery_flow, self.delivery_pressure),
            (-self.inlet_flow, self.inlet_pressure),
            (self.drain_flow, self.drain_pressure),
        )


@dataclass(frozen=True)
class Outside(Generic[Number]):
    """Flows, torque and power past a pump's chambers; Outside[Array]: at N points, arrays (N,).

    Added to delivery, inlet and drain flow in m3/s and to the shaft's torque in N m; carried_off in W: sink of the
    power of flows and torque; delivery_reading: factor on the flow that the delivery's meter reads; suction_loss: Pa
    that the inlet loses between its gauge and the suction port.
    """

    delivery: Number
    inlet: Number
    drain: Number
    torque: Number
    carried_off: Number
    delivery_reading: Number
    suction_loss: Number


NOTHING_OUTSIDE: Outside[float] = Outside(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)


@dataclass(frozen=True)
class Efficiency:
    """Overall, volumetric and hydromechanical efficiency, dimensionless."""

    overall: float
    volumetric: float
    hydromechanical: float


EFFICIENCIES = tuple(part.name for part in fields(Efficiency))
"""Names of the three efficiencies."""


@dataclass(frozen=True)
class LossSplit:
    """The paper's two losses in W, Eqs. (1) and (2)."""

    volumetric: float
    hydromechanical: float

    @property
    def hydromechanical_share(self) -> float:
        """Share of the hydromechanical in both losses, as in the paper's Fig. 3."""
        return self.hydromechanical / (self.volumetric + self.hydromechanical)


@dataclass(frozen=True)
class EnergySplit:
    """Split of the shaft power in W: the four fields add up to it exactly.

    `hydraulic` is p Q summed over the ports; `elastic` the energy stored in the oil they pass, which a machine
    downstream can recover; `leakage` the loss of the drained oil on its path; `hydromechanical` the rest.
    """

    hydraulic: float
    elastic: float
    leakage: float
    hydromechanical: float


def ideal_torque(displacement: float, pressure_difference: float) -> float:
    """Torque in N m of a lossless pump: dp V/(2 pi), V in m3 per revolution, dp in Pa."""
    return displacement * pressure_difference / (2.0 * np.pi)


def ideal_flow(displacement: float, shaft_speed: float) -> float:
    """Flow in m3/s of a lossless pump: n V, V in m3 per revolution, shaft_speed in rad/s."""
    return displacement * shaft_speed / (2.0 * np.pi)


def paper_losses(reading: BenchReading) -> LossSplit:
    """The paper's Eqs. (1), (2) as printed.

    Eq. (1) charges the compression flow Q_i - Q_o - Q_drain with the whole pressure difference, Q_o dp^2/K: twice the
    elastic energy (at no inlet pressure) that the delivered oil carries and may give back. The excess in Eq. (1) is
    missing in Eq. (2). `energy_split` keeps the three apart.
    """
    r = reading
    drained = r.drain_flow * (r.delivery_pressure - r.drain_pressure)
    compressed = (r.inlet_flow - r.delivery_flow - r.drain_flow) * (r.delivery_pressure - r.inlet_pressure)
    volumetric = drained + compressed
    given = r.shaft_power + r.inlet_pressure * r.inlet_flow - r.delivery_pressure * r.delivery_flow
    return LossSplit(volumetric, given - volumetric)


def paper_efficiency(reading: BenchReading) -> Efficiency:
    """The paper's Eqs. (3)-(5) as printed.

    Eq. (4), 1 - (Q_i - Q_o)/Q_i, compares flows at different pressures: it is not ISO 4409's. Raises ValueError where a
    ratio is not defined: no shaft power, inlet or delivery flow.
    """
    r = reading
    overall = _overall(r)
    if not (r.inlet_flow > 0.0 and r.delivery_flow > 0.0):
        raise ValueError(
            f"inlet flow {r.inlet_flow:.3g} m3/s and delivery flow {r.delivery_flow:.3g} m3/s: expected both "
            "above 0 for the paper's efficiencies"
        )
    volumetric = 1.0 - (r.inlet_flow - r.delivery_flow) / r.inlet_flow
    return Efficiency(overall, volumetric, overall / volumetric)


def iso_efficiency(reading: BenchReading, derived_displacement: float) -> Efficiency:
    """Efficiencies of ISO 4391 as measured by ISO 4409, with the derived displacement V_i of ISO 8426 (m3/rev).

    Overall (p2 q2 - p1 q1)/(2 pi n T), volumetric q2/(n V_i), hydromechanical (p2 - p1) V_i/(2 pi T). Their product
    differs from the overall one by p1 (q1 - q2) over the shaft power. Raises ValueError without shaft power.
    """
    r = reading
    overall = _overall(r)
    return Efficiency(
        overall,
        r.delivery_flow / ideal_flow(derived_displacement, r.shaft_speed),
        ideal_torque(derived_displacement, r.delivery_pressure - r.inlet_pressure) / r.shaft_torque,
    )


def energy_split(reading: BenchReading, bulk_modulus: float) -> EnergySplit:
    """Shaft power split without charging the compression energy that the delivered oil keeps.

    With constant bulk modulus K (Pa) oil holds e(p) = K (exp(p/K) - 1) - p per volume, p^2/(2K) for p << K. Assumption:
    every drained volume was raised to the delivery pressure first, as in Eq. (1).
    """
    r = reading
    hydraulic = sum(flow * pressure for flow, pressure in r.ports)
    elastic = sum(flow * elastic_energy(pressure, bulk_modulus) for flow, pressure in r.ports)
    fall = r.delivery_pressure - r.drain_pressure
    leakage = -r.drain_flow * bulk_modulus * float(np.expm1(-fall / bulk_modulus))
    return EnergySplit(hydraulic, elastic, leakage, r.shaft_power - hydraulic - elastic - leakage)


def elastic_energy(pressure: float, bulk_modulus: float) -> float:
    """Elastic energy in J per m3 of oil at a gauge pressure: K (exp(p/K) - 1) - p, for constant bulk modulus."""
    return float(bulk_modulus * np.expm1(pressure / bulk_modulus) - pressure)


def of_shaft_power(reading: BenchReading, useful: float) -> float:
    """Useful power (W) over the shaft power. Raises ValueError without shaft power."""
    if not reading.shaft_power > 0.0:
        raise ValueError(f"shaft power {reading.shaft_power:.3g} W: expected more than 0 for an efficiency")
    return useful / reading.shaft_power


def _overall(reading: BenchReading) -> float:
    r = reading
    return of_shaft_power(r, r.delivery_flow * r.delivery_pressure - r.inlet_flow * r.inlet_pressure)
