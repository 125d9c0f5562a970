"""Oil in the volume behind a port over one period: inflow from the chambers, outflow into the line, pressure.

Mass over the density at zero gauge pressure, V exp(p/K) in a volume V of constant bulk modulus K, is kept:

    d/dt [V exp(p/K)] = inflow - exp(p/K) q_line(p) - draw,

integrated once, so that the oil received up to any shaft angle is that of the chambers' integration, with spikes
between the angles. M equidistant times in a period, from shaft angle 0; integrals by Fourier transform.
"""

from dataclasses import dataclass
from typing import assert_never

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.inputs.shown import pressure_text
from system.inputs.units import TURN
from system.pump.chamber.cycle import flow_energy
from system.pump.chamber.problem import ChamberProblem
from system.pump.ports.areas import orifice, orifice_coefficients
from system.pump.ports.lines import ImpedanceLine, OrificeLine

AREA_LIMIT = 50
AREA_TOLERANCE = 1e-13


@dataclass(frozen=True)
class Supply:
    """Inflow of a port from the chambers over one period (s), oil at zero gauge pressure.

    mean inflow in m3/s, negative at a suction port; surge (M,) m3, the inflow since shaft angle 0 beyond the mean; draw
    (M,) m3/s, from the port into films; open_volume m3 of the chambers open to it, mean.
    """

    period: float
    mean: float
    surge: Array
    draw: Array
    open_volume: float


@dataclass(frozen=True)
class LineFlow:
    """Flow of a line out of its port: flow (M,) m3/s at port pressure; area m2 of its orifice, if it has one.

    slope: d flow/d pressure in m3/(s Pa) of the harmonics 0 .. M/2.
    """

    flow: Array
    slope: NDArray[np.complex128]
    area: float | None


@dataclass(frozen=True)
class PortBalance:
    """A port's oil at a pressure (M,) Pa: the line's flow, the residual of the mass balance, the next pressure.

    rest (M,) m3 at zero gauge pressure: oil in the volume less the inflow, beyond the mean; mean_rest m3/s: outflow
    less inflow.
    """

    line: LineFlow
    rest: Array
    mean_rest: float
    next_pressure: Array


def port_balance(
    line: OrificeLine | ImpedanceLine, pressure: Array, wanted: float, supply: Supply, oil: ChamberProblem
) -> PortBalance:
    """Oil balance of a port at a pressure (M,), and a better pressure.

    `wanted` Pa: the mean that an orifice of free area, and the throttle of an impedance line, hold. The better pressure
    is Newton's, each harmonic k by itself: the rest over (V + open chambers) exp(p/K)/K + slope/(i k w). Exact except
    for the response of the chambers themselves.
    """
    taken = line_flow(line, pressure, supply, oil)
    dense = np.exp(pressure / oil.bulk_modulus)
    waves = np.arange(pressure.size // 2 + 1) * TURN / supply.period
    mass_flow = np.fft.rfft(dense * taken.flow + supply.draw)
    gone = np.zeros_like(mass_flow)
    gone[1:] = mass_flow[1:] / (1j * waves[1:])
    if pressure.size % 2 == 0:
        gone[-1] = 0.0  # the samples resolve only the cosine of the shortest wave, not its integral
    rest = np.fft.rfft(line.volume * dense - supply.surge) + gone
    mean_rest = float(mass_flow[0].real) / pressure.size - supply.mean
    step = np.zeros_like(rest)
    thickness = float(np.mean(dense))
    give = (line.volume + supply.open_volume) * thickness / oil.bulk_modulus
    step[1:] = -rest[1:] / (give + thickness * taken.slope[1:] / (1j * waves[1:]))
    rises = wanted - float(np.mean(pressure))
    if isinstance(line, OrificeLine) and line.area is not None:
        rises = -mean_rest / (thickness * float(taken.slope[0].real))
    rest[0] = 0.0
    return PortBalance(
        taken,
        np.fft.irfft(rest, pressure.size),
        mean_rest,
        np.asarray(pressure + np.fft.irfft(step, pressure.size) + rises),
    )


def line_flow(line: OrificeLine | ImpedanceLine, pressure: Array, supply: Supply, oil: ChamberProblem) -> LineFlow:
    """Flow of a line out of its port at a pressure (M,) Pa; raises NotConverged where no orifice passes it."""
    match line:
        case OrificeLine():
            return _orifice_flow(line, pressure, supply, oil)
        case ImpedanceLine():
            return _impedance_flow(line, pressure, supply, oil)
        case _:
            assert_never(line)


def line_power(flow: Array, pressure: Array, oil: ChamberProblem) -> float:
    """Mean power in W, pressure work and elastic energy, that a flow (M,) m3/s at pressures (M,) Pa carries."""
    mass_flow = flow * np.exp(pressure / oil.bulk_modulus)
    return float(np.mean(mass_flow * flow_energy(pressure, oil.bulk_modulus)))


def _orifice_flow(line: OrificeLine, pressure: Array, supply: Supply, oil: ChamberProblem) -> LineFlow:
    """Cd A sqrt(2 dp/rho), laminar near zero as in the pump's own ports (`ports.orifice_flow`)."""
    drop = pressure - line.tank_pressure
    area = _area_for(line, pressure, supply, oil) if line.area is None else line.area
    flow, slope = _through(area, drop, oil)
    return LineFlow(flow, np.full(pressure.size // 2 + 1, np.mean(slope), dtype=complex), area)


def _through(area: float, drop: Array, oil: ChamberProblem) -> tuple[Array, Array]:
    law = orifice_coefficients(area, oil.flow_coefficient, oil.density, oil.kinematic_viscosity, oil.critical_reynolds)
    flow, slope = np.array([orifice(one, *law) for one in drop]).T
    return flow, slope


def _area_for(line: OrificeLine, pressure: Array, supply: Supply, oil: ChamberProblem) -> float:
    """Area (m2) at which the line's flow equals the supply: the flow is nearly proportional to it."""
    dense, drop = np.exp(pressure / oil.bulk_modulus), pressure - line.tank_pressure
    needed = supply.mean - float(np.mean(supply.draw))
    area = 1e-5
    for _ in range(AREA_LIMIT):
        passed = float(np.mean(dense * _through(area, drop, oil)[0]))
        if not needed * passed > 0.0:
            break
        ratio = needed / passed
        area *= ratio
        if abs(ratio - 1.0) < AREA_TOLERANCE:
            return area
    raise NotConverged(
        f"orifice of a line: {needed * 6e4:.4g} L/min to pass at {pressure_text(float(np.mean(drop)))} over the tank, "
        "expected both of one sign; state the orifice's area, another tank pressure, or a held pressure"
    )


def _impedance_flow(line: ImpedanceLine, pressure: Array, supply: Supply, oil: ChamberProblem) -> LineFlow:
    """p/Z of each harmonic; the mean equals the supply."""
    orders = np.arange(1, pressure.size // 2 + 1)
    slope = np.zeros(orders.size + 1, dtype=complex)
    slope[1:] = 1.0 / line.impedance.at(orders / supply.period)
    waves = np.fft.irfft(slope * np.fft.rfft(pressure), pressure.size)
    dense = np.exp(pressure / oil.bulk_modulus)
    mean = (supply.mean - float(np.mean(supply.draw + dense * waves))) / float(np.mean(dense))
    return LineFlow(mean + waves, slope, None)
