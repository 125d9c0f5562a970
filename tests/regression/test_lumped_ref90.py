"""The pump: REF90 with the lumped loss model.

What its description and the paper say a simulation of it must give, and what it gives instead where it does not.
"""

import numpy as np
import pytest
from bench_pump import BENCH

from system import Pair, PointWarning, PumpPoint, load_pump, lumped_point, operating_point, piston_area, piston_motion
from system.pump.bench import ideal_flow, ideal_torque
from system.pump.lumped import lumped_pairs

RPM = 2 * np.pi / 60
PUMP = load_pump(BENCH)
PRESSURES = (5e6, 10e6, 20e6, 35e6)
SPEEDS = (1000, 1300, 1700, 2100)
RANGES = {
    Pair.PISTON_CYLINDER: (21.35, 58.96),
    Pair.SLIPPER_SWASH_PLATE: (28.97, 53.25),
    Pair.VALVE_PLATE_CYLINDER: (5.97, 23.25),
}
FORCES = 1e-3
"""Mean torque from 360 sampled forces: the pressure bends by 35 MPa within 2 deg where a port opens, 15 deg from
the dead centre, and the trapezoidal rule errs by step^2/12 of the bends: 1e-4 to 1e-3 of the mean."""
PAPER, BY_HAND = "Xu, Hu, Zhang and Mao 2017, text", "REF90, worked out by hand"


def run(delivery: float = 35e6, rpm: float = 2100, ratio: float = 1.0, **more: float) -> PumpPoint:
    return lumped_point(
        PUMP, operating_point(PUMP, delivery_pressure=delivery, shaft_speed=rpm * RPM, displacement_ratio=ratio, **more)
    )


@pytest.fixture(scope="module")
def rated() -> PumpPoint:
    return run()


def test_ideal_values(validation, rated):
    volume = rated.geometric_displacement
    speed = rated.point.shaft_speed
    for quantity, unit, expected, obtained, rounding in (
        ("displacement", "mL/rev", 89.86, volume * 1e6, 0.005),
        ("geometric flow, 2100 r/min", "L/min", 188.7, ideal_flow(volume, speed) * 6e4, 0.05),
        ("ideal torque, 35 MPa", "N m", 500.5, ideal_torque(volume, 35e6), 0.05),
        ("ideal torque, 5 MPa", "N m", 71.5, ideal_torque(volume, 5e6), 0.05),
    ):
        validation(
            case="REF90 ideal values",
            source=BY_HAND,
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=obtained,
            tolerance=rounding,
        )


def test_quoted_leakage_of_rigid_parallel_films(validation, rated):
    # Half the chambers at 35 MPa above the case; the quoted figures are rounded to a unit of their last digit.
    chambers, rise = PUMP.pump.pistons / 2, 35e6
    slipper, plate = rated.leaks.conductance[1:, 0]
    for gap, expected, conductance in (("slipper", 0.363, slipper), ("valve plate", 0.155, plate)):
        obtained = float(conductance) * chambers * rise * 6e4
        assert obtained == pytest.approx(expected, rel=0.0125)
        validation(
            case="REF90 quoted leakage of rigid parallel films, 35 MPa, 50 degC",
            source=BY_HAND,
            quantity=gap,
            unit="L/min",
            expected=expected,
            obtained=obtained,
            tolerance=0.0005,
            missed="both quoted figures are 1.0 to 1.2 % above the closed forms (16), (17) at their own "
            "25.78 mPa s, half of the chambers under 35 MPa; they do not say where that comes from",
        )


def test_piston_leakage_of_the_description(validation, rated):
    validation(
        case="REF90 piston leakage as described, 35 MPa, 2100 r/min",
        source=BY_HAND,
        quantity="piston",
        unit="L/min",
        expected=0.314,
        obtained=rated.leakage_flow.piston * 6e4,
        relative_tolerance=0.015,
        note="eps = 0.6, engaged length shrinking with the stroke, chamber pressure over the revolution",
        missed="the quoted figure is near that of eps = 0.8 and a constant engaged length of 45 mm (0.310), not "
        "of the described eps = 0.6 and an engaged length that loses the stroke",
    )


