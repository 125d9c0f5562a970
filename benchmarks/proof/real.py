"""Real recordings whose truth is known, by the engine of the pump's diagnosis with a model of each rig's own; and
the film simulation as plant. Sections of the page, each with its name."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from .film_plant import cases
from .film_trial import HEAD, diagnosed
from .told import Told, told

ROOT = Path(__file__).resolve().parents[2]
RECORDINGS = ROOT.parent / "shared" / "recordings"
RIG_TEXT = """Cycles of the ZeMA rig (UCI 447; Helwig et al. 2015) whose pump leakage is switched on, held
against those without: the leak is not told. In truth a bypass orifice of 0.20 mm (1) or 0.25 mm (2). Sizes
with a flow coefficient of 0.61; exponents of a leak ~ p^k nu^m with both free. A sigma of 0.5 of k is that
of its prior: 152 to 158 bar do not decide it (`examples/uci_hydraulic/leak.py`)."""
TANKS_TEXT = """Two tanks (Schoukens et al. 2016), Torricelli's law as the model; in truth both overflow.
Errors by simulating the whole record (`examples/cascaded_tanks/overflow.py`)."""
FILMS_TEXT = """The plant is the films fidelity (`system.points.films`), with one or two pieces of film physics
more each; the diagnosis has the lumped simulation. Rigid: nothing is left out (`benchmarks/proof_films.py`)."""


def sections() -> Mapping[str, Callable[[], Told]]:
    """What makes each section, by its name, as far as its data are beside the checkout."""
    found: dict[str, Callable[[], Told]] = {"films": films}
    if (RECORDINGS / "uci_hydraulic").is_dir():
        found["rig"] = rig
    if (RECORDINGS / "cascaded_tanks").is_dir():
        found["tanks"] = tanks
    return found


TITLES = {
    "rig": "A real rig, its leak concealed", "tanks": "A real record of two tanks",
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
                str(switched), first.name, f"{first.evidence:.0f}",
                f"{second.name}, {first.evidence - second.evidence:.1f} behind", bore,
                *(f"{value:.2f} +- {sigma:.2f}" for value, sigma in exponents),
            ))  # fmt: skip
    head = ("leak", "named", "nats over no change", "next", "bore", "power of viscosity", "power of pressure")
    return told(TITLES["rig"], RIG_TEXT, head, tuple(rows))


def tanks() -> Told:
    """Cascaded tanks: what one addition brings."""
    with _example("cascaded_tanks", "overflow") as overflow:
        record = overflow.read_record(RECORDINGS / "cascaded_tanks" / "dataBenchmark.csv")
        base = overflow.base_fit(record)
        found = overflow.additions(record, base, tuple(overflow.EXTENSIONS))
        own, test = overflow.errors(record, base)
    rows = [("nothing", "0", f"{own:.3f} V", f"{test:.3f} V")]
    rows += [(one.name, f"{one.evidence:.1f}", f"{one.error:.3f} V", f"{one.test_error:.3f} V") for one in found]
    return told(TITLES["tanks"], TANKS_TEXT, ("added", "nats over nothing", "RMS error", "test record"), tuple(rows))


def films() -> Told:
    """The film simulation as plant."""
    return told(TITLES["films"], FILMS_TEXT, HEAD, tuple(diagnosed(plant) for plant in cases()))


def _names(fit: object) -> list[str]:
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
