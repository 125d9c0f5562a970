"""Fixtures of all tests: a row of the validation page, a mesh refinement, the shared material."""

from __future__ import annotations

import importlib
import importlib.util
import json
import os
import sys

# Read by BLAS as numpy is loaded: its threads cost small solves more than they bring, the more on a busy machine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from measured import Reference
from measured_page import write_measured
from relative import compare_relatively
from validation_rows import Row, row_of, summary_of, write_summary

compare_relatively()
ROOT = Path(__file__).resolve().parents[1]
PAGE_COMMAND = "python -m pytest -m '' --validation-page=docs/validation.md"
SAFETY = 1.25  # Roache 1994: order observed on three meshes
FRONT_SAFETY = 3.0  # Roache 1994: order assumed


@dataclass(frozen=True)
class Refinement:
    """A quantity on meshes that are each `ratio` times finer than the one before, coarsest first."""

    values: tuple[float, ...]
    expected_order: float
    ratio: float = 2.0

    @property
    def finest(self) -> float:
        return self.values[-1]

    @property
    def order(self) -> float | None:
        """Order of convergence observed on the three finest meshes; None where only round-off is left."""
        before, after = np.diff(self.values)[-2:]
        if abs(after) < 1e-10 * max(abs(self.finest), 1e-300):
            return None
        return float(np.log(abs(before / after)) / np.log(self.ratio))

    def tolerance(self, rounding: float = 0.0) -> float:
        """Error the finest mesh may have (grid convergence index, Roache 1994), plus the reference's rounding.

        Asserts first that the value does converge, no slower than half an order below the expected order.
        No exact value enters, so a solver that converges to something else fails.
        """
        if self.order is not None:
            assert self.order > self.expected_order - 0.5, f"order {self.order:.2f} of {self.values}"
        step = abs(self.values[-1] - self.values[-2])
        return SAFETY * step / (self.ratio**self.expected_order - 1.0) + rounding + self._round_off

    def front_tolerance(self, rounding: float = 0.0) -> float:
        """The same for a film with a cavity, whose front moves by whole cells so that the order scatters.

        The step is the larger of the last one and what the one before it promises; the safety is Roache's for
        an order that is not observed.
        """
        factor = self.ratio**self.expected_order
        before, after = np.abs(np.diff(self.values)[-2:])
        step = max(after, before / factor)
        return float(FRONT_SAFETY * step / (factor - 1.0) + rounding + self._round_off)

    @property
    def _round_off(self) -> float:
        return 1e-9 * abs(self.finest)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--validation-page", type=Path, help="write the validation rows of this run to FILE")


def pytest_configure(config: pytest.Config) -> None:
    config.stash[ROWS] = []


ROWS = pytest.StashKey[list[Row]]()


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """A process of pytest-xdist that ends hands its rows over."""
    rows = json.loads(getattr(node, "workeroutput", {}).get("rows", "[]"))
    node.config.stash[ROWS] += [row_of(plain) for plain in rows]


def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    rows = session.config.stash[ROWS]
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["rows"] = json.dumps([asdict(row) for row in rows])
        return
    page = session.config.getoption("validation_page")
    if page is not None and exitstatus == pytest.ExitCode.OK:
        _write_pages(page, sorted(rows, key=lambda row: row.place))


def _write_pages(page: Path, rows: Sequence[Row]) -> None:
    """The validation page, and beside it the rows against measurement: as a page, a picture and JSON."""
    summary = summary_of(rows)
    page.write_text(validation_page(rows), encoding="utf-8")
    write_summary(summary, page.with_name("measured.json"))
    write_measured(summary, page.parent)


@pytest.fixture
def validation(request: pytest.FixtureRequest) -> Callable[..., None]:
    """validation(*, case, source, quantity, unit, expected, obtained, tolerance=None,
    relative_tolerance=None, order=None, note="", missed="", measured=None)

    Records one row of docs/validation.md and asserts |obtained - expected| <= tolerance (in `unit`) or
    <= relative_tolerance |expected|: give exactly one of the two. `case` is a literal string (a test compares
    the literals in the tests with the committed page); what varies goes into `quantity`. `order` is the
    observed order of convergence. `missed="reason"` records an out-of-tolerance result openly instead of
    failing, for a claim that physics contradicts, and fails if the claim is met after all. `measured` is given where
    `expected` was measured: `measured.Measured` with its uncertainties or `measured.Trend`, for docs/measured.md. The
    chapter is the first line of the test module's docstring, the text under its table the module's DISCUSSION.
    """
    chapter = (request.module.__doc__ or "").strip().splitlines()[0].rstrip(".")
    rows = request.config.stash[ROWS]

    def record(
        *,
        case: str,
        source: str,
        quantity: str,
        unit: str,
        expected: float,
        obtained: float,
        tolerance: float | None = None,
        relative_tolerance: float | None = None,
        order: float | None = None,
        note: str = "",
        missed: str = "",
        measured: Reference | None = None,
    ) -> None:
        if (tolerance is None) == (relative_tolerance is None):
            raise ValueError("validation: give either tolerance or relative_tolerance")
        allowed = abs(expected) * relative_tolerance if tolerance is None else tolerance
        row = Row(
            request.session.items.index(request.node),
            chapter,
            case,
            source,
            quantity,
            unit,
            float(expected),
            float(obtained),
            float(allowed),
            None if order is None else float(order),
            note,
            missed,
            getattr(request.module, "DISCUSSION", ""),
            measured,
        )
        rows.append(row)
        met = abs(row.obtained - row.expected) <= row.tolerance
        assert met != bool(missed), (
            f"{case}, {quantity}: obtained {obtained:.9g} {unit}, expected {expected:.9g} +- {allowed:.3g}"
        )

    return record


