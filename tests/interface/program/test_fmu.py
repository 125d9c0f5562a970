"""`swashfilm export --to fmu`: an importer of its own finds the map, inside, at the edge and beyond."""

import re
import zipfile
from ctypes import byref, c_bool, c_double, c_void_p
from pathlib import Path
from shutil import which

import numpy as np
import pint
import pytest
from kept_maps import LEVELS, kept_map
from stand_in_films import ThinningFilms

import swashfilm as sf
from swashfilm.__main__ import main
from swashfilm.runs.export.fmu import archive, compiler
from swashfilm.runs.export.fmu.archive import HEADERS, model_identifier
from swashfilm.runs.export.numbers import TABLES
from swashfilm.runs.map.files import read_map
from system.inputs.units import RPM
from system.maps.interpolation import MapInterpolant
from system.maps.plan import MapInput
from system.maps.point import DirectSolver

fmpy = pytest.importorskip("fmpy", reason="FMPy imports the unit; it is in the extra dev")
from fmpy.build import build_platform_binary  # noqa: E402
from fmpy.fmi1 import FMICallException  # noqa: E402
from fmpy.fmi3 import FMU3Slave  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402

SAME = 1e-12
"""Difference of unit and interpolation, of the value: round-off."""
needs_compiler = pytest.mark.skipif(not compiler.targets(), reason=compiler.NONE)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return kept_map(tmp_path_factory.mktemp("fmu") / "whole", LEVELS)


@pytest.fixture(scope="module")
def unit_file(whole):
    (path,) = sf.export(whole, "fmu", whole / "pump.fmu")
    return path


@pytest.fixture(scope="module")
def unpacked(unit_file):
    return Path(fmpy.extract(str(unit_file), str(unit_file.with_suffix(""))))


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


class Instance:
    """An instance in step mode, by names of variables in SI, with the messages that it logs."""

    def __init__(self, folder, log=True):
        about = fmpy.read_model_description(str(folder))
        self.references = {one.name: one.valueReference for one in about.modelVariables}
        self.messages = []
        self.fmu = FMU3Slave(
            guid=about.instantiationToken, unzipDirectory=str(folder), instanceName="pump",
            modelIdentifier=about.coSimulation.modelIdentifier,
        )  # fmt: skip
        self.fmu.instantiate(
            loggingOn=log, logMessage=lambda _, status, kind, text: self.messages.append(text.decode())
        )
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.time = 0.0

    def set(self, values):
        references = [self.references[given.value] for given in values]
        self.fmu.setFloat64(references, [float(value) for value in values.values()])

    def step(self, size=0.1):
        """The status of a step: 0 without warning, 1 with one."""
        flags, reached = [c_bool() for _ in range(3)], c_double()
        args = (self.fmu.component, self.time, size, True, *map(byref, flags), byref(reached))
        status = self.fmu.fmi3DoStep(*args)
        self.time += size
        assert not any(flag.value for flag in flags)
        assert reached.value == self.time
        return status

    def get(self, *names):
        return np.array(self.fmu.getFloat64([self.references[name] for name in names]))


def random_points(levels, count):
    random = np.random.default_rng(90)
    return {given: random.uniform(values[0], values[-1], count) for given, values in levels.items()}


def interpolated(folder, points):
    """The map's numbers at points, by the names of the unit."""
    data, _ = read_map(folder / "map.nc")
    found = MapInterpolant(data).at(points)
    found["loss"] = found["shaft_power"] - found["hydraulic_power"]
    useful = (
        found["port_delivery_pressure"] * found["delivery_flow"] - found["port_inlet_pressure"] * found["inlet_flow"]
    )
    speed = points.get(MapInput.SPEED, data.axes[0].values[0])
    efficiency = {"overall_efficiency": useful / (speed * found["shaft_torque"])}
    return {name.replace(".", "_"): found[name] for name in TABLES} | efficiency


def outputs_at(instance, points, names):
    """Outputs (points, names) of an instance at points, each reached without a warning."""
    found = []
    for row in zip(*points.values(), strict=True):
        instance.set(dict(zip(points, row, strict=True)))
        assert instance.step() == 0
        found.append(instance.get(*names))
    return np.array(found)


