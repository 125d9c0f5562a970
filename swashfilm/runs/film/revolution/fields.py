"""Kept films of a turn for ParaView: surfaces in their position in the pump, a series over the shaft angle."""

from pathlib import Path

import numpy as np

from reynolds.solve.export import write_pvd, write_vtu
from swashfilm.output.gap_names import FIELDS, vtu_name
from swashfilm.runs.film.revolution.data import film_temperatures
from swashfilm.runs.film.revolution.solve import RevolutionStudy
from system.films.places import place_of


def write_revolution_fields(folder: Path, study: RevolutionStudy) -> None:
    """Write fields/<gap>_NNN.vtu of every kept film and, over them, <gap>.pvd (time = shaft angle in degrees).

    With solved temperature the files hold `film_temperature` (K), its mean over the thickness.
    """
    (folder / FIELDS).mkdir(exist_ok=True)
    gap, entries, warm = study.case.gap.value, [], film_temperatures(study)
    for k, (angle, film) in enumerate(study.revolution.turn.films.items()):
        name = f"{FIELDS}/{vtu_name(gap, k)}"
        place = place_of(study.case.gap, study.case.rotor, study.parts, angle)
        write_vtu(folder / name, film, place, None if warm is None else {"film_temperature": warm[k]})
        entries.append((float(np.degrees(angle)), 0, name))
    write_pvd(folder / f"{gap}.pvd", entries)
