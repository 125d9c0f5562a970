"""The examples that have a page, by group: file, command, and the picture that stands for the result."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from itertools import takewhile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DRAWS = "--picture"
"""Option of a script that names the file of its picture."""


@dataclass(frozen=True)
class Example:
    """A file of examples/ and its command, as examples/README.md has it.

    picture: as `picture` of a run folder takes it; of a script its option DRAWS, or a picture in docs/ that it has
    drawn; "" where there is none. needs: what a run takes that a reader may lack, where no run is made for the page.
    left_out: the argument without which the run for the page is made, as it is a table that is not part of this
    repository.
    """

    file: str
    command: str
    picture: str = ""
    needs: str = ""
    left_out: str = ""

    @property
    def name(self) -> str:
        """Name of the page: that of the file, or of the folder of a recording."""
        path = Path(self.file)
        return path.parent.name if path.name == "recording.toml" else path.stem

    @property
    def shown(self) -> str:
        """Address of the picture on the page, empty where there is none."""
        if self.file.endswith(".py") and self.picture != DRAWS:
            return f"../{self.picture}" if self.picture else ""
        return f"{self.name}.png"

    @cached_property
    def opening(self) -> str:
        """The file's own description: its opening comment as one paragraph; docstring, title of a recording."""
        text = (ROOT / self.file).read_text("utf-8")
        if self.file.endswith(".py"):
            return text.split('"""')[1].strip()
        if self.file.endswith("recording.toml"):
            return re.findall(r'^title = "(.*)"', text, re.MULTILINE)[0]
        return " ".join(line[1:].strip() for line in takewhile(lambda line: line.startswith("#"), text.splitlines()))


@dataclass(frozen=True)
class Group:
    """Examples of one kind."""

    title: str
    examples: tuple[Example, ...]


def title(example: Example) -> str:
    """Title of the page: the first sentence of the file, as far as its first colon or bracket."""
    sentence = re.split(r"[:.;](?=\s|$)| \(", example.opening, maxsplit=1)[0]
    return sentence[0].upper() + sentence[1:]


def _optimised(name: str) -> Example:
    case = f"examples/optimisations/{name}.toml"
    return Example(case, f"swashfilm optimise {case}", "plot_pareto")


def _film(name: str, picture: str = "plot_fields") -> Example:
    return Example(f"examples/films/{name}.toml", f"swashfilm film examples/films/{name}.toml", picture)


def _reference(name: str, picture: str = "plot_coefficients") -> Example:
    return Example(f"examples/references/{name}.toml", f"swashfilm reference examples/references/{name}.toml", picture)


def _pump(name: str) -> Example:
    file = f"examples/pumps/{name}.toml"
    return Example(file, f"swashfilm run {file} --fidelity lumped", "plot_powers")


BENCH, RECORDINGS = "examples/recordings/bench_pump.toml", "examples/recordings"
MEASURED = "hst196_production_tests.csv"
UCI = "The data are not part of this repository; the script says where they are. A run takes a minute or two."


def _recorded(name: str, command: str, picture: str) -> Example:
    return Example(f"{RECORDINGS}/{name}/recording.toml", f"swashfilm {command} {RECORDINGS}/{name}", picture)


GROUPS = (
    Group("Films", (
        *(_film(name) for name in (
            "linear_slider", "step_pad", "journal_bearing", "starved_slider", "pressed_oil_pocket", "warm_slider",
            "soft_channel", "bending_plate", "mixed_slider", "oscillating_squeeze", "warming_film", "loaded_pad",
            "rotating_land")),
        _film("stribeck_study", "plot_stribeck"),
        _film("friction_map_study", "plot_number friction_coefficient"),
        Example("examples/films/shape_by_gradient.py", "python examples/films/shape_by_gradient.py", DRAWS),
    )),
    Group("Gaps of a pump", (
        _film("ref90_piston"), _film("ref90_slipper"), _film("ref90_valve_plate"),
        _film("own_slipper", "plot_film"),
        _film("worn_piston", "plot_number carried_load_N"),
        _film("floating_slipper_study", "plot_number film_thickness_min_m"),
    )),
    Group("Pumps", (
        *(_pump(name) for name in ("ref90_worn", "ref90_edges", "cylindrical_block", "hst196")),
        Example("examples/pumps/ref90_design.py", "python examples/pumps/ref90_design.py", DRAWS,
                needs="A run takes 10 to 30 s for each of its rows."),
    )),
    Group("Transients", (
        Example("examples/transients/destroke.toml", "swashfilm transient examples/transients/destroke.toml",
                "plot_plate"),
    )),
    Group("Optimisations", (
        _optimised("port_timing"), _optimised("slipper_land"),
        Example("examples/optimisations/piston_profile.py", "python examples/optimisations/piston_profile.py"),
    )),
    Group("References", (
        _reference("film_step"), _reference("grooves"), _reference("port_slot"),
        _reference("slipper_orifice", "flow_1.png"),
    )),
    Group("Recordings", (
        _recorded("open-06", f"diagnose {BENCH}", "plot_effect"),
        _recorded("open-04", f"diagnose {BENCH}", "plot_effect"),
        _recorded("open-01", f"calibrate {BENCH}", "plot_friction"),
        _recorded("paper_points", "reproduce fig13 --recording", "plot_verdicts"),
    )),
    Group("A transmission and its series", (
        Example("examples/hst196/band.py", f"python examples/hst196/band.py {MEASURED}", DRAWS, left_out=MEASURED),
        Example("examples/hst196/series.py", f"python examples/hst196/series.py {MEASURED} series.png",
                "hst196_series.png", needs="The table of measured units is not part of this repository."),
        Example("examples/hst196/floating.py", f"python examples/hst196/floating.py --rigid {MEASURED}",
                DRAWS, left_out=MEASURED),
    )),
    Group("Other models and rigs", (
        Example("examples/own_simulator/valve.py", "python examples/own_simulator/valve.py", DRAWS),
        Example("examples/cascaded_tanks/overflow.py", "python examples/cascaded_tanks/overflow.py dataBenchmark.csv",
                DRAWS, needs="The benchmark's data are not part of this repository; the script says where they are."),
        Example("examples/uci_hydraulic/rig.py",
                "python examples/uci_hydraulic/rig.py uci_hydraulic recording --leak 1", DRAWS, needs=UCI),
        Example("examples/uci_hydraulic/leak.py", "python examples/uci_hydraulic/leak.py uci_hydraulic", DRAWS,
                needs=UCI),
        Example("examples/uci_hydraulic/cycle.py",
                "python examples/uci_hydraulic/cycle.py uci_hydraulic --valve 73 --leak 1 --accumulator 100", DRAWS,
                needs=UCI),
    )),
)  # fmt: skip
EXAMPLES = tuple(example for group in GROUPS for example in group.examples)
