"""Traces of a profilometer: levelling, the Gaussian filter, and films of a shape known in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from gaps import DepthPoints, PistonDrive, PistonFilm, PistonShape, Profile, constant, standing_piston
from gaps.shapes.profiles import Barrel, EdgeRelief, missed_rise
from gaps.shapes.traces import grid, levelled, smoothed
from gaps.standing.gap_film import standing_piston_film
from reynolds import FilmSolver, held_at

LENGTH, CUTOFF = 40e-3, 0.8e-3
PLACES = np.arange(0.0, LENGTH + 1e-6, 20e-6)
RNG = np.random.default_rng(3)
SPREAD = np.log(2.0) / (4.0 * np.pi**2) * CUTOFF**2  # half the filter's variance, m2


def worn(places: np.ndarray) -> np.ndarray:
    """5 um taken off at the edge over 10 mm, nothing beyond."""
    return 5e-6 * np.maximum(1.0 - places / 10e-3, 0.0) ** 2


def test_levelling_takes_out_offset_and_tilt_to_the_last_digits():
    tilted = worn(PLACES) + 40e-6 - 3e-4 * PLACES
    found = levelled(PLACES, tilted, [(12e-3, 20e-3), (30e-3, 40e-3)])
    assert found == pytest.approx(worn(PLACES), abs=1e-18)


def test_levelling_on_a_worn_range_is_off_by_its_line():
    """Nothing tells the trace which range is worn: of a parabola over a range the line is that of least squares."""
    found = levelled(PLACES, worn(PLACES), [(0.0, 10e-3)])
    assert np.ptp(found[PLACES > 10e-3]) > 10e-6


@pytest.mark.parametrize("wavelength", [0.4e-3, 0.8e-3, 1.6e-3])
def test_waves_keep_their_share_by_iso_16610_21(wavelength):
    """2^-(cutoff/wavelength)^2, half of a wave as long as the cutoff."""
    places = np.arange(0.0, LENGTH, 5e-6)
    at = np.linspace(10e-3, 30e-3, 401)
    found = smoothed(places, np.cos(2.0 * np.pi * places / wavelength), CUTOFF, at)
    share = 2.0 ** -((CUTOFF / wavelength) ** 2)
    assert found == pytest.approx(share * np.cos(2.0 * np.pi * at / wavelength), abs=1e-6)


def test_a_straight_trace_stays_straight_up_to_its_ends():
    """Also on steps that differ by a factor of ten."""
    places = np.sort(np.unique(np.round(RNG.uniform(0.0, LENGTH, 3000), 7)))
    at = grid(places[0], places[-1], CUTOFF)
    assert (at[0], at[-1]) == (places[0], places[-1])
    assert np.diff(at).max() <= 1.5001 * CUTOFF / 10
    assert smoothed(places, 2e-6 + 1e-3 * places, CUTOFF, at) == pytest.approx(2e-6 + 1e-3 * at, abs=1e-15)


def test_a_parabola_is_raised_by_half_the_variance_of_the_filter():
    at = np.linspace(5e-3, 35e-3, 61)
    found = smoothed(PLACES, PLACES**2, CUTOFF, at)
    assert found - at**2 == pytest.approx(np.full(61, 2.0 * SPREAD), rel=1e-6)


def of_film(profile: Profile) -> tuple[float, float, float]:
    """Leakage (m3/s), force (N) and least film (m) of a piston beside its bore's axis that slides out at 2 m/s."""
    drive = PistonDrive(
        shaft_speed=220.0, viscosity=0.0258, case_pressure=1e6, cavitation_pressure=-1e5, piston_spin=0.0,
        bore_spin=0.0, chamber_pressure=constant(35e6), reach=constant(LENGTH), velocity=constant(2.0),
        outer=constant(0.0, 0.0, 0.0, 0.0),
    )  # fmt: skip
    film = PistonFilm(PistonShape(22e-3, 15e-6, LENGTH, piston=profile), drive, cells=(32, 16))
    position = np.array([6e-6, 0.0, 4e-6, 0.0])
    stage = held_at(FilmSolver(film.space_at(0.0)), standing_piston(film), 0.0, position)
    inner, case = stage.film_force.reshape(2, 2)
    found = standing_piston_film(film, stage)
    return found.leakage_flow, float(np.linalg.norm(inner + case)), found.loads.film_thickness_min


@pytest.mark.parametrize("shape", [EdgeRelief(0.0, 10e-3, 5e-6), Barrel(LENGTH, 6e-6)])
def test_a_trace_of_a_known_shape_gives_its_film(shape):
    """Tilt, offset and 0.1 um of roughness do not matter; what remains is the filter's raise and the noise."""
    depths = shape(PLACES, np.zeros(len(PLACES))).depth
    rough = depths + 30e-6 - 4e-4 * PLACES + 0.1e-6 * RNG.standard_normal(len(PLACES))
    unworn = [(10e-3, 40e-3)] if isinstance(shape, EdgeRelief) else []
    trace = levelled(PLACES, rough, unworn) if unworn else rough - 30e-6 + 4e-4 * PLACES
    at = grid(0.0, LENGTH, 4e-3)
    traced = Profile((DepthPoints(tuple(at), tuple(smoothed(PLACES, trace, 4e-3, at))),))
    (leakage, force, least), (found, carried, thin) = (of_film(profile) for profile in (Profile((shape,)), traced))
    assert found == pytest.approx(leakage, rel=5e-3)
    assert carried == pytest.approx(force, rel=2e-2)
    assert thin == pytest.approx(least, abs=0.05e-6)


def test_rise_that_a_cell_misses():
    """Waves of whole cells look like slopes to three points of each; smooth shapes and no points miss nothing."""
    edges = np.linspace(0.0, LENGTH, 17)
    places = np.linspace(0.0, LENGTH, 40001)
    depths = 0.1e-6 * np.sin(2.0 * np.pi * places / (edges[1] / 3.0))
    waves = Profile((DepthPoints(tuple(places), tuple(depths)),))
    slope = 0.1e-6 * 6.0 * np.pi  # amplitude of the slope times the cell
    nodes, weights = np.polynomial.legendre.leggauss(3)
    expected = slope * abs(np.cos(3.0 * np.pi * (1.0 + nodes)) @ weights) / 2.0
    assert missed_rise(waves, edges) == pytest.approx(expected, rel=0.005)
    straight = Profile((DepthPoints((0.0, LENGTH), (0.0, 5e-6)),))
    assert missed_rise(straight, edges) == pytest.approx(0.0, abs=1e-18)
    assert missed_rise(Profile((Barrel(LENGTH, 6e-6),)), edges) == 0.0
