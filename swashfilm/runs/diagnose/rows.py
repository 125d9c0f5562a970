"""Tables and tiles of a diagnosis's page, from the files of its run folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from diagnosis.procedure.compared import WITH, WITHOUT
from diagnosis.procedure.cost import is_material
from diagnosis.procedure.pump_comparison import SHAFT
from diagnosis.report.format import CHANNELS, chance, channel_words, effect_words, listed
from swashfilm.output.answer import Tile
from system.bench.departures import FORM
from system.description.gap import Gap
from system.effects.effect import EffectId
from system.estimation.parameters import Role
from system.inputs.channels import ChannelName
from system.inputs.units import Dimension, in_unit, reading_unit

Row = Mapping[str, str]
HELD_OUT = ("before", "after", "noise")
CHANNEL_HEAD = (
    "difference at points not used in the fit, rms", "without the finding", "with it", "scatter of the meter",
)  # fmt: skip
AGREED_HEAD = ("difference at points not used in the fit, rms", "simulation", "scatter of the meter")
BASE = Role.BASE.value
MOVED, BACK = 3.0, 0.5
"""Pull without the finding above which a stated value counts as moved, and the part of it that may stay."""


def words_of(name: str) -> str:
    """A channel's name in words with the name: "case drain (Q_case)"."""
    return channel_words(ChannelName.named(name))


def measured_words(summary: Mapping[str, Any]) -> str:
    """The channels of a recording in words: "speed, stroke, delivery pressure"."""
    return ", ".join(CHANNELS[ChannelName.named(name)] for name in summary["channels"])


def channel_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """(channel, rms without the finding, with it, scatter) at points not used in the fit; without a claim one rms."""
    keys = HELD_OUT if found["effects"] else ("before", "noise")
    for name, fit in found["fit"]["heldout"].items():
        yield words_of(name), *(f"{fit[key]:.3g} {fit['unit']}" if fit.get(key) is not None else "" for key in keys)


def misfit_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """(channel, chi2 per reading, share of the excess)."""
    for name, misfit in found["mismatch"]["channels"].items():
        yield name, f"{misfit['chi2_per_dof']:.3g}", f"{100 * misfit['share']:.0f} %"


def place_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """(property, value) of the place of the mismatch, or of a local mismatch without a claim."""
    where, steady = found["where"], set(found["where"]["channels"]) - {"p_chamber"}
    if where["channels"]:
        yield "channels", ", ".join(where["channels"])
    if steady:  # a region is of the map, on which traces have no place
        yield "region of the map", where["region"] or "everywhere"
    if where["components"] and steady:
        yield "component", " or ".join(where["components"]).replace("_", " ")
    if where["pair"]:
        yield "pair", where["pair"].replace("_", " ")
    if where["shaft_angle_deg"]:
        yield "shaft angle", " to ".join(f"{angle:.3g}" for angle in where["shaft_angle_deg"]) + " deg"
    if time := where["time"]:
        yield time["kind"], time["channel"] + (f" from point {time['point']} on" if time["point"] else "")


def claim_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """(effect, pair, probability, ids and gaps that cannot be separated from it with their shares, parameters)."""
    for claim in found["effects"]:
        sizes = (
            f"{one['name'].replace('_', ' ')} {_quantity(one['unit'], one['value'], one['sigma'])}"
            for one in claim["parameters"]
        )
        yield (
            claim["id"],
            (claim["pair"] or "").replace("_", " "),
            chance(claim["probability"]),
            ", ".join([*claim["equivalent"], *_other_gaps(claim)]),
            "; ".join(sizes),
        )


def _other_gaps(claim: Mapping[str, Any]) -> Iterator[str]:
    for gap, share in claim["other_pairs"].items():
        yield f"at the {gap.replace('_', ' ')} ({share:.2f})"


PARAMETER_HEAD = ("parameter", "before the fit", "without the finding", "with it", "pull")
AGREED_PARAMETER_HEAD = ("parameter", "before the fit", "fitted", "pull")


def parameter_rows(rows: Sequence[Row], claimed: bool) -> Iterator[tuple[str, ...]]:
    """Cells of PARAMETER_HEAD, the largest pulls first; without a claim of AGREED_PARAMETER_HEAD, of one fit."""
    for row in sorted(rows, key=lambda row: -abs(float(row["pull_after"] or "inf"))):
        unit, pull = row["unit"], f"{float(row['pull_after']):.2f}" if row["pull_after"] else "free"
        stated = _quantity(unit, float(row["prior"]), float(row["prior_sigma"]))
        after = _quantity(unit, float(row["after"]), float(row["sigma"]))
        before = _quantity(unit, float(row["before"])) if row["before"] else "not in the fit"
        was = f"{float(row['pull_before']):.2f}" if row["pull_before"] else "-"
        yield (
            (row["name"], stated, before, after, f"{was} -> {pull}") if claimed else (row["name"], stated, after, pull)
        )


