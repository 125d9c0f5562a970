"""The run folder of a diagnosis, from a finding."""

from datetime import date
from pathlib import Path

from diagnosis.finding import DiagnosisResult
from diagnosis.procedure.compared import PumpComparison
from swashfilm.console.fidelity import Fidelity
from swashfilm.console.schemas import write_new
from swashfilm.runs.diagnose.applied import applied_toml
from swashfilm.runs.diagnose.fields import write_film_fields
from swashfilm.runs.diagnose.files import write_diagnosis_files
from swashfilm.runs.diagnose.page import write_diagnose_page
from swashfilm.runs.pump.run import PumpCase, floating_run, lumped_run
from system.pump_file.file import resolved_toml

EXTENDED = "pump_extended.toml"
"""In the run folder, with a claim: the pump with it."""


def write_finding(folder: Path, found: DiagnosisResult) -> None:
    """Write the pump, the diagnosis's files, the run folders of the pump without and with it, and report.html."""
    write_new(folder / "resolved.toml", "pump", resolved_toml(found.pump))
    if found.extended_pump is not None:
        write_new(folder / EXTENDED, "pump", applied_toml(found, found.extended_pump, date.today()))
    _write_pumps(folder, found.comparison)
    write_diagnosis_files(folder, found.study, found.diagnosis, found.answer, found.assumptions, found.comparison)
    write_diagnose_page(folder)


def _write_pumps(folder: Path, compared: PumpComparison) -> None:
    """Write a run folder for each pump that is solved: by floating films, or lumped with films at given positions."""
    for name, point in compared.points.items():
        (folder / name).mkdir()
        pump, floating = compared.pumps[name], compared.films.floating.get(name)
        if floating is None:
            lumped_run(PumpCase(pump, resolved_toml(pump), Fidelity.LUMPED), point).write(folder / name)
        else:
            floating_run(PumpCase(pump, resolved_toml(pump), Fidelity.FLOATING), floating).write(folder / name)
    for name, films in compared.films.points.items():
        write_film_fields(folder / name, films)
