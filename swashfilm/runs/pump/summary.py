"""Summary of an operating point, summary.json: headline numbers in SI with units in the keys, checks, warnings."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, fields
from typing import Any

import numpy as np

from gaps.standing.gap_film import GapFilm
from swashfilm.console.fidelity import Fidelity
from swashfilm.formats.versions import headed
from swashfilm.output.data.gap_names import LARGEST_RIGID_PRESSURE, kind_folder
from swashfilm.runs.film.solve.gap import borne, imbalance
from swashfilm.runs.pump.coefficients.edge_losses import loss_records
from swashfilm.runs.pump.coefficients.flow import coefficient_records
from swashfilm.runs.pump.data import GAPS, PARTS, named_films
from system.description.pump import PumpDescription
from system.effects.effect import EffectId
from system.inputs.shown import pressure_text
from system.points.film_effects import effects_in_films
from system.points.films import FilmsKind, FilmsPoint
from system.pump.assembly import PumpPoint
from system.pump.bench import Efficiency, energy_split, ideal_flow, ideal_torque, paper_losses
from system.pump.laws.friction_pairs import Pair

LARGEST_SAMPLING_ERROR = 0.02


def pump_summary(
    pump: PumpDescription, point: PumpPoint, films: FilmsPoint | None, warnings: Sequence[str]
) -> dict[str, Any]:
    """Return the summary of an operating point; `films` is None in the lumped fidelity."""
    losses = paper_losses(point.bench)
    split = energy_split(point.bench, pump.oil.bulk_modulus)
    return {
        **headed("pump"),
        "name": pump.name,
        "fidelity": (Fidelity.FIXED if films else Fidelity.LUMPED).value,
        "operating_point": _operating_point(point),
        "displacement": {
            "geometric_m3_per_rev": point.geometric_displacement,
            "derived_m3_per_rev": point.derived_displacement,
        },
        "flow": {
            "delivery_m3_per_s": point.bench.delivery_flow,
            "inlet_m3_per_s": point.bench.inlet_flow,
            "case_m3_per_s": point.bench.drain_flow,
            "geometric_m3_per_s": ideal_flow(point.geometric_displacement, point.point.shaft_speed),
        },
        "ripple": _ripple(point),
        "leakage": {f"{gap}_m3_per_s": flow for gap, flow in asdict(point.leakage_flow).items()},
        "torque": {
            "shaft_Nm": point.bench.shaft_torque,
            "ideal_delivery_Nm": ideal_torque(point.geometric_displacement, point.point.delivery_pressure),
            "ideal_difference_Nm": ideal_torque(
                point.geometric_displacement, point.point.delivery_pressure - point.point.inlet_pressure
            ),
        },
        "efficiency": {"paper": _efficiency(point.paper_efficiency), "iso_4409": _efficiency(point.iso_efficiency)},
        "paper_loss": {
            **{f"{name}_W": value for name, value in asdict(losses).items()},
            "hydromechanical_share": losses.hydromechanical_share,
        },
        "bench_split": {f"{name}_W": value for name, value in asdict(split).items()},
        "pair_loss": {pair.value: _pair(point, pair) for pair in Pair},
        "power_balance": _power(point),
        "physics": _physics(pump, films),
        "gaps": _gaps(films.kinds[0], GAPS) if films else {},
        "unlike": _unlike(films) if films else {},
        "checks": _checks(point, films),
        "coefficients": [*coefficient_records(pump), *loss_records(pump)],
        "assumptions": [str(one) for one in films.parts.taken] if films else [],
        "warnings": list(warnings),
    }


def _physics(pump: PumpDescription, films: FilmsPoint | None) -> dict[str, list[str]]:
    """Return the effects of [physics], those solved by the films and those of closed-form laws."""
    solved, laws = effects_in_films(pump)
    return effect_lists(solved, laws) if films else effect_lists((), (*solved, *laws))


def effect_lists(solved: Sequence[EffectId], laws: Sequence[EffectId]) -> dict[str, list[str]]:
    """Return the names of effects that films solve, and of those of closed-form laws."""
    return {"films_solve": [one.value for one in solved], "closed_laws": [one.value for one in laws]}


def _gaps(kind: FilmsKind, gaps: Sequence[str]) -> dict[str, Any]:
    return {gap: gap_report(getattr(kind.gaps, gap)) for gap in gaps}


def _unlike(films: FilmsPoint) -> dict[str, Any]:
    """Return the gaps of chambers of the less common kinds."""
    return {
        kind_folder(kind.chambers): {"chambers": [k + 1 for k in kind.chambers], "gaps": _gaps(kind, PARTS)}
        for kind in films.kinds[1:]
    }


def chamber_numbers(kind: Mapping[str, Any]) -> str:
    """Return the chambers of a less common kind by name."""
    return "chamber " + ", ".join(str(number) for number in kind["chambers"])


def gap_report(series: Sequence[GapFilm]) -> dict[str, Any]:
    """Return film, supported share of the load, leakage and friction of a gap over the turn at given positions."""
    fractions = [film.carried_fraction for film in series]
    return {
        "film_thickness_mean_m": float(np.mean([film.film_thickness_mean for film in series])),
        "film_thickness_min_m": min(film.loads.film_thickness_min for film in series),
        "carried_fraction_min": min(fractions),
        "carried_fraction_max": max(fractions),
        "friction_power_mean_W": float(np.mean([film.friction_power for film in series])),
        "leakage_flow_mean_m3_per_s": float(np.mean([film.leakage_flow for film in series])),
        "pressure_max_Pa": max(film.loads.pressure_max for film in series),
        "mass_balance_error_max": max(film.loads.mass_balance_error for film in series),
        "energy_balance_error_max": max(film.loads.energy_balance_error for film in series),
        "unknowns": series[0].solution.problem.space.size,
        "statement": gap_statement(series),
    }


def gap_statement(series: Sequence[GapFilm]) -> str:
    """Return a sentence on the share of the load that the film supports at the described position."""
    return (
        f"position given by the description at {len(series)} angles; the film bears, at the worst angle, "
        f"{borne(worst_film(series))}"
    )


def worst_film(series: Sequence[GapFilm]) -> GapFilm:
    """Return the film whose load differs most from the required one."""
    return max(series, key=lambda film: abs(film.required_load - film.carried_load))


def _efficiency(found: Efficiency | None) -> dict[str, float | None]:
    """Return the three efficiencies, None where undefined."""
    return {part.name: getattr(found, part.name) if found else None for part in fields(Efficiency)}


def _operating_point(point: PumpPoint) -> dict[str, float]:
    p = point.point
    return {
        "shaft_speed_rad_per_s": p.shaft_speed,
        "delivery_pressure_Pa": p.delivery_pressure,
        "inlet_pressure_Pa": p.inlet_pressure,
        "case_pressure_Pa": p.case_pressure,
        "displacement_ratio": p.displacement_ratio,
        "swash_angle_rad": point.swash_angle,
        "temperature_K": p.temperature,
        "viscosity_Pa_s": p.viscosity,
    }


def _ripple(point: PumpPoint) -> dict[str, float | None]:
    """Return the ripple over the turn: peak to peak, and amplitudes of the orders z, 2 z and 3 z."""
    series = {
        "delivery_pressure": (point.delivery.pressure, "Pa"),
        "delivery_flow": (point.delivery.line_flow, "m3_per_s"),
        "inlet_pressure": (point.suction.pressure, "Pa"),
        "inlet_flow": (-point.suction.line_flow, "m3_per_s"),
        "shaft_torque": (point.shaft_torque, "Nm"),
    }
    found: dict[str, float | None] = {}
    for name, (values, unit) in series.items():
        found[f"{name}_peak_to_peak_{unit}"] = float(np.ptp(values))
        amplitudes = 2.0 / values.size * np.abs(np.fft.rfft(values))
        for order, multiple in (("z", 1), ("2z", 2), ("3z", 3)):
            found[f"{name}_order_{order}_{unit}"] = float(amplitudes[multiple * point.pistons])
    found["delivery_orifice_area_m2"] = point.delivery.orifice_area
    return found


def _pair(point: PumpPoint, pair: Pair) -> dict[str, float]:
    loss = point.pairs.loss(pair)
    return {
        "coulomb_W": loss.mean_coulomb,
        "viscous_W": loss.mean_viscous,
        "total_W": loss.mean,
        "share": point.pairs.share(pair),
    }


def _power(point: PumpPoint) -> dict[str, float]:
    power = point.power
    parts = {f"leakage_{gap}_W": value for gap, value in asdict(power.leakage).items()}
    return {
        "shaft_W": power.shaft,
        "hydraulic_W": power.hydraulic,
        "elastic_W": power.elastic,
        "ripple_W": power.ripple,
        **parts,
        "throttling_delivery_W": power.throttling_delivery,
        "throttling_suction_W": power.throttling_suction,
        "friction_W": power.friction,
        "extended_W": power.extended,
    }


def _checks(point: PumpPoint, films: FilmsPoint | None) -> dict[str, float]:
    cycle = point.cycle
    checks = {
        "mass_balance_error": point.checks.mass_balance_error,
        "energy_balance_error": point.checks.energy_balance_error,
        "work_balance_error": point.checks.work_balance_error,
        "port_balance_error": max(point.delivery.balance_error, point.suction.balance_error),
        "quadrature_error": point.checks.quadrature_error,
        "chamber_work_error": cycle.checks.work_error,
        "chamber_periodicity_error_Pa": cycle.checks.periodicity_error,
        "chamber_revolutions": cycle.effort.revolutions,
        "chamber_steps": cycle.effort.steps,
    }
    if films:
        checks |= {
            "coupling_rounds": films.rounds,
            "coupling_pressure_change_Pa": films.pressure_change,
            "film_angle_sampling_error": films.sampling_error,
        }
    return checks


def films_warnings(films: FilmsPoint) -> list[str]:
    """Return all warnings of a films point, `name: text` each."""
    return [*unsupported_loads(films), *impossible_pressures(films), *few_angles(films)]


def unsupported_loads(films: FilmsPoint) -> list[str]:
    """Return a warning for each gap whose film, at some angle, does not support its load at the given position."""
    return [
        f"load_not_carried: {name}: {gap_statement(series)}: {imbalance(worst_film(series))}; "
        "--fidelity floating finds the position"
        for name, _, series in named_films(films)
        if not all(film.holds_its_load for film in series)
    ]


def impossible_pressures(films: FilmsPoint) -> list[str]:
    """Return a warning for each gap whose film pressure exceeds the limit of rigid walls and isoviscous oil."""
    found = []
    for name, gap, series in named_films(films):
        physics = getattr(films.physics, gap)
        if physics.elastic_walls and physics.pressure_viscosity:
            continue
        peak = max(film.loads.pressure_max for film in series)
        if peak > LARGEST_RIGID_PRESSURE:
            found.append(
                f"film_pressure_beyond_rigid: {name}: film pressure up to {pressure_text(peak)} "
                f"(limit {pressure_text(LARGEST_RIGID_PRESSURE)}: walls deform and viscosity rises before); state "
                "a smaller eccentricity or tilt, a larger clearance, or both effects in [physics]: "
                f"compliance in [physics.elastic_opening.{gap}] and [physics.viscosity_pressure]"
            )
    return found


def few_angles(films: FilmsPoint) -> list[str]:
    """Return a warning where the leakage depends on the number of film angles."""
    if films.sampling_error <= LARGEST_SAMPLING_ERROR:
        return []
    return [
        f"film_angles_too_few: leakage changes by {films.sampling_error:.1%} when every second film angle is left "
        f"out (limit {LARGEST_SAMPLING_ERROR:.0%}); from Python, films_point(pump, point, positions_per_pitch=8)"
    ]
