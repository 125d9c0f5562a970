"""Command `swashfilm doctor`: examination of this machine."""

import argparse
import sys

from swashfilm.console.command import Command
from swashfilm.console.terminal import show_table


def run_doctor(options: argparse.Namespace) -> int:
    """Run `swashfilm doctor`; return 0, or 1 where a requirement of every run is missing."""
    from swashfilm.cli.machine import examine, is_well

    findings = examine()
    show_table("Doctor", [(finding.what, finding.text) for finding in findings])
    for finding in findings:
        if finding.remedy:
            sys.stderr.write(f"{finding.what}: {finding.remedy}\n")
    return 0 if is_well(findings) else 1


def _no_options(command: argparse.ArgumentParser) -> None:
    """Add nothing to the parser: the command has no options."""


COMMAND = Command("doctor", "packages, caches and graphics of this machine", _no_options, run_doctor, in_folder=False)
