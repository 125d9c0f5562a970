"""Chebyshev series at many points, compiled once by numba: eight points at a time."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from numba import njit

from reynolds.numerics.lanes import WIDTH, all_lanes, lanes, put_lanes


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def chebyshev_sums(series, twice, out):
    """out[s, i] = sum_k series[s, k] T_k(x_i) by Clenshaw's recurrence, `twice` = 2 x a whole number of eights."""
    for s in range(series.shape[0]):
        for i in range(0, len(twice), WIDTH):
            x = lanes(twice, i)
            one, two = all_lanes(twice, 0.0), all_lanes(twice, 0.0)
            for k in range(series.shape[1] - 1, 0, -1):
                one, two = all_lanes(twice, series[s, k]) + x * one - two, one
            put_lanes(out[s], i, all_lanes(twice, series[s, 0]) + all_lanes(twice, 0.5) * x * one - two)
