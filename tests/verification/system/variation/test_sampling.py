"""Pumps drawn from a drawing: moments of the shapes, correlation, classes, what [tolerance] states."""

import numpy as np
import pytest
from scipy import stats

from system import base_parameters, load_pump, tolerances
from system.description.drawing import drawing_of, drawn_sigmas
from system.description.drawn import DrawnFit, fit_sigma
from system.description.keys import pump_keys
from system.description.tolerance import Shape
from system.inputs.faults import InputFaults
from system.inputs.sections.reader import with_values
from system.pump_file.file import resolved_toml, varied
from system.variation.admitted import commonest, trial
from system.variation.sampling import alike, below, drawn_series, fit_values, groups, part_of, quantile

COUNT = 40_000


def pump_with(**tables):
    """REF90 with tolerances of the drawing beside those of its file."""
    return load_pump("ref90", {f"tolerance.{key}": rows for key, rows in tables.items()})


def drawn_values(pump, name, count=COUNT):
    series = drawn_series(drawing_of(pump), count, seed=3)
    return series.values[:, series.drawing.names.index(name)]


@pytest.mark.parametrize(
    ("row", "of"),
    [
        ({"shape": "normal", "sigma": "0.5 um"}, stats.norm(10.0, 0.5)),
        ({"shape": "normal", "sigma": "5 %"}, stats.norm(10.0, 0.5)),
        ({"shape": "normal", "plus_minus": "1.5 um"}, stats.norm(10.0, 0.5)),
        ({"shape": "normal", "least": "9 um", "most": "12 um"}, stats.norm(10.5, 0.5)),
        ({"shape": "uniform", "least": "9 um", "most": "12 um"}, stats.uniform(9.0, 3.0)),
        ({"shape": "triangular", "least": "9 um", "most": "12 um"}, stats.triang(1.0 / 3.0, 9.0, 3.0)),
    ],
)
def test_distributions(row, of):
    """Against scipy's, by Kolmogorov's and Smirnov's test; sigma and middle as stated."""
    pump = pump_with(dimension=[{"key": "slipper.film_thickness"} | row])
    found = 1e6 * drawn_values(pump, "slipper.film_thickness")
    assert stats.kstest(found, of.cdf).pvalue > 1e-3
    one = next(each for each in drawing_of(pump).dimensions if each.name == "slipper.film_thickness")
    assert (1e6 * one.middle, 1e6 * one.sigma) == (pytest.approx(of.mean()), pytest.approx(of.std()))


@pytest.mark.parametrize("shape", list(Shape))
def test_quantiles_and_shares_are_inverse(shape):
    share = np.linspace(0.01, 0.99, 50)
    values = quantile(shape, 2.0, 4.0, 3.0, share)
    assert below(shape, 2.0, 4.0, values) == pytest.approx(share)


def test_correlated_dimensions_keep_their_distributions():
    rows = [{"key": key, "shape": "uniform", "plus_minus": "1 um"}
            for key in ("slipper.film_thickness", "valve_plate.film_thickness")]  # fmt: skip
    pump = pump_with(dimension=rows, correlation=[{"one": rows[0]["key"], "other": rows[1]["key"], "coefficient": 0.8}])
    one, other = (drawn_values(pump, row["key"]) for row in rows)
    # of uniform values with a Gaussian copula: 6/pi asin(r/2)
    assert np.corrcoef(one, other)[0, 1] == pytest.approx(6.0 / np.pi * np.arcsin(0.4), abs=0.01)
    assert stats.kstest(1e6 * one, stats.uniform(9.0, 2.0).cdf).pvalue > 1e-3
    drawing = drawing_of(pump)
    together = {drawing.names.index(row["key"]) for row in rows}
    assert sorted(map(len, groups(drawing)))[-2:] == [1, 2]
    assert together in [set(group) for group in groups(drawing)]