def moved_words(rows: Sequence[Row]) -> str:
    """The value of the pump that the fit moves most without the finding, and hardly with it; empty without."""
    own = [row for row in rows if row["role"] == BASE and not row["name"].startswith(FORM)]
    known = [row for row in own if row["pull_before"] and row["pull_after"]]
    freed = [
        row
        for row in known
        if abs(float(row["pull_before"])) > MOVED
        and abs(float(row["pull_after"])) < BACK * abs(float(row["pull_before"]))
    ]
    if not freed:
        return ""
    row = max(freed, key=lambda row: abs(float(row["pull_before"])))
    unit, name = row["unit"], row["name"].replace("_", " ").replace(".", ", ")
    prior = _quantity(unit, float(row["prior"]), float(row["prior_sigma"]))
    without, with_it = (_quantity(unit, float(f"{float(row[key]):.3g}")) for key in ("before", "after"))
    return f"Without the finding the fit moves {name} from {prior} to {without}; with it, to {with_it}."


def hidden_head(rows: Sequence[Row]) -> tuple[str, ...]:
    """Columns of `hidden_rows`: effect, size, and the channels in words."""
    return ("effect", "no larger than", *(CHANNELS[name] for name in _channels(rows)))


def hidden_rows(rows: Sequence[Row]) -> Iterator[tuple[str, ...]]:
    """(effect at its place, largest size, change of each channel by it alone) of the effects that are limited."""
    limited = [row for row in rows if row["limited"] == "yes"]
    for place in dict.fromkeys((row["effect"], row["pair"]) for row in limited):
        own = {row["channel"]: row for row in limited if (row["effect"], row["pair"]) == place}
        shown = (f"{_signed(float(row['change']))} {row['change_unit']}" for row in own.values())
        yield _hidden_words(*place), next(iter(own.values()))["size"], *shown


def unlimited_words(rows: Sequence[Row]) -> str:
    """The effects that the recording does not limit, as a list; empty without any."""
    places = dict.fromkeys((row["effect"], row["pair"]) for row in rows if row["limited"] == "no")
    return listed(_hidden_words(*place) for place in places)


def _channels(rows: Sequence[Row]) -> Iterator[ChannelName]:
    yield from dict.fromkeys(ChannelName.named(row["channel"]) for row in rows)


def _hidden_words(effect: str, pair: str) -> str:
    return effect_words([EffectId(effect)], Gap(pair) if pair else None)


def _signed(value: float) -> str:
    return f"{value:+.2g}" if value else "0"


def change_rows(rows: Sequence[Mapping[str, str]]) -> Iterator[tuple[str, ...]]:
    """(quantity, without, with, change, share of the shaft power of both) of a point run without and with it.

    The change of a quantity that reads the same in both is 0.
    """
    shaft = shaft_power(rows)
    for row in rows:
        both = [f"{_plain(float(row[key]), 4)} {row['unit']}" for key in (WITHOUT, WITH)]
        change = 0.0 if both[0] == both[1] else float(row["change"])
        moved = f"{_plain(change, 3)} {'points' if row['unit'] == '%' else row['unit']}"
        shares = (f"{100.0 * float(row[key]) / whole:.2f} %" for key, whole in shaft.items() if row["unit"] == "W")
        yield row["quantity"], *both, moved, " -> ".join(shares)


FILM_HEADS = {"lumped": "closed-form laws", "films": "films"}
"""Source of a gap's quantities, by the first part of their columns."""


def film_kinds(rows: Sequence[Mapping[str, str]]) -> list[str]:
    """Sources of the quantities in films.csv; floating films have no closed-form laws beside them."""
    return [kind for kind in FILM_HEADS if rows and f"{kind}_{WITHOUT}" in rows[0]]


def film_rows(rows: Sequence[Mapping[str, str]]) -> Iterator[tuple[str, ...]]:
    """(quantity, by closed-form laws where films.csv has them, by films): without -> with the finding, the factor."""
    for row in rows:
        films = []
        for kind in film_kinds(rows):
            one, other = (float(row[f"{kind}_{name}"]) for name in (WITHOUT, WITH))
            times = f" (x {other / one:.3g})" if one else ""
            films.append(f"{_plain(one, 4)} -> {_plain(other, 4)} {row['unit']}{times}")
        yield row["quantity"], *films


def shaft_power(rows: Sequence[Mapping[str, str]]) -> dict[str, float]:
    """Shaft power in W without and with the finding; empty without runs."""
    return {key: float(row[key]) for row in rows if row["quantity"] == SHAFT for key in (WITHOUT, WITH)}


