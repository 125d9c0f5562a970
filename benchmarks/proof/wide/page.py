"""Section of docs/proof.md on the gates of all three plants."""

from __future__ import annotations

from collections.abc import Sequence

from ..gate import Gate
from ..markdown import table
from ..outcome import Outcome
from ..parts import Plant
from .gates import by_plant

TEXT = """
## Gates on three plants

No plant shares code with another one or with the program; campaigns and sensors of the second are those of the first.

- First plant: that of the gates above.
- Other laws (`benchmarks/proof/other`): a lumped pump of the same drawing. Its viscosity follows Roelands, its density
  a secant modulus. Leakage has closed forms, a chamber one implicit step of closed form at each angle. Every effect has
  another law than in the program and in the first plant.
- Rough (`benchmarks/proof/rough`): pumps of 5 to 11 pistons and 10 to 250 cm3, known by their type plate. Pressure runs
  through stairs, ramps, triangles or sweeps at 1 Hz for 4,000 to 8,000 s while the oil warms, at one speed or at three.
  Meters lag, have a zero, a dead band, noise that wanders and a last digit; their repeatability is unstated, stated, or
  stated wrong. Flows and torque have scale-free closed forms.

The score z of a rough recording is that of the plant's own model, fitted to its own quasi-steady means. Everything
that a type plate leaves open is uncertain there. An effect that would need an impossible size keeps the score that it
has. Of two or three effects each has the score beside the others. A sensor's fault beside physics may be named too; it
need not be. Meters are as good there as the plant draws them, to 0.3 %: a class B that a recording states is wider,
and a fault of z = 8 may lie within it.

"""
WORDS = {True: "", False: " **missed**", None: ""}
HEADS = {Plant.FIRST: "first plant", Plant.OTHER: "other laws", Plant.ROUGH: "rough"}


def section(outcomes: Sequence[Outcome]) -> str:
    """A row a gate, a column a plant."""
    found = by_plant(outcomes)
    rows = [
        (gates[0].name, gates[0].asked, *(_cell(gate) for gate in gates)) for gates in zip(*found.values(), strict=True)
    ]
    return TEXT + table(("gate", "required", *(HEADS[plant] for plant in found)), rows)


def _cell(gate: Gate) -> str:
    return f"{gate.found}{WORDS[gate.passed]}" if gate.cases else "no case yet"