def test_quoted_full_film_shear(validation, rated):
    nominal_plate = rated.pairs.valve_plate_cylinder.mean_viscous
    radii = (26.5e-3, 31.5e-3, 40.5e-3, 45.7e-3)
    lands = np.pi * (radii[1] ** 2 - radii[0] ** 2 + radii[3] ** 2 - radii[2] ** 2) * 36e-3**2
    integral = np.pi / 2 * (radii[1] ** 4 - radii[0] ** 4 + radii[3] ** 4 - radii[2] ** 4)
    for pair, expected, obtained, note, missed in (
        ("slippers", 957.0, rated.pairs.slipper_swash_plate.mean_viscous, "", ""),
        ("valve plate", 529.0, nominal_plate * integral / lands, "r^2 integrated over the lands, not R_v^2", ""),
        (
            "pistons",
            335.0,
            rated.pairs.piston_cylinder.mean_viscous,
            "eps = 0.6, engaged length shrinking with the stroke",
            "the quoted figure is that of eps = 0.8 and a constant engaged length of 45 mm (334.4)",
        ),
    ):
        validation(
            case="REF90 quoted shear of full films, 2100 r/min",
            source="REF90, worked out by hand",
            quantity=pair,
            unit="W",
            expected=expected,
            obtained=float(obtained),
            relative_tolerance=0.005,
            note=note,
            missed=missed,
        )


@pytest.fixture(scope="module")
def grid() -> dict[tuple[float, int], PumpPoint]:
    """The paper's operating range at full displacement, its pressures read as differences over the ports."""
    inlet = PUMP.operating.inlet_pressure
    return {(p, n): run(p + inlet, n) for p in PRESSURES for n in SPEEDS}


@pytest.mark.parametrize("pair", list(RANGES))
def test_shares_of_the_main_pairs(validation, grid, pair):
    low, high = RANGES[pair]
    shares = [100 * point.pairs.share(pair) for point in grid.values()]
    for quantity, obtained in (("least share", min(shares)), ("largest share", max(shares))):
        validation(
            case="REF90 shares of hydromechanical loss, pressure difference 5 .. 35 MPa, 1000 .. 2100 r/min",
            source=PAPER,
            quantity=f"{pair.value}, {quantity}",
            unit="%",
            expected=(low + high) / 2,
            obtained=obtained,
            tolerance=(high - low) / 2,
            note=f"range {low} .. {high}",
        )


def test_piston_share_at_a_delivery_pressure_of_5_mpa(validation):
    low, high = RANGES[Pair.PISTON_CYLINDER]
    validation(
        case="REF90 share of the piston-cylinder pair, delivery at 5 MPa gauge, 2100 r/min",
        source=PAPER,
        quantity="piston_cylinder",
        unit="%",
        expected=(low + high) / 2,
        obtained=100 * run(5e6).pairs.share(Pair.PISTON_CYLINDER),
        tolerance=(high - low) / 2,
        note=f"range {low} .. {high}",
        missed="5 MPa gauge leaves 2.5 MPa over the ports of a closed circuit; read as a pressure difference, as "
        "the paper says, the share is inside",
    )


def test_uppermost_pair_is_piston_or_slipper(grid):
    for point in grid.values():
        largest = max(Pair, key=point.pairs.share)
        assert largest in (Pair.PISTON_CYLINDER, Pair.SLIPPER_SWASH_PLATE)


def test_slipper_and_valve_plate_lead_at_low_displacement():
    for pressure in PRESSURES:
        pairs = run(pressure, 2100, 0.28).pairs
        ranked = sorted(Pair, key=pairs.share, reverse=True)
        assert ranked[:2] == [Pair.SLIPPER_SWASH_PLATE, Pair.VALVE_PLATE_CYLINDER]


