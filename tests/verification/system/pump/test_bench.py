"""Bench equations on machines whose losses are known in closed form."""

from dataclasses import replace

import numpy as np
import pytest

from system.pump import bench
from system.pump.chamber.cycle import flow_energy

K = 1.6e9
DISPLACEMENT = 89.86e-6
SPEED = 2100.0 * 2 * np.pi / 60
HIGH, LOW, CASE = 35e6, 2.5e6, 0.15e6


def lossless(bulk_modulus: float) -> bench.BenchReading:
    """Takes in n V at LOW, delivers the same mass at HIGH, spends just its flow energy."""
    inlet = bench.ideal_flow(DISPLACEMENT, SPEED)
    at_zero = inlet * np.exp(LOW / bulk_modulus)
    power = at_zero * float(flow_energy(HIGH, bulk_modulus) - flow_energy(LOW, bulk_modulus))
    delivery = at_zero * np.exp(-HIGH / bulk_modulus)
    return bench.BenchReading(SPEED, power / SPEED, HIGH, LOW, CASE, delivery, inlet, 0.0)


def test_ideal_values_of_ref90():
    assert bench.ideal_flow(DISPLACEMENT, SPEED) * 60e3 == pytest.approx(188.7, abs=0.05)
    assert bench.ideal_torque(DISPLACEMENT, 35e6) == pytest.approx(500.5, abs=0.1)
    assert bench.ideal_torque(DISPLACEMENT, 5e6) == pytest.approx(71.5, abs=0.05)


def test_a_lossless_pump_has_no_loss_in_the_energy_split():
    split = bench.energy_split(lossless(K), K)
    assert split.leakage == 0.0
    assert split.hydromechanical == pytest.approx(0.0, abs=1e-9 * lossless(K).shaft_power)
    assert split.hydraulic + split.elastic == pytest.approx(lossless(K).shaft_power, rel=1e-12)


def test_the_paper_charges_compression_twice_and_friction_short():
    reading = lossless(K)
    losses = bench.paper_losses(reading)
    squeezed = reading.delivery_flow * (HIGH - LOW) ** 2 / K
    # to first order in dp/K = 2 %
    assert losses.volumetric == pytest.approx(squeezed, rel=0.02)
    elastic = bench.energy_split(reading, K).elastic
    assert elastic == pytest.approx(reading.delivery_flow * (HIGH**2 - LOW**2) / (2 * K), rel=0.02)
    assert losses.volumetric + losses.hydromechanical == pytest.approx(elastic, rel=1e-9)
    assert losses.hydromechanical < -0.4 * squeezed


def test_stiff_oil_makes_every_efficiency_one():
    reading = lossless(1e15)
    for efficiency in (bench.paper_efficiency(reading), bench.iso_efficiency(reading, DISPLACEMENT)):
        for value in (efficiency.overall, efficiency.volumetric, efficiency.hydromechanical):
            assert value == pytest.approx(1.0, abs=1e-7)


def test_leakage_and_friction_are_told_apart():
    leak, friction = 2e-5, 3000.0
    stiff = lossless(1e15)
    reading = replace(
        stiff,
        delivery_flow=stiff.delivery_flow - leak,
        drain_flow=leak,
        shaft_torque=stiff.shaft_torque + friction / SPEED,
    )
    split = bench.energy_split(reading, 1e15)
    assert split.leakage == pytest.approx(leak * (HIGH - CASE), rel=1e-6)
    assert split.hydromechanical == pytest.approx(friction, rel=1e-4)
    losses = bench.paper_losses(reading)
    assert losses.volumetric == pytest.approx(leak * (HIGH - CASE), rel=1e-4)
    # Eqs. (1) + (2) forget the p Q that leaves by the drain: it stays in the hydromechanical loss
    assert losses.hydromechanical == pytest.approx(friction + leak * CASE, rel=1e-4)
    iso, paper = bench.iso_efficiency(reading, DISPLACEMENT), bench.paper_efficiency(reading)
    assert iso.volumetric == pytest.approx(1 - leak / stiff.delivery_flow, rel=1e-6)
    assert paper.volumetric == pytest.approx(iso.volumetric, rel=1e-6)
    assert iso.hydromechanical == pytest.approx(1 - friction / reading.shaft_power, rel=1e-6)
    product = iso.volumetric * iso.hydromechanical
    gap = LOW * (reading.inlet_flow - reading.delivery_flow) / reading.shaft_power
    assert product - gap == pytest.approx(iso.overall, rel=1e-6)


@pytest.mark.parametrize("change", [{"shaft_torque": 0.0}, {"inlet_flow": 0.0}, {"delivery_flow": -1e-6}])
def test_a_void_ratio_is_refused(change):
    with pytest.raises(ValueError, match="expected"):
        bench.paper_efficiency(replace(lossless(K), **change))


def test_elastic_energy_is_the_work_of_compression():
    pressure = np.linspace(0.0, 50e6, 20001)
    # per volume at pressure: integral of p (-dv) / v with v = exp(-p/K)
    work = np.trapezoid(pressure * np.exp(-pressure / K) / K, pressure) / np.exp(-50e6 / K)
    assert bench.elastic_energy(50e6, K) == pytest.approx(work, rel=1e-8)
