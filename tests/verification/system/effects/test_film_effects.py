"""[physics] at the fidelity fixed: closed forms, equivalent inputs, all effects."""

from dataclasses import replace

import numpy as np
import pytest
from bench_pump import BENCH

from gaps import Effect, Pose
from gaps.walls.pair import BoreWalls, PlateWalls
from gaps.walls.springs import SpringBore, SpringPlates
from reynolds import InputError, NotConverged
from system import (
    EXTENSIONS,
    SMOOTH,
    EffectId,
    Gap,
    films_point,
    floating_parts,
    load_pump,
    lumped_point,
    operating_point,
    rotor,
)
from system.description.effects import PhysicsSection
from system.effects.friction import OF_GAP
from system.effects.laws.film import barus_flow, opening_flow
from system.films.cycle import PLAIN, GapKind, GapPhysics, gap_cycles
from system.films.oil_state import oil_state
from system.inputs.sections.reader import section_of
from system.points.film_effects import SOLVED, effects_in_films, even_rise, film_effects, resisting
from system.points.films import leak_table
from system.pump.film_thickness import at_temperature, moved_to, unpressed

REF90 = load_pump(BENCH)
COARSE = {"positions_per_pitch": 2, "finer": 0.5}
FEW = {"finer": 0.25, "tolerance": 1.0}
OPENING, COEFFICIENT = 2e-8, 2e-8
ROUNDED = 1e-9
CLOSED = 2e-3
"""Largest error of the power balance with an effect on, of the shaft power: that of the lumped fidelity twice."""


def extended(tables, pump=REF90):
    return replace(pump, physics=section_of(PhysicsSection, tables))


def coarse(pump, **options):
    return films_point(pump, operating_point(pump), **COARSE | options)


def leaks(films):
    return np.array([getattr(films.pump_point.leakage_flow, gap.value) for gap in Gap])


def slow_flow(tables, case_pressure):
    """Flow (N,) m3/s past pistons in the middle of their bores that hardly slide, under one pressure."""
    centred = {"piston.eccentricity_ratio": 0.0, "operating.case_pressure": f"{case_pressure} Pa"}
    pump = extended(tables, load_pump(BENCH, centred))
    point, stands = replace(operating_point(pump), shaft_speed=SLOW), unpressed(pump, case_pressure)
    at = rotor(stands, point)
    films = film_effects(at, floating_parts(stands), pump, PLAIN)
    angles = 2.0 * np.pi * np.arange(18) / 18
    kind = GapKind(at, films.parts)
    return gap_cycles((kind,), angles, (np.full(18, FULL),), physics=films.physics, finer=0.5)[0].flow[0]


def worst(found, expected):
    """Of an array the entry farthest from a number."""
    return float(found[np.argmax(np.abs(found - expected))])


SLOW, FULL = 1e-3, 30e6  # rad/s, Pa
SLID = 1e-5
"""Share of the flow that the sliding drags along."""


@pytest.fixture(scope="module")
def plain():
    return coarse(REF90)


@pytest.mark.parametrize("case_pressure", [0.0, 1e6])
def test_springs_let_through_what_the_closed_law_says(case_pressure, validation):
    """int h^3 dp over h = h0 (1 + s (p - pc)): the law's very integral."""
    stated = {"elastic_opening": {"piston": {"opening": OPENING}}}
    ratio = slow_flow(stated, case_pressure) / slow_flow({}, case_pressure)
    validation(
        case="[physics.elastic_opening] solved: a bore on springs, 20 1/GPa, 30 MPa",
        source="((1 + c)^4 - 1)/(4 c), plane films",
        quantity=f"leakage over that of rigid walls, case at {case_pressure * 1e-6:g} MPa",
        unit="1",
        expected=float(opening_flow(np.array(OPENING * (FULL - case_pressure)))),
        obtained=worst(ratio, opening_flow(np.array(OPENING * (FULL - case_pressure)))),
        relative_tolerance=SLID,
    )


