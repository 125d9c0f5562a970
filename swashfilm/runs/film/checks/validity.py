"""Validity of a solved film: warnings, each with its number, limit and remedy."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from reynolds.laws.contact import lambda_ratio
from reynolds.laws.fluid import isoviscous
from reynolds.laws.roughness import beyond_range
from reynolds.problem import Cavitation, FilmSolution, Pocket
from reynolds.solve.loads import couette_through, dissipated
from reynolds.solve.rubbing import rubbing
from swashfilm.runs.film.checks.extent import Warned, extent_warnings
from swashfilm.runs.film.checks.regime import regime_warnings
from swashfilm.runs.film.checks.scale import natural_sizes
from swashfilm.runs.film.checks.seam import seam_warnings
from swashfilm.runs.film.solve.gap import gap_warnings
from system.inputs.shown import pressure_text

if TYPE_CHECKING:
    from swashfilm.runs.film.solve.study import FilmStudy

LARGEST_CAVITY_FLOW = 0.01  # of the throughput; Reynolds' condition creates or removes oil in a cavity
FEW_UNKNOWNS = 8
LARGEST_FALL = 2.0  # ratio of film thicknesses within a cell
MOST_BYTES = 200e6  # of the fields of a transient in results.nc
MOST_FIELDS = 11  # at vertices and in cells
LARGEST_RISE = 10.0  # K; the viscosity of oil falls by a quarter to a third
HOTTEST = 393.15  # K (120 degC), above which mineral oils age within hours
HEAT_CAPACITY = 1.7e6  # J/(m3 K), of mineral oils
CONDUCTIVITY = 0.13  # W/(m K), of mineral oils
LEAST_FILM_FRACTION = 1e-3
LEAST_INFLOW = 1e-6  # of the flows within the film; less is round-off of the edges' directions
MOST_CAVITY = 0.5  # of the film's area, beside which a film without pressure of its own is no seal with a cavity
VACUUM = -101325.0  # Pa, gauge
LEAST_LAMBDA = 1.0  # h/sigma; below, contacts support most of the load
LARGEST_ISOVISCOUS_PRESSURE = 50e6  # Pa; the viscosity of a mineral oil is about three times its low-pressure value
LARGEST_FLANK_POWER = 0.05  # of the largest power: work on the flanks of rough walls
LARGEST_OIL_PRESSURE = 1e9  # Pa; oil turns solid about it, and hardened steel yields soon above it


def film_warnings(study: FilmStudy) -> list[dict[str, str]]:
    """Return name and text of each warning of a solved film."""
    found = [
        *_flow_warnings(study),
        *_mesh_warnings(study.solution),
        *_rough_warnings(study),
        *_pressure_warnings(study),
        *_supply_warnings(study),
        *seam_warnings(study.solution.problem, study.geometry),
        *regime_warnings(study.solution),
        *_heat_warnings(study),
        *_size_warnings(study),
        *_one_sided_warnings(study),
    ]
    own = [] if study.gap is None else gap_warnings(study.gap)
    return own + [{"name": name, "text": text} for name, text in found]


def _flow_warnings(study: FilmStudy) -> Iterator[Warned]:
    """Yield warnings of a cavity that creates oil, of a film unlike its extent, and of oil under tension."""
    problem, integrals = study.solution.problem, study.loads
    through = integrals.throughput
    share = abs(integrals.cavity_flow) / through if through > 0.0 else np.inf * abs(integrals.cavity_flow)
    if integrals.cavity_flow != 0.0 and share > LARGEST_CAVITY_FLOW:
        verb = "makes" if integrals.cavity_flow > 0.0 else "swallows"
        yield (
            "cavity_does_not_conserve_mass",
            f"Reynolds' condition {verb} oil in the cavity, {share:.2%} of the throughput "
            f"(limit {LARGEST_CAVITY_FLOW:.0%}): inflow and outflow differ",
        )
    yield from extent_warnings(problem.space, study.solution.film.thickness)
    lowest = float(study.solution.pressure.min())
    if problem.cavitation is Cavitation.NONE and lowest < problem.cavitation_pressure:
        yield (
            "pressure_below_cavitation",
            f"the film is pulled down to {pressure_text(lowest)} (limit {pressure_text(problem.cavitation_pressure)}, "
            "its cavitation pressure): oil would cavitate; choose cavitation = 'jfo'",
        )


def _mesh_warnings(solution: FilmSolution) -> Iterator[Warned]:
    """Yield a warning of a mesh with few pressure unknowns, or with large changes of the film within a cell."""
    few, thickness = int(np.count_nonzero(~solution.held)), solution.film.thickness
    fall = float(np.max(thickness.max(axis=1) / thickness.min(axis=1)))
    reasons = []
    if few < FEW_UNKNOWNS:
        reasons.append(f"pressure is solved at only {few} points (fewer than {FEW_UNKNOWNS})")
    if fall > LARGEST_FALL:
        reasons.append(f"the film changes {fall:.3g} times within a cell (limit {LARGEST_FALL:g})")
    if reasons:
        yield "coarse_mesh", f"{', '.join(reasons)}: --refine 3 measures the error"


def _heat_warnings(study: FilmStudy) -> Iterator[Warned]:
    """Yield a warning of an isothermal film with notable heat, or of a film too hot for oil."""
    if study.heat is not None:
        if (hottest := float(study.heat.highest.max())) > HOTTEST:
            yield (
                "film_hot",
                f"the film reaches {hottest - 273.15:.0f} degC (limit {HOTTEST - 273.15:.0f} degC for mineral oils, "
                "which age quickly above it): use more flow, a thicker film, or walls with more heat transfer",
            )
    elif not study.gap and not study.history and (rise := _least_rise(study)) > LARGEST_RISE:
        yield (
            "temperature_not_solved",
            f"the film's heat raises its temperature by about {rise:.3g} K even between cold walls (limit "
            f"{LARGEST_RISE:g} K for an isothermal film): the viscosity falls; add a table [thermal]",
        )


def _least_rise(study: FilmStudy) -> float:
    """Return the mean rise (K) of the film's temperature with heat removed by both the flow and cold walls.

    Flow alone: heat/(rho c Q); walls alone: heat per area x h/(12 k), that of a parabola across the film.
    """
    solution = study.solution
    area, film = solution.problem.space.area, solution.film
    driven, sliding = dissipated(solution)
    # Heat of the contacts flows into the walls.
    contact = rubbing(film, solution.problem.asperities, solution.gap, area.shape)
    heat = float(np.sum(driven + sliding)) - float(np.sum(contact.heat * area))
    mean = float(np.sum(film.thickness * area)) / float(area.sum())
    by_flow = HEAT_CAPACITY * study.loads.throughput
    by_walls = 12.0 * CONDUCTIVITY * float(area.sum()) / mean
    return heat / (by_flow + by_walls)


def thinned_by(study: FilmStudy) -> int:
    """Return n where results.nc holds every n-th film of a transient, so that it is smaller than MOST_BYTES."""
    films = sum(moment.solution is not None for moment in study.history)
    size = films * MOST_FIELDS * 8.0 * len(study.solution.problem.space.vertices)
    return max(1, int(np.ceil(size / MOST_BYTES)))


def _size_warnings(study: FilmStudy) -> Iterator[Warned]:
    if (every := thinned_by(study)) > 1:
        yield (
            "results_thinned",
            f"results.nc holds one of every {every} written films, to stay below {MOST_BYTES * 1e-6:g} MB; all are "
            "in film_NNNN.vtu; with fewer outputs or a coarser mesh results.nc holds all of them",
        )


def _one_sided_warnings(study: FilmStudy) -> Iterator[Warned]:
    """Yield a warning of derivatives that are one-sided, since the cavity changes with the slightest change."""
    if study.sensitivity is not None and (weak := study.sensitivity.weak):
        yield (
            "weakly_active_cavity",
            f"{weak} of {study.solution.problem.space.size} unknowns neither bear pressure nor lack oil (limit: none, "
            "to 1e-6 of the largest pressure): the cavity may open or close there with the slightest change, so that "
            "the sensitivities hold for changes to one side only; compare with films that are a little thicker and "
            "thinner",
        )


def _rough_warnings(study: FilmStudy) -> Iterator[Warned]:
    solution, surface = study.solution, study.solution.problem.surface
    if surface is None:
        return
    least = float(lambda_ratio(solution.film.thickness.min(), surface.composite_roughness))
    if least < LEAST_LAMBDA:
        yield (
            "boundary_lubrication",
            f"the least lambda ratio h/sigma is {least:.3g} (limit {LEAST_LAMBDA:g}): contacts "
            f"support most of the load there, beyond the range of the film equation{_boundary_remedy(study)}",
        )
    beyond = beyond_range(solution.film.thickness, surface)
    if beyond.fraction > 0.0:
        yield (
            "flow_factors_out_of_range",
            f"h/sigma is {beyond.lowest_ratio:.3g} at the least, below the {beyond.limit:g} down to "
            f"which Patir and Cheng's flow factors are published, on {beyond.fraction:.1%} of the film: "
            "they are extrapolated; use a thicker film or smoother walls",
        )
    if (missing := study.loads.energy_balance_error) > LARGEST_FLANK_POWER:
        yield (
            "friction_of_rough_walls",
            f"{missing:.0%} of the largest power is not in the energy balance (limit {LARGEST_FLANK_POWER:.0%}): it is "
            "the work of the pressure on the flanks of the asperities, which no published factor includes; friction "
            "and dissipation are uncertain by as much; use a thicker film or smoother walls",
        )


def _boundary_remedy(study: FilmStudy) -> str:
    """Return the remedy for contacts that support load, for a free film or a pump's gap."""
    if study.gap:
        return (
            f"; the asperities support {study.gap.film.contact_load:.4g} N in total: use an oil of higher "
            "viscosity, less load, or smoother walls (composite_roughness in [pump.surfaces.PAIR])"
        )
    return "" if study.solution.problem.asperities else "; a table [contact] adds the load on the asperities"