def test_ball_guide_loss_does_not_know_the_pressure(validation):
    losses = [run(p).pairs.ball_guide_retainer.mean for p in PRESSURES]
    assert np.ptp(losses) == 0.0
    validation(
        case="REF90 ball guide-retainer share, 5 MPa, 2100 r/min",
        source=PAPER,
        quantity="share of hydromechanical loss",
        unit="%",
        expected=10.0,
        obtained=100 * run(5e6).pairs.share(Pair.BALL_GUIDE_RETAINER),
        tolerance=0.5,
        note="paper: nearly 10; 9.5 % at 1000 r/min",
        missed="with REF90's nominal films and coefficients the other pairs lose more at 5 MPa and 2100 r/min "
        "than the paper's Coulomb-only pairs, which carry no shear that grows with the square of speed",
    )


@pytest.mark.parametrize(
    ("delivery", "rpm", "ratio"),
    [(35e6, 2100, 1.0), (5e6, 2100, 1.0), (35e6, 1000, 0.28), (20e6, 1500, 0.13), (2.5e6, 2100, 1.0)],
)
def test_mass_and_energy_balances(delivery, rpm, ratio):
    point = run(delivery, rpm, ratio)
    assert point.checks.mass_balance_error < 1e-6
    assert point.checks.work_balance_error < 1e-6
    assert point.checks.energy_balance_error < FORCES
    assert point.checks.quadrature_error < 1e-3
    assert point.power.leakage.piston > 0.0
    density = point.cycle.outflow
    total = sum(float(getattr(density, k)) for k in ("delivery", "suction", "piston", "slipper", "valve_plate"))
    assert abs(total) < 1e-6 * abs(float(density.suction))


@pytest.mark.parametrize("ratio", [1.0, 0.3])
def test_derived_displacement_is_the_delivery_without_load(ratio):
    # ISO 8426: equal pressures everywhere, slow turning, high enough to keep the oil together.
    point = run(10e6, 300, ratio, inlet_pressure=10e6, case_pressure=10e6)
    found = point.bench.delivery_flow / (300 * RPM / (2 * np.pi))
    assert found == pytest.approx(point.derived_displacement, rel=5e-4)


def test_torque_without_losses_is_that_of_the_energy_delivered(rated):
    power = rated.power
    frictionless = power.shaft - power.friction - power.leakage.total - power.throttling
    bench = rated.bench
    ideal = bench.delivery_flow * 35e6 - bench.inlet_flow * 2.5e6
    # delivered oil keeps p/2K = 1.1 % more than p Q; the case returns next to nothing
    assert frictionless == pytest.approx(ideal * (1 + 35e6 / 2 / 1.6e9), rel=2e-3)


def test_efficiencies_are_ordered(rated):
    iso, paper = rated.iso_efficiency, rated.paper_efficiency
    assert iso.overall == pytest.approx(paper.overall, rel=1e-12)
    assert 0.8 < iso.overall < iso.volumetric < 1.0
    assert iso.volumetric < paper.volumetric  # Eq. (4) leaves most of the compression out


def test_part_displacement():
    """Where the plate pivots on the shaft axis half of the stroke set back is dead volume."""
    found = run(ratio=0.28)
    stroke = [displacement / (9 * piston_area(PUMP)) for displacement in (89.86e-6, found.geometric_displacement)]
    dead = PUMP.pump.dead_volume + piston_area(PUMP) * (stroke[0] - stroke[1]) / 2
    assert found.cycle.volume[0] == pytest.approx(dead, rel=1e-4)
    assert found.bench.delivery_flow * 6e4 == pytest.approx(46.53, rel=1e-4)
    assert found.iso_efficiency.overall == pytest.approx(0.7149, abs=5e-5)
    assert PointWarning.CHAMBER_OVERPRESSURE not in {remark.warning for remark in found.warnings}


def test_pairs_follow_the_pressures_they_are_given(rated):
    motion = piston_motion(PUMP, rated.point)
    again = lumped_pairs(PUMP, rated.point, motion, rated.cycle)
    assert again.power == pytest.approx(rated.pairs.power, rel=1e-14)
    assert rated.warnings, "the nominal port timing of REF90 pulls a vacuum after the suction port shuts"
