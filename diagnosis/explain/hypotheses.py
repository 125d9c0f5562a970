"""Hypotheses: nothing, an effect of the catalogue, a sensor's fault, a wrong parameter, unknown physics."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from math import log

from diagnosis.study.model import Candidate, PumpSimulator, Study
from diagnosis.thresholds import PriorMasses, Thresholds
from system.description.gap import Gap
from system.effects.components import Component
from system.effects.effect import EffectId, Kind
from system.effects.extension import Extension
from system.estimation.parameters import Parameter, Role

RUBBED = {"piston_cylinder": Gap.PISTON, "slipper_swash_plate": Gap.SLIPPER, "valve_plate_cylinder": Gap.VALVE_PLATE}
"""Gaps by the names of their friction pairs; the other pairs have no gap."""


@dataclass(frozen=True)
class Hypothesis:
    """One hypothesis: effects (several that act together), at a gap or None.

    extra: parameters added to the simulator; widened: names of parameters with a widened prior; log_prior: natural
    logarithm of the prior probability; laws: switched on, each with the open members of its grid; component: of
    unknown physics, whose law departs over the map; other_form: the laws are of another form than
    the pump's; stand_ins: effects that compensate this error of form; reach: factor on the fault factor.
    """

    effects: tuple[EffectId, ...]
    pair: Gap | None
    kind: Kind
    extra: tuple[Parameter, ...]
    widened: tuple[str, ...]
    log_prior: float
    laws: tuple[Extension, ...] = ()
    component: Component | None = None
    other_form: bool = False
    stand_ins: tuple[EffectId, ...] = ()
    reach: float = 1.0

    @property
    def members(self) -> tuple[Hypothesis, ...]:
        """One hypothesis for each choice of members of its laws' grids."""
        return tuple(replace(self, laws=chosen) for chosen in product(*(law.members for law in self.laws)))

    @property
    def open_names(self) -> tuple[str, ...]:
        """Names of the parameters that are free beyond the null's: added and widened."""
        return (*(parameter.name for parameter in self.extra), *self.widened)

    @property
    def subjects(self) -> tuple[Extension | str, ...]:
        """Subject of each effect: its law, or the parameter that it widens ("" for unknown physics). An effect may
        act at several gaps, with a law for each.
        """
        laws, widened = list(self.laws), iter(self.widened)
        found: list[Extension | str] = []
        for effect in self.effects:
            law = next((one for one in laws if one.id is effect), None)
            if law is None:
                found.append(next(widened, ""))
            else:
                laws.remove(law)
                found.append(law)
        return tuple(found)

    @property
    def places(self) -> tuple[Gap | None, ...]:
        """The gap of each effect: of its law, or of its parameter."""
        return tuple(gap_of(one) if isinstance(one, str) else one.pair for one in self.subjects)

    @property
    def text(self) -> str:
        """Its ids, each with its place: "elastic_opening (slipper) + churning", "nothing"."""
        if self.component is not None:
            return f"{self.effects[0].value} ({self.component.value})"
        parts = [
            f"{effect.value} ({place.value})" if place else effect.value
            for effect, place in zip(self.effects, self.places, strict=True)
        ]
        return (" + ".join(parts) or "nothing") + (", of another form" if self.other_form else "")


def hypotheses(study: Study, thresholds: Thresholds) -> tuple[Hypothesis, ...]:
    """All single hypotheses with any influence on the readings, "nothing" first; prior probabilities sum to 1.

    The ids of a kind share its mass evenly, the places of an id share that of the id.
    """
    single = [*_of_candidates(study), *_unknown(study)]
    mass = thresholds.prior
    kinds = {Kind.NO_MISMATCH} | {each.kind for each in single}
    total = sum(_mass(mass, kind) for kind in kinds)
    nothing = Hypothesis((), None, Kind.NO_MISMATCH, (), (), log(mass.none / total))
    return (nothing, *(_with_prior(each, single, mass, total) for each in single))


