"""The part of a pump's page that shows its floating gaps, made from the run folder's own files."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from swashfilm.case.gap.physics_told import PHYSICS_HEAD, physics_told
from swashfilm.output.gap_names import TITLES
from swashfilm.output.page import inlined
from swashfilm.runs.film.revolution.plots import film_text, revolution_plots
from swashfilm.runs.pump.data import GAPS
from system.inputs.units import LPM

SHOWN = ("film", "path", "temperature", "contact", "maps")
SHOWN_UNLIKE = ("film", "path")
CAPTIONS = {
    "film": "film over the shaft angle, the chamber's pressure (dashed), and what limits the film",
    "path": "where the part stands; the colour is the shaft angle",
    "temperature": "temperature of film and walls",
    "contact": "contact, cavitation and the largest film pressure",
    "maps": "films at some of the kept angles",
}
HEAD = (
    "gap", "mean film", "least film", "leakage of one", "power of the walls", "of it contact", "contact, largest",
    "turns, multiplier",
)  # fmt: skip


def floating_view(folder: Path, summary: Mapping[str, Any]) -> dict[str, Any]:
    """What the template shows of floating gaps: rows with their head, pictures with captions, turns."""
    import xarray

    pictures = []
    shown: list[tuple[str, str, tuple[str, ...]]] = [(gap, TITLES[gap], SHOWN) for gap in GAPS]
    for place, kind in summary["unlike"].items():
        shown += [(f"{place}/{gap}", f"{TITLES[gap]}, {_numbers(kind)}", SHOWN_UNLIKE) for gap in kind["gaps"]]
    for group, title, names in shown:
        with xarray.open_dataset(folder / "results.nc", group=group, engine="h5netcdf") as data:
            drawn = revolution_plots(data.load())
        pictures += [(inlined(drawn[name]), f"{title}: {CAPTIONS[name]}") for name in names if name in drawn]
    turns = {TITLES[gap]: _table(folder / f"{gap}_convergence.csv") for gap in GAPS}
    return {
        "head": HEAD, "rows": floating_rows(summary), "pictures": pictures, "turns": turns,
        "physics_head": PHYSICS_HEAD,
        "physics": physics_told(summary["physics_left_out"], summary["cost"]["physics_seconds"]),
    }  # fmt: skip


def floating_rows(summary: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """A row a gap: films, leakage, friction, contact, and how its turn closed; then those of unlike chambers."""
    named = [(TITLES[gap], of) for gap, of in summary["gaps"].items()]
    for kind in summary["unlike"].values():
        named += [(f"{TITLES[gap]}, {_numbers(kind)}", of) for gap, of in kind["gaps"].items()]
    return [
        (
            name,
            f"{of['film_thickness_mean_m'] * 1e6:.2f} um",
            f"{film_text(of['film_thickness_min_m'] * 1e6)} at {of['film_thickness_min_at_deg']:.0f} deg",
            f"{of['leakage_flow_m3_per_s'] * LPM:.4f} L/min",
            f"{of['friction_power_W']:.1f} W",
            f"{of['rubbing_power_W']:.1f} W",
            f"{of['contact_load_max_N']:.0f} N",
            f"{of['turns']}, {of['largest_multiplier']:.2g}",
        )
        for name, of in named
    ]


def _numbers(kind: Mapping[str, Any]) -> str:
    return "chamber " + ", ".join(str(number) for number in kind["chambers"])


def _table(path: Path) -> list[list[str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.reader(file))
