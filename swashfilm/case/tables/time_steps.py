"""Time table of a film case: duration, time step, and number of written films."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from reynolds.errors import InputError
from reynolds.solve.transient import equal_steps
from system.inputs.sections.fields import Limits, Positive
from system.inputs.sections.reader import table_section
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity

MOST_STEPS = 1_000_000
Duration = Annotated[float, Dimension.TIME, Positive]


@dataclass(frozen=True, kw_only=True)
class TimeStepsSection:
    """[time]: end and step of a transient."""

    end: Duration
    step: Duration
    outputs: Annotated[int, Limits(least=1)] = 50  # written films, equally spaced in time

    def __post_init__(self) -> None:
        if self.step > self.end or self.end > self.step * MOST_STEPS:
            found = format_quantity(self.step, Dimension.TIME, digits=4)
            raise InputError("step", found, f"at most the end, in at most {MOST_STEPS} steps")

    @property
    def steps(self) -> int:
        """Number of steps, none longer than stated; the last one ends at `end`."""
        return equal_steps(self.end, self.step)

    @property
    def step_taken(self) -> float:
        """The step that divides the duration evenly, s."""
        return self.end / self.steps

    @property
    def halved(self) -> TimeStepsSection:
        """The same times in twice the number of steps; raises InputError beyond the largest number."""
        return replace(self, step=0.5 * self.step_taken)

    @property
    def output_times(self) -> list[float]:
        """Times (s) of the start and of the written films."""
        return [self.end * number / self.outputs for number in range(self.outputs + 1)]

    def number(self, time: float) -> int:
        """Return number of whole steps up to a time (s)."""
        return int(time / self.step_taken + 1e-6)

    def is_output(self, time: float, step: float) -> bool:
        """Return True where the film of the step that ends at `time` (s) is written; the last one always is."""
        every = self.end / self.outputs
        return int(time / every + 1e-6) > int((time - step) / every + 1e-6)


def read_time(top: Table) -> TimeStepsSection | None:
    """Return the [time] table; None if it is absent, or with its faults listed."""
    stated = table_section(top, "time", TimeStepsSection)
    return replace(stated, outputs=min(stated.outputs, stated.steps)) if stated else None