@pytest.mark.parametrize("case_pressure", [0.0, 1e6])
def test_oil_that_stiffens_lets_through_what_barus_says(case_pressure, validation):
    """(1 - exp(-a p))/(a p), exact for a film of one thickness; p over the case's, at which viscosity stands."""
    stated = {"viscosity_pressure": {"coefficient": COEFFICIENT}}
    ratio = slow_flow(stated, case_pressure) / slow_flow({}, case_pressure)
    law = barus_flow(np.array(COEFFICIENT * (FULL - case_pressure)))
    validation(
        case="[physics.viscosity_pressure] solved: a bore, 20 1/GPa, 30 MPa",
        source="(1 - exp(-a p))/(a p), Barus 1893",
        quantity=f"leakage over that of oil that does not stiffen, case at {case_pressure * 1e-6:g} MPa",
        unit="1",
        expected=float(law),
        obtained=worst(ratio, law),
        relative_tolerance=SLID,
    )


def test_a_slipper_that_lies_flat_carries_no_oil_however_its_oil_stiffens(validation):
    """All its flow is driven by pressure, all its walls' power is shear: by Barus' mean over its lands.

    exp(-a p) falls in proportion to ln r over the lands, of which the mean of exp(a p) is an integral.
    """
    stiff = coarse(extended({"viscosity_pressure": {"coefficient": COEFFICIENT}}), tolerance=1.0)
    dragged = leak_table(stiff.gaps, stiff.pump_point.point.case_pressure).drag_flow[1]
    assert np.abs(dragged).max() < 1e-3 * stiff.gaps.flow[1].max()
    k = int(0.75 * len(stiff.gaps.slipper))
    one, other = stiff.gaps.slipper[k], coarse(REF90, tolerance=1.0).gaps.slipper[k]
    inside, outside = np.exp(-COEFFICIENT * (one.loads.pressure_max - REF90.operating.case_pressure)), 1.0
    edges = REF90.slipper.land_inner_radius, REF90.slipper.land_outer_radius
    radius = np.linspace(*edges, 2001)
    way = np.log(radius / edges[0]) / np.log(edges[1] / edges[0])
    mean = np.trapezoid(radius / (inside + (outside - inside) * way), radius) / np.trapezoid(radius, radius)
    validation(
        case="[physics.viscosity_pressure] solved: a flat slipper, 20 1/GPa, 35 MPa, six cells across its land",
        source="mean of exp(a p) over a ring, by quadrature",
        quantity="power of its walls over that in oil that does not stiffen",
        unit="1",
        expected=float(mean),
        obtained=one.friction_power / other.friction_power,
        relative_tolerance=0.01,
    )


@pytest.mark.parametrize("gap", list(Gap))
def test_compliance_one_is_the_pumps_own_bodies_and_none_is_rigid(gap, plain):
    soft = {gap.value: SMOOTH.including(Effect.ELASTIC_WALLS)}
    own = coarse(REF90, physics=GapPhysics(**soft), **FEW)
    stated = coarse(extended({"elastic_opening": {gap.value: {"compliance": 1.0}}}), **FEW)
    np.testing.assert_allclose(leaks(stated), leaks(own), rtol=ROUNDED)
    rigid = coarse(extended({"elastic_opening": {gap.value: {"compliance": 0.0}}}))
    np.testing.assert_allclose(leaks(rigid), leaks(plain), rtol=ROUNDED)


def test_compliance_is_a_softer_material():
    softer = {f"materials.{name}.youngs_modulus": f"{value / 1.5} GPa" for name, value in SLIDES.items()}
    pump = load_pump(BENCH, softer | {f"materials.{name}.poissons_ratio": r for name, r in RATIOS.items()})
    own = coarse(pump, physics=GapPhysics(slipper=SMOOTH.including(Effect.ELASTIC_WALLS)), **FEW)
    stated = coarse(extended({"elastic_opening": {"slipper": {"compliance": 1.5}}}), **FEW)
    np.testing.assert_allclose(leaks(stated), leaks(own), rtol=1e-6)


