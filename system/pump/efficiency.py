"""Efficiencies by the name of their definition: the only source of plotted or compared efficiencies."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import nan

from reynolds.errors import InputError
from system.pump.bench import BenchReading, Efficiency, energy_split, iso_efficiency, of_shaft_power, paper_efficiency


class EfficiencyDefinition(Enum):
    """A definition: its name in files, its label, and its formula in words of a plot's title.

    1 inlet, 2 delivery, 3 case; Q, p at the port; E elastic energy of the oil passing the ports.
    """

    PAPER = ("paper", "the paper's Eqs. (3)-(5)", "(p2 Q2 - p1 Q1)/(w T), Q2/Q1")
    ISO_SWEPT = ("iso_4409_swept", "ISO 4409, swept displacement", "(p2 Q2 - p1 Q1)/(w T), Q2/(n V), V swept")
    ISO_TOET = ("iso_4409_toet", "ISO 4409, displacement by Toet", "(p2 Q2 - p1 Q1)/(w T), Q2/(n V), V by ISO 8426-1")
    ENERGY_RETURNED = ("energy_returned", "energy, compression given back", "(sum p Q + E)/(w T)")
    ENERGY_NOT_RETURNED = ("energy_not_returned", "energy, compression lost", "(sum p Q)/(w T)")

    label: str
    formula: str

    def __new__(cls, name: str, label: str, formula: str) -> EfficiencyDefinition:
        """A member whose value is its name alone."""
        member = object.__new__(cls)
        member._value_ = name
        member.label, member.formula = label, formula
        return member


@dataclass(frozen=True)
class EfficiencyBasis:
    """Input of every definition: a reading, the oil's bulk modulus (Pa), and derived displacements (m3/rev).

    swept: by the geometry of pistons and ports (`lumped.swept_displacement`); toet: by readings, None
    without them.
    """

    reading: BenchReading
    bulk_modulus: float
    swept: float
    toet: float | None = None


def efficiency(definition: EfficiencyDefinition, basis: EfficiencyBasis) -> Efficiency:
    """The efficiencies of a definition; volumetric and hydromechanical are nan if not defined.

    The two by energy differ by E/(w T): the share of the shaft power that the oil carries as compression. Raises
    ValueError where a ratio is not defined, InputError for Toet's without its displacement.
    """
    reading = basis.reading
    match definition:
        case EfficiencyDefinition.PAPER:
            return paper_efficiency(reading)
        case EfficiencyDefinition.ISO_SWEPT:
            return iso_efficiency(reading, basis.swept)
        case EfficiencyDefinition.ISO_TOET:
            if basis.toet is None:
                raise InputError("efficiency", "no displacement by Toet", "one derived from a map's readings")
            return iso_efficiency(reading, basis.toet)
        case _:
            return _by_energy(reading, basis.bulk_modulus, definition is EfficiencyDefinition.ENERGY_RETURNED)


def _by_energy(reading: BenchReading, bulk_modulus: float, returned: bool) -> Efficiency:
    split = energy_split(reading, bulk_modulus)
    return Efficiency(of_shaft_power(reading, split.hydraulic + (split.elastic if returned else 0.0)), nan, nan)
