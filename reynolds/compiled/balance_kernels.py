"""The balance of every unknown of a film and its slopes in one call: the loops of `fem.kernels`, in sequence.

The terms are those of `equation.balance`, which explains them, and of `floating.sensitivity` by the position.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from reynolds.equation import hourglass_kernels
from reynolds.equation.balance import NO_FLOW, NOTHING
from reynolds.equation.deformation_kernels import slopes_by_deformation
from reynolds.equation.thickness_kernels import integrate, mixed_more, thicken
from reynolds.fem import kernels
from reynolds.numerics.array_kernels import all_equal, largest

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}

Reals = NDArray[np.float64]


class FlowBalance(NamedTuple):
    """Balance of each unknown (size,) m3/s and its operators on the pattern, as `equation.balance` has them.

    net: its residual; scale: sum of the magnitudes; grown: growth of its oil; mixed: flow by upwinding; rate of a
    full film; contents (size,) m3 of a full film; brim m3/s; lack Pa; stiffness, upper, lower, diffusion (entries,)
    of K, C, its mirror and D; leaves (size,): unknowns of edges without inflow; level (size,): fraction times the
    density ratio at the cavitation pressure.
    """

    net: Reals
    scale: Reals
    grown: Reals
    mixed: Reals
    rate: Reals
    contents: Reals
    brim: Reals
    lack: Reals
    stiffness: Reals
    upper: Reals
    lower: Reals
    diffusion: Reals
    leaves: NDArray[np.bool_]
    level: Reals


@njit(**_FAST)
def _without_inflow(mesh, flux_x, flux_y, given):
    """Unknowns of held edges over which the walls bring no oil in, (size,): `equation.balance.without_inflow`."""
    held, sends = np.zeros(len(given.held), dtype=np.bool_), np.zeros(len(given.held), dtype=np.bool_)
    for f in range(len(mesh.rim_cells)):
        if not given.rim_held[f]:
            continue
        x = y = 0.0
        for q in range(len(mesh.points)):
            x += flux_x[mesh.rim_cells[f], q] / len(mesh.points)
            y += flux_y[mesh.rim_cells[f], q] / len(mesh.points)
        out = x * mesh.rim_normal[0, f] + y * mesh.rim_normal[1, f]
        size = np.hypot(x, y) * np.hypot(mesh.rim_normal[0, f], mesh.rim_normal[1, f])
        for k in range(mesh.rim_unknowns.shape[0]):
            held[mesh.rim_unknowns[k, f]] = True
            if out < -NO_FLOW * size or size == 0.0:
                sends[mesh.rim_unknowns[k, f]] = True
    for i in range(len(held)):
        held[i] = held[i] and not sends[i] and not given.tied[i]
    return held


@njit(**_FAST)
def _stiffness(mesh, conductance):
    data = np.zeros(len(mesh.indices))
    if mesh.is_quadrilateral:
        hourglass_kernels.stiffness(mesh.slots, mesh.shape, mesh.pairs, mesh.parallel, conductance, mesh.points, data)
    else:
        kernels.stiffness(mesh.slots, mesh.shape, mesh.pairs, conductance, mesh.basis, mesh.points, data)
    kernels.close_rows(mesh.indptr, mesh.indices, data)
    return data


@njit(**_FAST)
def flow_balance(mesh, c, oil, given):
    """The balance at a state; c: `Coefficients`, oil: `Filling`, given: `Conditions`."""
    size, entries = len(oil.pressure), len(mesh.indices)
    contents, squeezed = np.empty(size), np.empty(size)
    kernels.lump(mesh.dofs, mesh.value, mesh.area, c.content, mesh.basis, mesh.points, contents)
    if given.squeeze.size > 1 or given.squeeze[0, 0] != 0.0:
        moved = c.content_slope * given.squeeze
        kernels.lump(mesh.dofs, mesh.value, mesh.area, moved, mesh.basis, mesh.points, squeezed)
    else:
        squeezed[:] = 0.0
    upper, lower, diffusion = np.empty(entries), np.empty(entries), np.zeros(entries)
    kernels.convection(
        mesh.dofs, mesh.slots, mesh.shape, mesh.value, mesh.gradient, c.flux_x, c.flux_y, mesh.basis, mesh.points,
        upper, lower,
    )  # fmt: skip
    stiffness, leaves = _stiffness(mesh, c.conductance), np.zeros(size, dtype=np.bool_)
    if given.conserving:
        leaves = _without_inflow(mesh, c.flux_x, c.flux_y, given)
        kernels.upwinding(mesh.indptr, mesh.indices, upper, lower, leaves, diffusion)
    net, scale, grown, mixed = np.empty(size), np.empty(size), np.empty(size), np.zeros(size)
    rate, brim, lack, level, filling = np.empty(size), np.empty(size), np.empty(size), np.empty(size), np.empty(size)
    uneven, most = False, 0.0
    for i in range(size):
        contents[i] += given.pockets[i]
        rate[i] = squeezed[i] + contents[i] / given.step
        filling[i] = oil.fraction[i] * oil.ratio[i]
        grown[i] = rate[i] * (filling[i] if rate[i] > 0.0 else oil.ratio[i])
        net[i], scale[i] = grown[i], abs(rate[i] * filling[i])
        level[i] = oil.cavity_ratio * oil.fraction[i]
        uneven = uneven or level[i] != level[0]
        last = mesh.indptr[i + 1] - 1
        brim[i] = upper[last] + diffusion[last] + max(rate[i], 0.0)
        most = max(most, brim[i])
    for i in range(size):
        stiff = stiffness[mesh.indptr[i + 1] - 1]
        lack[i] = max(brim[i], NOTHING * most + 1e-300) / (stiff if stiff > 0.0 else 1.0)
    kernels.convect(mesh.indptr, mesh.indices, upper, lower, filling, net, scale)
    if uneven:
        kernels.exchange(mesh.indptr, mesh.indices, diffusion, level, mixed, scale)
    kernels.exchange(mesh.indptr, mesh.indices, stiffness, oil.pressure, net, scale)
    for i in range(size):
        before = given.before[i] / given.step
        net[i] += mixed[i] - before
        grown[i] -= before
    return FlowBalance(
        net, scale, grown, mixed, rate, contents, brim, lack, stiffness, upper, lower, diffusion, leaves, level
    )


@njit(**_FAST)
def _gradients(dofs, shape, steep, area, nodal, basis, points, x, y):
    for e in range(dofs.shape[0]):
        s = kernels.at_index(shape[e])
        for q in range(len(points)):
            along = across = 0.0
            for i in range(len(basis)):
                level = nodal[kernels.at_index(dofs[e, i])]
                along += level * steep[s, q, i, 0]
                across += level * steep[s, q, i, 1]
            x[e, q] = along / area[e, q]
            y[e, q] = across / area[e, q]


@njit(**_FAST)
def _gradient(mesh, nodal):
    """Gradient of a nodal field by the conductance's tables, (cells, points) along x and y."""
    x, y = np.empty(mesh.area.shape), np.empty(mesh.area.shape)
    _gradients(mesh.dofs, mesh.shape, mesh.steep, mesh.steep_area, nodal, mesh.basis, mesh.points, x, y)
    return x, y


