"""Anderson's extrapolation of a fixed point x = g(x) (Anderson 1965, Walker and Ni 2011)."""

import numpy as np

from reynolds.numerics.arrays import Array

REMEMBERED = 5  # earlier rounds that the extrapolation uses


class History:
    """The last points x and images g(x) of an iteration, of one shape."""

    def __init__(self) -> None:
        self._images: list[Array] = []
        self._rests: list[Array] = []

    def extrapolate(self, point: Array, image: Array) -> Array:
        """The next point to try: the mix of the last images whose changes, mixed alike, are least."""
        self._images.append(image.ravel())
        self._rests.append((image - point).ravel())
        del self._images[: -REMEMBERED - 1], self._rests[: -REMEMBERED - 1]
        if len(self._rests) == 1:
            return image
        slopes = np.diff(np.stack(self._rests), axis=0).T
        mix, *_ = np.linalg.lstsq(slopes, self._rests[-1], rcond=1e-10)
        steps = np.diff(np.stack(self._images), axis=0).T
        return np.asarray((self._images[-1] - steps @ mix).reshape(image.shape))