def _pressure_warnings(study: FilmStudy) -> Iterator[Warned]:
    """Yield a warning of pressures beyond those of any oil, or else of an isoviscous free film of high pressure."""
    highest = study.loads.pressure_max
    if highest > LARGEST_OIL_PRESSURE:
        yield beyond_oil(highest, elastic=study.solution.problem.walls is not None)
        return
    constant = study.solution.problem.fluid.viscosity is isoviscous
    if constant and not study.gap and highest > LARGEST_ISOVISCOUS_PRESSURE:
        yield (
            "viscosity_without_pressure",
            f"the film reaches {pressure_text(highest)} (limit {pressure_text(LARGEST_ISOVISCOUS_PRESSURE)} for a "
            "constant viscosity): viscosity is several times higher; add pressure_law in [oil]"
            + ("" if study.solution.problem.walls else ", and elastic walls, [elastic]"),
        )


def beyond_oil(highest: float, *, elastic: bool) -> Warned:
    """Return the warning of a film whose largest pressure (Pa) is above LARGEST_OIL_PRESSURE, between such walls."""
    return (
        "film_pressure_beyond_oil",
        f"the film reaches {pressure_text(highest)} (limit {pressure_text(LARGEST_OIL_PRESSURE)}, about which oil "
        "turns solid; steel yields soon above it): no such film exists; check the units of film thickness, speed, "
        f"viscosity and load{'' if elastic else ', and add elastic walls'}",
    )


