"""[physics] in films: effects that heat, stiffen, thin or open a film are solved in it, not applied as a factor.

    film_heating        films warm, between walls with the stated thermal resistance to the case
    viscosity_pressure  Barus' law at every place of the films; Roelands' where they float, under edges in contact
    elastic_opening     by compliance: the parts' own bodies, so many times as compliant; by opening: springs
    thermal_clearance   films of the thickness at the point's temperature (`film_thickness`)
    shear_thinning      Cross' law at the rate of sliding, at every place of the films

Floating films also compute lift, tipping and contact of their parts (BALANCED). All other effects remain the
closed-form laws of the lumped fidelity.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from gaps.films.physics import Effect, FilmLaws, Physics
from gaps.revolution.film_heat import GapHeat
from gaps.walls.pair import BoreWalls, GapWalls, PlateWalls
from gaps.walls.springs import SpringBore, SpringPlates
from reynolds.bodies.elasticity import Elastic
from reynolds.laws.fluid import Fluid, ViscosityLaw
from reynolds.laws.law import Tangent
from reynolds.laws.rheology import Cross
from reynolds.laws.viscosity import Roelands, barus
from system.description.assumptions import Assumption, Taken
from system.description.effects import FilmHeatingSection, OpeningSection
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.effect import EffectId
from system.effects.switched import switched_on
from system.films.cycle import GapPhysics
from system.films.heat import all_taken, block_heat, piston_heat, slipper_heat
from system.films.parts import FloatingParts
from system.films.rotor import Rotor
from system.inputs.units import Dimension, format_quantity
from system.pump.film_thickness import given_film, opening_share

SOLVED = (
    EffectId.FILM_HEATING,
    EffectId.VISCOSITY_PRESSURE,
    EffectId.ELASTIC_OPENING,
    EffectId.THERMAL_CLEARANCE,
    EffectId.SHEAR_THINNING,
)
"""Effects that films solve; any other effect acts by its closed-form law."""
BALANCED = {
    EffectId.SLIPPER_LIFT: "the slippers ride and tilt as the forces on them balance",
    EffectId.BLOCK_TIPPING: "the block tips as the forces on it balance",
    EffectId.MIXED_FRICTION: "asperities bear and rub where films are thin",
}
"""Effects that floating films compute by themselves, without the numbers of [physics], with the method."""
_SOLVED_SHARES = (0.0, 1.0, 0.0)
"""carried_share, throttled_share and carry_over with which the closed-form law is nearest to solved films."""
_PART = {Gap.PISTON: "piston", Gap.SLIPPER: "slipper", Gap.VALVE_PLATE: "block"}
_FACES = {
    Gap.PISTON: ("bushing", "piston"),
    Gap.SLIPPER: ("swash_plate", "slipper"),
    Gap.VALVE_PLATE: ("valve_plate", "block"),
}
_HEAT: Mapping[Gap, Callable[[Rotor, FloatingParts], GapHeat]] = {
    Gap.PISTON: piston_heat,
    Gap.SLIPPER: slipper_heat,
    Gap.VALVE_PLATE: block_heat,
}


@dataclass(frozen=True)
class FilmEffects:
    """Films with the physics that [physics] switches on: their parts, and the effects in each gap."""

    parts: FloatingParts
    physics: GapPhysics


@dataclass(frozen=True)
class BarusAboveCase:
    """Barus' law from the case's pressure (Pa) on, at which the point's viscosity holds; coefficient 1/Pa."""

    coefficient: float
    case_pressure: float

    def __call__(self, pressure: ArrayLike, viscosity_at_case: ArrayLike) -> Tangent:
        """Viscosity (Pa s) and its slope; raises as `barus`."""
        resting = np.asarray(viscosity_at_case) * math.exp(-self.coefficient * self.case_pressure)
        return barus(pressure, resting, self.coefficient)


def effects_in_films(
    pump: PumpDescription, floating: bool = False
) -> tuple[tuple[EffectId, ...], tuple[EffectId, ...]]:
    """Effects of [physics] that films solve, and those that remain closed-form laws."""
    on, solved = dict.fromkeys(extension.id for extension, _ in switched_on(pump)), _solved(floating)
    return tuple(one for one in on if one in solved), tuple(one for one in on if one not in solved)


