"""The public benchmark: what its scorer makes of perfect, empty and malformed answers, and what its folders hold."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from system.inputs.faults import InputFaults

ROOT = Path(__file__).parents[4]


@pytest.fixture(scope="module")
def bench() -> Iterator[SimpleNamespace]:
    """The benchmark's modules."""
    place = str(ROOT / "benchmarks")
    sys.path.insert(0, place)
    names = ("answer", "chosen", "entries", "made", "page", "scoring", "truth")
    yield SimpleNamespace(**{name: importlib.import_module(f"concealed.{name}") for name in names})
    sys.path.remove(place)


@pytest.fixture
def truths(bench: SimpleNamespace) -> list:
    """Truths of four recordings."""
    rows = (
        ("a", "first", "null", "no_mismatch", (), (), ()),
        ("b", "first", "graded", "missing_physics", ("elastic_opening",), ("slipper",), ()),
        ("c", "other", "other-unknown", "unknown_physics", (), (), ()),
        ("d", "rough", "rough-pair", "missing_physics", ("churning", "swash_droop"), ("", ""), ("torque_offset",)),
    )
    return [bench.truth.Truth(*row, score=8.0, sizes={}) for row in rows]


def perfect(bench: SimpleNamespace, truth) -> object:
    """The answer that is true, and sure."""
    names = tuple(bench.answer.Name(id, gap, 1.0, ()) for id, gap in zip(truth.ids, truth.gaps, strict=True))
    ranking = (bench.answer.Ranked(truth.ids, truth.gaps, 1.0),) if truth.ids else ()
    return bench.answer.Answer(truth.recording, truth.verdict, "named", names, ranking, 2.0)


def written(folder: Path, **changes) -> Path:
    """A folder with one answer to recording b, with changes; None leaves a key out."""
    row = {"format": 1, "recording": "b", "verdict": "missing_physics", "names": [{"id": "churning"}]} | changes
    (folder / "b.json").write_text(json.dumps({key: value for key, value in row.items() if value is not None}))
    return folder


def test_a_perfect_answer(bench, truths, tmp_path):
    """Every rate at its best, through the files."""
    for truth in truths:
        bench.answer.write_answer(tmp_path, perfect(bench, truth))
    found = bench.scoring.score("p", truths, bench.answer.read_answers(tmp_path, [one.recording for one in truths]))
    counts = {name: (own.hits, own.of) for name, own in vars(found).items() if isinstance(own, bench.scoring.Share)}
    assert counts == {
        "answered": (4, 4), "false_positive": (0, 1), "false_negative": (0, 3), "detected": (4, 4), "right": (3, 3),
        "right_alone": (3, 3), "wrong": (0, 4), "sure_and_wrong": (0, 4), "in_set": (2, 2),
    }  # fmt: skip
    assert (found.errors, found.cpu_s, found.set_size) == (0.0, 2.0, 1.0)
    assert (found.right_at["rough"].hits, found.right_at["rough"].of) == (1, 1)


def test_no_answer(bench, truths, tmp_path):
    """Nothing is detected, nothing is wrong; the ids that are there are errors of classification."""
    found = bench.scoring.score("e", truths, bench.answer.read_answers(tmp_path, ["a", "b", "c", "d"]))
    assert (found.answered.hits, found.detected.hits, found.right.hits, found.wrong.hits) == (0, 0, 0, 0)
    assert (found.false_negative.hits, found.false_positive.hits) == (3, 0)
    assert found.errors == 4 / 4
    assert found.in_set.text == "-"


def test_wrong_answers(bench, truths):
    """A name on a null, a wrong gap, half of a pair, a fault beside it, a suspicion: each counts as what it is."""
    name, answer = bench.answer.Name, bench.answer.Answer
    nan = float("nan")
    told = {
        "a": answer("a", "missing_physics", "named", (name("churning", "", 0.95, ()),), (), nan),
        "b": answer("b", "missing_physics", "named", (name("elastic_opening", "piston", 0.5, ()),), (), nan),
        "c": answer("c", "missing_physics", "suspicion", (name("churning", "", 0.99, ()),), (), nan),
        "d": answer("d", "missing_physics", "named",
                    (name("churning", "", 0.9, ()), name("torque_offset", "", 0.9, ())), (), nan),
    }  # fmt: skip
    found = bench.scoring.score("w", truths, told)
    assert (found.false_positive.hits, found.false_negative.hits, found.right.hits) == (1, 0, 0)
    assert (found.wrong.hits, found.sure_and_wrong.hits) == (2, 1)
    assert found.errors == pytest.approx((1 + 0 + 1 + 1) / 4)


