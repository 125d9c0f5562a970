"""What rough walls leave open, point by point, compiled once by numba."""

from math import erfc, exp, pi, sqrt

from numba import njit

FAR = 9.0  # standard deviations: beyond, less than 1e-18 of the heights reach over


@njit(cache=True, error_model="numpy", fastmath={"contract"})
def cut_off(gap, sigma, mean, share):
    """mean = sigma (H N(H) + n(H)) and share = N(H) of H = gap/sigma: normal distribution N and density n."""
    for i in range(len(gap)):
        ratio = gap[i] / sigma
        if ratio > FAR:
            mean[i], share[i] = gap[i], 1.0
        else:
            share[i] = 0.5 * erfc(-ratio / sqrt(2.0))
            mean[i] = sigma * (ratio * share[i] + exp(-0.5 * ratio * ratio) / sqrt(2.0 * pi))
