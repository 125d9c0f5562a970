"""Cost of a finding: flow, torque and efficiency of the pump with it, less those without."""

from __future__ import annotations

from collections.abc import Iterator

from diagnosis.procedure.compared import WITH, PumpComparison
from diagnosis.report.format import listed, setting_text

MATERIAL = 0.002
"""Of a flow or a torque: smaller changes are not reported. Of an efficiency as much, 0.1 points."""
POINTS = 0.1
COSTS = {
    "efficiency, overall (ISO 4409)": (-1.0, "{} point{} of efficiency", "{} point{} more efficiency"),
    "delivery flow": (-1.0, "{} L/min of delivery", "{} L/min more delivery"),
    "shaft torque": (1.0, "{} N m of torque", "{} N m less torque"),
    "case drain": (1.0, "{} L/min through the case drain", "{} L/min less case drain"),
}
"""Sign of a change that is a cost, its words, and those of the opposite change, by the quantity of a comparison.

The words have the size and, where they have it, the ending of a plural.
"""
BETTER = (
    "So the pump is better than described: look first at the values of its file, stated and assumed, above all "
    "friction and clearances."
)
"""Of a finding that costs nothing."""


def cost_words(comparison: PumpComparison) -> str:
    """Cost of a finding at the point of its largest effect, as a sentence, with its gain there. Empty without a run."""
    if not comparison.changes:
        return comparison.text if not comparison.pumps else ""
    at = comparison.pumps[WITH].operating if comparison.pumps else None
    place = f" ({setting_text(at.speed, at.pressure, at.displacement_ratio)})" if at else ""
    found = list(_material(comparison))
    costs, gains = ([text for cost, text in found if cost is side] for side in (True, False))
    parts = [f"costs {listed(costs)}"] if costs else []
    parts += [f"brings {listed(gains)}"] if gains else []
    told = " and ".join(parts) or "changes flow, torque and efficiency by less than can be seen"
    better = f" {BETTER}" if gains and not costs else ""
    return f"It {told} where it shows most{place}.{better}"


def _material(comparison: PumpComparison) -> Iterator[tuple[bool, str]]:
    """(whether it costs, words) of every change that counts."""
    changes = {one.quantity: one for one in comparison.changes}
    for name, (sign, cost, gain) in COSTS.items():
        one = changes.get(name)
        if one is not None and is_material(one.unit, one.without, one.found):
            moved = one.found - one.without
            costs = bool(sign * moved > 0.0)
            size = f"{abs(moved):.2g}"
            yield costs, (cost if costs else gain).format(size, "" if size == "1" else "s")


def is_material(unit: str, without: float, found: float) -> bool:
    """True for a change of a flow or a torque, or of an efficiency in %, that is large enough to be reported."""
    least = POINTS if unit == "%" else MATERIAL * max(abs(without), abs(found))
    return abs(found - without) > least
