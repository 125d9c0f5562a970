"""Efficiencies by name on one reading worked by hand."""

from __future__ import annotations

from math import isnan, pi

import numpy as np
import pytest

from reynolds import InputError
from system import load_pump
from system.pump.bench import BenchReading
from system.pump.efficiency import EfficiencyBasis, EfficiencyDefinition, efficiency

READING = BenchReading(100 * pi, 200.0, 20e6, 1e6, 0.0, 2.5e-3, 2.6e-3, 0.05e-3)
BASIS = EfficiencyBasis(READING, 1.6e9, swept=52e-6, toet=51e-6)
SHAFT = 200.0 * 100 * pi


@pytest.mark.parametrize(
    ("definition", "overall", "volumetric", "hydromechanical"),
    [
        (EfficiencyDefinition.PAPER, (50e3 - 2.6e3) / SHAFT, 2.5 / 2.6, (50e3 - 2.6e3) / SHAFT * 2.6 / 2.5),
        (EfficiencyDefinition.ISO_SWEPT, (50e3 - 2.6e3) / SHAFT, 2.5 / 2.6, 19e6 * 52e-6 / (2 * pi * 200)),
        (EfficiencyDefinition.ISO_TOET, (50e3 - 2.6e3) / SHAFT, 2.5 / 2.55, 19e6 * 51e-6 / (2 * pi * 200)),
    ],
)
def test_definitions_by_hand(definition, overall, volumetric, hydromechanical):
    found = efficiency(definition, BASIS)
    assert found.overall == pytest.approx(overall, rel=1e-12)
    assert found.volumetric == pytest.approx(volumetric, rel=1e-12)
    assert found.hydromechanical == pytest.approx(hydromechanical, rel=1e-12)


def test_the_two_by_energy_differ_by_compression():
    back, lost = (
        efficiency(one, BASIS)
        for one in (EfficiencyDefinition.ENERGY_RETURNED, EfficiencyDefinition.ENERGY_NOT_RETURNED)
    )
    elastic = 2.5e-3 * 20e6**2 / 3.2e9 - 2.6e-3 * 1e6**2 / 3.2e9
    assert (back.overall - lost.overall) * SHAFT == pytest.approx(elastic, rel=0.01)  # to first order in p/K
    assert lost.overall * SHAFT == pytest.approx(50e3 - 2.6e3, rel=1e-12)
    assert isnan(back.volumetric)
    assert isnan(lost.hydromechanical)


def test_toet_needs_its_displacement():
    with pytest.raises(InputError, match="no displacement by Toet"):
        efficiency(EfficiencyDefinition.ISO_TOET, EfficiencyBasis(READING, 1.6e9, 52e-6))


def test_names_are_unique_and_have_formulas():
    assert len({one.value for one in EfficiencyDefinition}) == 5
    assert len({one.formula for one in EfficiencyDefinition}) == 5
    assert EfficiencyDefinition("iso_4409_toet") is EfficiencyDefinition.ISO_TOET


def test_simulated_energies_are_those_of_the_power_balance():
    """The definitions read port flows alone; the solver's own balance says the same to its error."""
    from system import lumped_point, operating_point

    pump = load_pump("ref90")
    point = lumped_point(pump, operating_point(pump))
    basis = EfficiencyBasis(point.bench, pump.oil.bulk_modulus, point.derived_displacement)
    found = efficiency(EfficiencyDefinition.ENERGY_RETURNED, basis).overall
    expected = (point.power.hydraulic + point.power.elastic) / point.power.shaft
    assert found == pytest.approx(expected, rel=1e-9)
    assert np.isfinite(expected)
