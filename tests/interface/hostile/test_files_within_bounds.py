"""Devices, pipes, links, sizes and nesting: refused in words, in time, and without memory."""

import os
import zipfile

import h5py
import numpy as np
import pytest

from diagnosis.recording.tables.read import read_columns
from diagnosis.recording.tables.table import TableFault, TableSource
from reynolds.errors import FilmInputError
from reynolds.numerics.cache import CacheOrigin, kept
from reynolds.numerics.files import UnfitFile, inside, read_json, read_text
from reynolds.numerics.hdf5 import expect_contained
from reynolds.numerics.npz import read_npz
from swashfilm.__main__ import main
from swashfilm.output.data.files import read_netcdf
from system import InputFaults
from system.inputs.csv_table import read_csv_text
from system.inputs.toml_table import parse_toml, read_toml
from system.inputs.units import QuantityError


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a = " + "[" * 100_000 + "]" * 100_000, "nested"),
        ("a = " + "{b=" * 3000 + "1" + "}" * 3000, "nested"),
        ("a = " + "[" * 30 + "]" * 30, "nested"),
        (".".join(["a"] * 20_000) + " = 1", "a key of more than"),
        ("[" + " . ".join(['"a"'] * 500) + "]", "a key of more than"),
        ("a = " + "9" * 5000, "thousands of digits"),
        ("a = 10000000000000000000", "64 bits"),
        ("a = [1, [2, 99999999999999999999]]", "64 bits"),
    ],
)
def test_toml_beyond_any_file_is_refused(tmp_path, text, found):
    (tmp_path / "a.toml").write_text(f"format = 1\n{text}\n", "utf-8")
    with pytest.raises(InputFaults, match=found):
        read_toml(tmp_path / "a.toml")


def test_toml_of_usual_depth_is_read():
    text = 'a.b.c = 9223372036854775807\n"x.y" = [[[1.5]]]\nz = "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s"\n'
    assert parse_toml(text) == {"a": {"b": {"c": 2**63 - 1}}, "x.y": [[[1.5]]], "z": text.split('"')[3]}


def test_devices_pipes_and_folders_are_no_files(tmp_path, capsys):
    os.mkfifo(tmp_path / "pipe.toml")
    (tmp_path / "circle.toml").symlink_to("circle.toml")
    for path in ("/dev/zero", "/dev/null", tmp_path / "pipe.toml", tmp_path / "circle.toml"):
        assert main(["check", str(path)]) == 2
        assert str(path) in capsys.readouterr().err
    for path in (tmp_path / "pipe.csv", tmp_path / "pipe.mf4"):
        os.mkfifo(path)
        with pytest.raises(TableFault, match="a pipe"):
            read_columns(TableSource(path))
    with pytest.raises(QuantityError, match="a pipe"):
        read_csv_text(tmp_path / "pipe.csv", "a table")


def test_a_file_larger_than_any_is_not_read(tmp_path):
    with (tmp_path / "large.toml").open("wb") as file:
        file.truncate(10**12)
    with pytest.raises(UnfitFile, match="1000000 MB"):
        read_text(tmp_path / "large.toml")


@pytest.mark.parametrize(
    "text", ["NaN", '{"a": NaN}', '{"a": 1e999}', '{"a": ' + "9" * 400 + "}", "[1]", "{", "[" * 90_000]
)
def test_json_that_no_run_writes_is_refused(tmp_path, text):
    (tmp_path / "a.json").write_text(text, "utf-8")
    with pytest.raises(ValueError, match=r"."):
        read_json(tmp_path / "a.json")


class Runs:
    """Object that would be run by unpickling it."""

    def __reduce__(self):
        return os.system, ("touch canary",)


def test_arrays_that_are_not_those_written_are_computed_anew(tmp_path):
    assert kept("a", lambda: {"x": np.ones(2), "y": np.zeros(3)}, tmp_path).origin is CacheOrigin.COMPUTED
    whole = read_npz(tmp_path / "a.npz")
    for changed in ({**whole, "x": np.zeros(2)}, {name: one for name, one in whole.items() if name != "y"}):
        np.savez(tmp_path / "a.npz", **changed)
        assert kept("a", lambda: {"x": np.ones(2), "y": np.zeros(3)}, tmp_path).origin is CacheOrigin.RECOMPUTED
    assert kept("a", dict, tmp_path).origin is CacheOrigin.CACHE


@pytest.mark.parametrize("what", ["object", "nan", "text", "truncated", "bomb"])
def test_broken_arrays_are_computed_anew_and_run_nothing(tmp_path, monkeypatch, what):
    monkeypatch.chdir(tmp_path)
    values = {"object": np.array([Runs()], dtype=object), "nan": np.array([np.nan]), "text": np.array(["a"])}
    np.savez(tmp_path / "a.npz", x=values.get(what, np.ones(100)))
    if what == "truncated":
        (tmp_path / "a.npz").write_bytes((tmp_path / "a.npz").read_bytes()[:-80])
    if what == "bomb":
        with zipfile.ZipFile(tmp_path / "a.npz", "w", zipfile.ZIP_DEFLATED) as file:
            file.writestr("x.npy", bytes(300_000_000))
    with pytest.raises((ValueError, UnfitFile)):
        read_npz(tmp_path / "a.npz")
    found = kept("a", lambda: {"x": np.ones(2)}, tmp_path)
    assert found.origin is CacheOrigin.RECOMPUTED
    assert kept("a", lambda: {}, tmp_path).arrays["x"].tolist() == [1.0, 1.0]
    assert [path.name for path in tmp_path.iterdir()] == ["a.npz"]


