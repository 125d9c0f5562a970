"""The shortest model of one's own in the estimation engine, and what the tutorial says that it prints."""

from pathlib import Path

import numpy as np
import pytest

from system import FunctionSimulator

ROOT = Path(__file__).resolve().parents[3]
TUTORIAL = ROOT / "docs" / "tutorial.md"
VALVE = "own_simulator/valve.py"
MOST_LINES = 40


def test_a_leak_is_named_where_there_is_one(example, capsys):
    valve = example(VALVE)
    assert valve.main() == ("leak",)
    assert capsys.readouterr().out.strip() in TUTORIAL.read_text("utf-8")
    assert valve.main(leak=0.0) == ()


def test_a_model_of_one_s_own_takes_few_lines():
    code = (ROOT / "examples" / VALVE).read_text("utf-8").split('"""', 2)[2]
    assert len([line for line in code.splitlines() if line.strip()]) < MOST_LINES


def test_parameters_are_replaced_or_added(example):
    valve = example(VALVE)
    grown = FunctionSimulator(valve.flow, (valve.ORIFICE,)).with_parameters(valve.POSSIBLE["leak"])
    assert [one.name for one in grown.parameters] == ["orifice", "leak"]
    assert grown.with_parameters(valve.POSSIBLE["leak"]) == grown


def test_slopes_are_those_of_the_function_in_the_order_of_the_names(example):
    valve = example(VALVE)
    model = FunctionSimulator(valve.flow, (valve.ORIFICE, *valve.POSSIBLE["leak"]))
    found = model.slopes(np.array([1e-6, 0.0]), ("leak", "orifice"))[:, 0]
    assert found[:, 0] == pytest.approx(valve.DROP, rel=1e-6)
    assert found[:, 1] == pytest.approx(np.sqrt(valve.DROP), rel=1e-6)
    assert model.input_slopes(np.array([1e-7, 0.0])).shape == (valve.DROP.size, 1, 0)
