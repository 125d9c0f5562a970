"""Scatter of a pump's dimensions over a series, as [tolerance] of its file states it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import combinations

import numpy as np

from system.description.drawn import DEVIATION, SIGMAS, Drawing, Drawn, DrawnFit, pump_sigma
from system.description.keys import PumpKey, pump_keys, unknown_key
from system.description.pump import PumpDescription
from system.description.tolerance import DrawnSection, FitSection, Shape
from system.description.tolerances import BOUNDS, FARTHEST
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.units import Dimension, QuantityError, parse_quantity

_FILMS = ("piston.radial_clearance", "slipper.film_thickness", "valve_plate.film_thickness")
_PAIRS = ("piston_cylinder", "slipper_swash_plate", "piston_slipper_socket", "valve_plate_cylinder")
_RELATIVE = {
    "film_thickness": _FILMS,
    "bulk_modulus": ("oil.bulk_modulus",),
    "friction": tuple(f"friction.{pair}" for pair in _PAIRS),
    "guide_friction": ("friction.ball_guide_retainer",),
    "bearing_friction": ("friction.front_bearing", "friction.rear_bearing"),
    "dead_volume": ("pump.dead_volume",),
    "flow_coefficient": ("ports.flow_coefficient",),
}
"""Dimensions of a sigma of [tolerance] that is a share of the stated value; each scatters by itself."""
_ABSOLUTE = {"eccentricity_ratio": "piston.eccentricity_ratio", "stand_out_share": "piston.stand_out_share"}
_VISCOSITIES = ("oil.kinematic_viscosity_40C", "oil.kinematic_viscosity_100C")


def drawing_of(pump: PumpDescription) -> Drawing:
    """Return the scatter that a pump's [tolerance] states; other dimensions do not scatter.

    [[tolerance.dimension]] and [[tolerance.fit]] replace the table's own sigma of the same dimension. Raises
    InputFaults with every fault.
    """
    faults: list[Fault] = []
    known = pump_keys(pump)
    found = [*_drawn(pump, known, faults)]
    fits = [*_fits(pump, known, faults)]
    _check_names([*found, *fits], faults)
    taken = {name for one in found for name in one.keys} | {one.name for one in fits}
    whole = (*(one for one in _by_sigma(pump, known) if taken.isdisjoint(one.keys)), *found)
    correlation = _correlation(pump, [one.name for one in found], faults)
    made = Drawing(whole, tuple(fits), correlation, _unused(pump))
    if not faults:
        faults += _definite(made)
    if faults:
        raise InputFaults(f"[tolerance] of {pump.name}", faults)
    return made


def drawing_faults(pump: PumpDescription) -> tuple[Fault, ...]:
    """Return the faults of a pump's tolerances of the drawing."""
    part = pump.tolerance
    if not (part.dimension or part.fit or part.correlation):
        return ()
    try:
        drawing_of(pump)
    except InputFaults as reason:
        return reason.faults
    return ()


def drawn_sigmas(pump: PumpDescription) -> dict[str, float]:
    """Return one sigma (SI) of each dimension of [[tolerance.dimension]] and [[tolerance.fit]], by path.

    Of a fit in classes it is that of the paired parts.
    """
    part = pump.tolerance
    if not (part.dimension or part.fit):
        return {}
    drawn, listed = drawing_of(pump), {one.key for one in part.dimension}
    return {one.name: pump_sigma(one) for one in drawn.members if one.name in listed or one in drawn.fits}


def _by_sigma(pump: PumpDescription, known: Mapping[str, PumpKey]) -> Iterator[Drawn]:
    """Yield the dimensions of the sigmas that [tolerance] states, within the bounds that a fit keeps them in.

    A relative sigma is that of the logarithm, so that a positive value stays positive; an absolute one is normal.
    """
    part = pump.tolerance
    for key, paths in _RELATIVE.items():
        share = getattr(part, key)
        for path in paths if share is not None else ():
            if path in known and known[path].value > 0.0:
                yield _relative((path,), known[path].value, share, BOUNDS.get(key, (0.0, math.inf))[1])
    for key, path in _ABSOLUTE.items():
        sigma = getattr(part, key)
        if sigma is not None and path in known:
            least, most = BOUNDS[key]
            yield replace(_normal(path, (path,), known[path].value, sigma), least=least, most=most)
    if part.viscosity is not None:
        yield _relative(_VISCOSITIES, known[_VISCOSITIES[0]].value, part.viscosity)
    if part.displacement is not None:  # stroke goes with the tangent of the angle
        angle = pump.pump.swash_angle_max
        path = "pump.swash_angle_max"
        yield _normal(path, (path,), angle, 0.5 * part.displacement * math.sin(2.0 * angle))


