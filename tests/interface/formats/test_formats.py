"""Formats that last: a schema for each version, kept files of each version, later versions refused in words."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import formats
import h5py
import pytest
from formats import KEPT, fingerprint, input_names, main as write_formats, run_names
from written_formats import folder_faults

import swashfilm as sf
from diagnosis.report.json_file import read_diagnosis
from swashfilm.__main__ import main
from swashfilm.cli.report import PAGES
from swashfilm.console.schemas import SCHEMAS, schema_of
from swashfilm.formats.versions import VERSIONS
from swashfilm.runs.map.files import read_map
from system import InputFaults, load_pump

FILES = Path(__file__).parent / "kept"
RUNS = sorted(FILES.glob("*.zip"))
CURRENT = [*map(run_names, VERSIONS), *map(input_names, SCHEMAS)]


@pytest.fixture
def unpacked(tmp_path):
    """A kept run folder by its name."""

    def place(name: str) -> Path:
        with zipfile.ZipFile(FILES / f"{name}.zip") as archive:
            archive.extractall(tmp_path / name)
        return tmp_path / name

    return place


@pytest.fixture
def unreleased(tmp_path, monkeypatch):
    """Fingerprints of all schemas, none of them released, in place of the kept ones."""
    stated = {key: one for own in formats.read_fingerprints().values() for key, one in own.items()}
    monkeypatch.setattr(formats, "FINGERPRINTS", tmp_path / "fingerprints.toml")
    formats.write_fingerprints({formats.UNRELEASED: stated})
    return formats.FINGERPRINTS


def changed(folder: Path, **values: object) -> Path:
    """The folder with other entries in its summary."""
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    (folder / "summary.json").write_text(json.dumps(summary | values), encoding="utf-8")
    return folder


def test_every_version_has_a_schema_and_its_fingerprint():
    kept = {path.stem: fingerprint(path) for path in KEPT.glob("*.json")}
    stated = {key: one for own in formats.read_fingerprints().values() for key, one in own.items()}
    assert stated == kept, "python tools/formats.py; a released version never changes: raise it instead"
    assert {names.key for names in CURRENT} <= set(kept)
    assert set(PAGES) == set(VERSIONS)


@pytest.mark.parametrize("kind", SCHEMAS)
def test_the_schema_of_an_input_is_the_kept_one(kind):
    kept = input_names(kind).path.read_text("utf-8")
    assert formats.schema_text(schema_of(kind)) == kept, "python tools/formats.py, or a new version of the input"


def test_a_released_schema_does_not_change(unpacked, unreleased, capsys):
    folder = changed(unpacked("duty-1"), no_such_key=1.0)
    before = run_names("duty").path.read_text("utf-8")
    assert write_formats(["--release", "0.2.0"]) == 0
    stated = unreleased.read_text("utf-8")
    assert write_formats(["--release", "0.2.0"]) == 1
    assert "0.2.0 is released" in capsys.readouterr().err
    assert unreleased.read_text("utf-8") == stated
    assert write_formats([str(folder)]) == 1
    assert "run.duty-1 is released" in capsys.readouterr().err
    assert run_names("duty").path.read_text("utf-8") == before


def test_a_release_is_of_the_schemas_as_they_are(unreleased, capsys):
    unreleased.write_text(unreleased.read_text("utf-8").replace('duty-1" = "', 'duty-1" = "0'), "utf-8")
    assert write_formats(["--release", "0.2.0"]) == 1
    assert "python tools/formats.py first" in capsys.readouterr().err


def test_what_a_schema_does_not_state_is_told(unpacked):
    folder = changed(unpacked("map-1"), points="twelve", no_such_key=1)
    with h5py.File(folder / "map.nc", "a") as file:
        file["compression_power"].attrs["units"] = "kW"
        del file["shaft_torque"]
    faults = "\n".join(folder_faults(folder))
    assert "summary.json/points" in faults
    assert "no_such_key" in faults
    assert "map.nc/variables/compression_power/units" in faults
    assert "'shaft_torque' is a required property" in faults


@pytest.mark.parametrize("path", RUNS, ids=lambda path: path.stem)
def test_kept_runs_are_read(path, unpacked):
    folder = unpacked(path.stem)
    assert folder_faults(folder) == []
    found = sf.open(folder)
    assert found.name
    assert found.to_xarray().sizes
    assert repr(found)


@pytest.mark.slow
@pytest.mark.parametrize("path", RUNS, ids=lambda path: path.stem)
def test_kept_runs_get_their_page(path, unpacked):
    folder = unpacked(path.stem)
    assert main(["report", str(folder)]) == 0
    assert (folder / "report.html").stat().st_size > 10_000


def test_every_kind_has_a_kept_run():
    assert {names.key.removeprefix("run.") for names in CURRENT if names.kind.startswith("run.")} <= {
        path.stem for path in RUNS
    }


def test_what_works_on_kept_runs(unpacked, tmp_path):
    run, table = unpacked("map-1"), unpacked("gap_table-1")
    assert main(["export", str(run), "--to", "csv", "-o", str(tmp_path / "map.csv")]) == 0
    assert sf.read_gap_table(table / "table.json").response.learnt.points.size


def test_a_kept_pump_file_is_read():
    assert load_pump(FILES / "pump-1.toml").pump.pistons == 9


def test_a_later_summary_is_refused_in_words(unpacked, capsys):
    folder = changed(unpacked("duty-1"), format=2)
    assert main(["report", str(folder)]) == 2
    told = capsys.readouterr().err
    for words in ("found:    2", "format = 1, the duty run format of this version", "pip install --upgrade swashfilm"):
        assert words in told
    with pytest.raises(InputFaults, match="a later Swashfilm"):
        sf.open(folder)


def test_later_files_are_refused_in_words(unpacked, tmp_path):
    run, table, found = unpacked("map-1"), unpacked("gap_table-1"), unpacked("diagnosis-1")
    with h5py.File(run / "map.nc", "a") as file:
        file.attrs["format_version"] = 2
    with pytest.raises(InputFaults, match="a later Swashfilm"):
        read_map(run / "map.nc")
    for path, key, read in (
        (table / "table.json", "table_format", sf.read_gap_table),
        (found / "diagnosis.json", "format", read_diagnosis),
    ):
        path.write_text(json.dumps(json.loads(path.read_text("utf-8")) | {key: 99}), encoding="utf-8")
        with pytest.raises(InputFaults, match="a later Swashfilm"):
            read(path)
    pump = tmp_path / "pump.toml"
    pump.write_text((FILES / "pump-1.toml").read_text("utf-8").replace("format = 1", "format = 2"), encoding="utf-8")
    assert main(["check", str(pump)]) == 2


def test_an_unknown_kind_is_told_with_the_nearest(unpacked):
    with pytest.raises(InputFaults, match="duty"):
        sf.open(changed(unpacked("duty-1"), kind="dutty"))
