"""Option --vary: keys of a pump file with their values, and the faults of the resulting pumps."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product

from swashfilm.case.axis import StudyAxis, listed_axis, place_words, stepped
from swashfilm.case.study import MOST_POINTS, Point
from swashfilm.console.levels import level_texts
from swashfilm.console.settings import LEVELS_EXAMPLE, toml_value
from system.inputs.faults import Fault, InputFaults
from system.inputs.units import Dimension, QuantityError, parse_quantity

CHECKED = 100
"""Number of points up to which each pump is checked before the first is solved; else those at the ends."""
MOST_KEYS = 3


def vary_axes(texts: Sequence[str], faults: list[Fault]) -> tuple[StudyAxis, ...]:
    """Return the keys and values of `KEY=LEVELS` texts; list the faults of the others."""
    found: dict[str, StudyAxis] = {}
    for text in texts:
        key, equals, levels = (part.strip() for part in text.partition("="))
        if not (equals and key and levels):
            faults.append(Fault("--vary", repr(text), f"KEY=LEVELS, such as {LEVELS_EXAMPLE}"))
            continue
        if key in found:
            faults.append(Fault(f"--vary {key}", "stated twice", "one list of levels, such as 6..14um:9,20um"))
        try:
            found[key] = _axis(key, levels)
        except QuantityError as reason:
            faults.append(Fault(f"--vary {key}", reason.found, f"{reason.expected}: {LEVELS_EXAMPLE}", reason.nearest))
    if len(texts) > MOST_KEYS:
        faults.append(Fault("--vary", f"{len(texts)} keys", f"at most {MOST_KEYS}"))
    count = 1
    for axis in found.values():
        count *= len(axis.values)
    if count > MOST_POINTS:
        faults.append(Fault("--vary", f"{count} points", f"at most {MOST_POINTS}"))
    return tuple(found.values())


def _axis(key: str, levels: str) -> StudyAxis:
    """Return a key with levels in one unit, or with words and bare numbers; raise QuantityError."""
    texts = level_texts(levels)
    ends = [end for item in texts for end in item.ends]
    dimension = next((one for one in Dimension if _all_of(ends, one)), None)
    if dimension is None:
        if all(len(item.ends) == 1 for item in texts):
            return listed_axis(key, [toml_value(item.ends[0]) for item in texts])
        if not all(_is_bare(end) for end in ends):
            raise QuantityError(repr(levels), "two ends of one kind, or bare numbers")
    values = [value for item in texts for value in item.levels(dimension)]
    return stepped(key, sorted({float(f"{value:.12g}") for value in values}), dimension)


def _all_of(texts: Iterable[str], dimension: Dimension) -> bool:
    try:
        for text in texts:
            parse_quantity(text, dimension)
    except QuantityError:
        return False
    return True


def _is_bare(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def pump_faults(
    axes: Sequence[StudyAxis], points: Sequence[Point], check: Callable[[Mapping[str, object]], object]
) -> list[Fault]:
    """Return the faults of the pumps at the points, each once, at its key with the valid levels.

    check: makes the pump with these values of the keys; raises InputFaults.
    """
    checked, wrong = _checked(axes, points), dict[Point, Sequence[Fault]]()
    for point in checked:
        try:
            check({axis.key: axis.values[k] for axis, k in zip(axes, point, strict=True)})
        except InputFaults as reason:
            wrong[point] = reason.faults
    each: dict[str, list[tuple[Point, Fault]]] = {}
    for point, faults in wrong.items():
        for fault in faults:
            each.setdefault(fault.path, []).append((point, fault))
    return [_told(axes, found, len(checked), wrong) for found in each.values()]


def _told(
    axes: Sequence[StudyAxis], found: Sequence[tuple[Point, Fault]], checked: int, wrong: Mapping[Point, object]
) -> Fault:
    """Return the fault of a path, as it is where it does not change with the keys."""
    point, fault = found[0]
    if len(found) == checked > 1 and all(other == fault for _, other in found):
        return fault
    return _at_axis(axes, point, fault, len(found), wrong)


def _checked(axes: Sequence[StudyAxis], points: Sequence[Point]) -> Sequence[Point]:
    if len(points) <= CHECKED:
        return points
    return list(product(*(sorted({0, len(axis.values) - 1}) for axis in axes)))


def _at_axis(axes: Sequence[StudyAxis], point: Point, fault: Fault, count: int, wrong: Mapping[Point, object]) -> Fault:
    """Return a fault of the pump at a point as one of --vary."""
    keys = [axis.key for axis in axes]
    path = f"--vary {fault.path}" if fault.path in keys else fault.path
    values = place_words(axes, {axis.key: axis.values[k] for axis, k in zip(axes, point, strict=True)})
    more = f"; {count} points have such a fault" if count > 1 else ""
    near = fault.nearest
    if len(axes) == 1:
        good = [axes[0].text(value) for k, value in enumerate(axes[0].values) if (k,) not in wrong]
        span = f"from {good[0]} to {good[-1]}" if len(good) > 1 else f"of {good[0]}" if good else ""
        near = f"{keys[0]} {span}" if span else near
    return Fault(path, f"{fault.found} (at {values}{more})", fault.expected, near)
