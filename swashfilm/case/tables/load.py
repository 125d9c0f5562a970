"""Load of a film case: `film.load`, and moments where its walls may tilt."""

from __future__ import annotations

from reynolds.floating.load_search import RigidLoad
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity

_MOMENTS = ("moment_x", "moment_y")


def read_load(top: Table, film: Table) -> RigidLoad | None:
    """Return the load of a [film] table, SI; None where there is none, or with its faults listed."""
    if top.get("load") is not None:
        top.fault("load", "a table [load] of a free film", "keys of [film]", 'load = "1 kN" in [film]')
    stated = [key for key in _MOMENTS if film.get(key) is not None]
    moments = {key: film.quantity(key, Dimension.TORQUE) for key in stated}
    if film.get("load") is None:
        if stated:
            film.fault(stated[0], "a moment without a load", 'a load besides, such as load = "1 kN"')
        return None
    force = film.positive("load", Dimension.FORCE)
    if top.get("time") is not None:
        film.fault("load", "a load beside a table [time]", "one of the two: a transient states its thickness")
    return None if force is None or None in moments.values() else RigidLoad(force, **moments)


def load_rows(load: RigidLoad) -> dict[str, str]:
    """Return the keys as text of a case file."""
    moments = ((key, getattr(load, key)) for key in _MOMENTS)
    return {"load": f'"{format_quantity(load.force, Dimension.FORCE)}"'} | {
        key: f'"{format_quantity(value, Dimension.TORQUE)}"' for key, value in moments if value is not None
    }
