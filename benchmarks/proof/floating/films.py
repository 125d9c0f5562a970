"""Films of plant and simulations: the pump, the box of its tables, and the physics that each simulation leaves out."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

from diagnosis.study.films.box import STEPS
from gaps.films.physics import Effect
from system.description.pump import PumpDescription
from system.inputs.channels import ChannelName
from system.points.floating_gaps import usual_options
from system.points.table.build import table_axes
from system.points.table.film_physics import FilmModel, FilmTask, film_model
from system.pump_file.file import load_pump
from system.work.processes import process_pool
from system.work.progress import Report, silent

PUMP = "ref90"
SPEEDS, PRESSURES = (10.0 * STEPS[ChannelName.SPEED], 22.0 * STEPS[ChannelName.SPEED]), (5e6, 25e6)
"""Box of the tables, SI, as `film_box` rounds that of the campaign, at full displacement and the pump's temperature."""
LEARNT, HELD_OUT = 8, 2
OFF: tuple[tuple[Effect, ...], ...] = (
    (),
    (Effect.ELASTIC_WALLS,),
    (Effect.HEAT,),
    (Effect.PRESSURE_VISCOSITY,),
    (Effect.ROUGHNESS,),
    (Effect.ELASTIC_WALLS, Effect.HEAT),
    (Effect.HEAT, Effect.PRESSURE_VISCOSITY),
    (Effect.ELASTIC_WALLS, Effect.ROUGHNESS),
    (Effect.PRESSURE_VISCOSITY, Effect.ROUGHNESS),
)
"""Physics left out by the simulations. Without cavitation the block's film has no solution: it would bear tension."""


def off_text(off: tuple[Effect, ...]) -> str:
    """Name of the physics that a simulation leaves out."""
    return "-".join(one.value for one in off) or "nothing"


@cache
def pump() -> PumpDescription:
    """The pump of plant and simulation."""
    own = load_pump(PUMP)
    return replace(own, operating=replace(own.operating, displacement_ratio=1.0))


def task(off: tuple[Effect, ...]) -> FilmTask:
    """The films of a simulation without some effects."""
    usual = usual_options(pump().pump.pistons)
    axes = table_axes(pump(), SPEEDS, PRESSURES, held=("displacement_ratio", "viscosity"))
    return FilmTask(pump(), replace(usual, physics=usual.physics.without(*off)), axes, LEARNT, HELD_OUT)


def model(off: tuple[Effect, ...], workers: int = 1, report: Report = silent, folder: Path | None = None) -> FilmModel:
    """The films of a diagnosis whose simulation leaves these effects out; tables are kept."""
    with process_pool(workers) as executor:
        return film_model(task(off), executor=executor, report=report, folder=folder)
