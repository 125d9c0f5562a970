"""An extension: a law with physical parameters, and its entry in the catalogue of effects."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from system.description.gap import Gap
from system.effects.components import Component
from system.effects.effect import BenchState, EffectId, Effects, GapCourse, Kind
from system.estimation.parameters import Parameter
from system.inputs.channels import ChannelName

Values = Mapping[str, float]  # of the parameters of one extension by name, SI
Law = Callable[[Values, Mapping[Gap, GapCourse], BenchState], Effects]  # values of 0 change nothing, exactly


@dataclass(frozen=True)
class Extension:
    """One law switched on, at one gap or (None) at the pump as a whole.

    Parameters are named as in a pump file, `elastic_opening.slipper.opening`; the law uses the last part. `grid` lists
    the values of parameters that set a scale rather than a size and are tried one after the other: one empty mapping
    without such parameters. `scales` are the continuous ones of them: in a fit of a member they are free about the
    member's values. Values are those of the grid's first member and the parameters'.

    `forms` are other published laws of the same effect. Each has the sizes of this one, and a key of its own in its
    grid, by which a pump file states it. of_films: solved with the films, without a table of a pump file.
    """

    id: EffectId
    pair: Gap | None
    law: Law
    parameters: tuple[Parameter, ...]
    grid: tuple[Values, ...] = ({},)
    scales: tuple[Parameter, ...] = ()
    forms: tuple[Extension, ...] = ()
    of_films: bool = False

    @property
    def members(self) -> tuple[Extension, ...]:
        """One extension for each member of the grid, its own and those of the other forms."""
        own = (replace(self, grid=(one,), scales=self._scales_about(one), forms=()) for one in self.grid)
        return (*own, *(member for form in self.forms for member in form.members))

    def form_of(self, values: Values) -> Extension:
        """The form of which a pump file's table states all keys of the grid; else this one."""
        found = (form for form in self.forms if form.grid[0].keys() <= values.keys())
        return max(found, key=lambda form: len(form.grid[0]), default=self)

    @property
    def free(self) -> tuple[Parameter, ...]:
        """All free parameters in a fit of one member: the sizes and the scales."""
        return (*self.parameters, *self.scales)

    def stated(self, values: Mapping[str, float]) -> dict[str, float]:
        """The law's values by its own keys, as a pump file's table states them, of parameters by name."""
        return {**self.grid[0], **{_key(one): values[one.name] for one in self.free if one.name in values}}

    def stated_beside(self, own: Values, values: Mapping[str, float]) -> dict[str, float]:
        """`stated`, each size added to that of a table `own` whose law acts too, within the size's bounds.

        The sum of two laws at once: exact where their changes add, else to first order in the sizes. Scales and form
        are those of this law; a size of the table that it does not have is left out.
        """
        table = self.stated(values)
        for one in self.parameters:
            if (key := _key(one)) in own:
                table[key] = min(max(own[key] + table.get(key, 0.0), one.lower), one.upper)
        return table

    def _scales_about(self, member: Values) -> tuple[Parameter, ...]:
        return tuple(replace(one, centre=member[_key(one)]) for one in self.scales)


def _key(parameter: Parameter) -> str:
    """The law's own name of a parameter."""
    return parameter.name.rpartition(".")[2]


THEORY = "docs/theory.md, Physics left out, as laws"
"""Source of an entry whose law the documentation derives."""


@dataclass(frozen=True)
class Entry:
    """One id of the catalogue: its places, the channels in which it shows, the ids that resemble it, its text."""

    id: EffectId
    verdict: Kind
    extensions: tuple[Extension, ...]
    components: tuple[Component, ...]
    channels: tuple[ChannelName, ...]
    regime: str
    twins: tuple[EffectId, ...]
    sentence: str
    source: str
