"""Fields of a film for results.nc: one film, or those of a transient over time, bounded in size."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from swashfilm.runs.film.checks.validity import thinned_by
from swashfilm.runs.film.solve.study import FilmStudy
from swashfilm.runs.film.solve.transient import Moment
from swashfilm.runs.film.summary import film_dataset

if TYPE_CHECKING:
    import xarray


def fields_over_time(study: FilmStudy) -> xarray.Dataset:
    """Return fields as `film_dataset`; for a transient those of the written films over `time` (s), with the last.

    Where they exceed `validity.MOST_BYTES`, only every n-th film is included.
    """
    import xarray

    moments = written(study.history)
    every = thinned_by(study)
    kept = moments[::-1][::every][::-1]
    if len(kept) < 2:
        return film_dataset(study)
    films = [film_dataset(at_moment(study, moment)) for moment in kept]
    time = xarray.IndexVariable("time", [moment.time for moment in kept], {"units": "s"})
    varying = [name for name in films[0].data_vars if name != "cells"]
    return xarray.concat(films, time, data_vars=varying, coords="minimal", compat="override")


def written(history: tuple[Moment, ...]) -> list[Moment]:
    """Return the moments with written films."""
    return [moment for moment in history if moment.solution]


def at_moment(study: FilmStudy, moment: Moment) -> FilmStudy:
    """Return the study with the film of a written moment."""
    assert moment.solution is not None
    return replace(study, solution=moment.solution, heat=moment.heat)


def last_of(fields: xarray.Dataset) -> xarray.Dataset:
    """Return the fields at the end of a transient, or those of a single film."""
    return fields.isel(time=-1) if "time" in fields.dims else fields
