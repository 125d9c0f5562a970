"""The command `swashfilm coefficients`: a flow coefficient out of an OpenFOAM case, as a row of a file."""

from __future__ import annotations

import argparse
from pathlib import Path

from swashfilm.terminal import show, show_table
from system.faults import Fault, InputFaults
from system.units import Dimension, QuantityError, parse_quantity

COMMAND_LINE = "command line"
SIZES = {
    "--throat-area": (Dimension.AREA, "narrowest section of the flow"),
    "--density": (Dimension.DENSITY, "density of the liquid"),
    "--viscosity": (Dimension.KINEMATIC_VISCOSITY, "its kinematic viscosity"),
}
HEAD = "opening [mm2], reynolds [1], flow_coefficient [1]"
COEFFICIENT_OPTIONS = ["--inlet", "--outlet", *SIZES]


def add_coefficient_options(command: argparse.ArgumentParser) -> None:
    """Give the command what it takes."""
    command.add_argument("folder", type=Path, metavar="CASE", help="folder of an OpenFOAM case that has been run")
    command.add_argument("--inlet", required=True, metavar="PATCH", help="patch where the flow enters")
    command.add_argument("--outlet", required=True, metavar="PATCH", help="patch where it leaves")
    for option, (dimension, what) in SIZES.items():
        command.add_argument(option, required=True, metavar=f"'{dimension.example}'", help=what)
    command.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE.csv",
        help="coefficient file that gets the row, made where absent",
    )


def run_coefficients_command(options: argparse.Namespace) -> int:
    """Run `swashfilm coefficients` and return its exit code; raises InputFaults with what is wrong."""
    from system.openfoam_case import read_case_flow

    area, density, viscosity = _sizes(options)
    found = read_case_flow(options.folder, options.inlet, options.outlet, density)
    coefficient, number = found.flow_coefficient(area, density), found.reynolds(area, viscosity)
    rows = [
        ("time", f"{found.time:g}"),
        ("flow", f"{6e4 * found.flow:.5g} L/min"),
        ("pressure drop", f"{1e-5 * found.pressure_drop:.5g} bar"),
        ("outflow less inflow", f"{found.balance_error:.1e} of the inflow"),
        ("Reynolds number", f"{number:.5g}"),
        ("flow coefficient", f"{coefficient:.4f}"),
    ]
    show_table(f"OpenFOAM case {options.folder}", rows)
    if options.output is not None:
        append_row(options.output, options.folder, area, number, coefficient)
        show(f"row in {options.output}")
    return 0


def append_row(path: Path, case: Path, area: float, number: float, coefficient: float) -> None:
    """Add a row to a coefficient file, with its case in a comment; a file that is absent gets source and head.

    Raises InputFaults for a file of other columns, which stays as it is.
    """
    import numpy as np

    from system.coefficient_files import PORT_HEADS, SOURCE
    from system.csv_table import read_table

    row = f"# case: {case.resolve()}\n{1e6 * area:.6g}, {number:.6g}, {coefficient:.6g}\n"
    if not path.exists():
        path.write_text(f"# {SOURCE}: OpenFOAM, {case.resolve().name}\n{HEAD}\n{row}", encoding="utf-8")
        return
    found = read_table(path, PORT_HEADS)
    if HEAD not in path.read_text("utf-8-sig").splitlines():
        raise InputFaults(str(path), [Fault("head", "other order or units", HEAD)])
    alike = (
        np.isclose(found.columns[name], own, rtol=1e-5) for name, own in (("opening", area), ("reynolds", number))
    )
    if np.any(np.logical_and(*alike)):
        fault = Fault("row", f"Re {number:.6g} at this opening", "a row that the file does not have yet")
        raise InputFaults(str(path), [fault])
    with path.open("a", encoding="utf-8") as file:
        file.write(row)


def _sizes(options: argparse.Namespace) -> list[float]:
    """Area in m2, density in kg/m3, kinematic viscosity in m2/s; raises InputFaults with every fault at once."""
    found, faults = [], []
    for option, (dimension, _) in SIZES.items():
        text = getattr(options, option[2:].replace("-", "_"))
        try:
            found.append(parse_quantity(text, dimension))
            if not found[-1] > 0.0:
                faults.append(Fault(option, text, f"{dimension.noun} above zero"))
        except QuantityError as reason:
            faults.append(Fault(option, reason.found, reason.expected, reason.nearest))
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return found