def _unused(pump: PumpDescription) -> tuple[str, ...]:
    kept = ("viscosity_slope", "inlet_share")
    return tuple(f"tolerance.{key}" for key in kept if getattr(pump.tolerance, key) is not None)


def _relative(keys: tuple[str, ...], middle: float, share: float, most: float = math.inf) -> Drawn:
    """Return a log-normal dimension of a relative sigma about its median."""
    least, most = middle / FARTHEST, min(FARTHEST * middle, most)
    return replace(_normal(keys[0], keys, middle, share * middle), least=least, most=most, logarithmic=True)


def _normal(name: str, keys: tuple[str, ...], middle: float, sigma: float) -> Drawn:
    return Drawn(name, keys, Shape.NORMAL, middle, sigma)


def _drawn(pump: PumpDescription, known: Mapping[str, PumpKey], faults: list[Fault]) -> Iterator[Drawn]:
    for number, row in enumerate(pump.tolerance.dimension, start=1):
        where = f"tolerance.dimension.{number}"
        if row.key not in known:
            faults.append(unknown_key(f"{where}.key", row.key, known))
            continue
        if (made := _dimension(where, row, known[row.key], faults)) is not None:
            yield replace(made, parts=row.parts)


def _dimension(where: str, row: DrawnSection, key: PumpKey, faults: list[Fault]) -> Drawn | None:
    """Return the distribution of a row, None with its faults noted."""
    ways = [name for name in ("sigma", "plus_minus") if getattr(row, name) is not None]
    ways += ["least and most"] if row.least is not None and row.most is not None else []
    lone = (row.least is None) != (row.most is None)
    if lone or len(ways) != 1 or (row.sigma is not None and row.shape is not Shape.NORMAL):
        stated = [name for name in ("sigma", "plus_minus", "least", "most") if getattr(row, name) is not None]
        found = f"shape = '{row.shape.value}' with {', '.join(stated) or 'no width'}"
        faults.append(Fault(where, found, "plus_minus, or least and most; for 'normal' also sigma; one of these"))
        return None
    if row.sigma is not None:
        sigma = _width(f"{where}.sigma", row.sigma, key, faults)
        return None if sigma is None else _normal(key.path, (key.path,), key.value, sigma)
    limits = _limits(where, row, key, faults)
    if limits is None:
        return None
    least, most = limits
    middle, half = 0.5 * (least + most), 0.5 * (most - least)
    if row.shape is Shape.NORMAL:
        return _normal(key.path, (key.path,), middle, half / SIGMAS)
    if row.shape is Shape.UNIFORM:
        return Drawn(key.path, (key.path,), row.shape, middle, half / DEVIATION[row.shape], least, most)
    return _triangle(where, key, least, most, faults)


def _triangle(where: str, key: PumpKey, least: float, most: float, faults: list[Fault]) -> Drawn | None:
    peak = key.value
    if not least <= peak <= most:
        box = f"a value between {key.shown(least)} and {key.shown(most)}: the peak of the triangle"
        faults.append(Fault(where, f"{key.path} = {key.text}", box))
        return None
    mean = (least + most + peak) / 3.0
    spread = least**2 + most**2 + peak**2 - least * most - least * peak - most * peak
    return Drawn(key.path, (key.path,), Shape.TRIANGULAR, mean, math.sqrt(spread / 18.0), least, most, peak)


def _limits(where: str, row: DrawnSection, key: PumpKey, faults: list[Fault]) -> tuple[float, float] | None:
    if row.plus_minus is not None:
        half = _width(f"{where}.plus_minus", row.plus_minus, key, faults)
        return None if half is None else (key.value - half, key.value + half)
    ends = [_quantity(f"{where}.{name}", str(getattr(row, name)), key, faults) for name in ("least", "most")]
    return _ordered(where, ends[0], ends[1], key, faults)


def _ordered(
    where: str, least: float | None, most: float | None, key: PumpKey, faults: list[Fault]
) -> tuple[float, float] | None:
    if least is None or most is None:
        return None
    if not least < most:
        faults.append(Fault(where, f"{key.shown(least)} .. {key.shown(most)}", "the least limit below the largest"))
        return None
    return least, most