@pytest.mark.parametrize("classes", [1, 2, 3, 8])
def test_paired_parts_scatter_less(classes):
    """Hole 20 um and shaft 10 um wide, uniform: the width of a class remains, and the classes' own distance."""
    fit = DrawnFit("piston.radial_clearance", Shape.UNIFORM, (22.030e-3, 22.050e-3), (22.000e-3, 22.010e-3), classes)
    found = fit_values(fit, np.random.default_rng(5).standard_normal((COUNT, 2)))
    assert np.std(found) == pytest.approx(fit_sigma(fit), rel=0.02)
    assert np.mean(found) == pytest.approx(17.5e-6, rel=2e-3)
    # hole and shaft at opposite ends of one class: the first class is the tightest
    tightest = 0.5 * (22.030e-3 - (22.000e-3 + 0.010e-3 / classes))
    assert found.min() >= tightest - 1e-12


def test_classes_of_equal_parts_divide_the_scatter():
    widths = [fit_sigma(DrawnFit("x", Shape.UNIFORM, (10.02e-3, 10.04e-3), (10.0e-3, 10.02e-3), n)) for n in (1, 4)]
    assert widths[0] / widths[1] == pytest.approx(4.0)


def test_normal_parts_stay_in_their_class():
    fit = DrawnFit("x", Shape.NORMAL, (10.02e-3, 10.04e-3), (10.0e-3, 10.02e-3), 5)
    one = DrawnFit("x", Shape.NORMAL, fit.hole, fit.shaft, 1)
    scores = np.random.default_rng(7).standard_normal((COUNT, 2))
    assert np.std(fit_values(fit, scores)) < 0.4 * np.std(fit_values(one, scores))


@pytest.mark.parametrize("parts", [1, 9])
def test_parts_of_their_own_size(parts):
    """The mean over a pump scatters by the root of their number; clearances by the leakage that they have together."""
    fit = {"key": "piston.radial_clearance", "shape": "uniform", "hole_least": "22.02 mm", "hole_most": "22.04 mm",
           "shaft_least": "22 mm", "shaft_most": "22.01 mm", "parts": parts}  # fmt: skip
    row = {"key": "slipper.orifice_diameter", "shape": "triangular", "plus_minus": "0.03 mm", "parts": parts}
    pump = pump_with(fit=[fit], dimension=[row])
    orifice = drawn_values(pump, "slipper.orifice_diameter")
    assert np.std(orifice) == pytest.approx(0.03e-3 / np.sqrt(6.0 * parts), rel=0.02)
    clearance = drawn_values(pump, "piston.radial_clearance")
    cube = stats.uniform(11.01e-3, 0.01e-3), stats.uniform(11.0e-3, 0.005e-3)
    drawn = [one.rvs(COUNT, random_state=k) for k, one in enumerate(cube)]
    assert np.mean(clearance**3) == pytest.approx(np.mean((drawn[0] - drawn[1]) ** 3), rel=0.01, abs=0.0)
    assert drawn_sigmas(pump)["piston.radial_clearance"] == pytest.approx(np.std(clearance), rel=0.06)


def test_one_part_without_clearance_is_no_pump():
    values = np.array([[3e-6, 4e-6, 5e-6], [3e-6, -1e-6, 5e-6]])
    found = alike("piston.radial_clearance", values)
    assert found[0] == pytest.approx(np.cbrt(72.0) * 1e-6)
    assert found[1] == -1e-6


def test_sigmas_of_the_table_are_dimensions():
    drawing = drawing_of(load_pump("ref90"))
    sigma = {one.name: one.sigma / one.middle for one in drawing.dimensions}
    assert sigma["piston.radial_clearance"] == pytest.approx(0.08)
    assert sigma["friction.slipper_swash_plate"] == pytest.approx(0.15)
    assert sigma["friction.ball_guide_retainer"] == pytest.approx(0.06)
    assert sigma["piston.eccentricity_ratio"] == pytest.approx(0.08 / 0.6)
    assert not drawing.fits


