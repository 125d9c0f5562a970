"""Reading of `gap_table` and the coefficients of the film equation at every point, compiled once by numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from reynolds.compiled.gap_table import CONDUCTION, CONTACT, CONTENT, FILM, SHEAR

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}

Reals = NDArray[np.float64]


class Motion(NamedTuple):
    """Mean velocity of the walls along x and y, and their slip U1 - U2, (cells, points) m/s each."""

    mean_x: Reals
    mean_y: Reals
    slip_x: Reals
    slip_y: Reals


class Coefficients(NamedTuple):
    """Coefficients of a film at its points, (cells, points) each, and their slopes by the gap.

    film m; conductance r h^3/(12 mu) phi, m3/(Pa s); flux, m2/s, of a full film with the walls; content, m, of oil
    per area; contact pressure, Pa.
    """

    film: Reals
    film_slope: Reals
    conductance: Reals
    flux_x: Reals
    flux_y: Reals
    content: Reals
    contact: Reals
    conductance_slope: Reals
    flux_x_slope: Reals
    flux_y_slope: Reals
    content_slope: Reals
    contact_slope: Reals


@njit(inline="always")
def place(table, gap):
    """Knot below a gap, share of the way to the next one, and du/dgap times the number of knots."""
    knots = table.values.shape[0]
    above = max(gap - table.start, 0.0)
    whole = 1.0 / (above + table.middle)
    at = knots * above * whole
    knot = min(int(at), knots - 2)
    return knot, min(at - knot, 1.0), knots * table.middle * whole * whole


@njit(inline="always")
def read(table, knot, share, steep, column):
    """Value and slope by the gap of a column: the cubic of values and rises at both knots."""
    a, b = table.values[knot, column], table.values[knot + 1, column]
    p, q = table.rises[knot, column], table.rises[knot + 1, column]
    bend, twist = 3.0 * (b - a) - 2.0 * p - q, 2.0 * (a - b) + p + q
    value = a + share * (p + share * (bend + share * twist))
    slope = p + share * (2.0 * bend + share * 3.0 * twist)
    return value, slope * steep


@njit(**_FAST)
def coefficients(table, gap, factor, motion):
    """Coefficients at gaps (cells, points) m; factor: r/(12 mu), 1/(Pa s). The rest as `Coefficients`."""
    shape = gap.shape
    film, widened, conductance, content = np.empty(shape), np.empty(shape), np.empty(shape), np.empty(shape)
    flux_x, flux_y, by_x, by_y = np.empty(shape), np.empty(shape), np.empty(shape), np.empty(shape)
    by_conductance, by_content = np.empty(shape), np.empty(shape)
    contact, by_contact = np.zeros(shape), np.zeros(shape)
    rough = table.values.shape[0] > 0
    for e in range(shape[0]):
        for q in range(shape[1]):
            h, widening, phi, phi_slope = gap[e, q], 1.0, 1.0, 0.0
            filled, filled_slope, shear, shear_slope = h, 1.0, 0.0, 0.0
            if rough:
                knot, share, steep = place(table, gap[e, q])
                more, more_slope = read(table, knot, share, steep, FILM)
                h, widening = h + more, widening + more_slope
                phi, phi_slope = read(table, knot, share, steep, CONDUCTION)
                more, more_slope = read(table, knot, share, steep, CONTENT)
                filled, filled_slope = h + more, widening + more_slope
                shear, shear_slope = read(table, knot, share, steep, SHEAR)
                contact[e, q], by_contact[e, q] = read(table, knot, share, steep, CONTACT)
            square = factor[e, q] * h * h
            widened[e, q] = widening
            film[e, q], content[e, q], by_content[e, q] = h, filled, filled_slope
            conductance[e, q] = square * h * phi
            by_conductance[e, q] = square * (3.0 * widening * phi + h * phi_slope)
            flux_x[e, q] = filled * motion.mean_x[e, q] + shear * motion.slip_x[e, q]
            flux_y[e, q] = filled * motion.mean_y[e, q] + shear * motion.slip_y[e, q]
            by_x[e, q] = filled_slope * motion.mean_x[e, q] + shear_slope * motion.slip_x[e, q]
            by_y[e, q] = filled_slope * motion.mean_y[e, q] + shear_slope * motion.slip_y[e, q]
    return Coefficients(
        film, widened, conductance, flux_x, flux_y, content, contact, by_conductance, by_x, by_y, by_content, by_contact
    )


@njit(**_FAST)
def contact_forces(contact, slope, area, modes):
    """int p_c phi_j dA (k,), int p_c' phi_i phi_j dA (k, k), and int p_c |phi_j| dA (k,)."""
    count = modes.shape[2]
    force, slopes, size = np.zeros(count), np.zeros((count, count)), np.zeros(count)
    for e in range(contact.shape[0]):
        for q in range(contact.shape[1]):
            if contact[e, q] == 0.0:
                continue
            pressed, stiff = contact[e, q] * area[e, q], slope[e, q] * area[e, q]
            for i in range(count):
                force[i] += pressed * modes[e, q, i]
                size[i] += pressed * abs(modes[e, q, i])
                for j in range(count):
                    slopes[i, j] += stiff * modes[e, q, i] * modes[e, q, j]
    return force, slopes, size
