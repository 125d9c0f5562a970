"""Points of a pump over ranges of its keys, each an operating point."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

from reynolds.numerics.cache import content_key
from swashfilm.case.study import Point, Study
from swashfilm.console.fidelity import Fidelity
from swashfilm.runs.pump.data import GAPS
from swashfilm.runs.pump.run import PumpCase, solve_pump
from swashfilm.runs.table.summary import table_of
from system.points.table.store import table_name
from system.pump.operating import operating_point
from system.pump_file.file import resolved_toml

KEY_LENGTH = 24
CaseOf = Callable[[Mapping[str, object]], PumpCase]
"""The case of a pump with other values of its keys; raises InputFaults. It can be sent to another process."""


@dataclass(frozen=True)
class PumpStudy(Study[PumpCase]):
    """A pump over ranges of keys of its file, at one fidelity."""

    case_of: CaseOf
    fidelity: Fidelity

    def case(self, point: Point) -> PumpCase:
        """Return the case of a point; raise InputFaults with its faults."""
        return self.case_of(self.values(point))


def pump_digest(case: PumpCase) -> str:
    """Return a name of all inputs of a case's numbers; raise InputFaults where no response table fits it."""
    by_table = case.fidelity is Fidelity.TABLE
    table = table_name(table_of(case.own or case.pump, operating_point(case.pump), case.table)) if by_table else None
    made_by = "pump study", version("swashfilm"), case.fidelity.value, case.options, table
    return content_key(*made_by, resolved_toml(case.pump), case.pump.file_contents)[:KEY_LENGTH]


def solved_point(case: PumpCase) -> dict[str, Any]:
    """Solve a case and return its numbers, checks, warnings and assumptions; raise as `solve_pump`."""
    began = time.process_time()
    summary = solve_pump(case).summary
    return point_summary(summary) | {"solve_seconds": time.process_time() - began}


def point_summary(summary: Mapping[str, Any]) -> dict[str, Any]:
    """Return the headline numbers of an operating point, SI with units in keys, as in a study of films."""
    flow, torque, power = summary["flow"], summary["torque"], summary["power_balance"]
    efficiency, own, table = summary["efficiency"]["iso_4409"], summary["gaps"], summary.get("table", {})
    films = {
        key: {gap: own[gap][key] for gap in GAPS if gap in own} or table.get(key, {})
        for key in ("film_thickness_min_m", "film_thickness_mean_m")
    }
    return {
        "delivery_flow_m3_per_s": flow["delivery_m3_per_s"],
        "inlet_flow_m3_per_s": flow["inlet_m3_per_s"],
        "drain_flow_m3_per_s": flow["case_m3_per_s"],
        "shaft_torque_Nm": torque["shaft_Nm"],
        "shaft_power_W": power["shaft_W"],
        "hydraulic_power_W": power["hydraulic_W"],
        "loss_W": power["shaft_W"] - power["hydraulic_W"],
        **{f"{name}_efficiency": value for name, value in efficiency.items()},
        "leakage_flow_m3_per_s": {gap: summary["leakage"][f"{gap}_m3_per_s"] for gap in GAPS},
        "pair_loss_W": {pair: loss["total_W"] for pair, loss in summary["pair_loss"].items()},
        **films,
        "delivery_pressure_ripple_Pa": summary["ripple"]["delivery_pressure_peak_to_peak_Pa"],
        "delivery_flow_ripple_m3_per_s": summary["ripple"]["delivery_flow_peak_to_peak_m3_per_s"],
        "derived_displacement_m3_per_rev": summary["displacement"]["derived_m3_per_rev"],
        "mass_balance_error": summary["checks"]["mass_balance_error"],
        "energy_balance_error": summary["checks"]["energy_balance_error"],
        "assumptions": summary["assumptions"],
        "warnings": [dict(zip(("name", "text"), one.split(": ", 1), strict=True)) for one in summary["warnings"]],
    }