def test_a_class_stands_for_its_member(bench, truths):
    """An id that cannot be told from the true one is right, and no error."""
    one = bench.answer.Answer(
        "b", "wrong_parameter", "named", (bench.answer.Name("film_thickness", "", 0.9, ("elastic_opening",)),), (), 1.0
    )
    found = bench.scoring.score("c", truths[1:2], {"b": one})
    assert (found.right.hits, found.errors) == (1, 0.0)


def test_a_class_of_every_id_is_told(bench, truths):
    """It is right of one cause without knowledge, by its class alone; nothing is right without it."""
    ids = bench.answer.IDS
    names = (bench.answer.Name(ids[0], "", 0.97, ids[1:]),)
    told = {one.recording: bench.answer.Answer(one.recording, "missing_physics", "named", names, (), 1.0)
            for one in truths[1:2]}  # fmt: skip
    found = bench.scoring.score("all", truths[1:2], told)
    assert (found.right.hits, found.right_alone.hits) == (1, 0)


def test_nothing_is_an_explanation_of_the_set(bench, truths):
    """Of a null the true one; a hidden cause behind it is not in the set, and a short list is as long as it is."""
    ranked, answer = bench.answer.Ranked, bench.answer.Answer
    nothing, churning = ranked((), (), 0.97), ranked(("churning",), ("",), 0.03)
    told = {name: answer(name, "no_mismatch", "named", (), (nothing, churning), 1.0) for name in ("a", "b")}
    found = bench.scoring.score("n", truths[:2], told)
    assert (found.in_set.hits, found.in_set.of, found.set_size) == (1, 2, 1.0)
    few = answer("b", "no_mismatch", "named", (), tuple(ranked((id,), ("",), 0.01) for id in bench.answer.IDS), 1.0)
    assert bench.scoring.score("f", truths[1:2], {"b": few}).set_size == len(bench.answer.IDS)


def test_a_failure_detects_nothing(bench, truths):
    failed = bench.answer.Answer("a", "no_mismatch", "failed", (), (), 1.0)
    found = bench.scoring.score("f", truths[:1], {"a": failed})
    assert (found.answered.hits, found.detected.hits, found.false_positive.hits) == (0, 0, 0)


def test_a_suspicion_of_unknown_physics_does_not_name_it(bench, truths):
    told = bench.answer.Answer("c", "unknown_physics", "suspicion", (), (), 1.0)
    found = bench.scoring.score("s", truths[2:3], {"c": told})
    assert (found.right.hits, found.errors) == (0, 1.0)


def test_unknown_physics_told_for_a_known_cause_is_wrong_and_sure(bench, truths):
    weighed = (bench.answer.Ranked(("unknown_physics",), ("",), 0.95),)
    told = bench.answer.Answer("b", "unknown_physics", "named", (), weighed, 1.0)
    found = bench.scoring.score("u", truths[1:2], {"b": told})
    assert (found.wrong.hits, found.sure_and_wrong.hits) == (1, 1)


