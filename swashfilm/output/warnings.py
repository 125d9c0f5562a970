"""Warnings of a run for its page: each named check has a grade; those of one cause are grouped."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum


class Grade(Enum):
    """Grade of a warning: care, a change of the design, or none."""

    CARE = "needs care"
    DESIGN = "design of the pump"
    MODEL = "limit of the model"

    def counted(self, count: int) -> str:
        """Return a number of causes of this grade in words."""
        one, more = {
            Grade.CARE: ("needs care", "need care"),
            Grade.DESIGN: ("of the pump's design", "of the pump's design"),
            Grade.MODEL: ("limit of the model", "limits of the model"),
        }[self]
        return f"{count} {one if count == 1 else more}"


_NAMED = {
    Grade.CARE: (
        "actuator_oversized boundary_lubrication cavitation_below_vacuum coarse_angles coarse_mesh "
        "contact_beyond_roughness designs_refused energy_not_balanced error_unknown fidelities_differ "
        "film_builds_no_pressure film_extent_unlikely film_has_inertia film_hot film_not_thin film_pressure_beyond_oil "
        "film_runs_dry film_turbulent film_without_supply motion_unstable no_3d_picture no_delivery "
        "nothing_feasible pareto_still_grows points_failed port_pressure_follows_line profile_not_resolved "
        "pumps_refused seam_is_a_wall search_not_settled start_outside_bounds steps_too_long table_guesses "
        "operating.case_pressure operating.temperature piston.radial_clearance"
    ),
    Grade.DESIGN: (
        "actuator_cavitates block_tips chamber_cavitates chamber_overpressure retainer_gives_way "
        "slipper_has_a_wedge slipper_lifts ball_guide.spring_preload piston.engaged_length piston.guide_length "
        "ports.kidney_full_end ports.kidney_full_start slipper.land_outer_radius slipper.profile "
        "valve_plate.land_radius_4"
    ),
    Grade.MODEL: (
        "cavity_does_not_conserve_mass coefficients_beyond_file film_angles_too_few film_pressure_beyond_rigid "
        "flow_factors_out_of_range friction_at_low_speed friction_of_rough_walls large_error load_not_carried "
        "losses_left_out pressure_below_cavitation results_thinned shares_uncertain start_refused table_error "
        "temperature_not_solved values_scaled viscosity_without_pressure weakly_active_cavity "
        "operating.inlet_pressure operating.pressure operating.speed "
        "slipper.groove_file slipper.orifice_file slipper.pocket_file valve_plate.kidney_file "
        "valve_plate.sphere_radius"
    ),
}
GRADES: Mapping[str, Grade] = {name: grade for grade, names in _NAMED.items() for name in names.split()}
"""Grade of each named check, and of each key of a pump file that a check may doubt.

A key that is not listed needs care: a doubtful value is most often a unit mistaken.
"""
_TITLES = {
    "operating.case_pressure": "Pressure in the case",
    "operating.pressure": "Above the rated pressure",
    "operating.speed": "Above the rated speed",
    "operating.temperature": "Viscosity of the oil",
}
"""Titles of warnings about an operating point, whose key alone would not tell what is doubtful."""
_NAME = re.compile(r"(?P<name>[a-z][\w.]*): (?P<text>.*)", re.DOTALL)
_SINGLE = re.compile(r"\.\d+(?=\.|$)")
UNNAMED = "other"


@dataclass(frozen=True)
class Cause:
    """Warnings of one name: their grade, texts with number and limit, and the remedies."""

    name: str
    grade: Grade
    texts: tuple[str, ...]
    remedies: tuple[str, ...]

    @property
    def title(self) -> str:
        """Name in words, with the number of warnings where there are several."""
        plain = self.name if "." in self.name else self.name.replace("_", " ").capitalize()
        words = _TITLES.get(self.name, plain)
        return words if len(self.texts) == 1 else f"{words}, {len(self.texts)} times"


def grade_of(name: str) -> Grade:
    """Return the grade of a warning's name; of a single part's key that of the key of all parts."""
    return GRADES.get(_SINGLE.sub("", name), Grade.CARE)


def causes(warnings: Iterable[str | Mapping[str, str]]) -> tuple[Cause, ...]:
    """Return warnings, `name: text` or name and text each, by their names; those that need care come first."""
    texts: dict[str, list[str]] = {}
    for warning in warnings:
        name, text = _parted(warning)
        texts.setdefault(name, []).append(text)
    found = [_cause(name, own) for name, own in texts.items()]
    return tuple(sorted(found, key=lambda cause: list(Grade).index(cause.grade)))


def counted(found: Sequence[Cause]) -> str:
    """Return the number of causes in a line: `3 notes: 1 needs care, 2 limits of the model`."""
    count = {grade: sum(cause.grade is grade for cause in found) for grade in Grade}
    listed = ", ".join(grade.counted(number) for grade, number in count.items() if number)
    return f"{len(found)} note{'s' * (len(found) > 1)}: {listed}"


def _parted(warning: str | Mapping[str, str]) -> tuple[str, str]:
    if not isinstance(warning, str):
        return warning["name"], warning["text"]
    parts = _NAME.fullmatch(warning)
    return (parts["name"], parts["text"]) if parts else (UNNAMED, warning)


def _cause(name: str, texts: Sequence[str]) -> Cause:
    """Return a cause; the text after its last semicolon is the remedy."""
    parts = [text.rstrip(".").rpartition("; ") for text in texts]
    facts = tuple(fact or remedy for fact, _, remedy in parts)
    remedies = dict.fromkeys(remedy for fact, _, remedy in parts if fact)
    return Cause(name, grade_of(name), facts, tuple(remedies))