def _supply_warnings(study: FilmStudy) -> Iterator[Warned]:
    """Yield warnings of a starved film, of one without supply, and of a cavitation pressure below vacuum."""
    problem, least = study.solution.problem, float(study.solution.film_fraction.min())
    if study.gap is None and not study.history and study.solution.cavity.any():
        yield from _cavity_warnings(study)
    if study.gap is None and not study.history and least < LEAST_FILM_FRACTION:
        yield (
            "film_runs_dry",
            f"the film fraction falls to {max(least, 0.0):.2g} (limit {LEAST_FILM_FRACTION:g}): no oil reaches a part "
            "of the film; is its inflow edge closed? A boundary that is not named is closed",
        )
    if problem.cavitation is not Cavitation.NONE and problem.cavitation_pressure < VACUUM:
        yield (
            "cavitation_below_vacuum",
            f"the cavitation pressure is {pressure_text(problem.cavitation_pressure, 4)} gauge (vacuum: "
            f"{pressure_text(VACUUM, 4)}): oil cavitates before; is the value absolute, not gauge?",
        )


def _cavity_warnings(study: FilmStudy) -> Iterator[Warned]:
    """Yield warnings of a steady free film whose cavity nothing fills, and of one that bears no pressure of its own."""
    solution, share = study.solution, study.loads.cavitated_area_fraction
    problem, level = solution.problem, solution.problem.cavitation_pressure
    given = float(np.max(solution.pressure[solution.held], initial=level))
    fed = any(isinstance(condition, Pocket) for condition in problem.boundary.values())
    # At the cavitation pressure, the least of the film, oil enters with a wall's motion alone.
    entering = sum(float(-np.minimum(flow, 0.0).sum()) for flow in couette_through(solution).values())
    closed = entering <= LEAST_INFLOW * natural_sizes(solution)["flow"]
    if problem.cavitation is Cavitation.JFO and given <= level and closed and not fed:
        yield (
            "film_without_supply",
            f"{share:.0%} of the film cavitates, no boundary is above the cavitation pressure and no oil enters: the "
            "oil that this steady film holds is arbitrary, and its pressure and load fall with every finer mesh; add a "
            "supply (a groove or an edge held above it), a cavitation pressure below ambient ('-0.7 bar'), [time] from "
            "a known filling, or cavitation = 'reynolds', which feeds the film as a flooded one",
        )
    elif share > MOST_CAVITY and float(solution.pressure.max()) <= given:
        yield (
            "film_builds_no_pressure",
            f"{share:.0%} of the film cavitates (limit {MOST_CAVITY:.0%}) and nowhere is it above the pressure of its "
            f"boundaries, {pressure_text(given)}: it bears nothing of its own; {_wrong_way(solution)}",
        )


def _wrong_way(solution: FilmSolution) -> str:
    """Return the cause to look for where a film builds no pressure: sliding or, between walls at rest, squeeze."""
    film = solution.film
    if any(np.any(part) for part in (*film.velocity_moving, *film.velocity_fixed)):
        return (
            "is the sign of the velocity right? A film has to become thinner along the motion of the wall that slides"
        )
    return "its walls move apart; is the sign of squeeze right? It is dh/dt, below zero where the film closes"
