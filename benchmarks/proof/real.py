"""Sections of the page beside its cases, each with its name: the ceiling of names; real recordings whose truth is
known, by the engine of the pump's diagnosis with a model of each rig's own; the film simulation as plant."""

from __future__ import annotations

import importlib.util
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from types import ModuleType

import numpy as np

from system.estimation.fit import Posterior

from .ceiling import TITLE as CEILING, ceiling
from .film_plant import cases
from .film_trial import HEAD, diagnosed
from .told import Told, told

ROOT = Path(__file__).resolve().parents[2]
RECORDINGS = ROOT.parent / "shared" / "recordings"
RIG_TEXT = """Cycles of the ZeMA rig (UCI 447; Helwig et al. 2015) whose pump leakage is switched on, held
against those without: the leak is not told. In truth a bypass orifice of 0.20 mm (1) or 0.25 mm (2). Sizes
with a flow coefficient of 0.61; exponents of a leak ~ p^k nu^m with both free. A sigma of 0.5 of k is that
of its prior: 152 to 158 bar do not decide it (`examples/uci_hydraulic/leak.py`)."""
CYCLES_TEXT = """Mean cycles of the ZeMA rig in all its states of cooler (100 and 20 %), valve, pump leak and
accumulator, by their difference from the sound rig's. Settings are concealed. Thirteen causes may be found, four of
them true ones. Half of the cycles of a state is fitted, the other half held out. Errors are in sigma, which has a tenth
of the difference in it (`examples/uci_hydraulic/cycle.py`)."""
HST_TEXT = """A hydrostatic transmission of which one operating point is measured, beside the simulation from its
drawing. One point locates nothing: no cause is named (`examples/hst196/band.py`)."""
TANKS_TEXT = """Two tanks (Schoukens et al. 2016), Torricelli's law as the model; in truth both overflow. One record
decides, the other is held out. Errors by simulating whole records (`examples/cascaded_tanks/overflow.py`). In the last
row's residual no possible addition gains three nats."""
FILMS_TEXT = """The plant is the fidelity fixed (`system.points.films`), with one or two pieces of film physics
more each; the diagnosis has the lumped simulation. Rigid: nothing is left out (`benchmarks/proof_films.py`)."""


def sections() -> Mapping[str, Callable[[], Told]]:
    """Writers of the sections by name, as far as their data are beside the checkout."""
    of_data = {
        "uci_hydraulic": {"rig": rig, "cycles": cycles},
        "cascaded_tanks": {"tanks": tanks},
        "hst196": {"hst": hst},
    }
    found: dict[str, Callable[[], Told]] = {"ceiling": ceiling, "films": films}
    for folder, makers in of_data.items():
        if (RECORDINGS / folder).is_dir():
            found |= makers
    return found


GAS = (130, 115, 100, 90)  # bar of the accumulator
CAUSES = {
    "cooler": "cooler removes less heat", "valve": "valve opens later", "leak": "leak through an orifice",
    "accumulator": "accumulator with less gas",
}  # fmt: skip
TITLES = {
    "ceiling": CEILING,
    "rig": "A real rig, its leak concealed", "cycles": "A real rig, up to four causes concealed",
    "hst": "A real transmission", "tanks": "A real record of two tanks",
    "films": "Fidelity: the film simulation as plant",
}  # fmt: skip


def rig() -> Told:
    """The ZeMA rig, leaks 1 and 2."""
    rows = []
    with _example("uci_hydraulic", "leak") as leak:
        data = RECORDINGS / "uci_hydraulic"
        for switched in (1, 2):
            first, second, *_ = leak.explanations(data, switched)
            law = leak.free_law(data, switched)
            exponents = (law.size(f"{name}_exponent") for name in ("viscosity", "pressure"))
            bore = f"{1e3 * leak.diameter(first.size('area')[0]):.3f} mm" if "area" in _names(first.fit) else "-"
            rows.append((
                str(switched), first.name, f"{first.gain:.0f}",
                f"{second.name}, {first.gain - second.gain:.1f} behind", bore,
                *(f"{value:.2f} +- {sigma:.2f}" for value, sigma in exponents),
            ))  # fmt: skip
    head = ("leak", "named", "nats over no change", "next", "bore", "power of viscosity", "power of pressure")
    return told(TITLES["rig"], RIG_TEXT, head, tuple(rows))


