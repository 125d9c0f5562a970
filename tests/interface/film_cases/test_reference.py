"""`swashfilm reference`: coefficients in a run folder, every fault of a case at once."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from swashfilm.cli.app import run_command
from swashfilm.runs.reference.case import ReferenceKind, load_reference
from system import InputFaults, read_flow_coefficients, read_step_losses

EXAMPLES = sorted((Path(__file__).parents[3] / "examples" / "references").glob("*.toml"))
STEP = 'format = 1\n[reference]\nkind = "step"\nfilm_ratio = [2, 0.5]\nreynolds = [5, 0]\ncells = 2\n'
SLOT = """format = 1
[reference]
kind = "slot"
height = ["0.2 mm", "0.4 mm"]
length = "0.2 mm"
width = "5 mm"
pipe_ratio = 3
reynolds = [0, 1, 4]
cells = 2
"""


def written(place: Path, text: str) -> Path:
    path = place / "case.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_load(path):
    assert load_reference(path).passages


def test_the_examples_show_every_kind():
    assert {load_reference(path).kind for path in EXAMPLES} == set(ReferenceKind)


@pytest.mark.usefixtures("rendered")
def test_a_step_leaves_loss_factors_and_a_page(tmp_path, capsys):
    folder = tmp_path / "out"
    assert run_command(["reference", str(written(tmp_path, STEP)), "-o", str(folder)]) == 0
    assert "film behind / film before = 0.5" in capsys.readouterr().out
    found = read_step_losses(folder / "loss_factor.csv")
    assert list(found.reynolds) == [0.0, 5.0]
    assert found.sizes.tolist() == [[0.5], [2.0]]
    assert found.extra_length[0] == pytest.approx(found.extra_length[1], rel=0.05)
    assert found.source.startswith("swashfilm")
    (folder / "report.html").unlink()
    assert run_command(["report", str(folder)]) == 0
    assert (folder / "report.html").stat().st_size > 5e4
    assert {path.name for path in folder.iterdir()} == {
        "input.toml", "loss_factor.csv", "summary.json", "report.html", "flow_1.png", "flow_2.png",
    }  # fmt: skip


def test_a_slot_leaves_coefficients_over_opening_and_reynolds_number(tmp_path):
    folder = tmp_path / "out"
    assert run_command(["reference", str(written(tmp_path, SLOT)), "-o", str(folder)]) == 0
    found = read_flow_coefficients(folder / "port_coefficient.csv")
    assert found.opening == pytest.approx([1e-6, 2e-6])
    assert found.reynolds.shape == (2, 2)
    assert found.reynolds[0, 1] == pytest.approx(4.0 * 5.642, rel=1e-3)
    rows = json.loads((folder / "summary.json").read_text("utf-8"))["passages"][0]["rows"]
    assert rows[0]["flow_coefficient"] == 0.0
    assert found.flow_coefficient[0, 0] == pytest.approx(rows[1]["flow_coefficient"], rel=1e-5)


def test_every_fault_is_told_at_once(tmp_path):
    text = 'format = 2\n[reference]\nkind = "step"\nfilm_ratio = [1, -2]\nreynolds = "5"\ncells = 0.5\nwidth = 1\n'
    with pytest.raises(InputFaults) as told:
        load_reference(written(tmp_path, text))
    paths = {fault.path for fault in told.value.faults}
    assert {"format", "reference.film_ratio", "reference.reynolds", "reference.cells", "reference.width"} == paths


def test_sizes_of_a_bore_are_held_to_their_kind(tmp_path):
    text = SLOT.replace("slot", "orifice").split("height")[0]
    text += 'diameter = ["1 mm", "2 bar", "0 mm"]\npipe_ratio = 0.5\nreynolds = []\n'
    with pytest.raises(InputFaults) as told:
        load_reference(written(tmp_path, text))
    found = [fault.path.removeprefix("reference.") for fault in told.value.faults]
    assert sorted(found) == ["diameter", "diameter", "length", "pipe_ratio", "reynolds"]


def test_a_kind_that_is_none_names_the_nearest(tmp_path):
    with pytest.raises(InputFaults, match="orifice"):
        load_reference(written(tmp_path, 'format = 1\n[reference]\nkind = "orifise"\n'))