SLIDES, RATIOS = {"slipper": 110.0, "swash_plate": 210.0}, {"slipper": 0.34, "swash_plate": 0.3}
"""GPa, and Poisson's ratios, as `floating_parts` takes them of ref90."""


def test_springs_open_by_their_own_pressure_alone():
    parts = floating_parts(REF90)
    space = films_point(REF90, operating_point(REF90), **COARSE).gaps.piston[0].solution.problem.space
    bore, plates = parts.piston.laws.walls, parts.slipper.laws.walls
    assert isinstance(bore, BoreWalls)
    assert isinstance(plates, PlateWalls)
    pressure = np.arange(float(space.size))
    on = SpringBore(bore.piston, bore.bushing, compliance=1e-13)
    np.testing.assert_allclose(on.at(space, Pose()).matrix @ pressure, 1e-13 * pressure[space.vertex_dofs])
    assert not (on.piston_at(space, Pose()).matrix @ pressure).any()
    bare = on.by_chamber(space, Pose())
    assert bare.chamber_growth == 0.0
    assert not bare.deformation.any()
    also = SpringPlates(plates.parts, compliance=2e-13)
    np.testing.assert_allclose(also.at(space, Pose()).matrix @ pressure, 2e-13 * pressure[space.vertex_dofs])


def test_heat_between_the_pumps_own_walls_is_heat():
    """The resistance by drawing and material, stated, changes nothing; a lesser one cools the film."""
    point = operating_point(REF90)
    own = film_effects(rotor(REF90, point), floating_parts(REF90), extended({"film_heating": {}}), PLAIN)
    told = [one for one in own.parts.taken if one.path.startswith("walls of the")]
    assert [one.path for one in told] == [f"walls of the {name} film" for name in NAMES]
    stated = {gap.value: in_unit_of(one.reason) for gap, one in zip(Gap, told, strict=True)}
    heated = extended({"film_heating": stated})
    hot = coarse(REF90, physics=GapPhysics.alike(SMOOTH.including(Effect.HEAT)), **FEW)
    same, cooled = (coarse(pump, **FEW) for pump in (heated, extended({"film_heating": {}})))
    np.testing.assert_allclose(leaks(same), leaks(hot), rtol=1e-4)  # the stated ones are of five digits
    assert np.all(leaks(cooled) < leaks(hot))
    assert [one.value for one in same.parts.taken if one.path == told[0].path] == ["1 times as resistant to heat"]


NAMES = ("piston", "slipper", "valve plate")


def in_unit_of(reason):
    """m2 K/W at the end of the assumption on a wall."""
    return float(reason.rpartition("material ")[2].partition(" ")[0])


@pytest.mark.parametrize(("one", "two"), [(3e-5, 3e-5), (6e-5, 1.6e-3), (0.0, 5e-5)])
def test_a_film_rises_by_its_walls_and_by_itself(one, two):
    """Mean of T'' = -q/(h k) between walls at R1 q1 and R2 q2, by differences over 4001 levels."""
    across, levels = 1.15e-4, np.linspace(0.0, 1.0, 4001)
    heat = 0.5 * across + two
    first = heat / (one + two + across)
    inside = one * first + across * (levels * first - 0.5 * levels**2)
    assert inside[-1] == pytest.approx(two * (1.0 - first), abs=1e-12)
    assert even_rise(across, one, two) == pytest.approx(float(np.trapezoid(inside, levels)), rel=1e-6)


def test_walls_are_found_that_give_the_stated_rise():
    for wanted in (2e-5, 6.6e-5, 5e-4, 2e-3):
        times = resisting(wanted, 1.15e-4, 5.84e-5, 1.65e-3)
        assert even_rise(1.15e-4, 5.84e-5 * times, 1.65e-3 * times) == pytest.approx(wanted, rel=1e-6)
    assert resisting(9e-6, 1.15e-4, 5.84e-5, 1.65e-3) == 0.0


