"""A diagnosis told: the sentence of every status, diagnosis.json, and the page that is made from its folder."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from diagnosis.angle_scan import AngleWindow
from diagnosis.bench_box import BenchBox
from diagnosis.detect import ChannelMisfit, Detection
from diagnosis.diagnosis_file import diagnosis_record, read_diagnosis, write_diagnosis
from diagnosis.diagnosis_tables import pull_sums
from diagnosis.hypotheses import Hypothesis
from diagnosis.locate import Location
from diagnosis.next_point import NextPoint
from diagnosis.recording import Circuit, DataNote, NoteKind, RecordedChannel, Recording, SteadyTable
from diagnosis.regions import Region
from diagnosis.study import Study
from diagnosis.table_rows import by_table_rows
from diagnosis.thresholds import load_thresholds
from diagnosis.time_scan import TimeKind, TimeMark
from diagnosis.unknown import Scaling
from diagnosis.verdict import Claim, Diagnosis, Estimate, Status
from diagnosis.weighed import HeldOut, Weighed
from diagnosis.words import next_point_text, paragraphs, statement
from swashfilm.__main__ import main
from swashfilm.diagnose_files import read_rows, write_diagnosis_files
from swashfilm.diagnose_page import claim_rows
from swashfilm.diagnose_runs import NOTHING, Told, run_both
from system.channels import ChannelName
from system.components import Component
from system.estimation.fit import maximum_posterior
from system.estimation.observations import Array, Channel, Observations
from system.estimation.parameters import Parameter, Role, Scale
from system.estimation.posterior import Effort, Posterior
from system.faults import InputFaults
from system.operating import operating_point
from system.physics.effects import EffectId, Kind
from system.pump_file import load_pump
from system.pump_gap import Gap
from system.units import Dimension

LPM = 1.0 / 60000.0
PRESSURE = np.tile(np.linspace(5e6, 35e6, 7), 4)
SPEED = np.repeat([60.0, 110.0, 160.0, 210.0], 7)
E = EffectId
Q, T = ChannelName.Q_CASE, ChannelName.TORQUE


@dataclass(frozen=True)
class Lines:
    """Case flow ~ p and torque ~ p; the second parameter is a leak ~ p^2."""

    parameters: tuple[Parameter, ...]

    def predict(self, values: Array) -> Array:
        return np.einsum("nck,k->nc", self._columns(), np.append(values, 0.0)[:3])

    def _columns(self) -> Array:
        level = PRESSURE / 35e6
        nothing = np.zeros_like(level)
        flow = np.stack([5 * LPM * level, nothing, 2 * LPM * level**2], axis=-1)
        torque = np.stack([nothing, 400 * level + SPEED / 50, nothing], axis=-1)
        return np.stack([flow, torque], axis=1)

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        return self._columns()[:, :, [[one.name for one in self.parameters].index(name) for name in names]]

    def input_slopes(self, values: Array) -> Array:
        return np.zeros((PRESSURE.size, 2, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Lines:
        return replace(self, parameters=parameters)


def _readings() -> Observations:
    rng = np.random.default_rng(5)
    sigma = np.tile([0.02 * LPM, 0.8], (PRESSURE.size, 1))
    truth = Lines(()).predict(np.array([1.0, 1.0, 0.4]))
    return Observations(
        channels=(Channel("Q_case", Dimension.VOLUME_FLOW), Channel("torque", Dimension.TORQUE)),
        values=truth + sigma * rng.normal(size=truth.shape),
        sigma=sigma,
        inputs=(),
        input_sigma=np.zeros((PRESSURE.size, 0)),
        quantum=np.zeros(2),
        blocks=np.arange(PRESSURE.size),
    )


def _fit(names: tuple[str, ...]) -> Posterior:
    def prior(name: str) -> Parameter:
        if name == "opening":
            return Parameter(name, Role.EXTENSION, Scale.HALF, 0.0, 1.0, 0.0, np.inf, None, "test")
        return Parameter(name, Role.BASE, Scale.NORMAL, 1.0, 0.05, 0.0, 5.0, None, "test")

    return maximum_posterior(Lines(tuple(prior(name) for name in names)), _readings())


def _hypothesis(*effects: EffectId, pair: Gap | None = None, kind: Kind = Kind.MISSING_PHYSICS) -> Hypothesis:
    return Hypothesis(effects, pair, kind, (), (), -2.0)


@pytest.fixture(scope="module")
def named() -> Diagnosis:
    """A valve plate that opens under pressure, named."""
    before, after = _fit(("film", "friction")), _fit(("film", "friction", "opening"))
    rms = ({Q: 1e-6, T: 0.81}, {Q: 2.6e-7, T: 0.8}, {Q: 2.5e-7, T: 0.8})
    fit = HeldOut({"high p": 40.0, "low n": 3.0}, *rms, False, "five random fifths")
    opening = Estimate("elastic_opening.valve_plate.opening", 2.2e-8, 2e-9, Dimension.PRESSURE_COEFFICIENT)
    weighed = (
        Weighed(_hypothesis(E.ELASTIC_OPENING, pair=Gap.VALVE_PLATE), -20.0, False, after, 22.0, 0.93, fit),
        Weighed(_hypothesis(E.FILM_HEATING), -24.0, False, before, 20.0, 0.06, None),
        Weighed(_hypothesis(kind=Kind.NO_MISMATCH), -400.0, False, before, 0.0, 0.0, None),
    )
    point = operating_point(load_pump("ref90"), shaft_speed=104.7, delivery_pressure=37e6)
    return Diagnosis(
        kind=Kind.MISSING_PHYSICS,
        status=Status.NAMED,
        detection=Detection(
            1e-30, 9.1, {Q: ChannelMisfit(17.0, 0.97), T: ChannelMisfit(1.1, 0.03)}, 1e-20, (), ()
        ),
        location=Location(
            channels=(Q,),
            region=Region(Q, {"p_out": 25e6}, {}, 12.0, "p_out above 250 bar"),
            components=((Component.PLATE_LEAKAGE, 200.0),),
            groups=(),
            tie=(Component.PLATE_LEAKAGE,),
            angle=None,
            time=None,
        ),
        effects=(Claim(E.ELASTIC_OPENING, Gap.VALVE_PLATE, 0.93, (), (opening,)),),
        hypotheses=weighed,
        before=before,
        after=after,
        fit=fit,
        scaling=Scaling(
            Q,
            True,
            {"speed": 0.02, "pressure": 2.1, "displacement": 0.0, "viscosity": -1.0},
            dict.fromkeys(("speed", "pressure", "displacement", "viscosity"), 0.1),
        ),
        next_point=NextPoint(
            box=BenchBox(((104.7, 104.7), (1e6, 37e6), (1.0, 1.0), (343.15, 343.15)), 2e6, 1e5, 0.0, (40.0, 1.0)),
            point=point,
            inlet_temperature=343.15,
            between=("elastic opening at the valve plate", "film heating"),
            separates=(E.ELASTIC_OPENING, E.FILM_HEATING),
            before=np.log(15.5),
            gain=7.0,
            after=4.3,
            chance=0.87,
            repeats=3,
            why="there Q_case parts",
        ),
        not_identifiable=("film_thickness slipper vs film_thickness piston",),
        notes=("row 3 of Q_case was removed",),
        effort=Effort(10, 3, 1.0),
    )


@pytest.fixture(scope="module")
def study(named: Diagnosis) -> Study:
    """The recording that it was found in."""
    values = np.full((PRESSURE.size, len(ChannelName)), np.nan)
    order = list(ChannelName)
    for name, column in {ChannelName.SPEED: SPEED, ChannelName.P_OUT: PRESSURE}.items():
        values[:, order.index(name)] = column
    values[:, [order.index(Q), order.index(T)]] = _readings().values
    channels = (
        RecordedChannel(Q, "Q_case", "L/min", 0.02 * LPM, 0.0, 0.0, 0.0, 0.0, 0.0, ("gain_sigma",)),
        RecordedChannel(T, "M", "N m", 0.8, 0.0, 0.0, 0.0, 0.0, 0.0, ()),
    )
    notes = (DataNote(NoteKind.REMOVED, Q, (2,), "far from its neighbours"),)
    nan, ones = np.full(PRESSURE.size, np.nan), np.ones(PRESSURE.size)
    steady = SteadyTable(values, np.arange(PRESSURE.size), nan, ones)
    recording = Recording("Bench <4>", "ref90", "ISO VG 46", Circuit.CLOSED, channels, steady, (), notes)
    lines: Any = Lines(named.before.parameters)
    return Study(recording, lines, _readings(), named.before, (), {}, np.zeros((PRESSURE.size, 4)))


def _agreeing(diagnosis: Diagnosis) -> Diagnosis:
    detection = replace(diagnosis.detection, p_value=0.4, chi2_per_dof=1.0)
    return replace(
        diagnosis, kind=Kind.NO_MISMATCH, detection=detection, effects=(), scaling=None, next_point=None
    )


def test_a_named_effect_is_told_with_place_size_and_odds(named: Diagnosis) -> None:
    text = statement(named)
    for part in ("Q_case", "p_out above 250 bar", "film opens under pressure", "the valve plate",
                 "22 +- 2 1/GPa", "0.93"):  # fmt: skip
        assert part in text
    told = " ".join(paragraphs(named))
    for part in (
        "0.06 -> 0.0156 (noise 0.015) L/min",
        "film heating (1:16)",
        "Error on points held out",
        "999.8 rpm",
        "370 bar",
        "3 times",
    ):
        assert part in told, told


def test_the_next_point_is_told_with_what_it_promises(named: Diagnosis) -> None:
    """A promise with its odds; where none can be made so, with what would instead; where the odds do, no more."""
    found = named.next_point
    assert found is not None
    text = next_point_text(found)
    for part in (
        "To separate elastic opening at the valve plate from film heating (odds now 1:16), record speed",
        "3 times: odds of 1:74 are foretold, 1:20 or better with a chance of 0.87",
    ):
        assert part in text
    assert "outside the range recorded" in next_point_text(replace(found, beyond=True))
    poor = replace(found, chance=0.1, gain=0.7, repeats=None, instead="The leak would.")
    text = next_point_text(poor)
    assert text.startswith("No point that an ordinary bench runs is likely to separate")
    assert "multiplies the odds for the true one by 2 on average" in text
    assert text.endswith("The leak would.")
    assert next_point_text(replace(poor, before=-8.0)).startswith("To be surer")
    record = diagnosis_record(replace(named, next_point=poor))["next_test"]
    assert (record["settles"], record["chance"], record["readings"]) == (False, 0.1, 3)
    assert record["log_odds"] == {"now": pytest.approx(np.log(15.5)), "foretold": 4.3}
    assert (record["instead"], record["repeats"]) == ("The leak would.", None)


@pytest.mark.parametrize("status", Status)
@pytest.mark.parametrize("kind", Kind)
def test_every_kind_and_status_has_a_sentence(named: Diagnosis, kind: Kind, status: Status) -> None:
    claims = () if kind in (Kind.NO_MISMATCH, Kind.UNKNOWN_PHYSICS) else named.effects
    claims = tuple(replace(claim, equivalent=(E.FILM_HEATING,)) for claim in claims)
    text = statement(replace(named, kind=kind, status=status, effects=claims))
    assert text.endswith(".")
    assert "  " not in text
    assert "None" not in text
    if status is Status.SUSPICION:
        assert "nothing is claimed" in text
    elif claims and status is Status.CLASS:
        assert "cannot tell elastic_opening from film_heating" in text


@pytest.mark.parametrize("effect", [effect for effect in E if effect is not E.UNKNOWN_PHYSICS])
def test_every_effect_can_be_said(named: Diagnosis, effect: EffectId) -> None:
    text = statement(replace(named, effects=(Claim(effect, None, 0.99, (), ()),)))
    assert f"({effect.value})" in text


def test_a_gap_that_cannot_be_told_is_told_with_its_rivals(named: Diagnosis) -> None:
    claim = replace(named.effects[0], elsewhere=((Gap.SLIPPER, 0.22),))
    found = replace(named, status=Status.CLASS, effects=(claim,))
    text = statement(found)
    assert "most likely at the valve plate" in text
    assert "cannot tell the valve plate (0.78) from the slippers (0.22)" in text
    assert diagnosis_record(found)["effects"][0]["other_pairs"] == {"slipper": 0.22}


def test_unknown_physics_is_described_by_its_exponents(named: Diagnosis) -> None:
    text = statement(replace(named, kind=Kind.UNKNOWN_PHYSICS, effects=()))
    assert "pressure^(2.1 +- 0.1)" in text
    assert "speed^" not in text
    assert "plate leakage" in text


def test_angles_and_times_are_part_of_where(named: Diagnosis) -> None:
    angle = AngleWindow(0.1, 0.3, 1e-3, ("delivery groove opens",))
    time = TimeMark(TimeKind.ONSET, Q, 39, 1e-4, None)
    found = replace(named, location=replace(named.location, angle=angle, time=time))
    assert "shaft angle 5.73 to 17.2 deg (delivery groove opens)" in statement(found)
    assert "point 40" in statement(found)
    where = diagnosis_record(found)["where"]
    assert where["shaft_angle_deg"] == pytest.approx([5.7296, 17.1887], rel=1e-4)
    assert where["time"] == {"kind": "onset", "point": 40}
    lacking = DataNote(NoteKind.REMOVED, None, (1,), "an input of these points is missing")
    recording = SimpleNamespace(notes=(lacking,), steady=SimpleNamespace(values=np.zeros((60, 0))))
    assert diagnosis_record(by_table_rows(found, recording))["where"]["time"]["point"] == 41


def test_temperatures_off_are_told_as_differences(named: Diagnosis) -> None:
    """An offset of 2 K is no temperature of -271 degC."""
    off = Claim(E.T_CASE_OFFSET, None, 0.95, (), (Estimate("T_case.zero", 2.0, 0.3, Dimension.TEMPERATURE),))
    assert "zero 2 +- 0.3 K" in statement(replace(named, kind=Kind.SENSOR_FAULT, effects=(off,)))
    warm = replace(
        named.fit, before={ChannelName.T_OUT: 2.0}, after={ChannelName.T_OUT: 0.5}, noise={ChannelName.T_OUT: 0.4}
    )
    row = diagnosis_record(replace(named, fit=warm))["fit"]["heldout"]["T_out"]
    assert (row["before"], row["unit"]) == (pytest.approx(2.0), "K")


def test_the_file_has_the_form_of_format_1(named: Diagnosis, tmp_path: Path) -> None:
    """Keys, types and units of shared/recordings/README.md."""
    path = tmp_path / "diagnosis.json"
    write_diagnosis(path, named)
    record = read_diagnosis(path)
    assert record == json.loads(path.read_text("utf-8"))
    assert (record["verdict"], record["status"]) == ("missing_physics", "named")
    assert record["mismatch"]["channels"]["Q_case"] == {"chi2_per_dof": 17.0, "share": 0.97}
    assert record["where"]["pair"] == "valve_plate"
    assert record["effects"] == [
        {
            "id": "elastic_opening", "pair": "valve_plate", "probability": 0.93, "equivalent": [],
            "other_pairs": {}, "parameters": [{"name": "opening", "value": 2.2e-8, "sigma": 2e-9, "unit": "1/Pa"}],
        }
    ]  # fmt: skip
    assert record["hypotheses"][0]["heldout_rmse"] == pytest.approx(0.0156)
    assert record["hypotheses"][0]["bic"] == 40.0
    assert record["fit"]["heldout"]["Q_case"]["unit"] == "L/min"
    assert record["fit"]["heldout"]["Q_case"]["before"] == pytest.approx(0.06)
    assert record["next_test"]["point"]["p_out_bar"] == pytest.approx(370)
    assert record["next_test"]["point"]["speed_rpm"] == pytest.approx(999.8, abs=0.1)
    assert record["scaling"]["exponents"]["pressure"] == 2.1


def test_the_page_tells_gaps_that_cannot_be_told_apart() -> None:
    """Ids and other gaps with their share stand in the column of what an effect cannot be told from."""
    claim = {
        "id": "elastic_opening", "pair": "piston", "probability": 0.97, "equivalent": ["thermal_clearance"],
        "other_pairs": {"valve_plate": 0.35}, "parameters": [],
    }  # fmt: skip
    (row,) = claim_rows({"effects": [claim]})
    assert row[3] == "thermal_clearance, at the valve plate (0.35)"


def test_the_file_has_every_key_of_the_stated_form(named: Diagnosis) -> None:
    """The example of recordings/README.md: its keys at every level, values of its kinds."""
    form = Path(__file__).parents[3] / "shared" / "recordings" / "README.md"
    if not form.is_file():
        pytest.skip("needs ../shared/recordings/README.md, which states the form")
    text = form.read_text("utf-8")
    example = json.loads(
        text[text.index("```json") + 7 : text.index("```", text.index("```json") + 7)].replace("...", "")
    )
    _same_form(example, diagnosis_record(named))


def _same_form(example: Any, record: Any, where: str = "diagnosis") -> None:
    if isinstance(example, dict):
        assert set(example) <= set(record), where
        for key, value in example.items():
            _same_form(value, record[key], f"{where}.{key}")
    elif isinstance(example, list) and example:
        assert record, where
        _same_form(example[0], record[0], f"{where}[0]")
    elif example is not None:
        kinds = (int, float) if isinstance(example, int | float) else type(example)
        assert isinstance(record, kinds), where


def test_agreement_claims_nothing(named: Diagnosis, tmp_path: Path) -> None:
    found = _agreeing(named)
    assert "agree within noise and tolerance" in statement(found)
    record = diagnosis_record(found)
    assert (record["effects"], record["next_test"], record["where"]["channels"]) == ([], None, [])


def test_the_folder_holds_tables_and_a_page(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """Pulls in residuals.csv are of the fit they name; the page is made anew from the folder alone."""
    write_diagnosis_files(tmp_path, study, named, load_thresholds())
    rows = read_rows(tmp_path / "residuals.csv")
    assert len(rows) == 2 * PRESSURE.size
    flow = [row for row in rows if row["channel"] == "Q_case"]
    before, after = (
        np.sqrt(np.mean([float(row[key]) ** 2 for row in flow])) for key in ("pull_before", "pull_after")
    )
    assert after < 1.3 < 2.0 < before
    assert float(flow[0]["p_out [bar]"]) == pytest.approx(50)
    assert float(flow[0]["measured"]) == pytest.approx(float(study.observations.values[0, 0]) / LPM, rel=1e-5)
    assert [row["behind [nats]"] for row in read_rows(tmp_path / "hypotheses.csv")] == ["0", "4", "380"]
    opening = next(row for row in read_rows(tmp_path / "parameters.csv") if row["name"] == "opening")
    assert opening["before"] == ""
    assert float(opening["after"]) == pytest.approx(0.4, abs=4 * float(opening["sigma"]))
    page = (tmp_path / "report.html").read_text("utf-8")
    for part in (
        "Bench &lt;4&gt;",
        "film opens under pressure",
        "point 3: far from its neighbours",
    ):
        assert part in page
    (tmp_path / "report.html").unlink()
    assert main(["report", str(tmp_path)]) == 0
    assert (tmp_path / "report.html").read_text("utf-8") == page


def test_a_page_says_what_changes_in_the_pump(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """A point run without and with the finding: links to both, each number with its unit; films told."""
    row = {"quantity": "case drain", "unit": "L/min", "without": "1.2", "with": "1.9", "change": "0.7"}
    told = Told((row,), "Point 7, where the finding adds most: 2100 rpm.", "No film fields.")
    write_diagnosis_files(tmp_path, study, named, load_thresholds(), told=told)
    page = (tmp_path / "report.html").read_text("utf-8")
    for part in (
        "Point 7",
        'href="without/report.html"',
        'href="with/report.html"',
        "1.9 L/min",
        "No film fields.",
    ):
        assert part in page
    assert read_rows(tmp_path / "changes.csv") == [row]


def test_a_meters_fault_is_no_change_of_the_pump(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """Nothing is run, and why is told; nothing is told where nothing is claimed."""
    fault = replace(named, effects=(Claim(E.TORQUE_OFFSET, None, 0.99, (), ()),))
    pump = load_pump("ref90")
    told = run_both(tmp_path, pump, study, fault, load_thresholds(), lambda *_: None)
    assert told.text == "A sensor's fault changes nothing in the pump."
    assert not list(tmp_path.iterdir())
    assert run_both(tmp_path, pump, study, _agreeing(named), load_thresholds(), lambda *_: None) == NOTHING


def test_numbers_are_told_in_the_units_people_read(study: Study, named: Diagnosis, tmp_path: Path) -> None:
    """An opening in 1/GPa and not 1/Pa, in the table of what is claimed."""
    write_diagnosis_files(tmp_path, study, named, load_thresholds())
    assert "opening 22 +- 2 1/GPa</td>" in (tmp_path / "report.html").read_text("utf-8")


def test_a_right_name_lets_the_pulls_fall(named: Diagnosis) -> None:
    before, after = pull_sums(named.before, named.after)
    assert after < 0.5 * before


@pytest.mark.parametrize("kind", [Kind.NO_MISMATCH, Kind.UNKNOWN_PHYSICS])
def test_a_page_without_a_claim(study: Study, named: Diagnosis, tmp_path: Path, kind: Kind) -> None:
    found = replace(
        _agreeing(named), kind=kind, after=named.before, fit=HeldOut({}, {}, {}, {}, False, "not split")
    )
    write_diagnosis_files(tmp_path, study, found, load_thresholds())
    page = (tmp_path / "report.html").read_text("utf-8")
    assert "<h2>What</h2>" not in page


@pytest.mark.parametrize(
    ("text", "fault"), [("{}", "format"), ('{"format": 1}', "verdict"), ("[", "file"), ("[]", "list")]
)
def test_a_file_that_is_none_is_refused(tmp_path: Path, text: str, fault: str) -> None:
    path = tmp_path / "diagnosis.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputFaults, match=fault):
        read_diagnosis(path)