FAULTS = [
    ({"format": 2}, "b.json: format", "1"),
    ({"recording": "bb"}, "b.json: recording", "b"),
    ({"verdict": None}, "b.json: verdict", ""),
    ({"verdict": "missing_physic"}, "b.json: verdict", "missing_physics"),
    ({"status": "sure"}, "b.json: status", ""),
    ({"verdicts": "x"}, "b.json: verdicts", "verdict"),
    ({"names": "churning"}, "b.json: names", ""),
    ({"names": ["churning"]}, "b.json: names.1", ""),
    ({"names": [{"id": "churnig"}]}, "b.json: names.1.id", "churning"),
    ({"names": [{"id": "churning", "gap": "slippr"}]}, "b.json: names.1.gap", "slipper"),
    ({"names": [{"id": "churning", "probability": 97}]}, "b.json: names.1.probability", ""),
    ({"names": [{"id": "churning", "or": ["drop"]}]}, "b.json: names.1.or", ""),
    ({"ranking": [{"ids": ["churning"], "gaps": [], "probability": 1}]}, "b.json: ranking.1.gaps", ""),
    ({"ranking": [{"ids": ["churning"], "gaps": ["slippr"], "probability": 1}]}, "b.json: ranking.1.gaps", "slipper"),
    ({"ranking": [{"ids": ["churning"], "gaps": [["piston"]], "probability": 1}]}, "b.json: ranking.1.gaps", ""),
    ({"ranking": [{"ids": [], "probability": 0.6}] * 2}, "b.json: ranking", ""),
    ({"cpu_s": "12"}, "b.json: cpu_s", ""),
    ({"verdict": "no_mismatch"}, "b.json: names", ""),
]


@pytest.mark.parametrize(("change", "where", "nearest"), FAULTS, ids=[where[8:] for _, where, _ in FAULTS])
def test_malformed_answers(bench, tmp_path, change, where, nearest):
    with pytest.raises(InputFaults) as raised:
        bench.answer.read_answers(written(tmp_path, **change), ["a", "b"])
    (fault,) = raised.value.faults
    assert fault.path == where
    assert nearest in fault.nearest


def test_all_malformed_files_at_once(bench, tmp_path):
    (tmp_path / "a.json").write_text("{")
    (tmp_path / "c.json").write_text("[1]")
    with pytest.raises(InputFaults) as raised:
        bench.answer.read_answers(written(tmp_path, format="one", cpu_s=True), ["a", "b"])
    paths = [one.path for one in raised.value.faults]
    assert paths == ["a.json", "b.json: format", "b.json: cpu_s", "c.json: the file"]


def test_a_second_answer(bench, tmp_path):
    written(tmp_path)
    (tmp_path / "z.json").write_text((tmp_path / "b.json").read_text())
    with pytest.raises(InputFaults, match="a second time"):
        bench.answer.read_answers(tmp_path, ["a", "b"])


def test_splits_differ_and_plants_take_turns(bench):
    """Of each plant a third; no case is in both splits, none twice."""
    development, test = (bench.chosen.chosen(seed, 42) for seed in bench.chosen.SEEDS.values())
    assert {sum(case.part.plant is plant for case in test) for plant in bench.chosen.PARTS} == {14}
    keys = [(case.part, case.seed) for case in (*development, *test)]
    assert len(set(keys)) == 84
    assert bench.chosen.chosen(72, 10) == test[:10]
    assert len(bench.chosen.chosen(72, 10_000)) == bench.chosen.most(72)


def test_no_two_recordings_share_their_draws(bench):
    """Two of one pump with the same noise would differ by what is concealed alone; neither in the other split."""
    seeds = [case.seed for seed in bench.chosen.SEEDS.values() for case in bench.chosen.chosen(seed, 300)]
    assert len(set(seeds)) == 600


@pytest.mark.parametrize("recordings", [12, 84, 300])
def test_no_campaign_is_one_of_nulls_alone(bench, recordings):
    """A recording's channels and number of points do not tell that nothing is concealed in it."""
    for seed in bench.chosen.SEEDS.values():
        found = bench.chosen.chosen(seed, recordings)
        nulls = {(one.part.plant, one.campaign) for one in found if one.part.value.endswith("null")}
        others = {(one.part.plant, one.campaign) for one in found if not one.part.value.endswith("null")}
        assert nulls
        assert nulls <= others


@pytest.fixture(scope="module")
def made(bench, tmp_path_factory) -> Path:
    """A benchmark of three recordings, nothing concealed."""
    folder = tmp_path_factory.mktemp("bench")
    bench.made.make_benchmark(folder, 3)
    return folder