def _quantity(unit: str, value: float, sigma: float | None = None) -> str:
    """A value in SI, with its sigma, in its reading unit; temperatures are differences."""
    dimension = next((one for one in Dimension if one.si_unit == unit), None)
    if dimension is not None and dimension is not Dimension.TEMPERATURE:
        unit = reading_unit(value or sigma or 0.0, dimension)
        value, sigma = in_unit(value, unit, dimension), sigma and in_unit(sigma, unit, dimension)
    shown = _plain(value, 4) if sigma is None else f"{_plain(value, 4)} +- {_plain(sigma, 2)}"
    return shown if unit == "1" else f"{shown} {unit}"


def _plain(value: float, digits: int) -> str:
    """A number of `digits` significant digits, or all digits before the decimal point where these are more."""
    return f"{value:.{digits}g}" if abs(value) < 10.0**digits else f"{value:.0f}"


COST_TILES = ("efficiency, overall (ISO 4409)", "delivery flow", "shaft torque", "case drain")
MOST_SIZES, MOST_FIRST = 2, 3
SIZE_TAILS = (" per 100 bar", " too high", " too low", " more", " less", " times")
"""Words behind a size, which a tile has in its note."""


def tiles(found: Mapping[str, Any], summary: Mapping[str, Any], changes: Sequence[Row]) -> tuple[Tile, ...]:
    """Size of the finding, its cost, its certainty, and the deviations of points not used in the fit."""
    sizes = tuple(_size_tiles(found))
    costs = _cost_tiles(changes, MOST_FIRST - len(sizes))
    return (*sizes, *costs, _sure_tile(found), *_fit_tiles(found), *_point_tiles(found, summary))


def _size_tiles(found: Mapping[str, Any]) -> Iterator[Tile]:
    """Sizes of the first claims that have one."""
    known = [pair for pair in zip(found["effects"], found["answer"]["sizes"], strict=True) if pair[1]]
    for claim, size in known[:MOST_SIZES]:
        value, _, sigma = size.partition(" +- ")
        scatter, _, rest = sigma.partition(" ")
        tail = next((words for words in SIZE_TAILS if rest.endswith(words)), "")
        unit, name = rest.removesuffix(tail).strip(), effect_words([EffectId(claim["id"])])
        yield Tile(f"{value} {unit}".rstrip(), name, f"+- {scatter}{tail}, one sigma" if sigma else "")


def _cost_tiles(changes: Sequence[Row], most: int) -> Iterator[Tile]:
    """The change of efficiency, then the largest relative change."""
    known = [row for row in changes if row["quantity"] in COST_TILES and _is_material(row)]
    ranked = sorted(
        known, key=lambda row: (row["unit"] != "%", -abs(float(row["change"]) / (float(row[WITHOUT]) or 1.0)))
    )
    for row in ranked[:most]:
        unit = "points" if row["unit"] == "%" else row["unit"]
        name = row["quantity"].partition(", overall")[0]
        yield Tile(f"{float(row['change']):+.2g} {unit}", name, "with the finding, where it shows most")


def _is_material(row: Row) -> bool:
    return is_material(row["unit"], float(row[WITHOUT]), float(row[WITH]))


def _sure_tile(found: Mapping[str, Any]) -> Tile:
    told = found["answer"]
    outside = {EffectId.UNKNOWN_PHYSICS.value}
    alike = any(set(claim["equivalent"]) - outside or claim["other_pairs"] for claim in found["effects"])
    which = "it is one of these" if len(found["effects"]) == 1 else "these, or the like, are the causes"
    name = f"that {which}" if alike else "that there is a cause" if found["status"] == "suspicion" else "certainty"
    return Tile(told["sure"], name, f"in trials {told['record']}" if told["record"] else "")


def _fit_tiles(found: Mapping[str, Any]) -> Iterator[Tile]:
    """Of the channel with the largest effect of the finding; without a claim of the one with the largest deviation."""
    met = {name: one for name, one in found["fit"]["heldout"].items() if all(one[key] for key in HELD_OUT)}
    if not met:
        return
    named = [name for name in found["where"]["channels"] if name in met]
    worst = max(met, key=lambda name: met[name]["before"] / met[name]["noise"])
    name = named[0] if named else worst
    one = met[name]
    value, was, left = one["before"], "", "difference"
    if found["effects"]:
        value, was, left = one["after"], f"before {one['before']:.2g}; ", "difference left"
    note = f"{was}scatter of the meter {one['noise']:.2g}"
    yield Tile(f"{value:.2g} {one['unit']}", f"{left}, {words_of(name)}", note)


def _point_tiles(found: Mapping[str, Any], summary: Mapping[str, Any]) -> Iterator[Tile]:
    if not found["effects"]:
        compared = ", ".join(CHANNELS[ChannelName.named(name)] for name in found["fit"]["heldout"])
        yield Tile(str(summary["points"]), "points compared", compared)