def test_a_cache_that_cannot_be_written_is_told_with_its_place(tmp_path):
    (tmp_path / "a.npz").mkdir()
    with pytest.raises(FilmInputError, match=r"a\.npz: .*directory; expected a file"):
        kept("a", lambda: {"x": np.ones(2)}, tmp_path)


@pytest.mark.parametrize(("at", "size"), [(16, 16), (16, 200), (24, 0)])
def test_a_broken_heap_of_texts_ends(tmp_path, at, size):
    with h5py.File(tmp_path / "a.nc", "w") as file:
        file["x"] = np.array(["speed", "torque"], dtype=h5py.string_dtype())
        file["y"] = np.ones(3)
    data = bytearray((tmp_path / "a.nc").read_bytes())
    begin = data.index(b"GCOL") + at
    data[begin : begin + max(size, 8)] = bytes(size) if size else b"\xf0" + b"\xff" * 7
    expect_contained(tmp_path / "a.nc")
    (tmp_path / "a.nc").write_bytes(data)
    (tmp_path / "a.mat").write_bytes(data)
    with pytest.raises(InputFaults, match=r"a broken heap"):
        read_netcdf(tmp_path / "a.nc")
    with pytest.raises(TableFault, match=r"a broken heap"):
        read_columns(TableSource(tmp_path / "a.mat"))


def test_hdf5_reaches_no_other_file(tmp_path):
    secret = str(tmp_path / "secret.h5")
    with h5py.File(secret, "w") as file:
        file["x"] = np.ones(3)
    for ending, put in (
        ("linked", lambda file: file.__setitem__("x", h5py.ExternalLink(secret, "/x"))),
        ("circular", lambda file: file.__setitem__("x", h5py.SoftLink("/x"))),
        ("raw", lambda file: file.create_dataset("x", (3,), external=[(secret, 0, 24)], dtype="f8")),
        ("huge", lambda file: file.create_dataset("x", (10**6, 10**6), dtype="f8", chunks=(100, 100))),
    ):  # fmt: skip
        with h5py.File(tmp_path / f"{ending}.nc", "w") as file:
            put(file)
        with pytest.raises(InputFaults, match=r"link|another file|more than"):
            read_netcdf(tmp_path / f"{ending}.nc")
        (tmp_path / f"{ending}.mat").write_bytes((tmp_path / f"{ending}.nc").read_bytes())
        with pytest.raises(TableFault, match=r"link|another file|more than"):
            read_columns(TableSource(tmp_path / f"{ending}.mat"))


def test_a_name_leads_to_no_file_outside(tmp_path):
    (tmp_path / "run").mkdir()
    (tmp_path / "secret.txt").write_text("precious")
    (tmp_path / "run" / "link.txt").symlink_to(tmp_path / "secret.txt")
    for name in ("../secret.txt", str(tmp_path / "secret.txt"), "link.txt", "a\0b"):
        with pytest.raises(UnfitFile, match="outside"):
            inside(tmp_path / "run", name)


def test_a_workbook_that_unpacks_to_more_than_memory_holds_is_refused(tmp_path):
    from openpyxl import Workbook

    book = Workbook()
    book.active.append(["speed", "torque"])
    book.active.append([1.0, 2.0])
    book.save(tmp_path / "good.xlsx")
    assert read_columns(TableSource(tmp_path / "good.xlsx")).rows == 1
    (tmp_path / "large.xlsx").write_bytes((tmp_path / "good.xlsx").read_bytes())
    with zipfile.ZipFile(tmp_path / "large.xlsx", "a", zipfile.ZIP_DEFLATED, compresslevel=1) as book:
        book.writestr("xl/media/image1.png", bytes(600_000_000))
    with pytest.raises(TableFault, match="MB unpacked"):
        read_columns(TableSource(tmp_path / "large.xlsx"))


def test_a_formula_of_a_logger_is_arithmetic(tmp_path):
    asammdf = pytest.importorskip("asammdf")
    from asammdf.blocks.conversion_utils import from_dict

    time = np.arange(5.0)
    for formula, refused in (("2*X+1", False), ("__import__('os').system('touch canary')", True)):
        signal = asammdf.Signal(samples=time, timestamps=time, name="speed", conversion=from_dict({"formula": formula}))
        with asammdf.MDF(version="4.10") as file:
            file.append([signal])
            file.save(tmp_path / "a.mf4", overwrite=True)
        if refused:
            with pytest.raises(TableFault, match="formula"):
                read_columns(TableSource(tmp_path / "a.mf4"))
        else:
            assert read_columns(TableSource(tmp_path / "a.mf4")).values["speed"].tolist() == [1.0, 3.0, 5.0, 7.0, 9.0]
