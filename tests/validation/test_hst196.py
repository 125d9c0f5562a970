"""Volumetric efficiency of a hydrostatic transmission: band by the drawing's tolerances, and 399 units.

recordings/hst196: end-of-line tests of two like machines of 196 mL/r (examples/hst196/band.py, which names what is
not given and how far it may be off). One operating point, motor over pump speed. The data's author has the piston
clearance explain the whole of it, 84.8 .. 93.6 %; he sums one piston's leakage over the pistons z times: counted
once, his formulas give 96.0 .. 97.0 %.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from measured import Measured, Uncertainty, at_least, not_computed, within

from gaps import Accuracy
from system import (
    RIGID,
    FloatingOptions,
    drives,
    floating_parts,
    load_pump,
    lumped_point,
    no_rubbing,
    operating_point,
    piston_conductance,
    rotor,
    slipper_conductance,
    slipper_revolution,
    valve_plate_conductance,
)
from system.points.floating_gaps import block_revolution

PUMP = Path(__file__).resolve().parents[2] / "examples" / "pumps" / "hst196.toml"
SOURCE = "ivanokhotnikov/effmap, 399 units"
LICENCE = "MIT (ivanokhotnikov/effmap_demo)"
UNITS = 399
UNSTATED = "the bench's uncertainty is not stated"
CLOSED = Uncertainty(0.0, "closed forms along the gaps, chambers to 1e-6")
DISCUSSION = """\
Floating films do not close the gap between 94.1 % and 88.4 %; they widen it. By

    python examples/hst196/floating.py --isothermal hst196_production_tests.csv

the transmission has 94.26 % with the films given, all unknown values in the middle, and 95.67 % with floating films
between elastic walls in oil of 60 degC; with --rigid in place of --isothermal 95.33 %. The measured mean lies 5.83,
7.24 and 6.90 points below. Of the 4.33 points that the machines lose with elastic walls, the oil's compression and the
ports take 3.71, the droop of the swash plates 0.35 and all six gaps 0.28: pistons 0.34, valve plates 0.04, slippers
-0.10, since they drag oil in from the case. The films given leak 2.13. Floating films would have to leak more than
twenty times as much to meet the measurement. So what is left, 7.24 points, is not in the gaps as far as they are known,
at that temperature. Worn or distorted lands, hotter oil and what the circuit takes (flushing and relief valves, charge
pump, control) remain. Nothing is given of them.

With all physics the machine does not converge. On the flat valve plate of its file (`swashfilm run
examples/pumps/hst196.toml --fidelity floating`) the block's film between elastic walls does not settle at 0 s;
between rigid walls the block lies on its asperities, less than 1 um away. The flat plate is an assumption of that
file, as is the wavy one of the command above, REF90's. On the wavy plate (the command without an option) the pump's
slipper fails at 15 deg: its lands lift 117 % of what presses at low pressure, and the film warms beyond the 150 degC
to which its viscosity holds.

The drawing's clearances do not explain the scatter either. `examples/hst196/series.py` draws transmissions from the
tolerances of `examples/pumps/hst196.toml` and leaves all else in the middle. The picture has its distribution beside
the measured one, once with all pistons of a machine of one clearance, which no assembly does, and once with each piston
of its own.

