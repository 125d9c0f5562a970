"""Lines on the ports of the pump: a held pressure, a volume that an orifice empties, a line of given impedance.

A line's flow is counted out of the port, m3/s of oil at the port's pressure; a suction line's is negative. The volume
belongs to the port: pipe and passages up to the orifice or the place at which the impedance was measured.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class HeldPressure:
    """A constant pressure: an infinite volume."""


@dataclass(frozen=True)
class OrificeLine:
    """A volume (m3) that an orifice of `area` (m2) joins to a tank at a pressure (Pa gauge).

    area None: the one with which the port keeps its stated mean pressure.
    """

    volume: float
    tank_pressure: float
    area: float | None = None

    def __post_init__(self) -> None:
        _hold("orifice line, volume", self.volume, self.volume > 0.0, "m3", "above 0")
        if self.area is not None:
            _hold("orifice line, area", self.area, self.area > 0.0, "m2", "above 0")


@dataclass(frozen=True)
class Impedance:
    """Z = pressure over flow into the line by harmonics, Pa s/m3, at rising frequencies (Hz); between them linear.

    Complex amplitudes of exp(+i w t). Raises ValueError for fewer than two frequencies, those that do not rise
    from above zero, other shapes, or Z = 0.
    """

    frequency: Array
    value: NDArray[np.complex128]

    def __post_init__(self) -> None:
        rises = (
            self.frequency.ndim == 1 and self.frequency.size > 1 and np.all(np.diff(self.frequency, prepend=0.0) > 0.0)
        )
        if not rises or self.value.shape != self.frequency.shape or np.any(self.value == 0.0):
            raise ValueError(
                f"impedance: found {self.frequency.size} frequencies and {self.value.size} values, expected as "
                "many, two or more, frequencies rising from above zero and no value zero"
            )

    def at(self, frequency: Array) -> NDArray[np.complex128]:
        """Z at frequencies in Hz; raises ValueError outside the table."""
        lowest, highest = self.frequency[0], self.frequency[-1]
        if frequency.min() < lowest or frequency.max() > highest:
            raise ValueError(
                f"impedance: found a table from {lowest:.4g} to {highest:.4g} Hz, expected one that holds "
                f"{frequency.min():.4g} to {frequency.max():.4g} Hz, the harmonics of the pump's ripple"
            )
        real, imaginary = (np.interp(frequency, self.frequency, part(self.value)) for part in (np.real, np.imag))
        return np.asarray(real + 1j * imaginary)


@dataclass(frozen=True)
class ImpedanceLine:
    """A volume (m3, 0: none), behind it a line known by its impedance; throttling holds the mean pressure."""

    volume: float
    impedance: Impedance

    def __post_init__(self) -> None:
        _hold("impedance line, volume", self.volume, self.volume >= 0.0, "m3", "0 or more")


Line = HeldPressure | OrificeLine | ImpedanceLine


@dataclass(frozen=True)
class Lines:
    """Lines on delivery and suction port."""

    delivery: Line = HeldPressure()
    suction: Line = HeldPressure()


def _hold(where: str, found: float, holds: bool, unit: str, expected: str) -> None:
    if not holds:
        raise ValueError(f"{where}: found {found:.3g} {unit}, expected {expected}")