@needs_compiler
def test_an_importer_finds_no_fault(unit_file):
    assert validate_fmu(str(unit_file)) == []
    with zipfile.ZipFile(unit_file) as packed:
        names = set(packed.namelist())
        assert {one.external_attr >> 16 for one in packed.infolist()} == {0o644}
        assert {one.extract_version for one in packed.infolist()} == {20}, "the standard allows no more"
    assert {"modelDescription.xml", "sources/buildDescription.xml", "sources/fmi3.c", "sources/map.h"} <= names
    assert [name for name in names if name.startswith(f"binaries/{compiler.host()}/pump.")]
    assert not [name for name in names if "fmi3Functions" in name], "the importer has these headers"


@needs_compiler
def test_outputs_are_those_of_the_map(whole, unpacked):
    points = random_points(LEVELS, 200)
    known = interpolated(whole, points)
    found = outputs_at(Instance(unpacked), points, list(known))
    for name, column in zip(known, found.T, strict=True):
        np.testing.assert_allclose(column, known[name], rtol=SAME, err_msg=name)
    assert np.all((found[:, -1] > 0.5) & (found[:, -1] < 1.0))


@needs_compiler
def test_films_of_a_map_that_solves_them_are_outputs(tmp_path):
    levels = {MapInput.SPEED: LEVELS[MapInput.SPEED], MapInput.PRESSURE: (5e6, 10e6, 15e6, 20e6, 30e6)}
    folder = kept_map(tmp_path / "films", levels, solver=DirectSolver(ThinningFilms(exponent=0.3), 0.0))
    (path,) = sf.export(folder, "fmu", tmp_path / "films.fmu")
    points = random_points(levels, 50)
    known = interpolated(folder, points)
    films = [name for name in known if name.startswith("film_least")]
    found = outputs_at(Instance(fmpy.extract(str(path), str(tmp_path / "unpacked"))), points, films)
    assert len(films) == 3
    assert np.ptp(found[:, 1]) > 1e-6
    for name, column in zip(films, found.T, strict=True):
        np.testing.assert_allclose(column, known[name], rtol=SAME, err_msg=name)


@needs_compiler
def test_an_importer_simulates_a_course(whole, unit_file):
    time = np.linspace(0.0, 1.0, 11)
    course = {
        MapInput.SPEED: RPM * (1000.0 + 1000.0 * time),
        MapInput.PRESSURE: 10e6 + 20e6 * time**2,
        MapInput.RATIO: 1.0 - 0.5 * time,
        MapInput.TEMPERATURE: 313.15 + 20.0 * time,
    }
    names = ["time", *(given.value for given in course)]
    table = np.array([*zip(time, *course.values(), strict=True)], dtype=[(name, float) for name in names])
    found = fmpy.simulate_fmu(
        str(unit_file), input=table, stop_time=1.0, output_interval=0.1, output=["time", "shaft_torque", "inlet_flow"]
    )
    known = interpolated(whole, course)
    np.testing.assert_allclose(found["time"], time, atol=1e-12)
    for name in ("shaft_torque", "inlet_flow"):  # a step ends with the inputs that it began with
        np.testing.assert_allclose(found[name][1:], known[name][:-1], rtol=1e-9)


@needs_compiler
def test_beyond_the_map_its_edge_holds_with_a_warning(whole, unpacked):
    instance, held = Instance(unpacked), {MapInput.PRESSURE: 20e6, MapInput.RATIO: 0.8, MapInput.TEMPERATURE: 320.0}
    instance.set({MapInput.SPEED: RPM * 2500.0} | held)
    assert [instance.step(), instance.step()] == [1, 1]
    (message,) = instance.messages
    assert re.search(r"shaft_speed is 2500 r/min at 0.1 s, beyond the map, 1000 \.\. 2000 r/min", message)
    edge = interpolated(whole, {given: np.array([v]) for given, v in ({MapInput.SPEED: RPM * 2000.0} | held).items()})
    np.testing.assert_allclose(instance.get(*edge), np.ravel([*edge.values()]), rtol=SAME)
    assert instance.get("shaft_speed") == pytest.approx(RPM * 2500.0)
    instance.set({MapInput.TEMPERATURE: 273.15})
    assert instance.step() == 1
    assert "temperature is 0 degC" in instance.messages[-1]
    instance.set({MapInput.SPEED: RPM * 2000.0 * (1.0 + 1e-12), MapInput.TEMPERATURE: 333.15})
    assert instance.step() == 0
    assert len(instance.messages) == 2