![Transmissions by the drawing's clearances beside the measured ones](hst196_series.png)

The measured units have 0.64 points of standard deviation; 0.57 of these are the same forward and in reverse and so
belong to the unit. The clearances give 0.14 points at most, and 0.05 points where each piston has its own. So they
account for 6 % of the variance of the units at most. The rest, and the distance of the means, is in what the recording
does not give: films and lands of slippers and valve plates, valves of the circuit, temperature of the oil at each
test."""

OTHERS = not_computed("only clearances scatter here; how films and lands scatter from unit to unit is not given")


def of_mean(values: np.ndarray) -> Uncertainty:
    """Of the mean of efficiencies, in %."""
    error = 100.0 * float(values.std(ddof=1)) / np.sqrt(values.size)
    return at_least(Uncertainty(error, f"standard error of the mean; {UNSTATED}"))


def of_spread(spread: float, units: int) -> Uncertainty:
    """Of a standard deviation that is found of so many units."""
    error = spread / np.sqrt(2.0 * (units - 1))
    return at_least(Uncertainty(error, f"{units} units, normal; {UNSTATED}"))


def of_band(efficiencies: np.ndarray) -> Uncertainty:
    """Of efficiencies (n,) found with inputs drawn from their ranges, in %."""
    return Uncertainty(
        100.0 * float(efficiencies.std(ddof=1)),
        f"standard deviation of {efficiencies.size} transmissions drawn from the ranges of examples/hst196/band.py, "
        "most of which are assumed",
    )


@pytest.fixture(scope="module")
def band(example: Callable[[str], ModuleType]) -> ModuleType:
    return example("hst196/band.py")


@pytest.fixture(scope="module")
def floating(example: Callable[[str], ModuleType]) -> ModuleType:
    return example("hst196/floating.py")


@pytest.fixture(scope="module")
def band_and_series(example: Callable[[str], ModuleType]) -> tuple[ModuleType, ModuleType]:
    series = example("hst196/series.py")
    return series.band, series


@pytest.fixture(scope="module")
def recording(shared) -> Path:
    found: Path = shared / "recordings" / "hst196" / "hst196_production_tests.csv"
    return found


@pytest.fixture(scope="module")
def measured(band, recording) -> np.ndarray:
    return band.measured(recording)


def test_measured_speeds(measured):
    """As the recording's own sheet has them."""
    assert measured.size == UNITS
    assert 1780.0 * measured.mean() == pytest.approx(1574.0, abs=0.5)
    assert 100.0 * measured.std(ddof=1) == pytest.approx(0.64, abs=0.01)


def test_what_both_ways_share(band, tmp_path):
    """Units that differ by 1 % both ways and by 0.1 % in each; one row without a reading."""
    random = np.random.default_rng(196)
    unit, own = 0.01 * random.standard_normal(4000), 0.001 * random.standard_normal((2, 4000))
    forward, reverse = 1780.0 * (0.9 + unit + own)
    reverse[0] = 568.0
    rows = "\n".join(f"{f},{r}" for f, r in zip(forward, reverse, strict=True))
    file = tmp_path / "tests.csv"
    file.write_text(f"forward_speed_rpm,reverse_speed_rpm\n{rows}\n0,0\n", encoding="utf-8")
    assert band.shared_spread(file) == pytest.approx(np.std(unit), rel=0.02)


def test_the_authors_own_band():
    """His formulas by ours (capillaries only, 1 + 1.5 eps^3 at eps = 1, all gaps at half the pressure).

    Pump and motor lose the same, the pump compression too; pistons as he counts them, z times their sum, or once.
    """
    pump = load_pump(PUMP)
    viscosity, mean = 30.58e-3, 0.5 * (207e5 + 14e5)
    plate = pump.valve_plate
    radii = (plate.land_radius_1, plate.land_radius_2, plate.land_radius_3, plate.land_radius_4)
    others = 9.0 * valve_plate_conductance(radii, 15e-6, 9, viscosity)
    others += 9.0 * slipper_conductance(pump.slipper.lands.log_ratio, 15e-6, 1.0, 0.0, viscosity)
    engaged = 41.39e-3 + 31.72e-3 * np.sin(np.pi * np.arange(9) / 9.0)

    def found(clearance: float, counted: int) -> float:
        pistons = piston_conductance(29.566e-3, clearance, engaged, 1.0, viscosity).sum()
        lost = mean * (others + counted * pistons) / (1780.0 / 60.0 * 196e-6)
        return (1.0 - (207.0 - 14.0) / 15e3 - lost) * (1.0 - lost)

    for counted, band in ((9, (0.936, 0.848)), (1, (0.970, 0.960))):
        at_ends = [found(clearance, counted) for clearance in (22.86e-6, 34.29e-6)]
        assert at_ends == pytest.approx(band, abs=1e-3)


@pytest.mark.slow
def test_floating_slipper_leaks_within_the_range_taken():
    """Where its slipper floats, held by its retainer, it leaks within what the 8 .. 15 um taken would let through.

    Its mean film is near the upper end, but it rides on its leading edge and drags oil back from the case: it leaks as
    a parallel film of some 10 um.
    """
    pump = load_pump(PUMP)
    point, parts = operating_point(pump), floating_parts(pump)
    cycle = lumped_point(pump, point).cycle
    group = rotor(pump, point)
    driven = drives(group, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(cycle.shaft_angle.size))
    options = FloatingOptions(RIGID, steps=36, accuracy=Accuracy(step=3e-2), finer=0.5)
    turn = slipper_revolution(group, parts, driven.slipper, options).turn
    leak = 9.0 * float(np.mean([instant.report.leakage for instant in turn.instants]))
    least, most = (
        lumped_point(load_pump(PUMP, {"slipper.film_thickness": film}), point).leakage_flow.slipper
        for film in ("8 um", "11 um")
    )
    assert least < leak < most
    assert 8e-6 < float(np.mean([instant.mean_film for instant in turn.instants])) < 15e-6


def test_spread_by_clearance_alone(band, recording, validation):
    """All pistons at one end of the tolerance or the other: the most that the drawing's clearance can do.

    It is the same forward and back, so that it stands beside the spread that both ways share.
    """
    spread = np.ptp(band.by_clearance())
    shared_by_both = 100.0 * band.shared_spread(recording)
    data = of_spread(4.0 * shared_by_both, UNITS)
    validation(
        case="Hydrostatic transmission HST 196, 1780 rpm, 207 against 14 bar",
        source=SOURCE,
        quantity="spread by the whole piston clearance, 22.9 .. 34.3 um",
        unit="%",
        expected=4.0 * shared_by_both,
        obtained=100.0 * spread,
        tolerance=0.3,
        note="expected: 95 % of the units by what forward and reverse share",
        missed="clearance accounts for two fifths of what units have of their own; the rest is other gaps",
        measured=Measured("pump", LICENCE, data, OTHERS, CLOSED),
    )


def test_band(band, measured, validation):
    values, found = band.sample(count=64)
    low, high = 100.0 * np.quantile(found, (0.05, 0.95))
    validation(
        case="Hydrostatic transmission HST 196, 1780 rpm, 207 against 14 bar",
        source=SOURCE,
        quantity="volumetric efficiency",
        unit="%",
        expected=100.0 * measured.mean(),
        obtained=0.5 * (low + high),
        tolerance=0.5 * (high - low),
        note=f"tolerance: half the predicted 90 % band, {low:.1f} .. {high:.1f} %",
        missed="leakage and compression as far as they are known account for half the loss; films of 22 um in "
        "place of 8 to 15 um on slippers and valve plates would meet it, or what the circuit loses (not given); "
        "oil of 120 degC in the films alone would not, 89.2 %",
        measured=Measured("pump", LICENCE, of_mean(measured), of_band(found), CLOSED),
    )
    parts = band.shares(values, found)
    assert 0.8 < parts.sum() <= 1.0 + 1e-9
    assert found.max() < 1.0


@pytest.mark.long
def test_floating_films_do_not_close_the_gap(band, floating, measured, validation):
    """Rigid walls; the tolerance is that of the band, whose films are given."""
    _, found = band.sample(count=64)
    low, high = 100.0 * np.quantile(found, (0.05, 0.95))
    inputs = of_band(found)
    floats = floating.floating_losses(RIGID)
    assert sum(floats.shares.values()) == pytest.approx(1.0 - floats.speed_ratio)
    gaps = sum(abs(share) for name, share in floats.shares.items() if name.startswith(band.MACHINES))
    validation(
        case="Hydrostatic transmission HST 196 with floating films, 1780 rpm, 207 against 14 bar",
        source=SOURCE,
        quantity="volumetric efficiency",
        unit="%",
        expected=100.0 * measured.mean(),
        obtained=100.0 * floats.speed_ratio,
        tolerance=0.5 * (high - low),
        note="losses in % of the pump's flow: "
        + ", ".join(f"{name} {100.0 * share:.2f}" for name, share in floats.shares.items()),
        missed="floating films leak less than those given, so that the gap is wider with them; see the text of "
        "the chapter for what is left",
        measured=Measured(
            "pump",
            LICENCE,
            of_mean(measured),
            replace(inputs, how=f"{inputs.how}; here with given films in place of floating ones"),
            within(100.0 * gaps, "no more than all that the gaps leak: their meshes are coarse"),
        ),
    )


@pytest.mark.parametrize(
    ("pistons", "parts", "reason"),
    [
        ("of a machine alike", 1, "the clearances of the drawing give a fifth of the units' own scatter at most"),
        ("unlike", 9, "nine pistons of unlike clearance nearly average out"),
    ],
)
def test_scatter_by_the_tolerances(band_and_series, recording, validation, pistons, parts, reason):
    band, series = band_and_series
    shared_by_both = 100.0 * band.shared_spread(recording)
    validation(
        case="Hydrostatic transmission HST 196, 1780 rpm, 207 against 14 bar",
        source=SOURCE,
        quantity=f"standard deviation by the drawing's clearances, pistons {pistons}",
        unit="%",
        expected=shared_by_both,
        obtained=100.0 * float(np.std(series.series(parts=parts), ddof=1)),
        relative_tolerance=0.2,
        note="expected: what forward and reverse of a unit share",
        missed=reason,
        measured=Measured("pump", LICENCE, of_spread(shared_by_both, UNITS), OTHERS, CLOSED),
    )


@pytest.mark.slow
def test_flat_plate_bears_no_film():
    """Why the floating machines have a wavy plate: on a flat one the block sinks to its asperities."""
    pump = load_pump(PUMP)
    point, parts = operating_point(pump), floating_parts(pump)
    cycle = lumped_point(pump, point).cycle
    group = rotor(pump, point)
    driven = drives(group, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(cycle.shaft_angle.size))
    options = FloatingOptions(RIGID, steps=36, accuracy=Accuracy(step=3e-2), finer=0.5)
    turn = block_revolution(group, parts, driven.block, options)
    assert turn.mean_film < 1e-6
    assert min(instant.report.contact_load for instant in turn.turn.instants) > 0.0