@njit(**_FAST)
def _hourglass(mesh, conductance, grown, pressure):
    out = np.zeros(mesh.area.shape)
    if mesh.is_quadrilateral:
        hourglass_kernels.changed(
            mesh.dofs, mesh.shape, mesh.pairs, mesh.parallel, conductance, grown, pressure, mesh.points, out
        )
    return out


@njit(**_FAST)
def newton_matrix(mesh, c, oil, balance, cavity, fixed, gain):
    """Upper triangle and mirror of the balance's slopes by each unknown: pressure, or film fraction in the cavity.

    Scaled as in `solve.newton.general_step`; gain (size,): of the pockets. Also the unit of the balance and the
    scale that turns an unknown of the cavity into a film fraction.
    """
    size, entries = len(oil.pressure), len(mesh.indices)
    p_upper, p_lower, p_gain = balance.stiffness, balance.stiffness, gain
    f_upper, f_lower, f_gain = np.empty(entries), np.empty(entries), np.empty(size)
    for k in range(entries):
        f_upper[k] = balance.upper[k] * oil.ratio[mesh.columns[k]] + oil.cavity_ratio * balance.diffusion[k]
        f_lower[k] = balance.lower[k] * oil.ratio[mesh.indices[k]] + oil.cavity_ratio * balance.diffusion[k]
    if oil.by_pressure.size > 1:
        driven_x, driven_y = _gradient(mesh, oil.pressure)
        p_upper, p_lower, p_gain = np.empty(entries), np.empty(entries), np.empty(size)
        less = -oil.by_pressure * c.conductance
        kernels.convection(
            mesh.dofs, mesh.slots, mesh.shape, mesh.value, mesh.steep, less * driven_x, less * driven_y, mesh.basis,
            mesh.points, p_upper, p_lower,
        )  # fmt: skip
        if mesh.is_quadrilateral:
            grown = _hourglass(mesh, c.conductance, -less, oil.pressure)
            hourglass_kernels.convected(mesh.dofs, mesh.slots, mesh.value, grown, mesh.points, p_upper, p_lower)
        for k in range(entries):
            i, j = mesh.indices[k], mesh.columns[k]
            p_upper[k] += balance.stiffness[k] + balance.upper[k] * oil.fraction[j] * oil.ratio_slope[j]
            p_lower[k] += balance.stiffness[k] + balance.lower[k] * oil.fraction[i] * oil.ratio_slope[i]
        for i in range(size):
            p_gain[i] = gain[i] + balance.rate[i] * oil.fraction[i] * oil.ratio_slope[i]
    unit, most = largest(balance.stiffness), largest(f_upper)
    unit = unit if unit > 0.0 else 1.0
    for i in range(size):
        f_gain[i] = max(balance.rate[i], 0.0) * oil.ratio[i]
        most = max(most, f_gain[i])
    scale = unit / most if most > 0.0 else 1.0
    least = NOTHING * (most if most > 0.0 else unit)
    for i in range(size):
        if f_upper[mesh.indptr[i + 1] - 1] + f_gain[i] < least:
            f_gain[i] += least
    upper, lower = np.empty(entries), np.empty(entries)
    kernels.choose_columns(
        mesh.indptr, mesh.indices, p_upper, p_lower, f_upper, f_lower, p_gain, f_gain, fixed, cavity, 1.0 / unit,
        scale / unit, upper, lower,
    )  # fmt: skip
    return upper, lower, unit, scale


