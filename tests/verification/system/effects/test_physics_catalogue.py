"""The catalogue of effects: complete, neutral when off, each with a prior, a size and words of its own."""

from dataclasses import is_dataclass

import numpy as np
import pytest
from bench_pump import BENCH

from reynolds import dynamic_viscosity
from system import CATALOGUE, EXTENSIONS, BenchState, EffectId, Gap, GapCourse, Kind, entry_of, load_pump
from system.description.effects import PhysicsSection
from system.effects.catalogue.solved import SOLVED_ENTRIES
from system.effects.effect import both, neutral
from system.inputs.sections.fields import Limits, fields_of

REF90 = load_pump(BENCH)
POINTS, ANGLES = 3, 6
BY_NAME = [pytest.param(one, id=one.parameters[0].name) for one in EXTENSIONS]


@pytest.fixture(scope="module")
def state():
    viscosity = dynamic_viscosity(REF90.oil.fluid, 333.15)
    rows = ([60.0, 220.0, 330.0], [1.0, 0.6, 1.0], [35e6, 20e6, 5e6], [2.5e6, 1e5, 0.0], [0.15e6] * 3)
    columns = [np.array(row) for row in rows]
    return BenchState(*columns, np.full(3, viscosity), np.full(3, 333.15), np.zeros(3), REF90)


@pytest.fixture(scope="module")
def courses():
    pressure = np.outer([1.0, 0.6, 0.05], [35e6, 30e6, 20e6, 1e6, 0.0, 0.0])
    rest = [np.full((POINTS, ANGLES), value) for value in (3.0, 10e-6, 5e3, 100.0, 60.0, 2e-6)]
    return {gap: GapCourse(pressure, *rest, np.full(POINTS, 0.03), np.full(POINTS, 4e-4)) for gap in Gap}


def _effects(extension, courses, state, values):
    return extension.law(extension.stated(values), courses, state)


def _differs(one, other):
    return {name for name, value in vars(one).items() if not np.array_equal(value, getattr(other, name))}


def _centres(extension):
    """Parameters by name with which the law changes nothing."""
    return {parameter.name: parameter.centre for parameter in extension.parameters}


def test_every_effect_that_has_a_name_has_one_entry():
    """Effects of solved films alone have no law, and their entries stand beside the catalogue."""
    named = [entry.id.value for entry in (*CATALOGUE, *SOLVED_ENTRIES)]
    assert sorted(named) == sorted({one.value for one in EffectId} - {"unknown_physics"})
    assert not any(entry.extensions for entry in SOLVED_ENTRIES)
    assert all(bool(entry.extensions) == (entry.verdict is Kind.MISSING_PHYSICS) for entry in CATALOGUE)
    assert entry_of(EffectId.CHURNING).extensions[0].parameters[0].name == "churning.factor"
    with pytest.raises(ValueError, match="not in the catalogue"):
        entry_of(EffectId.UNKNOWN_PHYSICS)


@pytest.mark.parametrize("entry", CATALOGUE, ids=lambda entry: entry.id.value)
def test_entries_say_where_what_and_whence(entry):
    assert entry.components
    assert entry.channels
    assert entry.sentence
    assert entry.sentence[-1] != "."
    assert entry.source
    assert entry.id not in entry.twins
    assert all(one.id is entry.id for one in entry.extensions)
    assert all(parameter.source for one in entry.extensions for parameter in one.parameters)


@pytest.mark.parametrize("extension", BY_NAME)
def test_off_is_nothing_at_all(extension, courses, state):
    for member in extension.members:
        assert not _differs(_effects(member, courses, state, _centres(extension)), neutral(POINTS, ANGLES))


@pytest.mark.parametrize("extension", BY_NAME)
def test_on_each_parameter_changes_something_finite(extension, courses, state):
    for parameter in extension.parameters:
        values = _centres(extension) | {parameter.name: parameter.value(1.0)}
        found = [_effects(member, courses, state, values) for member in extension.members]
        assert any(_differs(one, neutral(POINTS, ANGLES)) for one in found), parameter.name
        assert all(np.isfinite(value).all() for one in found for value in vars(one).values())


@pytest.mark.parametrize("extension", BY_NAME)
def test_at_their_bounds_laws_stay_physical(extension, courses, state):
    values = {parameter.name: parameter.upper for parameter in extension.parameters}
    for member in extension.members:
        found = _effects(member, courses, state, values)
        assert all((getattr(found, name) > 0).all() for name in ("conductance", "viscous", "coulomb", "ideal"))
        assert ((found.intake > 0) & (found.intake <= 1)).all()
        assert (found.extra_coulomb >= 0).all()


def _limits(name: str) -> Limits:
    """What the pump file allows a key of [physics]."""
    section, limits = PhysicsSection, Limits()
    for key in name.split("."):
        field = fields_of(section)[key]
        section = next((one for one in field.types if is_dataclass(one)), None)
        limits = next((mark for mark in field.marks if isinstance(mark, Limits)), limits)
    return limits


@pytest.mark.parametrize("extension", BY_NAME)
def test_a_fit_keeps_to_the_bounds_of_the_pump_file(extension):
    for parameter in extension.parameters:
        limits = _limits(parameter.name)
        assert (parameter.lower, parameter.upper) == (limits.least, limits.most), parameter.name
    for scale in (scale for member in extension.members for scale in member.scales):
        limits = _limits(scale.name)
        assert scale.lower < scale.upper
        assert limits.least is None or limits.least <= scale.lower, scale.name
        assert limits.most is None or scale.upper <= limits.most, scale.name


def test_two_at_once_are_product_and_sum(courses, state):
    one, other = entry_of(EffectId.VISCOSITY_PRESSURE).extensions[0], entry_of(EffectId.CHURNING).extensions[0]
    values = {"viscosity_pressure.coefficient": 2e-8, "churning.factor": 1.0}
    thick, churned = _effects(one, courses, state, values), _effects(other, courses, state, values)
    found = both(thick, churned)
    assert not _differs(both(thick, neutral(POINTS, ANGLES)), thick)
    np.testing.assert_array_equal(found.conductance, thick.conductance)
    np.testing.assert_array_equal(found.torque, churned.torque)
    np.testing.assert_allclose(both(thick, thick).conductance, thick.conductance**2)
    np.testing.assert_allclose(both(churned, churned).carried_off, 2 * churned.torque * state.speed)


@pytest.mark.parametrize("extension", BY_NAME)
def test_a_prior_lies_within_the_bounds_of_its_size(extension):
    """Two sigma of it at least: a prior as wide as what a size may be would say nothing of it."""
    for one in extension.parameters:
        assert one.highest >= 2.0
        assert one.lowest == 0.0 or one.lowest <= -2.0