@pytest.mark.parametrize("share", [0.05, 0.6])
def test_a_relative_sigma_is_that_of_the_logarithm(share):
    """As the priors of a fit have it: the stated value is the median, within a tenth and ten times of it."""
    pump = load_pump("ref90", {"tolerance.friction": share})
    found = drawn_values(pump, "friction.piston_cylinder")
    stated = pump.friction.piston_cylinder
    logs, far = np.log(found / stated) / share, np.log(10.0) / share
    assert stats.kstest(logs, stats.truncnorm(-far, far).cdf).pvalue > 1e-3
    (prior,) = [p for p in base_parameters(pump, tolerances(pump)[0]) if p.name == "friction.piston_cylinder"]
    assert (prior.lower, prior.upper) == (pytest.approx(0.1 * stated), pytest.approx(10.0 * stated))
    assert prior.value(1.0) == pytest.approx(stated * np.exp(share))


def test_a_coefficient_is_cut_where_no_pump_has_more():
    pump = load_pump("ref90", {"tolerance.flow_coefficient": 0.3, "tolerance.eccentricity_ratio": 0.5})
    assert 0.95 < drawn_values(pump, "ports.flow_coefficient").max() <= 1.0
    ratio = drawn_values(pump, "piston.eccentricity_ratio")
    of = stats.truncnorm(-0.6 / 0.5, 0.35 / 0.5, 0.6, 0.5)
    assert stats.kstest(ratio, of.cdf).pvalue > 1e-3


def test_pumps_of_wide_sigmas_are_all_pumps():
    """The sigmas of a pump that is known by its type plate: none is refused."""
    wide = {"friction": 0.6, "guide_friction": 0.6, "bearing_friction": 0.6, "film_thickness": 0.5,
            "flow_coefficient": 0.3, "eccentricity_ratio": 0.2, "dead_volume": 0.3, "bulk_modulus": 0.1}  # fmt: skip
    pump = load_pump("ref90", {f"tolerance.{key}": value for key, value in wide.items()})
    found = trial(pump, list(drawn_series(drawing_of(pump), 300, 1).variants(pump)))
    assert (found.tried, found.refused) == (300, {})


def test_refused_pumps_are_counted_by_the_key_that_refuses_them():
    rows = [{"key": "slipper.film_thickness", "shape": "normal", "sigma": "100 %"},
            {"key": "ports.flow_coefficient", "shape": "uniform", "least": "0.5", "most": "1.1"}]  # fmt: skip
    pump = pump_with(dimension=rows)
    found = trial(pump, list(drawn_series(drawing_of(pump), 300, 1).variants(pump)))
    keys = [reason.partition(":")[0] for reason in found.refused]
    assert set(keys) == {"slipper.film_thickness", "ports.flow_coefficient"}
    assert found.share == pytest.approx(1.0 - 5.0 / 6.0 * stats.norm.cdf(1.0), abs=0.06)
    assert any(" um, expected at least 0.01 um" in reason for reason in found.refused)


def test_every_value_beyond_its_limit_is_told():
    with pytest.raises(InputFaults) as reason:
        varied(load_pump("ref90"), (("slipper.film_thickness", -1e-6), ("friction.front_bearing", -0.1)))
    assert [fault.line for fault in reason.value.faults] == [
        "slipper.film_thickness: -1 um, expected at least 0.01 um: oil thinner than 10 nm is no continuum",
        "friction.front_bearing: -0.1, expected at least 0",
    ]


def test_both_viscosities_scatter_in_proportion():
    pump = load_pump("ref90")
    for variant in list(drawn_series(drawing_of(pump), 5, 1).variants(pump)):
        values = dict(variant)
        ratio = values["oil.kinematic_viscosity_40C"] / values["oil.kinematic_viscosity_100C"]
        assert ratio == pytest.approx(pump.oil.kinematic_viscosity_40C / pump.oil.kinematic_viscosity_100C)