@needs_compiler
def test_warnings_are_silent_without_logging_and_errors_are_not(unpacked):
    instance = Instance(unpacked, log=False)
    instance.set({MapInput.SPEED: 1e4})
    assert instance.step() == 1
    assert not instance.messages
    instance.fmu.setDebugLogging(True, ["logStatusWarning"])
    instance.set({MapInput.PRESSURE: 1e9})
    assert instance.step() == 1
    assert len(instance.messages) == 1


@needs_compiler
@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda one: one.set({MapInput.SPEED: np.nan}), "shaft_speed: not a finite number"),
        (lambda one: one.set({MapInput.PRESSURE: np.inf}), "delivery_pressure: not a finite number"),
        (lambda one: one.set({MapInput.INLET_PRESSURE: 1e5}), "no input"),
        (lambda one: one.fmu.setFloat64([one.references["loss"]], [0.0]), "no input"),
        (lambda one: one.fmu.getFloat64([99]), "value reference"),
        (lambda one: one.fmu.getInt32([1]), "no variable has this type"),
        (lambda one: one.step(0.0), "step size"),
        (lambda one: one.fmu.enterEventMode(), "no such capability"),
        (lambda one: one.fmu.setDebugLogging(True, ["all"]), "categories"),
    ],
)
def test_what_the_unit_refuses_is_an_error_with_a_message(call, told, unpacked):
    instance = Instance(unpacked, log=False)
    with pytest.raises(FMICallException, match="error"):
        call(instance)
    assert told in instance.messages[-1]


@needs_compiler
def test_instances_do_not_touch_each_other_and_states_return(unpacked):
    one, other = Instance(unpacked), Instance(unpacked)
    one.set({MapInput.PRESSURE: 12e6})
    other.set({MapInput.PRESSURE: 28e6})
    assert [one.step(), other.step()] == [0, 0]
    low, high = one.get("shaft_torque"), other.get("shaft_torque")
    assert high > 2.0 * low
    kept = other.fmu.serializeFMUState(other.fmu.getFMUState())
    other.set({MapInput.PRESSURE: 12e6})
    assert other.step() == 0
    assert other.get("shaft_torque") == low
    state = c_void_p()
    other.fmu.deserializeFMUState(kept, state)
    other.fmu.setFMUState(state)
    assert [*other.get("shaft_torque", "delivery_pressure", "time")] == [high[0], 28e6, pytest.approx(0.1)]
    other.fmu.freeFMUState(state)
    one.fmu.freeInstance()
    other.fmu.reset()
    assert other.get("delivery_pressure") == 25e6


@needs_compiler
def test_another_token_gives_no_instance(unpacked):
    about = fmpy.read_model_description(str(unpacked))
    fmu = FMU3Slave(guid="other", unzipDirectory=str(unpacked), instanceName="pump", modelIdentifier="pump")
    with pytest.raises(Exception, match="Failed to instantiate"):
        fmu.instantiate(logMessage=lambda *_: None)
    assert about.instantiationToken != "other"


def test_units_and_variables_are_described(unit_file):
    about, units = fmpy.read_model_description(str(unit_file)), pint.UnitRegistry()
    units.define("@alias turn = rev = r")
    for unit in about.unitDefinitions:
        si = 1.0 * units.parse_units(re.sub(r"(?<=m)3", "^3", unit.name).replace(".", "*"))
        powers = [
            units.parse_units(base) ** (getattr(unit.baseUnit, base) or 0) for base in ("kg", "m", "s", "K", "rad")
        ]
        assert si.to_base_units() == 1.0 * np.prod(powers), unit.name
        for shown in unit.displayUnits:
            value = units.Quantity(300.0, si.units).to(shown.name.replace("%", "percent")).magnitude
            assert 300.0 * float(shown.factor) + float(shown.offset) == pytest.approx(value), shown.name
    variables = {one.name: one for one in about.modelVariables}
    shown = {name: one.displayUnit for name, one in variables.items() if one.displayUnit}
    assert (shown["shaft_speed"], shown["delivery_pressure"], shown["temperature"]) == ("r/min", "bar", "degC")
    assert {shown[name] for name in ("delivery_flow", "inlet_flow", "drain_flow")} == {"L/min"}
    assert {one.name for one in about.modelVariables if one.causality == "input"} == {one.value for one in LEVELS}
    held = variables["inlet_pressure"]
    assert (held.causality, held.variability, float(held.start)) == ("local", "constant", pytest.approx(2.5e6))
    assert "constant: inlet pressure 2.5 MPa" in about.description
    speed = variables["shaft_speed"]
    assert [float(speed.min), float(speed.max)] == [LEVELS[MapInput.SPEED][0], LEVELS[MapInput.SPEED][-1]]


