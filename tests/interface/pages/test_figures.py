"""Pictures of figures on pages: small ones as SVG, others in pixels, and the figure left as it was."""

import io

import numpy as np
import pytest
from PIL import Image

from swashfilm.output.figures import FEWEST_PIXELS, LARGE, compact, figure_of
from swashfilm.output.scenes.field_maps import draw_map

pytestmark = pytest.mark.usefixtures("rendered")


def lines(points: int):
    figure = figure_of(6.0, 3.0)
    figure.subplots().plot(np.arange(points), np.random.default_rng(1).normal(size=points))
    return figure


def field():
    figure = figure_of(6.0, 3.0)
    corners = np.array([0.0, 1.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0, 1.0])
    draw_map(figure.subplots(), corners, np.array([[0, 1, 2, 3]]), np.arange(4.0), "pressure [MPa]")
    return figure


@pytest.mark.parametrize("figure", [lines(10), lines(2000), lines(9000), field()], ids=["few", "many", "most", "field"])
def test_a_figure_is_drawn_once_and_left_on_its_canvas(figure):
    canvas, dpi = figure.canvas, figure.dpi
    picture = compact(figure)
    assert (figure.canvas, figure.dpi) == (canvas, dpi)
    box = figure.axes[0].get_position()
    figure.draw_without_rendering()
    assert np.allclose(figure.axes[0].get_position().bounds, box.bounds, atol=0.01)
    assert picture.startswith((b"<?xml", b"RIFF"))


def test_a_small_figure_is_an_svg_and_a_large_one_pixels():
    small = compact(lines(10))
    assert small.startswith(b"<?xml")
    assert len(small) <= LARGE
    for points in (2000, 9000):
        assert Image.open(io.BytesIO(compact(lines(points)))).size == (540, 270)


def test_the_picture_of_a_field_is_wide_enough():
    assert Image.open(io.BytesIO(compact(field()))).size[0] >= FEWEST_PIXELS - 1
