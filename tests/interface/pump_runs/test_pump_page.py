"""The page of an operating point: its answer first, and where the shaft power goes."""

import json
import re
from dataclasses import replace

import matplotlib.text
import numpy as np
import pytest

from swashfilm.__main__ import main
from swashfilm.output.figures import compact
from swashfilm.runs.pump.headline.answer import pump_answer
from swashfilm.runs.pump.headline.powers import Power, PowerKind, gathered, largest_losses, power_parts
from swashfilm.runs.pump.headline.ribbons import flow_diagram
from system import load_pump, resolved_toml

DELIVERED = Power("delivered hydraulic power", 600.0, PowerKind.DELIVERED)
FRICTION = Power("friction, piston-cylinder", 450.0, PowerKind.FRICTION)
RETURNED = Power("leakage, slipper-swash plate", -50.0, PowerKind.LEAKAGE)
TINY = Power("throttling, delivery port", 1.0, PowerKind.THROTTLING)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A pump with markup in its name and churning, in the lumped fidelity."""
    place = tmp_path_factory.mktemp("page")
    text = resolved_toml(load_pump("ref90")).replace('name = "ref90"', 'name = "<b>ref90</b>"')
    text += "\n[physics.churning]\nfactor = 1.0\n"
    (place / "pump.toml").write_text(text, "utf-8")
    assert main(["run", str(place / "pump.toml"), "--fidelity", "lumped", "-o", str(place / "run")]) == 0
    return place / "run"


@pytest.fixture(scope="module")
def summary(folder):
    return json.loads((folder / "summary.json").read_text("utf-8"))


def test_the_parts_make_up_the_shaft_power(summary):
    shaft = summary["power_balance"]["shaft_W"]
    parts = power_parts(summary)
    assert sum(part.watts for part in parts) == pytest.approx(shaft, rel=1e-12)
    assert sum(part.watts for part in gathered(parts)) == pytest.approx(shaft, rel=1e-12)
    assert any(part.name == "churning" for part in parts)
    assert abs(parts[-1].watts) < 1e-3 * shaft


def test_small_parts_come_together_and_large_ones_by_size():
    small = [replace(TINY, watts=watts) for watts in (1.0, 2.0, -0.5)]
    found = gathered([FRICTION, *small, DELIVERED, RETURNED])
    assert [part.watts for part in found] == [600.0, 450.0, -50.0, 2.5]
    assert found[-1].name == "other, 3 parts"


def test_half_of_the_loss_is_named():
    named, share = largest_losses([DELIVERED, FRICTION, replace(TINY, watts=300.0), TINY])
    assert named == (FRICTION,)
    assert share == pytest.approx(450.0 / 751.0)


@pytest.mark.parametrize(
    ("shaft", "parts"),
    [
        (1051.0, [DELIVERED, FRICTION, TINY]),
        (1001.0, [DELIVERED, FRICTION, RETURNED, TINY]),
        (941.0, [DELIVERED, FRICTION, RETURNED, replace(RETURNED, watts=-60.0), TINY]),
        (-450.0, [replace(DELIVERED, watts=-900.0), FRICTION]),
        (361.0, [replace(DELIVERED, watts=-90.0), FRICTION, TINY]),
    ],
)
@pytest.mark.usefixtures("rendered")
def test_no_text_lies_over_another(shaft, parts):
    figure = flow_diagram(shaft, parts)
    compact(figure)
    texts = [text for text in figure.findobj(matplotlib.text.Text) if text.get_text() and text.get_visible()]
    boxes = [text.get_window_extent() for text in texts if text.axes and text in text.axes.texts]
    assert len(boxes) >= 3 * (1 + sum(part.watts > 0.0 for part in parts[1:]))
    width, height = figure.bbox.size
    for k, box in enumerate(boxes):
        assert not any(box.overlaps(other) for other in boxes[:k])
        assert 0.0 <= box.x0 < box.x1 <= width
        assert 0.0 <= box.y0 < box.y1 <= height


def test_the_page_begins_with_flow_torque_efficiency_and_loss(folder, summary):
    page = (folder / "report.html").read_text("utf-8")
    head = page[: page.index("<nav>")]
    names = re.findall(r'class="name">([^<]*)<', head)
    assert names == ["delivery flow", "shaft torque", "overall efficiency", "not delivered"]
    answer = pump_answer(summary)
    assert f"{summary['flow']['delivery_m3_per_s'] * 6e4:.1f} L/min" in answer.words
    assert "of this loss goes into friction at slipper-swash plate" in answer.words
    assert "<b>ref90</b>" not in page


def test_error_bars_of_finer_levels_stand_in_the_tiles(summary):
    number = {"extrapolated": 0.00304, "error": 2e-6, "verdict": "converges as expected", "order": 2.0}
    refined = {**summary, "refinement": {"numbers": {"delivery_flow_m3_per_s": number}}}
    assert pump_answer(refined).tiles[0].note == "limit 182.40 +- 0.12 L/min"
    none = {**number, "error": None, "verdict": "no order observed"}
    refined["refinement"]["numbers"]["delivery_flow_m3_per_s"] = none
    assert pump_answer(refined).tiles[0].note == "no order observed: no error bar"


def test_a_pump_that_delivers_nothing_says_so(summary):
    flow = {**summary["flow"], "delivery_m3_per_s": -1e-5}
    power = {**summary["power_balance"], "hydraulic_W": -100.0}
    none = {"overall": None, "volumetric": None, "hydromechanical": None}
    answer = pump_answer({**summary, "flow": flow, "power_balance": power, "efficiency": {"iso_4409": none}})
    assert "delivers nothing" in answer.words
    assert "overall efficiency" not in [tile.name for tile in answer.tiles]
    assert np.all([tile.value for tile in answer.tiles])


GAP = {
    "film_thickness_min_m": 3e-6, "film_thickness_min_at_deg": 280.0, "rubbing_power_W": 0.0,
    "film_temperature_max_K": 350.0,
}  # fmt: skip


def test_floating_films_tell_the_thinnest_the_hottest_and_what_rubs(summary):
    gaps = {"piston": GAP | {"film_thickness_min_m": 0.8e-6, "rubbing_power_W": 12.0}, "slipper": GAP}
    number = {"extrapolated": 0.79e-6, "error": 2e-8, "verdict": "converges as expected"}
    found = pump_answer({
        **summary, "fidelity": "floating", "gaps": gaps, "unlike": {},
        "refinement": {"numbers": {"film_least_m.piston": number}},
    })  # fmt: skip
    tiles = {tile.name: tile for tile in found.tiles}
    assert tiles["least film of the turn"].value == "0.80 um"
    assert tiles["least film of the turn"].note == "piston-cylinder, 280 deg; limit 0.790 +- 0.020 um"
    assert tiles["hottest oil"].value == "77 degC"
    assert "Parts rub on each other at one piston-cylinder (12 W)." in found.words


@pytest.mark.parametrize(("film", "shown"), [(0.71e-9, "0.00071 um"), (0.2e-6, "0.20 um"), (-0.3e-6, "-0.30 um")])
def test_a_film_of_nanometres_is_not_told_as_none(film, shown, summary):
    gaps = {"piston": GAP | {"film_thickness_min_m": film}, "slipper": GAP}
    found = pump_answer({**summary, "fidelity": "floating", "gaps": gaps, "unlike": {}})
    assert {tile.name: tile.value for tile in found.tiles}["least film of the turn"] == shown


def test_the_answer_counts_chambers_of_the_less_common_kinds(summary):
    """A worn slipper runs hotter, rubs and has the least film, whose error bar is not that of the others."""
    worn = GAP | {"film_thickness_min_m": 0.5e-6, "rubbing_power_W": 40.0, "film_temperature_max_K": 380.0}
    number = {"extrapolated": 3e-6, "error": 2e-8, "verdict": "converges as expected"}
    found = pump_answer({
        **summary, "fidelity": "floating", "gaps": {"slipper": GAP, "valve_plate": GAP},
        "unlike": {"chamber_3": {"chambers": [3], "gaps": {"slipper": worn}}},
        "refinement": {"numbers": {"film_least_m.slipper": number}},
    })  # fmt: skip
    tiles = {tile.name: tile for tile in found.tiles}
    assert tiles["least film of the turn"].note == "slipper-swash plate, chamber 3, 280 deg"
    assert (tiles["hottest oil"].value, tiles["hottest oil"].note) == ("107 degC", "slipper-swash plate, chamber 3")
    assert "Parts rub on each other at one slipper-swash plate, chamber 3 (40 W)." in found.words


@pytest.mark.parametrize(
    ("fidelity", "words"),
    [
        ("table", "response table of the fidelity floating without elastic walls, heat."),
        ("fixed", "positions of the pump file"),
    ],
)
def test_words_say_where_the_films_come_from(summary, fidelity, words):
    table = {"source": "floating", "stated": {"physics": "gaps float; left out: elastic walls, heat"}}
    assert words in pump_answer({**summary, "fidelity": fidelity, "table": table}).words
