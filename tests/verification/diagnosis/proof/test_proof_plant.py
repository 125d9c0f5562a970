"""The plant of the proof: knows nothing of the simulator, balances mass and power, converges in its steps."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

BENCHMARKS = Path(__file__).resolve().parents[4] / "benchmarks"
PACKAGES = {"reynolds", "gaps", "system", "diagnosis", "swashfilm"}


@pytest.fixture(scope="module")
def plant() -> Iterator[SimpleNamespace]:
    """The plant's modules, benchmarks/ on the path while they are loaded."""
    sys.path.insert(0, str(BENCHMARKS))
    from proof.plant import bench, gaps, hidden, machine, motion, settings

    yield SimpleNamespace(
        run=bench.run, gaps=gaps, of=motion, Hidden=hidden.Hidden, Settings=settings.Settings, RPM=settings.RPM,
        ref90=machine.ref90, drawn=machine.drawn, viscosity_at=machine.viscosity_at,
    )  # fmt: skip
    sys.path.remove(str(BENCHMARKS))


def _points(plant: SimpleNamespace, rpm: float = 2100.0, stroke: float = 1.0, warm: float = 323.15) -> object:
    """10, 20 and 35 MPa at one speed, stroke and temperature."""
    three = np.ones(3)
    p_out = np.array([10.0e6, 20.0e6, 35.0e6])
    return plant.Settings(
        rpm * plant.RPM * three, stroke * three, p_out, 2.5e6 * three, 0.15e6 * three, warm * three, warm * three
    )