def test_oil_that_stiffens_without_bound_is_told_in_the_pumps_words():
    """An eccentric piston in cold oil: (1 - exp(-a p))/a would have to be more than 1/a. Softer walls bear it."""
    pump = extended({"viscosity_pressure": {"coefficient": COEFFICIENT}})
    cold = operating_point(pump, temperature=313.15)
    with pytest.raises(NotConverged, match=r"plain oil would come to 50 MPa.*piston.eccentricity_ratio"):
        films_point(pump, cold, **COARSE)


def test_oil_that_is_said_not_to_stiffen_does_not(plain):
    found = coarse(extended({"viscosity_pressure": {"coefficient": 0.0}}))
    np.testing.assert_array_equal(leaks(found), leaks(plain))


def test_webs_over_a_port_have_the_cases_oil():
    """They are sealed by a viscosity that is no oil's."""
    point = operating_point(REF90)
    films = coarse(extended({"viscosity_pressure": {"coefficient": 1e-8}}), tolerance=1.0)
    found = oil_state(REF90, films.physics.valve_plate, films.gaps.valve_plate[0].solution, point.viscosity)
    highest = point.viscosity * np.exp(1e-8 * films.gaps.valve_plate[0].loads.pressure_max)
    assert found["film_viscosity"].min() > 0.99 * point.viscosity
    assert found["film_viscosity"].max() < 1.01 * highest


def test_shares_that_films_do_not_read_are_told():
    at, parts = rotor(REF90, operating_point(REF90)), floating_parts(REF90)
    usual, other = (
        film_effects(at, parts, extended({"film_heating": table}), PLAIN) for table in ({}, {"carry_over": 0.4})
    )
    assert not any(one.path == "heat of the oil" for one in usual.parts.taken)
    (told,) = (one for one in other.parts.taken if one.path == "heat of the oil")
    assert "carry_over 0.4" in told.reason


def test_barus_coefficient_takes_the_place_of_the_usual_one():
    at, parts = rotor(REF90, operating_point(REF90)), floating_parts(REF90)
    assert any(one.path == "oil.pressure_viscosity" for one in parts.taken)
    found = film_effects(at, parts, extended({"viscosity_pressure": {"coefficient": 1e-8}}), PLAIN).parts
    assert not any(one.path == "oil.pressure_viscosity" for one in found.taken)
    for part in (found.piston, found.slipper, found.block):
        above = 1e8 + REF90.operating.case_pressure
        assert part.laws.fluid.viscosity(above, 0.03)[0] == pytest.approx(0.03 * np.e)


WARMER = 20.0
RATES = {"thermal_clearance": {"piston": {"rate": 8e-3}, "slipper": {"rate": -4e-3}, "valve_plate": {"rate": 5e-3}}}
DRAGGED = 3e-3
"""Of a leakage: drag flow of the piston, in proportion to its film, which the closed-form law leaves as it is."""


def test_a_clearance_that_warmth_changes_is_a_film_thickness():
    """By the closed-form law, as the pump there, and in films: the same pump."""
    pump = extended(RATES)
    warm = replace(operating_point(REF90), temperature=REF90.operating.temperature + WARMER)
    there = at_temperature(pump, warm.temperature)
    assert not there.physics.on
    assert there.slipper.film_thickness == pytest.approx((1.0 - 4e-3 * WARMER) * REF90.slipper.film_thickness)
    by_law, as_pump = lumped_point(pump, warm), lumped_point(there, warm)
    for one in ("piston", "slipper", "valve_plate"):
        assert getattr(by_law.leakage_flow, one) == pytest.approx(getattr(as_pump.leakage_flow, one), rel=DRAGGED)
        loss = OF_GAP[Gap(one)]
        viscous = by_law.pairs.loss(loss).mean_viscous
        assert viscous == pytest.approx(as_pump.pairs.loss(loss).mean_viscous, rel=1e-9)
    np.testing.assert_array_equal(leaks(films_point(pump, warm, **COARSE)), leaks(films_point(there, warm, **COARSE)))