def closed_laws(pump: PumpDescription, floating: bool = False) -> PumpDescription:
    """The pump with only those effects that no film solves."""
    off = dict.fromkeys(one.value for one in _solved(floating))
    return replace(pump, physics=replace(pump.physics, **off))


def film_laws(pump: PumpDescription) -> PumpDescription:
    """The pump with only those effects that films at given positions solve; all of its films depend on these."""
    off = {one.id.value: None for one, _ in switched_on(pump) if one.id not in SOLVED}
    return replace(pump, physics=replace(pump.physics, **off))


def _solved(floating: bool) -> tuple[EffectId, ...]:
    return (*SOLVED, *BALANCED) if floating else SOLVED


def film_effects(rotor: Rotor, parts: FloatingParts, pump: PumpDescription, physics: GapPhysics) -> FilmEffects:
    """Parts and physics of the films with the pump's [physics], in addition to `physics`.

    rotor, parts: of the pump with its film thicknesses. Differences between films and closed-form laws are listed
    among the parts' assumptions.
    """
    found = _with_effects(rotor, parts, pump, physics, lambda coefficient: _barus(rotor, coefficient))
    taken = all_taken(rotor, found.parts, found.physics.piston)
    return replace(found, parts=replace(found.parts, taken=taken))


def floating_effects(rotor: Rotor, parts: FloatingParts, pump: PumpDescription, physics: Physics) -> FilmEffects:
    """The same for floating films; the effects that they compute by themselves are listed among the assumptions."""
    found, taken = _with_effects(rotor, parts, pump, GapPhysics.alike(physics), Roelands), Taken()
    if pump.physics.viscosity_pressure is not None:
        reason = "of the same coefficient; films under edges that touch pass the pressures of Barus' law"
        taken.note("physics.viscosity_pressure", "Roelands' law", reason)
    for effect, how in BALANCED.items():
        if getattr(pump.physics, effect.value) is not None:
            smooth = effect is EffectId.MIXED_FRICTION and not physics.roughness
            reason = "smooth films, which nothing touches" if smooth else how
            taken.note(f"physics.{effect.value}", "computed by the floating films, not by its law", reason)
    return replace(found, parts=replace(found.parts, taken=(*found.parts.taken, *taken.assumptions)))


def _barus(rotor: Rotor, coefficient: float) -> BarusAboveCase:
    return BarusAboveCase(coefficient, rotor.point.case_pressure)


def _with_effects(
    rotor: Rotor,
    parts: FloatingParts,
    pump: PumpDescription,
    physics: GapPhysics,
    stiffening: Callable[[float], ViscosityLaw],
) -> FilmEffects:
    stated, taken = pump.physics, list(parts.taken)
    on: dict[Gap, Physics] = {gap: getattr(physics, gap.value) for gap in Gap}
    if stated.viscosity_pressure is not None and stated.viscosity_pressure.coefficient > 0.0:
        fluid = Fluid(viscosity=stiffening(stated.viscosity_pressure.coefficient))
        parts = _with_laws(parts, lambda gap, laws: replace(laws, fluid=fluid))
        on = {gap: own.including(Effect.PRESSURE_VISCOSITY) for gap, own in on.items()}
        taken = [one for one in taken if one.path != "oil.pressure_viscosity"]
    if stated.elastic_opening is not None:
        soft = {gap: softened(pump, gap, getattr(parts, _PART[gap]).laws.walls) for gap in Gap}
        parts = _with_laws(parts, lambda gap, laws: replace(laws, walls=soft[gap] or laws.walls))
        on = {gap: own.including(Effect.ELASTIC_WALLS) if soft[gap] else own for gap, own in on.items()}
    if stated.shear_thinning is not None:
        thins = Cross(1.0 - stated.shear_thinning.drop, 1.0 / stated.shear_thinning.rate, 1.0)
        parts = _with_laws(parts, lambda gap, laws: replace(laws, thinning=thins))
    if stated.film_heating is not None:
        parts, assumed = _between_walls(rotor, parts, stated.film_heating)
        on = {gap: own.including(Effect.HEAT) for gap, own in on.items()}
        taken += assumed
    return FilmEffects(replace(parts, taken=tuple(taken)), GapPhysics(*(on[gap] for gap in Gap)))