@pytest.fixture
def refine() -> Callable[..., Refinement]:
    """refine(solve, meshes, order): solve(n) -> value or tuple of values on each mesh size n.

    Gives a Refinement, or a tuple of them, one per value.
    """

    def run(
        solve: Callable[[int], float | tuple[float, ...]], meshes: Sequence[int], order: float = 2.0
    ) -> Refinement | tuple[Refinement, ...]:
        results = [solve(n) for n in meshes]
        ratio = meshes[-1] / meshes[-2]
        if not isinstance(results[0], tuple):
            return Refinement(tuple(results), order, ratio)
        return tuple(Refinement(column, order, ratio) for column in zip(*results, strict=True))

    return run


@pytest.fixture
def energy_balances(validation: Callable[..., None]) -> Callable[..., None]:
    """energy_balances(*, case, checks): two rows, of a floating point's energy, and mass to round-off."""

    def record(*, case: str, checks: Any) -> None:
        errors = {"torque from forces": checks.energy_balance_error, "work on the chambers": checks.work_balance_error}
        for quantity, obtained in errors.items():
            validation(
                case=case,
                source="conservation; what the project asks for",
                quantity=f"energy balance error, {quantity}",
                unit="1",
                expected=0.0,
                obtained=obtained,
                tolerance=1e-3,
            )
        assert checks.mass_balance_error < 1e-9

    return record


@pytest.fixture(scope="module")
def example() -> Iterator[Callable[[str], ModuleType]]:
    """example("cascaded_tanks/overflow.py"): an example as a module, its neighbours on the path meanwhile."""
    path, loaded = sys.path.copy(), set(sys.modules)

    def load(name: str) -> ModuleType:
        file = ROOT / "examples" / name
        sys.path.insert(0, str(file.parent))
        spec = importlib.util.spec_from_file_location(name, file)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
        return module

    yield load
    sys.path[:] = path
    for name, module in tuple(sys.modules.items()):
        if name not in loaded and str(ROOT / "examples") in str(getattr(module, "__file__", "")):
            del sys.modules[name]


class Proof:
    """Modules of benchmarks/proof by their names, loaded as they are asked for."""

    def __getattr__(self, name: str) -> ModuleType:
        return importlib.import_module(f"proof.{name}")


@pytest.fixture(scope="session")
def proof() -> Iterator[Proof]:
    """The proof's modules: proof.gates, proof.judged; benchmarks/ is on the path meanwhile."""
    place = str(ROOT / "benchmarks")
    sys.path.insert(0, place)
    yield Proof()
    sys.path.remove(place)


@pytest.fixture(autouse=True)
def figures_closed() -> Iterator[None]:
    """Closes the figures that a result has drawn for a notebook: matplotlib warns of more than twenty."""
    yield
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None:
        pyplot.close("all")


@pytest.fixture(scope="session")
def shared() -> Path:
    """The project's shared reference material beside the checkout; skips where there is none."""
    folder = ROOT.parent / "shared"
    if not (folder / "physics").is_dir():
        pytest.skip(f"no shared reference material at {folder}")
    return folder


def validation_page(rows: Sequence[Row]) -> str:
    """The page as Markdown: one table per chapter, in the order of the tests."""
    lines = [
        "# Validation",
        "",
        f"Written by `{PAGE_COMMAND}`; do not edit.",
        "Every line is asserted by a test: the result may differ from the expected value by no more than the",
        "tolerance. Of a film under mesh refinement that is the error of the finest mesh estimated from the",
        "refinement alone (grid convergence index, Roache 1994: safety 1.25, and 3 where a cavity's front or a",
        "largest nodal value makes the order scatter), plus the rounding of the reference; `order` is the order",
        "of convergence observed. Rows against measurement stand in [measured parts](measured.md), too, with their",
        "validation uncertainties.",
    ]
    for chapter in dict.fromkeys(row.chapter for row in rows):
        own = [row for row in rows if row.chapter == chapter]
        lines += ["", f"## {chapter}", "", HEADER, RULE, *map(_line, own)]
        lines += [f"\n{text}" for text in dict.fromkeys(row.discussion for row in own) if text]
    missed = [row for row in rows if row.missed]
    if missed:
        lines += ["", "## Missed", ""]
        lines += [f"- {row.case}, {row.quantity}: {row.missed}" for row in missed]
    return "\n".join(lines) + "\n"


HEADER = "| case | quantity | unit | expected | obtained | difference | tolerance | order | source | note |"
RULE = "|---|---|---|---|---|---|---|---|---|---|"


def _line(row: Row) -> str:
    order = "" if row.order is None else f"{row.order:.1f}"
    note = f"{row.note}; MISSED, see below".lstrip("; ") if row.missed else row.note
    cells = [
        row.case, row.quantity, row.unit, f"{row.expected:.7g}", f"{row.obtained:.7g}",
        f"{row.obtained - row.expected:.1e}", f"{row.tolerance:.1e}", order, row.source, note,
    ]  # fmt: skip
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
