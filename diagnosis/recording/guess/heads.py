"""Heads of columns, English, German, French and Chinese: the quantity, its place on the pump, its unit."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum

from diagnosis.recording.channel_form import PressureReference
from diagnosis.recording.guess.unit_text import ReadUnit, read_unit
from system.inputs.units import Dimension


class Quantity(Enum):
    """Quantity of a column by the words of its head: whole words, and parts of words of four letters or more; of
    Chinese ones any part.
    """

    TIME = (Dimension.TIME, "time zeit t timestamp uhrzeit zeitstempel temps 时间")
    SPEED = (Dimension.ANGULAR_SPEED, "speed n rpm drehzahl rotation vitesse regime 转速")
    TORQUE = (Dimension.TORQUE, "torque m md trq moment drehmoment couple 扭矩 转矩")
    TEMPERATURE = (Dimension.TEMPERATURE, "temperature temp temperatur t 温度 油温")
    FLOW = (Dimension.VOLUME_FLOW, "flow q strom durchfluss leakage leckage drain debit fuite 流量")
    POWER = (Dimension.POWER, "power leistung pel puissance 功率")
    PRESSURE = (Dimension.PRESSURE, "pressure press druck p hd nd hp lp pression 压力 油压")
    RATIO = (None, "displacement ratio stroke schwenk swash alpha verstell beta foerdervolumen vg cylindree 排量")

    dimension: Dimension | None
    words: tuple[str, ...]

    def __new__(cls, dimension: Dimension | None, words: str) -> Quantity:
        """A member whose value is its words."""
        member = object.__new__(cls)
        member._value_ = words
        member.dimension, member.words = dimension, tuple(words.split())
        return member


class Place(Enum):
    """Place of a column's measurement on the pump, by the words of its head."""

    CASE = "case drain leck leak leckage leakage gehaeuse housing casing carter fuite l 壳体 泄漏 泄油"
    IN = (
        "inlet intake suction saug eingang eintritt zulauf feed charge speise niederdruck low boost tank entree "
        "aspiration in nd lp s 进口 入口 进油 吸油 补油"
    )
    OUT = (
        "outlet delivery ausgang austritt hochdruck high discharge ablauf foerder sortie refoulement out hd hp d 出口 "
        "出油 高压"
    )


@dataclass(frozen=True)
class Head:
    """A column's head as read: quantity and place (None: not stated), unit, and the zero of a pressure.

    unknown: the text in the place of a unit that is no known one.
    """

    column: str
    quantity: Quantity | None
    place: Place | None
    unit: ReadUnit | None
    electric: bool
    unknown: str = ""

    @property
    def reference(self) -> PressureReference | None:
        """Zero of a pressure, if the head states it."""
        return self.unit.reference if self.unit else None


_BRACKETS = re.compile(r"[\[(<{].*$")
_REFERENCE_BEHIND = re.compile(r"(bar|psi|mpa|kpa|pa)\s*\((abs|a|gauge|g|rel)\)[\])]?$", re.IGNORECASE)
_NUMBERED = re.compile(r".*:\d+")  # a column of a matrix
_OVER = re.compile(r"(\w{1,8}) ?/ ?([^ ]{1,8})")
"""A symbol over its unit, as in "p/bar"."""
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss"})
_ACCENTS = str.maketrans("éèêàâîôûç", "eeeaaiouc")
_INDICES = "|".join(word for place in Place for word in place.value.split() if word.isascii())
_SPLIT = re.compile(
    rf"(?<![A-Za-z])[pPTQ](?=(?:[A-Za-z]|(?i:{_INDICES}))(?![A-Za-z]))|[A-Z]?[a-z]+|[A-Z]+(?![a-z])|[^\x00-\u2e7f]+|\d+"
)
"""Words; a symbol and its index, one letter or a place, as in QL, ps and Tcase, are two."""
_ELECTRIC = ("elec", "elek", "netz", "mains")
_PART = 4  # letters from which a word counts inside of another


def read_head(column: str, in_table: str = "") -> Head:
    """Return the content of a column's head; in_table: the unit that the table states beside it.

    A unit that the table states determines the quantity; one at the end of the head ("p_out_bar") has to fit the words.
    """
    if _NUMBERED.fullmatch(column):
        return Head(column, None, None, None, False)
    if (told := _REFERENCE_BEHIND.search(column)) and (ending := read_unit(told[0].rstrip("])") + ")")):
        column_unit, bare = ending, column[: told.start()].strip(" _[(")
    else:
        column_unit, bare = None, _BRACKETS.sub("", column).strip()
    words = _words(bare)
    unit = column_unit or (read_unit(in_table) if in_table else None)
    spoken = _quantity(bare, words, unit)
    if unit is None:
        spoken, unit = _with_ending(bare, words, spoken)
        words = words if unit is None else _words(_parted(bare)[0])  # the l of l/min is no place
    place = next((one for one in Place if _among(one.value.split(), words)), None)
    electric = "el" in words or "pel" in words or any(part in word for part in _ELECTRIC for word in words)
    return Head(column, spoken, place, unit, electric, "" if unit else in_table)


def _words(text: str) -> list[str]:
    return [word.lower() for word in _SPLIT.findall(text.translate(_UMLAUTS).translate(_ACCENTS))]


def _parted(bare: str) -> tuple[str, str]:
    """Return a head without its last part, and that part: behind a blank, a low line, or the stroke of "p/bar"."""
    if (found := _OVER.fullmatch(bare)) and read_unit(found[2]) and not read_unit(bare):
        return found[1], found[2]
    before, _, ending = bare.replace(" ", "_").rpartition("_")
    return before, ending


def _quantity(bare: str, words: list[str], unit: ReadUnit | None) -> Quantity | None:
    """Return the quantity of a unit, or of the first words with one; a symbol's case counts (T, t)."""
    able = [one for one in Quantity if unit is None or one.dimension is unit.dimension]
    if unit is not None and unit.dimension is not None:
        return able[0] if able else None
    if unit is None and (bare in ("t", "s") or re.match(r"t[_ ]*s?$", bare)):
        return Quantity.TIME
    symbols = [one for one in able if one is not Quantity.TIME or "time" in words or "zeit" in words]
    named = [one for one in (symbols if "t" in words else able) if _among(one.words, words)]
    longer = [one for one in named if any(len(word) >= _PART and _among([word], words) for word in one.words)]
    return next(iter([*longer, *named]), None)


def _with_ending(bare: str, words: list[str], spoken: Quantity | None) -> tuple[Quantity | None, ReadUnit | None]:
    """Return quantity and unit of a head that ends with a unit; the unit None where it does not fit the words."""
    before, ending = _parted(bare)
    unit = read_unit(ending) if before and ending else None
    if unit is None or (unit.dimension is None and ending not in ("%", "pct")):
        return spoken, None
    if spoken is None or spoken.dimension is unit.dimension:
        return spoken or _quantity(bare, words, unit), unit
    told = _quantity(before, words[:-1], None)
    fits = len(ending) > 1 and (told is None or len(before) <= 2 or told.dimension is unit.dimension)
    return (_quantity(before, words, unit), unit) if fits else (spoken, None)


def _among(known: list[str] | tuple[str, ...], words: list[str]) -> bool:
    """True if one of the known words is among the words, or a longer or Chinese one a part of one of them."""
    parts = [one for one in known if len(one) >= _PART or not one.isascii()]
    return any(one in words for one in known) or any(one in word for one in parts for word in words)
