"""Stokes and Navier-Stokes reference: corrections of the film equation."""

from __future__ import annotations

import numpy as np
import pytest

from reynolds.stokes.corrections import CREEPING, groove_correction, orifice_correction, step_correction
from reynolds.stokes.space import Symmetry

KINETIC_PLANE, KINETIC_PIPE = 54 / 35, 2.0
"""Kinetic energy of a developed flow over that of its mean velocity."""


@pytest.mark.parametrize("ratio", [3.0, 1 / 3])
def test_creeping_loss_is_the_change_of_kinetic_energy(ratio):
    """To first order in Re the work of inertia on Stokes flow is that change (its own test function): exactly."""
    found = step_correction(ratio, [0.0], cells=3)
    before, behind = (1.0, 1.0 / 9.0) if ratio > 1.0 else (1.0 / 9.0, 1.0)
    assert found.loss_factor[0] == pytest.approx(KINETIC_PLANE * (behind - before), rel=1e-3, abs=10 * CREEPING**2)


def test_creeping_flow_over_a_step_runs_back_as_it_came():
    forth, back = step_correction(3.0, [0.0], cells=3), step_correction(1 / 3, [0.0], cells=3)
    assert forth.extra_length == pytest.approx(back.extra_length, rel=2e-3)
    assert forth.extra_length > 0.1


def test_wide_groove_is_two_steps():
    groove, step = groove_correction(2.0, 8.0, [0.0], cells=3), step_correction(2.0, [0.0], cells=3)
    assert groove.length == pytest.approx(1.0)
    assert groove.extra_length == pytest.approx(2.0 * step.extra_length, rel=0.01)
    assert groove.loss_factor[0] == pytest.approx(0.0, abs=1e-3)


def test_narrow_groove_hardly_eases_the_flow():
    """To the film equation a groove five times as deep as wide has next to no resistance: flow passes over it."""
    groove = groove_correction(6.0, 1.0, [0.0], cells=3)
    assert groove.length < 0.005
    assert 0.3 < groove.length + groove.extra_length < 1.0


@pytest.mark.parametrize("length", [0.25, 1.0])
def test_bore_in_a_wall(length, validation):
    found = orifice_correction(length, 10.0, [0.0], Symmetry.AXIAL, cells=3)
    validation(
        case="Stokes reference: bore through a wall",
        source="Dagan, Weinbaum, Pfeffer 1982, J. Fluid Mech. 115 (Sampson 1891 and Poiseuille in series, to 1 %)",
        quantity=f"pressure drop of Stokes flow, length {length:g} diameters, pipes 10 times as wide",
        unit="mu u/d",
        expected=6.0 * np.pi + 32.0 * length,
        obtained=found.drop[0],
        relative_tolerance=0.02,
        note="the formula's own error 1 %; 6 cells a diameter",
    )


def test_slot_in_a_wall(validation):
    found = orifice_correction(0.05, 12.0, [0.0], Symmetry.PLANE, cells=4)
    validation(
        case="Stokes reference: thin slot through a wall",
        source="after Hasimoto 1958, J. Phys. Soc. Japan 13, and Poiseuille flow in series",
        quantity="pressure drop of Stokes flow, length 0.05 heights, channels 12 times as high",
        unit="mu u/h",
        expected=32.0 / np.pi + 12.0 * 0.05,
        obtained=found.drop[0],
        relative_tolerance=0.03,
        note="the sum's own error 2 %; 8 cells a height",
    )


def test_flow_coefficient_rises_to_an_orifice_s():
    found = orifice_correction(0.25, 6.0, [0.0, 1.0, 10.0, 50.0], Symmetry.AXIAL, cells=3)
    assert found.flow_coefficient[0] == 0.0
    assert np.all(np.diff(found.flow_coefficient) > 0.0)
    assert found.flow_coefficient[1] == pytest.approx(np.sqrt(0.5 / found.drop[0]), rel=0.02)
    assert 0.58 < found.flow_coefficient[3] < 0.65