def together(first: Hypothesis, second: Hypothesis, penalty: float) -> Hypothesis:
    """Both together: prior the product times the penalty; missing physics if one is, else the first's kind."""
    kinds = (first.kind, second.kind)
    places = {each for each in (first.pair, second.pair) if each is not None}
    return Hypothesis(
        effects=first.effects + second.effects,
        pair=places.pop() if len(places) == 1 else None,
        kind=Kind.MISSING_PHYSICS if Kind.MISSING_PHYSICS in kinds else first.kind,
        extra=first.extra + second.extra,
        widened=first.widened + second.widened,
        log_prior=first.log_prior + second.log_prior + log(penalty),
        laws=first.laws + second.laws,
    )


def gap_of(parameter: str) -> Gap | None:
    """The gap of a parameter, by the end of its name: the gap, or a friction pair of the gap."""
    part = parameter.rpartition(".")[2]
    return RUBBED.get(part) or next((gap for gap in Gap if gap.value == part), None)


def simulator_of(study: Study, hypothesis: Hypothesis, thresholds: Thresholds) -> PumpSimulator:
    """The simulator with a hypothesis's laws on (first member of each grid) and its parameters widened.

    Parameters that are not free in any hypothesis stay within `tolerated` sigma: a flow coefficient of the ports nine
    sigma off would explain a starved pump, but no drawing allows it.
    """
    simulator = study.simulator
    if hypothesis.laws:
        simulator = simulator.with_extensions(tuple(law.members[0] for law in hypothesis.laws))
    factor = thresholds.name.fault_factor * hypothesis.reach
    questioned = {each.parameter for each in study.candidates if each.extension is None}
    changed = [
        each.widened(factor) if each.name in hypothesis.widened else each.held(thresholds.fit.tolerated)
        for each in simulator.parameters
        if each.name in hypothesis.widened or (each.role is not Role.EXTENSION and each.name not in questioned)
    ]
    return simulator.with_parameters(tuple(changed)) if changed else simulator


def candidates_of(study: Study, member: Hypothesis) -> tuple[Candidate, ...]:
    """The columns of the free parameters of a one-member hypothesis that move the readings."""
    return tuple(
        each
        for each in study.candidates
        if (each.extension in member.laws if each.extension else each.parameter in member.widened)
    )


def _of_candidates(study: Study) -> Iterator[Hypothesis]:
    """One for each law at each place and for each parameter, in the order of the candidates."""
    known: set[tuple[EffectId, Gap | None, str]] = set()
    for each in study.candidates:
        law = next((one for one in each.entry.extensions if each.extension in one.members), None)
        key = (each.entry.id, law.pair if law else None, "" if law else each.parameter)
        if key in known:
            continue
        known.add(key)
        if law:
            yield Hypothesis((each.entry.id,), law.pair, each.entry.verdict, law.parameters, (), 0.0, (law,))
        else:
            place = gap_of(each.parameter)
            yield Hypothesis((each.entry.id,), place, each.entry.verdict, (), (each.parameter,), 0.0)


def _unknown(study: Study) -> Iterator[Hypothesis]:
    for component in study.components:
        yield Hypothesis((EffectId.UNKNOWN_PHYSICS,), None, Kind.UNKNOWN_PHYSICS, (), (), 0.0, component=component)


def _with_prior(own: Hypothesis, single: list[Hypothesis], mass: PriorMasses, total: float) -> Hypothesis:
    ids = {each.effects for each in single if each.kind is own.kind}
    places = sum(each.effects == own.effects for each in single)
    return replace(own, log_prior=log(_mass(mass, own.kind) / total / len(ids) / places))


def _mass(mass: PriorMasses, kind: Kind) -> float:
    return {
        Kind.NO_MISMATCH: mass.none,
        Kind.MISSING_PHYSICS: mass.missing_physics,
        Kind.SENSOR_FAULT: mass.sensor_fault,
        Kind.WRONG_PARAMETER: mass.wrong_parameter,
        Kind.UNKNOWN_PHYSICS: mass.unknown_physics,
    }[kind]
