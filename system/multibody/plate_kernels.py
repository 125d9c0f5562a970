"""Compiled kinematics of a piston under a swash plate that swings: place along the bore and its derivatives.

Frame of the pump, x to the inner dead centre of the plate's own axes, y along the tilt axis, z along the shaft out of
the block, origin where the plane of the ball centres at zero tilt cuts the shaft. The ball is on its bore's axis at C +
s a, C = R (cos phi, sin phi, 0), and in the plane through the tilt axis at P = (offset, 0, 0) with normal n:

    s = n . (P - C)/(n . a),   n = (sin g, -tan k cos g, cos g),   k the cross angle.

Numbers and arrays are accepted.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numba
import numpy as np


@numba.njit(cache=True, error_model="numpy")
def axial(shaft_angle, swash_angle, pitch_radius, cone, cross, offset):
    """Place s (m) and s_phi, s_g (m/rad), s_phiphi, s_phig, s_gg (m/rad2), from s (n.a) = n.(P - C) derived."""
    c, s = np.cos(shaft_angle), np.sin(shaft_angle)
    tilt = np.tan(cross)
    nx, ny, nz = np.sin(swash_angle), -tilt * np.cos(swash_angle), np.cos(swash_angle)
    mx, my, mz = np.cos(swash_angle), tilt * np.sin(swash_angle), -np.sin(swash_angle)  # dn/dg
    out, along = np.sin(cone), np.cos(cone)
    n_out, n_on = nx * c + ny * s, ny * c - nx * s  # along the radius, and around
    m_out, m_on = mx * c + my * s, my * c - mx * s
    facing, facing_g = out * n_out + along * nz, out * m_out + along * mz
    place = (nx * offset - pitch_radius * n_out) / facing
    by_phi = -(pitch_radius + place * out) * n_on / facing
    by_g = (mx * offset - pitch_radius * m_out - place * facing_g) / facing
    by_phi_phi = ((pitch_radius + place * out) * n_out - 2.0 * by_phi * out * n_on) / facing
    turned = (pitch_radius + place * out) * m_on + by_g * out * n_on + by_phi * facing_g
    by_g_g = -2.0 * by_g * facing_g / facing
    return place, by_phi, by_g, by_phi_phi, -turned / facing, by_g_g
