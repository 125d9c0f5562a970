"""Eight neighbouring numbers of an array as one value in compiled loops.

A loop that reads a dozen arrays and writes one is vectorised by the compiler only behind a dozen tests that they
do not overlap, which short loops do not repay. `lanes(array, at)` reads array[at : at + 8], `put_lanes` writes it,
and +, -, *, / go number by number. Indices are not checked.

The environment variable SWASHFILM_LANES=scalar takes plain loops in place of vector registers, for a numba whose
internals have changed; give it a NUMBA_CACHE_DIR of its own, since compiled code is kept by file.
"""

import os

SCALAR = os.environ.get("SWASHFILM_LANES") == "scalar"

if SCALAR:
    from reynolds.numerics.scalar_lanes import (
        WIDTH,
        all_lanes,
        apart,
        lanes,
        lanes_like,
        put_lanes,
        together,
        where_positive,
    )  # fmt: skip
else:
    from reynolds.numerics.vector_lanes import (
        WIDTH,
        all_lanes,
        apart,
        lanes,
        lanes_like,
        put_lanes,
        together,
        where_positive,
    )  # fmt: skip

__all__ = [
    "SCALAR", "WIDTH", "all_lanes", "apart", "lanes", "lanes_like", "put_lanes", "together", "where_positive",
]  # fmt: skip
