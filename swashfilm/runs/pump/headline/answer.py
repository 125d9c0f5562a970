"""Answer of an operating point: its headline numbers, a paragraph in plain words, and the sinks of the shaft power."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from swashfilm.console.fidelity import Fidelity
from swashfilm.output.answer import Answer, Tile
from swashfilm.output.data.gap_names import TITLES
from swashfilm.output.page import inlined
from swashfilm.runs.pump.headline.powers import (
    SMALLEST,
    Power,
    gathered,
    largest_losses,
    power_parts,
    power_text,
    share_text,
)
from swashfilm.runs.pump.headline.ribbons import flow_diagram
from swashfilm.runs.pump.summary import chamber_numbers
from swashfilm.runs.table.summary import source_words
from system.description.gap import Gap
from system.inputs.shown import pressure_text
from system.inputs.units import LPM

CAPTION = (
    f"Where the shaft power goes, widths to scale; parts below {SMALLEST:.1%} of it come together as other. The "
    "section Balance of the shaft power lists every part"
)


RUBBING = 1.0
"""W of contact friction of a part above which it is mentioned."""
HOTTEST = "film_temperature_max_K"


@dataclass(frozen=True)
class Film:
    """Film of a gap with its numbers, those of one piston or slipper; chambers: of a less common kind, in words."""

    gap: str
    chambers: str
    numbers: Mapping[str, Any]

    @property
    def name(self) -> str:
        """Its name in words, with its chambers."""
        return f"{TITLES[self.gap]}, {self.chambers}" if self.chambers else TITLES[self.gap]

    @property
    def part(self) -> str:
        """Its name as that of a single part; the block is one."""
        return self.name if self.gap == Gap.VALVE_PLATE.value else f"one {self.name}"


def pump_answer(summary: Mapping[str, Any]) -> Answer:
    """Return tiles, words and picture of an operating point from its summary."""
    parts, shaft = power_parts(summary), summary["power_balance"]["shaft_W"]
    words = " ".join((_delivery_words(summary), *_loss_words(parts, shaft), *_film_words(summary)))
    picture = inlined(flow_diagram(shaft, gathered(parts)))
    return Answer(tuple(_tiles(summary, parts)), words, picture, CAPTION)


def _tiles(summary: Mapping[str, Any], parts: tuple[Power, ...]) -> Iterator[Tile]:
    flow, shaft = summary["flow"], summary["power_balance"]["shaft_W"]
    geometric = f"of {flow['geometric_m3_per_s'] * LPM:.1f} L/min geometric"
    yield Tile(
        f"{flow['delivery_m3_per_s'] * LPM:.1f} L/min", "delivery flow",
        _bar(summary, "delivery_flow_m3_per_s", LPM, "L/min") or geometric,
    )  # fmt: skip
    ideal = f"{summary['torque']['ideal_difference_Nm']:.1f} N m without losses"
    torque = _bar(summary, "shaft_torque_Nm", 1.0, "N m") or ideal
    yield Tile(f"{summary['torque']['shaft_Nm']:.1f} N m", "shaft torque", torque)
    found = summary["efficiency"]["iso_4409"]
    if found["overall"] is not None:
        volumetric, rest = (f"{100.0 * found[part]:.1f} %" for part in ("volumetric", "hydromechanical"))
        split = f"{volumetric} volumetric, {rest} hydromechanical, ISO 4409"
        exact = _bar(summary, "overall_efficiency", 100.0, "%")
        yield Tile(f"{100.0 * found['overall']:.1f} %", "overall efficiency", f"{exact}; {split}" if exact else split)
    lost = sum(part.watts for part in parts[1:])
    yield Tile(power_text(lost, shaft), "not delivered", f"{share_text(lost, shaft)} of the shaft power")
    yield from _film_tiles(summary)


def _bar(summary: Mapping[str, Any], key: str, scale: float, unit: str, zero: float = 0.0) -> str:
    """Return limit and error bar of a number on finer levels, (SI - zero) x scale; empty where the run has none."""
    number = summary.get("refinement", {}).get("numbers", {}).get(key)
    if number is None:
        return ""
    if number["error"] is None:
        return f"{number['verdict']}: no error bar"
    digits = max(0, 1 - int(np.floor(np.log10(max(scale * number["error"], 1e-9)))))
    limit, error = scale * (number["extrapolated"] - zero), scale * number["error"]
    return f"limit {limit:.{digits}f} +- {error:.{digits}f} {unit}"


def _film_tiles(summary: Mapping[str, Any]) -> Iterator[Tile]:
    """Yield least film and hottest oil of films that float."""
    if not _floats(summary):
        return
    thin = least_film(summary)
    place = f"{thin.name}, {thin.numbers['film_thickness_min_at_deg']:.0f} deg"
    exact = "" if thin.chambers else _bar(summary, f"film_least_m.{thin.gap}", 1e6, "um")
    least = thin.numbers["film_thickness_min_m"] * 1e6
    shown = f"{least:.2f}" if abs(least) >= 0.1 else f"{least:.2g}"  # of nanometres two digits, not zero
    yield Tile(f"{shown} um", "least film of the turn", f"{place}; {exact}" if exact else place)
    if (hot := hottest_oil(summary)) is not None:
        exact = "" if hot.chambers else _bar(summary, f"hottest_oil_K.{hot.gap}", 1.0, "degC", 273.15)
        note = f"{hot.name}; {exact}" if exact else hot.name
        yield Tile(f"{hot.numbers[HOTTEST] - 273.15:.0f} degC", "hottest oil", note)


def _floats(summary: Mapping[str, Any]) -> bool:
    return Fidelity(summary["fidelity"]) is Fidelity.FLOATING


def films_of(summary: Mapping[str, Any]) -> list[Film]:
    """Return the films of every gap, also those of chambers of the less common kinds."""
    common = [Film(gap, "", numbers) for gap, numbers in summary["gaps"].items()]
    kinds = summary["unlike"].values()
    return common + [Film(gap, chamber_numbers(kind), of) for kind in kinds for gap, of in kind["gaps"].items()]


def least_film(summary: Mapping[str, Any]) -> Film:
    """Return the film that is thinnest over the turn."""
    return min(films_of(summary), key=lambda film: float(film.numbers["film_thickness_min_m"]))


def hottest_oil(summary: Mapping[str, Any]) -> Film | None:
    """Return the film with the hottest oil; None without solved temperature."""
    warm = [film for film in films_of(summary) if HOTTEST in film.numbers]
    return max(warm, key=lambda film: float(film.numbers[HOTTEST]), default=None)


def _delivery_words(summary: Mapping[str, Any]) -> str:
    at, flow = summary["operating_point"], summary["flow"]["delivery_m3_per_s"] * LPM
    ratio = at["displacement_ratio"]
    stroke = "full displacement" if abs(ratio - 1.0) < 5e-4 else f"{100.0 * ratio:.4g} % displacement"
    speed = f"{at['shaft_speed_rad_per_s'] * 30.0 / np.pi:.0f} r/min"
    where = f"At {speed}, {pressure_text(at['delivery_pressure_Pa'], 4)} and {stroke}"
    torque = f"takes {summary['torque']['shaft_Nm']:.1f} N m at its shaft"
    if flow > 0.0:
        return f"{where} the pump delivers {flow:.1f} L/min and {torque}."
    return f"{where} the pump delivers nothing: {-flow:.3g} L/min flow back from the delivery port. It {torque}."


def _loss_words(parts: tuple[Power, ...], shaft: float) -> Iterator[str]:
    delivered, lost = parts[0].watts, sum(part.watts for part in parts[1:])
    if not (shaft > 0.0 and delivered > 0.0 and lost > 0.0):
        return
    named, share = largest_losses(parts)
    yield (
        f"Of {power_text(shaft, shaft)} at the shaft, {power_text(delivered, shaft)} ({share_text(delivered, shaft)}) "
        f"leave as hydraulic power and {power_text(lost, shaft)} do not. {100.0 * share:.0f} % of this loss goes into "
        f"{_listed([_in_words(one) for one in named])}."
    )


def _in_words(part: Power) -> str:
    kind, comma, place = part.name.partition(", ")
    return f"{kind} at {place}" if comma and kind in ("friction", "leakage", "throttling") else part.name


def _listed(names: list[str]) -> str:
    return " and ".join([part for part in (", ".join(names[:-1]), *names[-1:]) if part])


def _film_words(summary: Mapping[str, Any]) -> Iterator[str]:
    if summary["fidelity"] == Fidelity.TABLE.value:
        yield f"The films come from a response table of the fidelity {source_words(summary)}."
        return
    if not _floats(summary):
        yield {
            Fidelity.LUMPED: "The film thicknesses are those of the pump file, not computed: the fidelity floating "
            "computes them.",
            Fidelity.FIXED: "The films are solved at the positions of the pump file; the fidelity floating finds the "
            "positions at which the forces balance.",
        }[Fidelity(summary["fidelity"])]
        return
    thin = least_film(summary)
    yield (
        f"The thinnest film of the turn is {thin.numbers['film_thickness_min_m'] * 1e6:.2g} um, in the gap "
        f"{thin.name}, at {thin.numbers['film_thickness_min_at_deg']:.0f} deg of shaft angle."
    )
    rubbing = [film for film in films_of(summary) if film.numbers["rubbing_power_W"] > RUBBING]
    where = _listed([f"{film.part} ({film.numbers['rubbing_power_W']:.3g} W)" for film in rubbing])
    yield f"Parts rub on each other at {where}." if rubbing else "Contact takes less than 1 W at each part."
    if (hot := hottest_oil(summary)) is not None:
        yield f"The oil gets hottest in the gap {hot.name}: {hot.numbers[HOTTEST] - 273.15:.0f} degC."
