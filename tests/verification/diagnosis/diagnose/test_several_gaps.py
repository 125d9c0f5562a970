"""One law at several gaps at once: an explanation of its own, told, fitted and written back by gap."""

from types import SimpleNamespace

import numpy as np

from diagnosis import load_thresholds
from diagnosis.explain.combinations import _apart
from diagnosis.explain.hypotheses import Hypothesis, simulator_of, together
from system import SIMULATED, BenchPoints, EffectId, Gap, Kind, LumpedBench, entry_of, extended_pump, load_pump

REF90 = load_pump("ref90")
ONE = np.ones(1)
POINTS = BenchPoints(
    speed=220 * ONE, displacement_ratio=ONE, p_out=30e6 * ONE, p_in=2.5e6 * ONE, p_case=0.15e6 * ONE,
    T_case=323.15 * ONE, T_in=323.15 * ONE, hours=0 * ONE, order=0 * ONE, warming=0 * ONE,
)  # fmt: skip


def opening(gap):
    (law,) = (one for one in entry_of(EffectId.ELASTIC_OPENING).extensions if one.pair is gap)
    return Hypothesis((law.id,), gap, Kind.MISSING_PHYSICS, law.parameters, (), -5.0, (law,))


def wrong(name):
    return Hypothesis((EffectId.FILM_THICKNESS,), None, Kind.WRONG_PARAMETER, (), (name,), -5.0)


def test_a_law_may_act_at_two_gaps_and_no_other_effect_twice():
    assert _apart(opening(Gap.SLIPPER), opening(Gap.PISTON))
    assert not _apart(opening(Gap.SLIPPER), opening(Gap.SLIPPER))
    assert _apart(opening(Gap.SLIPPER), wrong("film_thickness.slipper"))
    assert not _apart(wrong("film_thickness.piston"), wrong("film_thickness.slipper"))


def test_both_gaps_are_told():
    found = together(opening(Gap.SLIPPER), opening(Gap.PISTON), 0.05)
    assert found.places == (Gap.SLIPPER, Gap.PISTON)
    assert found.text == "elastic_opening (slipper) + elastic_opening (piston)"
    mixed = together(wrong("film_thickness.piston"), found, 0.05)
    assert mixed.places == (Gap.PISTON, Gap.SLIPPER, Gap.PISTON)
    assert mixed.subjects[0] == "film_thickness.piston"


def test_both_gaps_open_in_the_map_and_in_the_pump_file():
    """The drain of both is that of each added up, and the pump that states both reads the same."""
    plain = LumpedBench(REF90, POINTS, SIMULATED, ())
    both = together(opening(Gap.SLIPPER), opening(Gap.PISTON), 0.05)
    values = {"elastic_opening.slipper.opening": 1e-8, "elastic_opening.piston.opening": 2e-8}

    def read(hypothesis):
        bench = simulator_of(SimpleNamespace(simulator=plain, candidates=()), hypothesis, load_thresholds())
        return bench.predict(np.array([values[one.name] for one in bench.parameters]))[0]

    nothing = plain.predict(np.array([]))[0]
    apart = sum(read(opening(gap)) - nothing for gap in (Gap.SLIPPER, Gap.PISTON))
    np.testing.assert_allclose(read(both) - nothing, apart, rtol=0.02)
    stated = extended_pump(REF90, values, both.laws)
    np.testing.assert_allclose(LumpedBench(stated, POINTS, SIMULATED, ()).predict(np.array([]))[0], read(both))