def test_the_plant_imports_nothing_of_the_simulator() -> None:
    """Neither a package of this project nor anything but numpy, scipy, numba and the standard library."""
    allowed = {"numpy", "scipy", "numba", *sys.stdlib_module_names}
    for path in (BENCHMARKS / "proof" / "plant").glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            names = [one.name for one in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                names.append(node.module or "")
            assert node.level < 2 if isinstance(node, ast.ImportFrom) else True
            assert {name.split(".")[0] for name in names} <= allowed - PACKAGES, path.name


def test_the_piston_moves_as_the_drawing_says(plant: SimpleNamespace) -> None:
    """Check values worked out by hand: stroke, speed, acceleration at 2100 rpm, swash angles at part stroke."""
    machine, omega = plant.ref90(), 2100.0 * plant.RPM
    move = plant.of.motion(machine, 1.0, np.linspace(0.0, 2.0 * np.pi, 3601))
    assert np.ptp(move.travel) == pytest.approx(26.264e-3, abs=5e-7)
    assert np.abs(move.speed).max() * omega == pytest.approx(2.890, abs=5e-4)
    bend = np.gradient(move.speed, move.angle)
    assert np.abs(bend).max() * omega**2 == pytest.approx(668.0, abs=1.0)
    outward = machine.radius * np.sin(machine.cone)  # what turning with the block takes off, along the bore
    assert bend - move.acceleration == pytest.approx(outward, rel=0.03)
    volume = machine.pistons * machine.area * np.ptp(move.travel)
    assert volume == pytest.approx(89.86e-6, rel=1e-4)
    angles = [np.degrees(plant.of.swash_at(machine, ratio)) for ratio in (0.13, 0.28, 0.51, 0.52, 0.77)]
    assert angles == pytest.approx([2.164, 4.653, 8.432, 8.595, 12.613], abs=6e-4)


def test_the_oil_is_iso_vg_46(plant: SimpleNamespace) -> None:
    """Viscosity to two digits: Vogel's law against ASTM D341."""
    celsius = np.array([20.0, 40.0, 50.0, 60.0, 80.0, 100.0])
    stated = np.array([118.0, 40.0, 25.8, 17.6, 9.3, 5.6])
    found = plant.viscosity_at(plant.ref90(), celsius + 273.15) * 1e3
    assert found == pytest.approx(stated, rel=0.05)
    assert found[1:4] == pytest.approx(stated[1:4], rel=0.015)


def test_films_leak_as_the_drawing_says(plant: SimpleNamespace) -> None:
    """Rigid parallel films at 50 degC, 35 MPa, half of the pistons (ref90.md): slipper .363, plate .155 L/min."""
    machine, at = plant.ref90(), _points(plant)
    films = plant.gaps.films(machine, plant.Hidden(), at, np.zeros((3, 3)))
    grid = np.linspace(0.0, films.top[0], films.parts.shape[2])
    mass = [np.interp(35.0e6, grid, films.parts[0, part]) for part in range(2)]
    litres = 4.5 * np.array(mass) / machine.density * 60e3
    assert litres == pytest.approx([0.363, 0.155], rel=0.03)  # oil denser under pressure: 1 %; viscosity: 1 %


def test_mass_balances_over_a_turn(plant: SimpleNamespace) -> None:
    """Inflow of the suction port equals outflow by delivery, bore and plate, to the closing of the stages."""
    truth = plant.run(plant.ref90(), _points(plant))
    dense = 860.0 * np.exp((np.array([10.0e6, 20.0e6, 35.0e6]) - 101325.0) / 1.6e9)
    taken = truth.Q_in * 860.0 * np.exp((2.5e6 - 101325.0) / 1.6e9)
    left = taken - truth.Q_out * dense - truth.Q_case * 860.0
    assert np.abs(left).max() < 1e-6 * taken.max()


def test_mass_balances_where_chambers_do_not_fill(plant: SimpleNamespace) -> None:
    """Behind a line that loses 60 kPa at rated flow as much less is delivered as comes in."""
    machine, three = plant.ref90(), np.ones(3)
    at = replace(_points(plant, rpm=2200.0), p_in=1e5 * np.array([0.6, 0.7, 0.8]), p_case=1.1e5 * three)
    sound, starved = (plant.run(machine, at, plant.Hidden(suction=loss)) for loss in (0.0, 6e4))
    dense = 860.0 * np.exp((at.p_out - 101325.0) / 1.6e9)
    left = starved.Q_in * 860.0 * np.exp((at.p_in - 101325.0) / 1.6e9) - starved.Q_out * dense - starved.Q_case * 860.0
    assert np.abs(left).max() < 1e-4 * starved.Q_in.max() * 860.0  # of the line's pressure, the density 4e-5
    for channel in ("Q_in", "Q_out"):
        share = getattr(starved, channel) / getattr(sound, channel)
        assert np.all(share < 0.95)
        assert np.all(np.diff(share) > 0.02)


def test_power_balances(plant: SimpleNamespace) -> None:
    """Shaft power is the flows' power, the films' and the pairs', where ports lose none.

    Slowly, with oil a hundred times as stiff, through ports that change over at the dead centres.
    """
    machine = replace(plant.ref90(), bulk_modulus=160.0e9, port_angles=(0.0, 0.02, 0.04, np.pi - 0.02, np.pi))
    at = _points(plant, rpm=60.0)
    truth = plant.run(machine, at)
    flows = at.p_out * truth.Q_out - at.p_in * truth.Q_in + at.p_case * truth.Q_case
    above = truth.pressure - at.p_case[:, None]
    films = plant.gaps.films(machine, plant.Hidden(), at, np.zeros((3, 3)))
    leaked = []
    for k in range(3):
        grid = np.linspace(0.0, films.top[k], films.flow.shape[3])
        move = plant.of.motion(machine, 1.0, truth.angle)
        bore = np.interp(above[k], grid, films.flow[k, 0, 0]) / (machine.engaged - move.travel)
        shared = np.interp(above[k], grid, films.flow[k, 0, 1])
        leaked.append(machine.pistons * np.mean(above[k] * (bore + shared)) / machine.density)
    shaft = truth.torque * at.speed - truth.lost.total
    assert shaft == pytest.approx(flows + np.array(leaked), rel=1e-3)


def test_drains_of_the_gaps_make_the_case_drain(plant: SimpleNamespace) -> None:
    """Pistons, slippers and plate leak what the case drains; an opening of the slippers shows in their drain alone."""
    machine, at = plant.ref90(), _points(plant)
    sound, opened = (plant.run(machine, at, plant.Hidden(opening_slipper=size), steps=360) for size in (0.0, 2e-8))
    parts = [sound.Q_piston, sound.Q_slipper, sound.Q_valve_plate]
    assert all(np.all(part > 0.0) for part in parts)
    assert np.sum(parts, axis=0) == pytest.approx(sound.Q_case, rel=1e-12)
    assert np.all(opened.Q_slipper > 1.05 * sound.Q_slipper)
    assert opened.Q_valve_plate == pytest.approx(sound.Q_valve_plate, rel=2e-3)


def test_the_step_converges(plant: SimpleNamespace) -> None:
    """Readings at 360 steps are within a tenth of a sigma of 2880; halving the step at least halves the error."""
    machine, at = plant.ref90(), _points(plant)
    sigma = np.array([0.19 / 60e3, 0.31 / 60e3, 0.018 / 60e3, 0.55])
    fine = plant.run(machine, at, steps=2880).outputs
    error = [np.abs((plant.run(machine, at, steps=steps).outputs - fine) / sigma).max() for steps in (180, 360, 720)]
    assert error[1] < 0.1
    assert error[1] < 0.5 * error[0]
    assert error[2] < 0.5 * error[1]


MOVES = {  # signs of Q_out, Q_in, Q_case, torque; 0: not moved; None: not asked
    "viscosity_pressure": (1.0e-8, (1, None, -1, 1)),
    "opening_plate": (1.0e-8, (-1, None, 1, -1)),
    "film_heating": (0.01, (-1, None, 1, -1)),
    "shear_thinning": (0.2, (0, 0, 0, -1)),
    "mixed_friction": (0.05, (0, 0, 0, 1)),
    "squeeze": (5.0e-6, (0, 1, 1, 0)),
    "churning": (1.0, (0, 0, 0, 1)),
    "seal": (1.0, (0, 0, 0, 1)),
    "short_circuit": (1.0e-7, (-1, -1, 0, 0)),
    "cross_leak": (1.0e-15, (-1, -1, 0, 0)),
    "control_flow": (1.0e-7, (-1, 0, 1, 0)),
    "droop": (1.0e-10, (-1, -1, None, -1)),
    "throttling": (1.0, (0, 0, 0, 1)),
    "air": (0.01, (-1, None, None, None)),
    "compression": (0.3, (0, 0, 0, 1)),
    "stiffening": (5.0, (1, None, None, None)),
    "spin_leak": (0.1, (None, None, 1, None)),
    "foam": (1.0, (0, 0, 0, 1)),
}


@pytest.mark.parametrize("name", MOVES)
def test_each_effect_moves_what_its_sheet_says(plant: SimpleNamespace, name: str) -> None:
    """The expected sign of every reading for every effect that the proof conceals, and none without a size."""
    size, signs = MOVES[name]
    at = _points(plant, stroke=0.8)
    nothing = plant.run(plant.ref90(), at, steps=180).outputs
    moved = plant.run(plant.ref90(), at, plant.Hidden(**{name: size}), steps=180).outputs - nothing
    for channel, sign in enumerate(signs):
        if sign is not None:
            assert np.all(np.sign(moved[:, channel]) == sign), channel


def test_a_drawn_machine_is_within_its_tolerances(plant: SimpleNamespace) -> None:
    """Two hundred machines: mean and spread of a film as stated, pistons unlike, shares between 0 and 1."""
    rng = np.random.default_rng(1)
    machines = [plant.drawn(plant.ref90(), rng) for _ in range(200)]
    films = np.log([one.slipper_film / plant.ref90().slipper_film for one in machines])
    assert abs(films.mean()) < 4.0 * 0.08 / np.sqrt(200)
    assert films.std() == pytest.approx(0.08, rel=4.0 / np.sqrt(400))
    assert all(len(set(one.clearance)) == 9 and 0.0 <= one.stand_out_share <= 1.0 for one in machines)
