"""Physics of a gap: switches, and the laws of oil and walls under them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from gaps.walls.pair import GapWalls
from reynolds.laws.contact import Asperities
from reynolds.laws.fluid import CONSTANT, Fluid
from reynolds.laws.roughness import Surface
from reynolds.problem import Cavitation
from reynolds.thermal.shear_thinning import ShearLaw, newtonian


class Effect(Enum):
    """A part of the physics that can be left out, each with the name of the field of `Physics` that it switches."""

    CAVITATION = "cavitation"
    PRESSURE_VISCOSITY = "pressure_viscosity"
    ROUGHNESS = "roughness"
    ELASTIC_WALLS = "elastic_walls"
    HEAT = "heat"


@dataclass(frozen=True)
class Physics:
    """Switches of the physics. Off: left out; on: as far as the pump file states it.

    cavitation: mass-conserving (JFO), else pressures may fall below the cavity's; pressure_viscosity: the fluid's
    laws over pressure, else viscosity and density are constant; roughness: flow factors and contact of asperities,
    else smooth walls that never touch; elastic_walls: walls deform, else rigid; heat: the film warms, else it
    has the case's temperature.
    """

    cavitation: bool = True
    pressure_viscosity: bool = True
    roughness: bool = True
    elastic_walls: bool = True
    heat: bool = True

    def without(self, *effects: Effect) -> Physics:
        """The same with these effects left out."""
        return replace(self, **{effect.value: False for effect in effects})

    def including(self, *effects: Effect) -> Physics:
        """The same with these effects too."""
        return replace(self, **{effect.value: True for effect in effects})

    @property
    def left_out(self) -> tuple[Effect, ...]:
        """Effects that are off, in the order of `Effect`, for the result."""
        return tuple(effect for effect in Effect if not getattr(self, effect.value))

    @property
    def left_out_words(self) -> tuple[str, ...]:
        """The same in words: "elastic walls"."""
        return tuple(effect.value.replace("_", " ") for effect in self.left_out)

    @property
    def film_rupture(self) -> Cavitation:
        """Cavitation model of the film solver."""
        return Cavitation.JFO if self.cavitation else Cavitation.NONE


@dataclass(frozen=True)
class FilmLaws:
    """Oil and walls of one gap for `reynolds.problem.FilmProblem`, the walls on any mesh.

    thinning: of the oil where it is sheared between sliding walls (`gaps.films.friction.wall_shear`).
    """

    fluid: Fluid = CONSTANT
    surface: Surface | None = None
    asperities: Asperities | None = None
    walls: GapWalls | None = None
    thinning: ShearLaw = newtonian


def laws_left(laws: FilmLaws, physics: Physics) -> FilmLaws:
    """The laws of a gap without those that `physics` switches off."""
    return FilmLaws(
        fluid=laws.fluid if physics.pressure_viscosity else CONSTANT,
        surface=laws.surface if physics.roughness else None,
        asperities=laws.asperities if physics.roughness else None,
        walls=laws.walls if physics.elastic_walls else None,
        thinning=laws.thinning,
    )
