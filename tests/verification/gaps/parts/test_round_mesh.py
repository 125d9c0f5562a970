"""Polygons that stand for circles: areas of meshes of straight cells."""

import numpy as np
import pytest

from gaps.shapes.round_mesh import round_scale
from gaps.shapes.slipper_lands import slipper_mesh
from reynolds import film_space


@pytest.mark.parametrize("around", [3, 7, 20, 72])
def test_a_land_has_the_area_of_its_circles(around):
    lands = ((7e-3, 10e-3), (11e-3, 14e-3))
    area = film_space(slipper_mesh(lands, (3, around))).area.sum()
    assert area == pytest.approx(np.pi * sum(b**2 - a**2 for a, b in lands), rel=1e-12)


def test_sectors_need_not_be_alike():
    sectors = np.array([0.5, 1.0, 0.7])
    sectors = np.append(sectors, 2.0 * np.pi - sectors.sum())
    corners = round_scale(sectors) * np.exp(1j * np.cumsum(sectors))
    area = 0.5 * np.sum(np.imag(np.conj(corners) * np.roll(corners, -1)))
    assert area == pytest.approx(np.pi)
