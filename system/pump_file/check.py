"""Named checks of a pump description: impossible and doubtful values, each with number, limit and remedy.

One check is one function. It states the values that it needs, so that it runs on every description in which these could
be read, with any other faults. They are in `system.pump_file.geometry`, `system.pump_file.films` and
`system.pump_file.operating`.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

from system.description.pump import PumpDescription
from system.inputs.faults import Fault
from system.inputs.units import Dimension, format_quantity


@dataclass(frozen=True)
class CheckWarning:
    """A possible but doubtful value: its path, the number, the limit, and the remedy."""

    path: str
    value: str
    limit: str
    remedy: str

    @property
    def text(self) -> str:
        """The warning without its path."""
        return f"{self.value}, limit {self.limit}; {self.remedy}"

    def __str__(self) -> str:
        return f"{self.path}: {self.text}"


Finding = Fault | CheckWarning


@dataclass(frozen=True)
class CheckReport:
    """Findings of the checks: faults prevent a run, warnings do not."""

    faults: tuple[Fault, ...]
    warnings: tuple[CheckWarning, ...]


@dataclass(frozen=True)
class Check:
    """A named check: the paths of the values it needs, and the function that yields its findings."""

    name: str
    needs: frozenset[str]
    findings: Callable[[PumpDescription], Iterator[Finding]]


def needs(*paths: str) -> Callable[[Callable[[PumpDescription], Iterator[Finding]]], Check]:
    """Make a check of a function, given the paths (`section.key`) of the values it reads."""

    def named(function: Callable[[PumpDescription], Iterator[Finding]]) -> Check:
        return Check(function.__name__, frozenset(paths), function)

    return named


def checks_in(module: Mapping[str, object]) -> tuple[Check, ...]:
    """Return the checks among the names of a module, in the order of their definition."""
    return tuple(one for one in module.values() if isinstance(one, Check))


def run_checks(checks: Iterable[Check], pump: PumpDescription, trusted: Collection[str] | None = None) -> CheckReport:
    """Run the checks of a pump and sort their findings.

    With `trusted`, only the checks with all values among these paths are run: the description may then lack the others.
    """
    found = [
        finding
        for check in checks
        if trusted is None or check.needs <= set(trusted)
        for finding in check.findings(pump)
    ]
    return CheckReport(
        faults=tuple(item for item in found if isinstance(item, Fault)),
        warnings=tuple(item for item in found if isinstance(item, CheckWarning)),
    )


def length(value: float) -> str:
    """Return a length as people read it, to four digits."""
    return format_quantity(value, Dimension.LENGTH, digits=4)


def angle(value: float) -> str:
    """Return an angle as people read it, to four digits."""
    return format_quantity(value, Dimension.ANGLE, digits=4)


def pressure(value: float) -> str:
    """Return a gauge pressure as people read it, to four digits."""
    return format_quantity(value, Dimension.PRESSURE, digits=4)
