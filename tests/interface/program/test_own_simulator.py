"""The shortest model of one's own in the estimation engine, and what the tutorial says that it prints."""

from pathlib import Path

TUTORIAL = Path(__file__).resolve().parents[3] / "docs" / "tutorial.md"


def test_a_leak_is_named_where_there_is_one(example, capsys):
    valve = example("own_simulator/valve.py")
    assert valve.main() > 10.0
    assert capsys.readouterr().out.strip() in TUTORIAL.read_text("utf-8")
    assert valve.main(leak=0.0) < 0.0


def test_parameters_are_replaced_or_added(example):
    valve = example("own_simulator/valve.py")
    grown = valve.Valve().with_parameters((valve.LEAK,))
    assert [one.name for one in grown.parameters] == ["orifice", "leak"]
    assert grown.with_parameters((valve.LEAK,)) == grown