def test_folders_and_seals(bench, made):
    about = json.loads((made / "manifest.json").read_text())
    assert (about["benchmark"], about["licence"], about["splits"]["test"]["seed"]) == (2, "CC-BY-4.0", 72)
    for split, path in (("development", made / "development" / "truths.json"),
                        ("test", made / "sealed" / "test-truths.json")):  # fmt: skip
        assert bench.truth.seal(path) == about["splits"][split]["truths_sha256"]
        truths = bench.truth.read_truths(path)
        assert [one.recording for one in truths] == sorted(about["splits"][split]["recordings_sha256"])
        assert {one.verdict for one in truths} == {"no_mismatch"}
    assert not (made / "test" / "truths.json").exists()


def test_a_recording_tells_nothing(bench, made):
    """Neither names nor texts tell what is concealed or the seed; each has its pump."""
    for folder in (made / "test" / "recordings").iterdir():
        text = (folder / "recording.toml").read_text()
        assert f'title = "{folder.name}"' in text
        assert "nothing" not in text
        assert "seed" not in text
        assert not any(str(one.seed) in (folder / "pump.toml").read_text() for one in bench.chosen.chosen(72, 3))


def test_the_page_tells_split_and_version(bench, truths, tmp_path):
    told = {truths[1].recording: perfect(bench, truths[1])}
    scores = [bench.scoring.score("e", truths, told)]
    bench.page.write_page(tmp_path / "p.md", "development", truths, {"e": told}, scores)
    text = (tmp_path / "p.md").read_text()
    assert "development split of version 2 with 4\nrecordings, 1 of them with nothing concealed" in text
    assert "**elastic_opening (slipper)**" in text
    assert text.count("\n| e |") == 2


def said(*words: object) -> str:
    """What `concealed.py` says as it refuses a command line."""
    command = [sys.executable, ROOT / "benchmarks" / "concealed.py", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    return done.stderr


def test_two_entries_of_one_name_are_refused(made, tmp_path):
    """Neither of them replaces the other."""
    folders = [tmp_path / team / "answers" for team in ("a", "b")]
    for folder in folders:
        folder.mkdir(parents=True)
    assert "'answers' 2 times" in said("score", made, "--split", "test", *folders)


def test_a_public_seed_is_no_secret_test(tmp_path):
    assert "--test-seed" in said("make", tmp_path / "new", "--test-seed", "71")
    assert not (tmp_path / "new").exists()


def test_rivals_as_answers(bench):
    """A rival that names nothing has a suspicion; one that names a fault of a meter has that verdict."""
    from concealed.entries import rival_answer
    from proof.outcome import Rival

    assert rival_answer("a", Rival(False, ())).verdict == "no_mismatch"
    assert rival_answer("a", Rival(True, ())).status == "suspicion"
    assert rival_answer("a", Rival(True, ("torque_offset",))).verdict == "sensor_fault"


def test_our_verdicts_as_answers(bench, truths):
    from concealed.entries import our_answer
    from proof.outcome import Claimed, Outcome, Ranked

    blank = Outcome("b", "", "", 0, 0.0, 0.0, {}, "", (), (), {})
    claimed = (Claimed("elastic_opening", "slipper", 0.97, ("film_thickness", "unknown_physics")),)
    told = Outcome(**vars(blank) | {"verdict": "missing_physics", "status": "incomplete", "claims": claimed})
    answer = our_answer("b", told)
    assert answer.names[0].equivalent == ("film_thickness",)  # an unknown cause is no id of the list
    assert bench.scoring.score("ours", truths[1:2], {"b": answer}).right.hits == 1
    weighed = (Ranked((), (), "no_mismatch", 0.96), Ranked(("churning",), (None,), "missing_physics", 0.04))
    quiet = our_answer("a", Outcome(**vars(blank) | {"verdict": "no_mismatch", "status": "named", "ranked": weighed}))
    assert bench.scoring.score("ours", truths[:1], {"a": quiet}).in_set.hits == 1
    failed = our_answer("b", Outcome(**vars(blank) | {"failed": "no film"}))
    assert failed.status == "failed"
    assert not bench.scoring.judged(truths[1], failed).alarm
