"""Time table of a film case: duration, time step, and number of written films."""

from __future__ import annotations

from dataclasses import dataclass

from swashfilm.case.fields.expressions import ExpressionError, parse_expression
from swashfilm.case.fields.field import Field, Formula
from swashfilm.case.fields.reader import FieldReader
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, format_quantity

MOST_STEPS = 1_000_000
USUAL_OUTPUTS = 50


@dataclass(frozen=True)
class TimeStatement:
    """End and step of a transient (s), and number of written films, equally spaced in time."""

    end: float
    step: float
    outputs: int

    @property
    def steps(self) -> int:
        """Number of steps; the last one ends at `end`."""
        return max(1, round(self.end / self.step))

    @property
    def step_taken(self) -> float:
        """The step that divides the duration evenly, s."""
        return self.end / self.steps

    def number(self, time: float) -> int:
        """Return number of whole steps up to a time (s)."""
        return int(time / self.step_taken + 1e-6)

    def is_output(self, time: float, step: float) -> bool:
        """Return True where the film of the step that ends at `time` (s) is written; the last one always is."""
        every = self.end / self.outputs
        return int(time / every + 1e-6) > int((time - step) / every + 1e-6)


def read_time(top: Table) -> TimeStatement | None:
    """Return the [time] table; None where there is none, or with its faults listed."""
    table = top.table("time")
    if table is None:
        return None
    end, step = (table.positive(key, Dimension.TIME) for key in ("end", "step"))
    outputs = table.get("outputs")
    wanted = USUAL_OUTPUTS if outputs is None else outputs
    if type(wanted) is not int or wanted < 1:
        table.fault("outputs", repr(outputs), "the number of written films, a whole number from 1 on")
        wanted = None
    table.close()
    if end is None or step is None or wanted is None:
        return None
    if step > end or end > step * MOST_STEPS:
        table.fault("step", str(table.values["step"]), f"at most the end, in at most {MOST_STEPS} steps")
        return None
    read = TimeStatement(end, step, wanted)
    return TimeStatement(end, step, min(wanted, read.steps))


def time_rows(stated: TimeStatement) -> list[str]:
    """Return the table as text of a case file."""
    end, step = (format_quantity(value, Dimension.TIME) for value in (stated.end, stated.step))
    return ["[time]", f'end = "{end}"', f'step = "{step}"', f"outputs = {stated.outputs}"]


def initial_film_fraction(top: Table, film: Table, reader: FieldReader) -> Field | None:
    """Return the film fraction at the start, by default 1; None with its fault listed."""
    if film.get("initial_film_fraction") is not None and top.get("time") is None:
        film.fault("initial_film_fraction", "a start without a table [time]", "a steady film without this key")
    if film.get("squeeze") is not None and top.get("time") is not None:
        film.fault("squeeze", "dh/dt beside a table [time]", "a transient without this key: dh/dt follows from t")
    raw = film.get("initial_film_fraction")
    expected = "a number above 0 and at most 1, or a formula of x and y (text in quotes)"
    try:
        field = Formula(parse_expression("1.0" if raw is None else str(raw), constants=reader.constants))
    except ExpressionError as reason:
        film.fault("initial_film_fraction", reason.found, expected, reason.nearest)
        return None
    if reader.space is not None:
        values = field.sample(reader.space)
        if not (values.min() > 0.0 and values.max() <= 1.0):
            film.fault("initial_film_fraction", f"{values.min():.4g} to {values.max():.4g}", expected)
            return None
    return field