def cycles() -> Told:
    """The ZeMA rig in every state: findings by the number of its causes."""
    rows = []
    with _example("uci_hydraulic", "cycle") as cycle:
        data = cycle.recorded(RECORDINGS / "uci_hydraulic")
        found = [_state(cycle, data, settings) for settings in product((100, 20), (100, 90, 80, 73), (0, 1, 2), GAS)]
    known = [one for one in found if one is not None]
    for is_warm, causes in sorted({("cooler" in one.settings, len(one.causes)) for one in known}):
        own = [one for one in known if ("cooler" in one.settings, len(one.causes)) == (is_warm, causes)]
        named = [cause in one.names for one in own for cause in one.causes]
        beside = Counter(name for one in own for name in one.names - one.causes)
        rows.append((
            "20 %" if is_warm else "100 %", str(causes), str(len(own)),
            str(sum(one.names == one.causes for one in own)),
            f"{sum(named)} of {len(named)}", ", ".join(f"{name} {n}" for name, n in beside.most_common()) or "none",
            *(f"{float(np.median([getattr(one, when) for one in own])):.2f}" for when in ("before", "after")),
        ))  # fmt: skip
    head = ("cooler", "causes", "states", "exactly these", "causes found", "names beside", "held out before", "after")
    return told(TITLES["cycles"], CYCLES_TEXT, head, tuple(rows))


@dataclass(frozen=True)
class _Found:
    """The settings of a state that are not the sound rig's, its causes, its names, and the errors held out."""

    settings: frozenset[str]
    causes: frozenset[str]
    names: frozenset[str]
    before: float
    after: float


def _state(cycle: ModuleType, data: object, settings: tuple[int, ...]) -> _Found | None:
    """Finding in a state; None where too few of its cycles work."""
    state = cycle.State(*settings)
    try:
        ladder, (before, after) = cycle.explained(data, state)
    except cycle.TooFew:
        return None
    changed = frozenset(name for name in CAUSES if getattr(state, name) != getattr(cycle.SOUND, name))
    causes = frozenset(CAUSES[name] for name in changed)
    return _Found(changed, causes, frozenset(ladder.kept), before, after)


def hst() -> Told:
    """HST 196: volumetric efficiency of the simulation beside that of the units."""
    with _example("hst196", "band") as band:
        _, drawn = band.sample(band.SAMPLES)
        low, high = np.quantile(drawn, (0.05, 0.95))
        hot = band.efficiency(band.middle(band.UNKNOWNS) | {"film heating": band.HOT})
        units = band.measured(RECORDINGS / "hst196" / "hst196_production_tests.csv")
    rows = (
        ("simulation, 90 % of all unknown values", f"{low:.1%} to {high:.1%}"),
        (f"simulation, films {band.HOT:.0f} K hotter than the oil", f"{hot:.1%}"),
        (f"{units.size} units", f"{units.mean():.1%} +- {units.std(ddof=1):.1%}"),
    )
    return told(TITLES["hst"], HST_TEXT, ("", "volumetric efficiency"), rows)


def tanks() -> Told:
    """Cascaded tanks: gain of one addition after the other."""
    with _example("cascaded_tanks", "overflow") as overflow:
        record = overflow.read_record(RECORDINGS / "cascaded_tanks" / "dataBenchmark.csv")
        steps = overflow.steps(record, overflow.found(record))
    rows = ((one.name, f"{one.gain:.1f}", f"{one.error:.3f} V", f"{one.test_error:.3f} V", one.note) for one in steps)
    return told(TITLES["tanks"], TANKS_TEXT, ("added", "nats", "RMS error", "held out", ""), tuple(rows))


def films() -> Told:
    """The film simulation as plant."""
    return told(TITLES["films"], FILMS_TEXT, HEAD, tuple(diagnosed(plant) for plant in cases()))


def _names(fit: Posterior) -> list[str]:
    return [parameter.name for parameter in fit.parameters]


@contextmanager
def _example(folder: str, name: str) -> Iterator[ModuleType]:
    """An example as a module, its neighbours on the path."""
    place = ROOT / "examples" / folder
    spec = importlib.util.spec_from_file_location(f"{folder}_{name}", place / f"{name}.py")
    if spec is None or spec.loader is None:
        raise ImportError(f"no example {folder}/{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(place))
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
        yield module
    finally:
        sys.path.remove(str(place))
        del sys.modules[spec.name]