@njit(**_FAST)
def _dragged(dofs, value, filling, slope_x, slope_y, basis, points, x, y):
    """Slopes of the walls' flux times the filling at the points, (cells, points)."""
    for e in range(dofs.shape[0]):
        for q in range(len(points)):
            full = 0.0
            for i in range(len(basis)):
                full += filling[kernels.at_index(dofs[e, i])] * value[q, i]
            x[e, q] = full * slope_x[e, q]
            y[e, q] = full * slope_y[e, q]


@njit(**_FAST)
def _filling(oil):
    """Film fraction times the density ratio, (size,)."""
    out = np.empty(len(oil.fraction))
    for i in range(len(out)):
        out[i] = oil.fraction[i] * oil.ratio[i]
    return out


@njit(**_FAST)
def _over(values, step):
    """Values (cells, points) over a step."""
    out = np.empty(values.shape)
    for e in range(values.shape[0]):
        for q in range(values.shape[1]):
            out[e, q] = values[e, q] / step
    return out


@njit(**_FAST)
def _flow_slopes(mesh, c, oil, filling):
    """Slopes by the gap at the points (cells, points): flow by pressure x, y, that of the hourglass mode, drag x, y."""
    driven_x, driven_y = _gradient(mesh, oil.pressure)
    for e in range(driven_x.shape[0]):
        for q in range(driven_x.shape[1]):
            driven_x[e, q] *= c.conductance_slope[e, q]
            driven_y[e, q] *= c.conductance_slope[e, q]
    mode = _hourglass(mesh, c.conductance, c.conductance_slope, oil.pressure)
    dragged_x, dragged_y = np.empty(mesh.area.shape), np.empty(mesh.area.shape)
    _dragged(
        mesh.dofs, mesh.value, filling, c.flux_x_slope, c.flux_y_slope, mesh.basis, mesh.points, dragged_x, dragged_y
    )
    return driven_x, driven_y, mode, dragged_x, dragged_y