def softened(pump: PumpDescription, gap: Gap, walls: GapWalls | None) -> GapWalls | None:
    """The walls that [physics.elastic_opening.GAP] gives a film; None for rigid ones, and without a table.

    compliance C: the parts' own bodies with moduli E/C, since displacement is proportional to 1/E. opening s, a share
    of the film per pressure: a wall on springs with deformation s p h0 under a pressure p.
    """
    stated: OpeningSection | None = getattr(pump.physics.elastic_opening, gap.value)
    if stated is None or walls is None:
        return None
    if stated.compliance is not None:
        return _softer(walls, stated.compliance) if stated.compliance > 0.0 else None
    springs = opening_share(pump, gap) * given_film(pump, gap)
    if springs == 0.0:
        return None
    if isinstance(walls, BoreWalls):
        return SpringBore(walls.piston, walls.bushing, compliance=springs)
    assert isinstance(walls, PlateWalls)
    return SpringPlates(walls.parts, compliance=springs)


def _softer(walls: GapWalls, times: float) -> GapWalls:
    """The same bodies, so many times as compliant."""

    def softer(part: Any) -> Any:
        return replace(part, elastic=Elastic(part.elastic.youngs_modulus / times, part.elastic.poisson_ratio))

    if isinstance(walls, BoreWalls):
        return BoreWalls(softer(walls.piston), softer(walls.bushing))
    assert isinstance(walls, PlateWalls)
    one, two = walls.parts
    return PlateWalls((softer(one), softer(two)))


def _between_walls(
    rotor: Rotor, parts: FloatingParts, stated: FilmHeatingSection
) -> tuple[FloatingParts, tuple[Assumption, ...]]:
    """Parts by which a film's mean temperature has the stated resistance to the case (`even_rise`); ratios stay.

    The walls have no resistance where the film alone has more than is stated.
    """
    materials, taken = dict(parts.materials), Taken()
    for gap in Gap:
        heat = _HEAT[gap](rotor, parts)
        across = given_film(rotor.pump, gap) / heat.conductivity
        walls = heat.fixed.resistance, heat.moving.resistance
        times = resisting(float(getattr(stated, gap.value)), across, *walls)
        for name in _FACES[gap]:
            conductivity = materials[name].thermal_conductivity / times if times > 0.0 else math.inf
            materials[name] = replace(materials[name], thermal_conductivity=conductivity)
        drawn = format_quantity(even_rise(across, *walls), Dimension.THERMAL_RESISTANCE, digits=5)
        taken.note(
            f"walls of the {gap.value.replace('_', ' ')} film", f"{times:.3g} times as resistant to heat",
            f"as [physics.film_heating] states; by drawing and material {drawn}",
        )  # fmt: skip
    shares = stated.carried_share, stated.throttled_share, stated.carry_over
    if shares != _SOLVED_SHARES:
        stated_shares = "carried_share {:.3g}, throttled_share {:.3g} and carry_over {:.3g}".format(*shares)
        taken.note("heat of the oil", "as the films carry it", f"{stated_shares} are of the closed-form law alone")
    return replace(parts, materials=materials), tuple(taken.assumptions)


def even_rise(across: float, one: float, two: float) -> float:
    """Mean rise of a film over the case per heat that arises evenly across it, m2 K/W.

    across: h/k of the film, between walls of the resistances one and two (m2 K/W). T'' = -q/(h k) between walls at R1
    q1 and R2 q2: q1/q = (h/(2 k) + R2)/(R1 + R2 + h/k), mean/q = (R1 q1 + R2 q2)/(2 q) + h/(12 k).
    """
    share = (0.5 * across + two) / (one + two + across)
    return 0.5 * (one * share + two * (1.0 - share)) + across / 12.0


def resisting(wanted: float, across: float, one: float, two: float) -> float:
    """Factor on the resistance of the walls for the wanted `even_rise` (m2 K/W) of a film; 0 where the film alone
    exceeds it.
    """
    if wanted <= across / 12.0:
        return 0.0
    most = 2.0 * wanted / min(one, two) + 2.0  # there even the better wall alone would cause a larger rise

    def missing(times: float) -> float:
        return even_rise(across, times * one, times * two) - wanted

    return float(brentq(missing, 0.0, most))


def _with_laws(parts: FloatingParts, changed: Callable[[Gap, FilmLaws], FilmLaws]) -> FloatingParts:
    """The parts with the laws of each gap's film changed."""
    found = {name: getattr(parts, name) for name in _PART.values()}
    return replace(
        parts, **{name: replace(found[name], laws=changed(gap, found[name].laws)) for gap, name in _PART.items()}
    )
