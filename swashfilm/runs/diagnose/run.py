"""The run folder of a diagnosis, from a finding."""

from datetime import date
from pathlib import Path

from diagnosis.finding import DiagnosisResult
from swashfilm.console.fidelity import Fidelity
from swashfilm.runs.diagnose.applied import applied_toml
from swashfilm.runs.diagnose.fields import write_film_fields
from swashfilm.runs.diagnose.files import write_diagnosis_files
from swashfilm.runs.diagnose.page import write_diagnose_page
from swashfilm.runs.pump.run import PumpCase, lumped_run
from system.pump_file.file import resolved_toml

EXTENDED = "pump_extended.toml"
"""In the run folder, where something is claimed: the pump with it."""


def write_finding(folder: Path, found: DiagnosisResult) -> None:
    """Write the pump, the diagnosis's files, the run folders of the pump without and with it, and report.html."""
    (folder / "resolved.toml").write_text(resolved_toml(found.pump), encoding="utf-8")
    if found.extended_pump is not None:
        text = applied_toml(found, found.extended_pump, date.today())
        (folder / EXTENDED).write_text(text, encoding="utf-8")
    for name, pump in found.comparison.pumps.items():
        (folder / name).mkdir()
        case = PumpCase(pump, resolved_toml(pump), Fidelity.LUMPED)
        lumped_run(case, found.comparison.points[name]).write(folder / name)
    for name, films in found.comparison.films.points.items():
        write_film_fields(folder / name, films)
    write_diagnosis_files(folder, found.study, found.diagnosis, found.assumptions, found.comparison)
    write_diagnose_page(folder)