@njit(**_FAST)
def by_deformation(mesh, c, oil, given, rows, slots, entries):
    """dR by the gap at each vertex, each row times its factor in rows (size,), m2/s at the entries of a pattern.

    slots and entries as `equation.deformation_sparsity` has them.
    """
    filling, stored, data = _filling(oil), _over(c.content_slope, given.step), np.empty(entries)
    driven_x, driven_y, mode, dragged_x, dragged_y = _flow_slopes(mesh, c, oil, filling)
    slopes_by_deformation(
        mesh.dofs, slots, mesh.shape, mesh.value, mesh.steep, mesh.gradient, mesh.corner, mesh.signs, mesh.area,
        driven_x, driven_y, mode, dragged_x, dragged_y, stored, filling, rows, mesh.basis, mesh.points, data,
    )  # fmt: skip
    return data


@njit(**_FAST)
def by_thickness(mesh, c, oil, given, balance, modes, pockets):
    """dR/dq_j at constant pressures and film fractions, (size, k) m3/s per unit of q_j.

    modes (cells, points, k): growth of the gap; pockets (size, k) m2: of the pockets' volumes.
    """
    out, filling, stored = (
        np.empty((len(oil.pressure), modes.shape[2])),
        _filling(oil),
        _over(c.content_slope, given.step),
    )
    driven_x, driven_y, mode, dragged_x, dragged_y = _flow_slopes(mesh, c, oil, filling)
    thicken(
        mesh.dofs, mesh.shape, mesh.value, mesh.steep, mesh.gradient, mesh.signs, mesh.area, driven_x, driven_y, mode,
        dragged_x, dragged_y, stored, filling, modes, mesh.basis, mesh.points, out,
    )  # fmt: skip
    if given.conserving and not all_equal(oil.fraction, 1.0):
        mixed_more(
            mesh.dofs, mesh.slots, mesh.shape, mesh.value, mesh.gradient, c.flux_x_slope, c.flux_y_slope, modes,
            mesh.basis, mesh.points, mesh.indptr, mesh.indices, balance.upper, balance.lower, balance.leaves,
            balance.level, out,
        )  # fmt: skip
    for i in range(out.shape[0]):
        for m in range(out.shape[1]):
            out[i, m] += filling[i] * pockets[i, m] / given.step
    return out


@njit(**_FAST)
def oil_by_thickness(mesh, c, oil, modes, pockets):
    """Change of each unknown's oil at constant pressures and fractions, (size, k) m3 per unit of q_j."""
    out, wider = np.empty((len(oil.pressure), modes.shape[2])), np.empty(modes.shape)
    for e in range(modes.shape[0]):
        for q in range(modes.shape[1]):
            for j in range(modes.shape[2]):
                wider[e, q, j] = c.content_slope[e, q] * modes[e, q, j]
    integrate(mesh.dofs, mesh.value, mesh.area, wider, mesh.basis, mesh.points, out)
    for i in range(out.shape[0]):
        for j in range(out.shape[1]):
            out[i, j] = oil.fraction[i] * oil.ratio[i] * (out[i, j] + pockets[i, j])
    return out