def _width(where: str, text: str, key: PumpKey, faults: list[Fault]) -> float | None:
    """Return a width above zero: a quantity, or a share of the stated value."""
    width = _quantity(where, text, key, faults, width=True)
    if width is not None and not width > 0.0:
        faults.append(Fault(where, repr(text), "more than 0"))
        return None
    return width


def _quantity(where: str, text: str, key: PumpKey, faults: list[Fault], *, width: bool = False) -> float | None:
    """Return the SI value of a text for a key, a width as a difference; None with its fault noted."""
    try:
        if text.strip().endswith("%"):
            return 0.01 * _number(text.strip()[:-1]) * abs(key.value)
        if key.dimension is None:
            return _number(text)
        return parse_quantity(text, key.dimension, difference=width)
    except QuantityError as reason:
        faults.append(Fault(where, reason.found, reason.expected, reason.nearest))
        return None


def _number(text: str) -> float:
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise QuantityError(repr(text), "a number, or a share of the stated value such as '4 %'")
    return found


def _fits(pump: PumpDescription, known: Mapping[str, PumpKey], faults: list[Fault]) -> Iterator[DrawnFit]:
    for number, row in enumerate(pump.tolerance.fit, start=1):
        where = f"tolerance.fit.{number}"
        if row.key not in known:
            faults.append(unknown_key(f"{where}.key", row.key, known))
        elif known[row.key].dimension is not Dimension.LENGTH:
            lengths = [path for path, one in known.items() if one.dimension is Dimension.LENGTH]
            near = nearest_choice(row.key, lengths)
            faults.append(Fault(f"{where}.key", f"'{row.key}', no length", "a radial clearance", near))
        elif (made := _fit(where, row, known[row.key], faults)) is not None:
            yield made


def _fit(where: str, row: FitSection, key: PumpKey, faults: list[Fault]) -> DrawnFit | None:
    sides = []
    for part in ("hole", "shaft"):
        ends = [
            _quantity(f"{where}.{part}_{end}", getattr(row, f"{part}_{end}"), key, faults) for end in ("least", "most")
        ]
        sides.append(_ordered(f"{where}.{part}_least", ends[0], ends[1], key, faults))
    hole, shaft = sides
    if hole is None or shaft is None:
        return None
    if not shaft[0] < hole[1]:
        faults.append(Fault(where, f"a shaft of {key.shown(shaft[0])} and more", f"one below {key.shown(hole[1])}"))
        return None
    return DrawnFit(key.path, row.shape, hole, shaft, row.classes, row.parts)


def _check_names(found: list[Drawn | DrawnFit], faults: list[Fault]) -> None:
    names = [one.name for one in found]
    for name in dict.fromkeys(names):
        if names.count(name) > 1:
            faults.append(Fault("tolerance", f"'{name}', {names.count(name)} times", "each dimension once"))


def _correlation(pump: PumpDescription, names: list[str], faults: list[Fault]) -> dict[tuple[str, str], float]:
    found: dict[tuple[str, str], float] = {}
    for number, row in enumerate(pump.tolerance.correlation, start=1):
        where = f"tolerance.correlation.{number}"
        for end in ("one", "other"):
            name = getattr(row, end)
            if name not in names:
                near = nearest_choice(name, names)
                faults.append(Fault(f"{where}.{end}", f"'{name}'", "a key of [[tolerance.dimension]]", near))
        pair = (min(row.one, row.other), max(row.one, row.other))
        several = [one.key for one in pump.tolerance.dimension if one.parts > 1 and one.key in pair]
        if several:
            expected = "dimensions of which a pump has one part"
            faults.append(Fault(where, f"'{several[0]}', of several parts", expected))
        if row.one == row.other or pair in found:
            faults.append(Fault(where, f"'{row.one}' and '{row.other}'", "two dimensions, each pair once"))
        found[pair] = row.coefficient
    return found


def _definite(drawn: Drawing) -> Iterator[Fault]:
    """Yield the fault of coefficients that no set of dimensions can have together."""
    least = float(np.linalg.eigvalsh(drawn.matrix()).min()) if drawn.dimensions else 1.0
    if least <= 1e-12:
        pairs = ", ".join(f"{one} and {other} {value:g}" for (one, other), value in drawn.correlation.items())
        worst = max(
            combinations(sorted(set(sum(drawn.correlation, ()))), 2),
            key=lambda pair: abs(drawn.correlation.get(pair, 0.0)),
        )
        expected = f"coefficients whose matrix is positive definite; its least eigenvalue is {least:.3g}"
        yield Fault("tolerance.correlation", pairs, expected, f"a smaller coefficient of {worst[0]} and {worst[1]}")