def test_a_pump_moved_to_another_temperature_keeps_its_films_there():
    pump = extended(RATES)
    warm = pump.operating.temperature + WARMER
    moved = moved_to(pump, replace(pump.operating, temperature=warm))
    assert moved.operating.temperature == warm
    assert moved.piston.radial_clearance == pytest.approx((1.0 + 8e-3 * WARMER) * REF90.piston.radial_clearance)
    one, other = (lumped_point(each, operating_point(moved)).bench.drain_flow for each in (pump, moved))
    assert one == pytest.approx(other, rel=DRAGGED)


def test_single_parts_expand_too():
    pump = extended(RATES, load_pump(BENCH, {"piston.3.radial_clearance": "25 um"}))
    there = at_temperature(pump, pump.operating.temperature + WARMER)
    ((chamber, part),) = there.single_pistons
    assert chamber == 3
    assert part.radial_clearance == pytest.approx(1.16 * 25e-6)


def test_a_film_that_warmth_closes_is_refused():
    pump = extended({"thermal_clearance": {"slipper": {"rate": -0.02}}})
    with pytest.raises(InputError, match=r"thermal_clearance.slipper.rate: -0.02 1/K.*expected above -0.0158"):
        at_temperature(pump, pump.operating.temperature + 60.0)
    with pytest.raises(InputError, match=r"expected below 0\.0158"):
        at_temperature(extended({"thermal_clearance": {"piston": {"rate": 0.02}}}), pump.operating.temperature - 60.0)
    warm = replace(operating_point(pump), temperature=pump.operating.temperature + 60.0)
    with pytest.raises(InputError, match="closed at"):
        lumped_point(pump, warm)


@pytest.mark.parametrize(
    "extension", [pytest.param(one, id=one.parameters[0].name) for one in EXTENSIONS if one.id not in SOLVED]
)
def test_what_no_film_solves_adds_what_it_adds_at_the_lumped_fidelity(extension, plain):
    """Flows past the chambers and drag are the same; factors on gaps and ports as nearly as gaps and shear are."""
    values = {one.name.rpartition(".")[2]: one.value(1.0) for one in extension.parameters}
    table = {**extension.members[-1].grid[0], **values}
    pump = extended({extension.id.value: {extension.pair.value: table} if extension.pair else table})
    films, lumped = coarse(pump).pump_point, lumped_point(pump, operating_point(pump))
    bare, before = plain.pump_point, lumped_point(REF90, operating_point(REF90))
    for name in ("delivery_flow", "inlet_flow", "drain_flow", "shaft_torque"):
        one, other = (
            getattr(with_it.bench, name) - getattr(without.bench, name)
            for with_it, without in ((films, bare), (lumped, before))
        )
        assert one == pytest.approx(other, rel=0.1, abs=2e-3 * abs(getattr(before.bench, name)))
    assert films.checks.energy_balance_error < CLOSED
    assert effects_in_films(pump) == ((), (extension.id,))


def test_several_effects_at_once_keep_energy():
    pump = extended(
        {
            "viscosity_pressure": {"coefficient": 1.5e-8},
            "elastic_opening": {"slipper": {"opening": 1e-8}, "valve_plate": {"opening": 5e-9}},
            "swash_droop": {"rate": 1e-10},
            "churning": {"factor": 1.0},
            "control_flow": {"area": 2e-7, "laminar": 0.5},
        }
    )
    films = coarse(pump)
    assert films.pump_point.checks.energy_balance_error < CLOSED
    assert films.physics.slipper.elastic_walls
    assert films.physics.valve_plate.elastic_walls
    assert not films.physics.piston.elastic_walls
    assert films.physics.piston.pressure_viscosity
    solved, laws = effects_in_films(pump)
    assert solved == (EffectId.VISCOSITY_PRESSURE, EffectId.ELASTIC_OPENING)
    assert set(laws) == {EffectId.SWASH_DROOP, EffectId.CHURNING, EffectId.CONTROL_FLOW}
