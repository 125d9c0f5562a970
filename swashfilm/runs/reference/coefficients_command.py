"""Command `swashfilm coefficients`: coefficients of a port, bore, step or groove from an OpenFOAM case."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.console.command import Command
from swashfilm.console.inputs import COMMAND_LINE, option_value
from swashfilm.console.terminal import show_table
from system.inputs.faults import Fault, InputFaults
from system.inputs.units import Dimension, QuantityError, parse_quantity

if TYPE_CHECKING:
    from system.inputs.coefficients.film_passages import FilmPassage
    from system.inputs.coefficients.openfoam_case import CaseFlow

Rows = list[tuple[str, str]]
SIZES = {
    "--throat-area": (Dimension.AREA, "narrowest section of the flow; of a film, that of the thinner one"),
    "--density": (Dimension.DENSITY, "density of the liquid"),
    "--viscosity": (Dimension.KINEMATIC_VISCOSITY, "kinematic viscosity of the liquid"),
}
FILM_SIZES = {
    "--film": (Dimension.LENGTH, "of a step or groove: thickness of the thinner film"),
    "--before": (Dimension.LENGTH, "length of the film from the inlet patch to the step or groove"),
    "--behind": (Dimension.LENGTH, "length of the film from the step or groove to the outlet patch"),
}
FILM_RATIOS = {
    "--film-ratio": "film behind / film before; of a groove: in the groove / film",
    "--width-ratio": "of a groove: its width / film",
}


def add_coefficient_options(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    command.add_argument("folder", type=Path, metavar="CASE", help="folder of an OpenFOAM case that has been run")
    command.add_argument("--inlet", required=True, metavar="PATCH", help="patch where the flow enters")
    command.add_argument("--outlet", required=True, metavar="PATCH", help="patch where the flow leaves")
    for option, (dimension, what) in SIZES.items():
        command.add_argument(option, required=True, metavar=f"'{dimension.example}'", help=what)
    for option, (dimension, what) in FILM_SIZES.items():
        command.add_argument(option, metavar=f"'{dimension.example}'", help=what)
    for option, what in FILM_RATIOS.items():
        command.add_argument(option, type=float, metavar="R", help=what)
    what = "coefficient file to which the row is added; created where absent"
    command.add_argument("-o", "--output", type=Path, metavar="FILE.csv", help=what)


def run_coefficients_command(options: argparse.Namespace) -> int:
    """Run `swashfilm coefficients` and return its exit code; raise InputFaults with every fault."""
    from system.inputs.coefficients.openfoam_case import read_case_flow

    area, density, viscosity = _sizes(options, SIZES)
    passage = _passage(options, area)
    found = read_case_flow(options.folder, options.inlet, options.outlet, density)
    rows = [
        ("time", f"{found.time:g}"),
        ("flow", f"{6e4 * found.flow:.5g} L/min"),
        ("pressure drop", f"{1e-5 * found.pressure_drop:.5g} bar"),
        ("outflow minus inflow", f"{found.balance_error:.1e} of the inflow"),
    ]
    if passage is None:
        _write_port(options, found, rows, area, density, viscosity)
    else:
        _write_film(options, found, rows, passage, density, viscosity)
    return 0


def _write_port(
    options: argparse.Namespace, found: CaseFlow, rows: Rows, area: float, density: float, viscosity: float
) -> None:
    """Print and write the flow coefficient of a port or bore."""
    from swashfilm.runs.reference.coefficient_rows import port_row

    coefficient, number = found.flow_coefficient(area, density), found.reynolds(area, viscosity)
    numbers = [("Reynolds number", f"{number:.5g}"), ("flow coefficient", f"{coefficient:.4f}")]
    show_table(f"OpenFOAM case {options.folder}", [*rows, *numbers])
    if options.output is not None:
        port_row(options.output, options.folder, area, number, coefficient)


def _write_film(
    options: argparse.Namespace, found: CaseFlow, rows: Rows, passage: FilmPassage, density: float, viscosity: float
) -> None:
    """Print and write extra length and loss factor of a step or groove."""
    from swashfilm.runs.reference.coefficient_rows import known_extra_length, loss_row
    from system.inputs.coefficients.film_passages import film_loss

    known = known_extra_length(options.output, passage)
    loss = film_loss(passage, found, density, viscosity, known)
    source = "from this flow" if known is None else "from the file"
    numbers = [
        ("Reynolds number", f"{loss.reynolds:.5g}"),
        ("extra length / film", f"{loss.extra_length:.4f}, {source}"),
        ("loss factor", f"{loss.loss_factor:.4f}" + (", of first order in Re" if known is None else "")),
    ]
    show_table(f"OpenFOAM case {options.folder}", [*rows, *numbers])
    if options.output is not None:
        loss_row(options.output, options.folder, passage, loss)


def _passage(options: argparse.Namespace, area: float) -> FilmPassage | None:
    """Return the step or groove of the options, None for a port; raise InputFaults for missing options."""
    from system.inputs.coefficients.film_passages import FilmPassage

    needed = (*FILM_SIZES, "--film-ratio")
    stated = [option for option in (*needed, "--width-ratio") if option_value(options, option) is not None]
    if not stated:
        return None
    faults = [
        Fault(option, "missing", f"a value, needed with {stated[0]}") for option in needed if option not in stated
    ]
    ratio, width = options.film_ratio, options.width_ratio
    if ratio is not None and not (ratio > 1.0 if width is not None else ratio > 0.0 and ratio != 1.0):
        expected = "more than 1, of a groove" if width is not None else "above zero, not 1"
        faults.append(Fault("--film-ratio", f"{ratio:g}", expected))
    if width is not None and not width > 0.0:
        faults.append(Fault("--width-ratio", f"{width:g}", "above zero"))
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    film, before, behind = _sizes(options, FILM_SIZES)
    return FilmPassage(film, area, ratio, before, behind, width)


def _sizes(options: argparse.Namespace, sizes: dict[str, tuple[Dimension, str]]) -> list[float]:
    """Return the options' values in SI; raise InputFaults with every fault."""
    found, faults = [], []
    for option, (dimension, _) in sizes.items():
        text = option_value(options, option)
        try:
            found.append(parse_quantity(text, dimension))
            if not found[-1] > 0.0:
                faults.append(Fault(option, str(text), f"{dimension.noun} above zero"))
        except QuantityError as reason:
            faults.append(Fault(option, reason.found, reason.expected, reason.nearest))
    if faults:
        raise InputFaults(COMMAND_LINE, faults)
    return found


COMMAND = Command(
    "coefficients",
    "coefficients of a port, bore, step or groove from a computed flow",
    add_coefficient_options,
    run_coefficients_command,
    in_folder=False,
)
