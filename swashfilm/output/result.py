"""Result of a run: numbers by attribute, tables, a data set, and its run folder."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from html import escape
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self

from swashfilm.output.data.files import RESULTS, read_netcdf
from swashfilm.output.figures import pyplot_figures
from swashfilm.output.headline import named
from swashfilm.output.page import read_summary
from swashfilm.output.run_folder import final_folder, run_folder
from swashfilm.output.tables import Table, aligned, parted
from system.inputs.shown import known_unit

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SUMMARY = "summary.json"


class Numbers(Mapping[str, Any]):
    """A summary by key and by attribute: `flow.delivery` is `flow["delivery_m3_per_s"]`, in SI."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values
        self._keys = {_attribute(key): key for key in values}

    def __getitem__(self, key: str) -> Any:
        value = self._values[key]
        return Numbers(value) if isinstance(value, Mapping) else value

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __getattr__(self, name: str) -> Any:
        keys = self.__dict__.get("_keys", {})
        if name not in keys:
            raise AttributeError(f"no number {name!r}; there are {', '.join(keys)}")
        return self[keys[name]]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._keys]

    def __repr__(self) -> str:
        return "\n".join(f"{_attribute(key)}: {_shown(key, value)}" for key, value in self._values.items())


def _attribute(key: str) -> str:
    return named(key)[0].replace(" ", "_").replace(",", "")


def _shown(key: str, value: Any) -> str:
    if isinstance(value, Mapping):
        return "{" + ", ".join(_attribute(str(part)) for part in value) + "}"
    return f"{value:.6g} {named(key)[1]}".strip() if isinstance(value, float) else str(value)


class Result:
    """A finished run.

    summary: the content of summary.json. write: writes the run's files into an empty folder and returns the
    warnings that writing adds. data: the run's data set. Any other attribute is a number of the summary, in SI.
    """

    kinds: ClassVar[tuple[str, ...]] = ()
    files: ClassVar[tuple[str, ...]] = (SUMMARY,)

    def __init__(
        self, summary: Mapping[str, Any], write: Callable[[Path], Sequence[str]], data: Callable[[], xarray.Dataset]
    ) -> None:
        self.summary = summary
        self.write = write
        self._data = data

    @classmethod
    def opened(cls, folder: Path) -> Self:
        """Return the result of a finished run folder; raise InputFaults where one of its files is missing."""
        summary = read_summary(folder, cls.files)

        def write(place: Path) -> tuple[str, ...]:
            shutil.copytree(folder, place, dirs_exist_ok=True)
            return ()

        return cls(summary, write, lambda: cls.read_data(folder))

    @classmethod
    def ran(cls, run: Callable[[Path], object]) -> Self:
        """Return the result of a run that writes its files while it computes, into a temporary folder."""
        place = tempfile.TemporaryDirectory(prefix="swashfilm-")
        run(Path(place.name))
        found = cls.opened(Path(place.name))
        found._place = place
        return found

    _place: tempfile.TemporaryDirectory[str] | None = None

    @staticmethod
    def read_data(folder: Path) -> xarray.Dataset:
        """Return the data set of a run folder."""
        return read_netcdf(folder / RESULTS)

    @cached_property
    def numbers(self) -> Numbers:
        """The summary by attribute."""
        return Numbers(self.summary)

    @property
    def name(self) -> str:
        """Name of the pump or case."""
        return str(self.summary["name"])

    @property
    def warnings(self) -> list[str]:
        """Warnings of the run, `name: text` each."""
        return [
            one if isinstance(one, str) else f"{one['name']}: {one['text']}" for one in self.summary.get("warnings", [])
        ]

    def tables(self) -> list[Table]:
        """Return tables of the run's numbers as the command prints them."""
        raise NotImplementedError

    def to_xarray(self) -> xarray.Dataset:
        """Return the run's fields and series; units in the attributes."""
        return self._data()

    def to_pandas(self) -> pandas.DataFrame:
        """Return the run's series or rows, a column each, SI units in brackets."""
        return framed(self.to_xarray())

    def save(self, folder: str | Path | None = None, *, excel: bool = False) -> Path:
        """Write the run folder of the command and return its path; a new one under runs/ by default.

        excel: also write its tables as a workbook.

        Raises InputFaults for a folder that holds files.
        """
        with run_folder(self.name, None if folder is None else Path(folder), workbook=excel) as place:
            self.write(place)
        return final_folder(place)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or "summary" not in self.__dict__:
            raise AttributeError(name)
        return getattr(self.numbers, name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in dir(self.numbers) if not name.startswith("_"))]

    def __repr__(self) -> str:
        lines = [line for title, rows in self.tables() for line in (title, *aligned(rows))]
        return "\n".join([*lines, *(f"warning: {one}" for one in self.warnings)])

    def _repr_html_(self) -> str:
        tables = "".join(_html(title, rows) for title, rows in self.tables())
        notes = "".join(f"<p>warning: {escape(one)}</p>" for one in self.warnings)
        return tables + notes


def plotted(draw: Callable[[], Figure | None]) -> list[Axes]:
    """Return the axes of a pyplot figure, which a notebook shows; none without anything to draw."""
    with pyplot_figures():
        figure = draw()
    return [] if figure is None else list(figure.axes)


def read_table(path: Path) -> xarray.Dataset:
    """Return a CSV file with heads `name [unit]` as variables over `row`, in SI; units in the attributes.

    Lines that begin with # are remarks.
    """
    import pandas

    rows = [line for line in path.read_text("utf-8").splitlines(keepends=True) if not line.startswith("#")]
    frame = pandas.read_csv(StringIO("".join(rows)), skipinitialspace=True).rename_axis("row")
    heads = [parted(title) for title in frame.columns]
    frame.columns = [name for name, _ in heads]
    data = frame.to_xarray()
    for name, unit in heads:
        if unit:
            shown = known_unit(unit)
            data[name] = ("row", shown.to_si(data[name].values), {"units": shown.si})
    return data


def framed(data: xarray.Dataset) -> pandas.DataFrame:
    """Return variables over the first dimension as columns, its coordinate as index; the unit in each head."""
    first = str(next(iter(data.sizes)))
    series = data.drop_dims([dim for dim in data.sizes if dim != first])
    frame = series.to_dataframe()
    units = {name: variable.attrs.get("units", "1") for name, variable in series.variables.items()}
    frame.columns = [f"{name} [{units[name]}]" for name in frame.columns]
    return frame.rename_axis(f"{first} [{units.get(first, '1')}]")


def _html(title: str, rows: Sequence[Sequence[str]]) -> str:
    cells = "".join(
        "<tr>" + "".join(f"<td style='text-align:left'>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><caption>{escape(title)}</caption>{cells}</table>"