@needs_compiler
@pytest.mark.skipif(not (which("cmake") and which("make")), reason="FMPy compiles by CMake and make")
def test_an_importer_compiles_the_sources(whole, unit_file, tmp_path):
    folder = Path(fmpy.extract(str(unit_file), str(tmp_path / "unit")))
    (binary,) = (folder / "binaries" / compiler.host()).iterdir()
    binary.unlink()
    build_platform_binary(folder)
    assert binary.is_file()
    points = random_points(LEVELS, 5)
    known = interpolated(whole, points)
    found = outputs_at(Instance(folder), points, list(known))
    np.testing.assert_allclose(found.T, [*known.values()], rtol=SAME)


def test_the_header_files_are_those_of_the_standard():
    theirs = Path(fmpy.__file__).parent / "c-code"
    for kept in HEADERS.iterdir():
        assert kept.read_text("utf-8").split() == (theirs / kept.name).read_text("utf-8").split(), kept.name


def test_without_a_compiler_the_unit_has_sources_and_says_so(whole, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(archive, "targets", lambda: ())
    assert main(["export", str(whole), "--to", "fmu", "-o", "pump.fmu"]) == 0
    assert "warning: no C compiler: the unit has sources and no binary" in capsys.readouterr().out
    assert fmpy.supported_platforms("pump.fmu") == ["c-code"]
    assert validate_fmu("pump.fmu") == []
    with pytest.warns(UserWarning, match="no C compiler"):
        sf.export(whole, "fmu", "other.fmu")


def test_a_compiler_that_fails_is_told_with_its_message(whole, tmp_path, capsys, monkeypatch):
    broken = tmp_path / "cc"
    broken.write_text("#!/bin/sh\necho 'note: here' >&2\necho 'fatal error: stdio.h: No such file' >&2\nexit 1\n")
    broken.chmod(0o755)
    monkeypatch.setattr(archive, "targets", lambda: (compiler.Target("x86_64-linux", (str(broken),)),))
    assert main(["export", str(whole), "--to", "fmu"]) == 0
    assert "warning: no binary for x86_64-linux: fatal error: stdio.h: No such file" in capsys.readouterr().out
    assert fmpy.supported_platforms("ref90.fmu") == ["c-code"]


def test_compilers_are_looked_for(monkeypatch):
    monkeypatch.setattr(compiler, "find_spec", lambda _: None)
    monkeypatch.setattr(compiler, "which", lambda name: f"/usr/bin/{name}" if name == "gcc" else None)
    assert [target.command for target in compiler.targets()] == [("/usr/bin/gcc",)]
    monkeypatch.setattr(compiler, "which", lambda _: None)
    assert compiler.targets() == ()
    monkeypatch.setattr(compiler, "find_spec", lambda _: True)
    assert {target.platform for target in compiler.targets()} >= {"x86_64-linux", "x86_64-windows", "aarch64-darwin"}


def test_the_same_map_gives_the_same_sources(whole, unit_file, tmp_path, monkeypatch):
    monkeypatch.setattr(archive, "targets", lambda: ())
    with pytest.warns(UserWarning, match="no C compiler"):
        (again,) = sf.export(whole, "fmu", tmp_path / "pump.fmu")
    with zipfile.ZipFile(unit_file) as one, zipfile.ZipFile(again) as other:
        assert all(one.read(name) == other.read(name) for name in other.namelist())


@pytest.mark.parametrize(("name", "identifier"), [("pump", "pump"), ("A4-90 é", "A4_90__"), ("90 mL", "map_90_mL")])
def test_identifiers_are_words_of_c(name, identifier):
    assert model_identifier(name) == identifier