def test_stroke_scatters_by_its_angle():
    """0.1 % of the stroke, which goes with the tangent of the swash angle."""
    pump = load_pump("ref90", {"tolerance.displacement": 0.001})
    one = next(each for each in drawing_of(pump).dimensions if each.name == "pump.swash_angle_max")
    angle = pump.pump.swash_angle_max
    assert np.tan(angle + one.sigma) / np.tan(angle) - 1.0 == pytest.approx(0.001, rel=0.01)


def test_a_dimension_of_the_drawing_replaces_the_sigma_of_the_table():
    pump = pump_with(dimension=[{"key": "slipper.film_thickness", "shape": "normal", "sigma": "0.1 um"}])
    names = drawing_of(pump).names
    assert names.count("slipper.film_thickness") == 1
    assert drawn_sigmas(pump) == {"slipper.film_thickness": pytest.approx(1e-7)}
    prior = {one.name: one for one in base_parameters(pump, tolerances(pump)[0])}
    assert prior["film_thickness.slipper"].spread == pytest.approx(0.01)  # relative, of 10 um
    assert prior["film_thickness.piston"].spread == pytest.approx(0.08)


def test_priors_without_a_drawing_are_as_before():
    pump = load_pump("ref90")
    assert drawn_sigmas(pump) == {}
    known = {one.name: one.spread for one in base_parameters(pump, tolerances(pump)[0])}
    assert known["friction.piston_cylinder"] == 0.15
    assert known["eccentricity_ratio"] == 0.08


def test_tolerances_survive_their_file(tmp_path):
    fit = {"key": "piston.radial_clearance", "shape": "uniform", "hole_least": "22.02 mm", "hole_most": "22.04 mm",
           "shaft_least": "22 mm", "shaft_most": "22.01 mm", "classes": 3}  # fmt: skip
    rows = [{"key": "slipper.film_thickness", "shape": "normal", "sigma": "4 %"},
            {"key": "oil.bulk_modulus", "shape": "uniform", "plus_minus": "0.1 GPa"}]  # fmt: skip
    pair = {"one": "slipper.film_thickness", "other": "oil.bulk_modulus", "coefficient": -0.3}
    pump = pump_with(dimension=rows, fit=[fit], correlation=[pair])
    path = tmp_path / "pump.toml"
    path.write_text(resolved_toml(pump))
    assert load_pump(path) == pump


def test_part_of_a_drawing():
    drawing = part_of(drawing_of(load_pump("ref90")), ["oil.bulk_modulus"])
    assert drawing.names == ("oil.bulk_modulus",)


def faults_of(**tables):
    with pytest.raises(InputFaults) as reason:
        pump_with(**tables)
    return {fault.path: fault for fault in reason.value.faults}


FILM = {"key": "slipper.film_thickness", "shape": "uniform", "plus_minus": "1 um"}
PLATE = {"key": "valve_plate.film_thickness", "shape": "uniform", "plus_minus": "1 um"}
PISTON = {"key": "piston.radial_clearance", "shape": "uniform", "plus_minus": "1 um"}


@pytest.mark.parametrize(
    ("row", "path", "words"),
    [
        ({"key": "piston.radial_clearence"}, "tolerance.dimension.1.key", "no dimension that the pump states"),
        ({"key": "clearance"}, "tolerance.dimension.1.key", "no dimension"),
        ({"key": "pump.displacement"}, "tolerance.dimension.1.key", "it follows from the geometry"),
        ({"sigma": "1 um"}, "tolerance.dimension.1", "sigma, plus_minus"),
        ({"plus_minus": None}, "tolerance.dimension.1", "no width"),
        ({"plus_minus": None, "least": "9 um"}, "tolerance.dimension.1", "with least"),
        ({"plus_minus": "1 deg"}, "tolerance.dimension.1.plus_minus", "not a length"),
        ({"plus_minus": "0 um"}, "tolerance.dimension.1.plus_minus", "'0 um'"),
        ({"plus_minus": "much"}, "tolerance.dimension.1.plus_minus", "'much'"),
        ({"plus_minus": None, "least": "9 um", "most": "8 um"}, "tolerance.dimension.1", "9 um .. 8 um"),
        ({"plus_minus": None, "least": "1 um", "most": "2 um", "shape": "triangular"}, "tolerance.dimension.1", "10"),
    ],
)  # fmt: skip
def test_faults_of_a_dimension(row, path, words):
    stated = {key: value for key, value in (FILM | row).items() if value is not None}
    found = faults_of(dimension=[stated])
    assert words in found[path].found


