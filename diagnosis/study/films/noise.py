"""Films of response tables in a study: the error of the tables as noise of the readings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.simulator import LumpedBench
from system.estimation.posterior import values_at
from system.points.table.film_physics import FilmModel

BALANCED_NAMES = frozenset({"film_thickness.slipper", "film_thickness.valve_plate", "eccentricity_ratio"})
"""Parameters of the lumped law that floating films find by the balance of forces."""


def table_noise(bench: LumpedBench, films: FilmModel) -> Array:
    """One sigma (N, C) of the readings, SI, from the errors of the tables of the films.

    Root of the sum of squares over the tables' outputs: the change of the readings by each output's error.
    """
    centre = values_at(bench.parameters, np.zeros(len(bench.parameters)))
    plain = bench.predict(centre)
    squares = np.zeros_like(plain)
    for output, error in films.error.items():
        law = replace(films.law, off={output: error})
        moved = bench.with_own_laws(
            tuple((law, own) if one is films.law else (one, own) for one, own in bench.own_laws)
        )
        squares += (moved.predict(centre) - plain) ** 2
    return np.sqrt(squares)