def test_nearest_dimension():
    assert faults_of(dimension=[FILM | {"key": "piston.clearance"}])[
        "tolerance.dimension.1.key"
    ].nearest == "piston.radial_clearance"  # fmt: skip
    assert "twice" not in str(faults_of(dimension=[FILM, FILM])["tolerance"])
    assert "2 times" in faults_of(dimension=[FILM, FILM])["tolerance"].found


def test_faults_of_a_fit():
    fit = {"key": "piston.radial_clearance", "shape": "uniform", "hole_least": "22.02 mm", "hole_most": "22.04 mm",
           "shaft_least": "22 mm", "shaft_most": "22.01 mm"}  # fmt: skip
    assert "no length" in faults_of(fit=[fit | {"key": "oil.density"}])["tolerance.fit.1.key"].found
    assert (
        "shaft" in faults_of(fit=[fit | {"shaft_least": "22.05 mm", "shaft_most": "22.06 mm"}])["tolerance.fit.1"].found
    )
    assert (
        "22.03 mm .. 22.01 mm"
        in faults_of(fit=[fit | {"shaft_least": "22.03 mm"}])["tolerance.fit.1.shaft_least"].found
    )
    assert "at least 1" in faults_of(fit=[fit | {"classes": 0}])["tolerance.fit.1.classes"].expected


def test_correlation_that_nothing_can_have():
    """Three dimensions of which one pair agrees and two disagree too much."""
    keys = [row["key"] for row in (FILM, PLATE, PISTON)]
    pairs = [
        {"one": keys[a], "other": keys[b], "coefficient": c} for a, b, c in ((0, 1, 0.9), (1, 2, 0.9), (0, 2, -0.9))
    ]
    found = faults_of(dimension=[FILM, PLATE, PISTON], correlation=pairs)["tolerance.correlation"]
    assert "positive definite" in found.expected
    assert pump_with(dimension=[FILM, PLATE, PISTON], correlation=pairs[:1])


def test_faults_of_a_correlation():
    pair = {"one": FILM["key"], "other": "oil.density", "coefficient": 0.5}
    assert faults_of(dimension=[FILM], correlation=[pair])["tolerance.correlation.1.other"].found == "'oil.density'"
    same = pair | {"other": FILM["key"]}
    assert "two dimensions" in faults_of(dimension=[FILM], correlation=[same])["tolerance.correlation.1"].expected
    assert faults_of(dimension=[FILM], correlation=[pair | {"coefficient": 1.0}])
    several = faults_of(dimension=[FILM | {"parts": 9}, PLATE], correlation=[pair | {"other": PLATE["key"]}])
    assert "of several parts" in several["tolerance.correlation.1"].found


def test_a_partial_section_has_no_keys_of_others():
    pump = load_pump("ref90")
    assert "bore.wall" not in pump_keys(pump)
    assert "bore.wall" in pump_keys(with_values(pump, bore=with_values(pump.bore, wall=3e-3)))


def test_the_commonest_reasons_come_first_each_subject_under_its_first():
    reasons = ["a.b: 3 mm", "c.d: 1 mm", "c.d: 2 mm", "no film at 3 deg", "no film at 5 deg", "no film at 7 deg"]
    found = commonest(reasons)
    assert list(found.items()) == [("no film at 3 deg", 3), ("c.d: 1 mm", 2), ("a.b: 3 mm", 1)]
