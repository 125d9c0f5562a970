"""Tables of recordings: what was written by another program is read to the last bit, or refused with words."""

import logging

import h5py
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.io import savemat

from diagnosis.recording.tables.read import read_columns
from diagnosis.recording.tables.table import TableFault, TableSource

SPEED = np.array([1001.4, 998.25, 1500.0, 2100.5, -3.0])
TORQUE = np.array([28.968, 53.0, np.nan, 1e-3, 7.25e2])
NUMBERS = st.floats(allow_nan=False, allow_infinity=False, width=64)


def _read(path, **form):
    return read_columns(TableSource(path, **form))


def _are_same(columns, names=("speed", "torque")):
    speed, torque = (columns.values[name] for name in names)
    return np.array_equal(speed, SPEED) and np.array_equal(torque, TORQUE, equal_nan=True)


@pytest.mark.parametrize(
    ("separator", "decimal"), [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), ("|", ",")]
)
def test_text_tells_its_own_form(tmp_path, separator, decimal):
    cells = [["speed", "torque"], *([repr(float(a)), repr(float(b))] for a, b in zip(SPEED, TORQUE, strict=True))]
    rows = [separator.join(cell.replace(".", decimal) for cell in row) for row in cells]
    path = tmp_path / "steady.csv"
    path.write_text("\n".join(rows), encoding="utf-8-sig")
    assert _are_same(_read(path))


@pytest.mark.parametrize(("decimal", "thousands"), [(",", "."), (".", ",")])
@pytest.mark.parametrize("separator", [";", "\t"])
def test_whole_numbers_may_part_their_thousands_too(tmp_path, separator, decimal, thousands):
    """A speed of 1.500 beside one of 950, in any place of the table, also where no flow has a decimal sign below it."""
    path = tmp_path / "steady.csv"
    rows = [
        ("speed", "Q", "V"),
        ("1T500", "1D5", "1T499D8"),
        ("2T000", "90D25", "12"),
        ("950", "-", "1T234T567"),
        ("0", "3", "over"),
    ]
    text = "\n".join(separator.join(row) for row in rows)
    path.write_text(text.replace("D", decimal).replace("T", thousands), "utf-8")
    columns = _read(path)
    assert np.array_equal(columns.values["speed"], [1500.0, 2000.0, 950.0, 0.0])
    assert np.array_equal(columns.values["Q"], [1.5, 90.25, np.nan, 3.0], equal_nan=True)
    assert np.array_equal(columns.values["V"], [1499.8, 12.0, 1234567.0, np.nan], equal_nan=True)
    assert [note for note in columns.notes if "no number" in note] == [
        "column 'V': 1 cells that are no number taken as gaps (over)"
    ]


@pytest.mark.parametrize(
    ("cells", "numbers"),
    [
        (["1.500", "1.5", "950"], [np.nan, np.nan, 950.0]),
        (["1.500", "12345", "950"], [np.nan, 12345.0, 950.0]),
        (["0.500", "1.500", "950"], [np.nan, np.nan, 950.0]),
    ],
)
def test_what_does_not_part_thousands_throughout_is_no_number(tmp_path, cells, numbers):
    """A point in a table with decimal commas: no cell is guessed, and a note names them."""
    path = tmp_path / "steady.csv"
    path.write_text("\n".join(["speed;Q;p", *(f"{cell};10,5;3,25" for cell in cells)]), "utf-8")
    columns = _read(path)
    assert np.array_equal(columns.values["speed"], numbers, equal_nan=True)
    assert any("no number" in note and "1.500" in note for note in columns.notes)


@pytest.mark.parametrize(
    ("rows", "flow"),
    [
        ('Q,p\n"1,500","12,5"\n"2,250","13,5"\n950,14', [np.nan, np.nan, 950.0]),
        ('Q,p\n"1,500",12.5\n"2,250",13.5\n950,14', [1500.0, 2250.0, 950.0]),
        ('Q,p\n"1,500","1,250"\n"2,250","1,375"\n"3,125","1,500"', [np.nan] * 3),
    ],
)
def test_quoted_cells_part_thousands_where_the_table_has_no_other_decimal_sign(tmp_path, rows, flow):
    """Commas part the cells: a quoted comma is a decimal sign in other cells, parts thousands, or tells neither."""
    path = tmp_path / "steady.csv"
    path.write_text(rows, "utf-8")
    assert np.array_equal(_read(path).values["Q"], flow, equal_nan=True)


def test_loggers_put_lines_above_and_units_below_the_head(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text(
        "Bench 4\nprinted,2026-01-02\n\nspeed,torque,p\nrpm,N m,bar\n1500,2.5,over\n1501,2.6,3\n1502,,4\n", "utf-8"
    )
    columns = _read(path)
    assert np.array_equal(columns.values["speed"], [1500.0, 1501.0, 1502.0])
    assert np.array_equal(columns.values["p"], [np.nan, 3.0, 4.0], equal_nan=True)
    told = " ".join(columns.notes)
    assert "2 rows above the head" in told
    assert "rpm" in told
    assert "over" in told
    path.write_text("Bench 4\nspeed,torque\n1500,2.5\n1501,2.6\n", "utf-8")
    assert "1 row above the head left out" in _read(path).notes


def test_titles_of_groups_above_the_head_are_no_head(tmp_path):
    path = tmp_path / "report.csv"
    path.write_text("Bench 4,,,\nDrive,,Flows,\nspeed,torque,Q1,Q2\nrpm,N m,L/min,L/min\n1500,2.5,1,2\n1501,2.6,3,4\n")
    columns = _read(path)
    assert list(columns.values) == ["speed", "torque", "Q1", "Q2"]
    assert columns.units == {"speed": "rpm", "torque": "N m", "Q1": "L/min", "Q2": "L/min"}
    assert np.array_equal(columns.values["Q2"], [2.0, 4.0])


def test_sums_and_means_below_the_readings_are_none(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("point;speed\nP1;1500\nP2;1501\n\nMean:;1500.5\nStd Dev;0.7\n", "utf-8")
    columns = _read(path)
    assert np.array_equal(columns.values["speed"], [1500.0, 1501.0])
    assert any("2 rows below the readings left out: Mean:, Std Dev" in told for told in columns.notes)
    path.write_text("stroke;speed\nmin;1500\nmax;1501\n", "utf-8")
    assert _read(path).rows == 2


def test_times_become_seconds(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("when;speed\n2026-01-02 10:00:00;1\n2026-01-02 10:00:02.5;2\n", "utf-8")
    assert np.array_equal(_read(path).values["when"], [0.0, 2.5])


@pytest.mark.parametrize(
    ("stamps", "seconds"),
    [
        (("02.05.2024 23:59:59,500", "03.05.2024 00:00:01,000"), 1.5),
        (("2.5.2024 8:15:30", "2.5.2024 8:15:32"), 2.0),
        (("2024/05/02 08:15:30", "2024/05/03 08:15:30"), 86400.0),
        (("05/02/2024 11:59:59 PM", "05/03/2024 12:00:01 AM"), 2.0),  # of two orders that in which a day passes
        (("13/02/2024 08:15", "13/02/2024 08:16"), 60.0),
        (("02-May-2024 08:15:30", "02-May-2024 08:15:31"), 1.0),
        (("2024-05-02T08:15:30Z", "2024-05-02T08:15:31.5Z"), 1.5),
        (("2024-05-02 08:15:30.25+0200", "2024-05-02 08:15:31.25+0200"), 1.0),
        (("2024-10-27T02:59:59+02:00", "2024-10-27T02:00:00+01:00"), 1.0),
        (("23:59:59", "00:00:01"), 2.0),
        (("08:15:30,5", "08:15:31,0"), 0.5),
    ],
)
def test_stamps_of_loggers_become_seconds(tmp_path, stamps, seconds):
    path = tmp_path / "run.csv"
    path.write_text("when;speed\n" + "".join(f"{stamp};1500,5\n" for stamp in stamps), "utf-8")
    columns = _read(path)
    assert np.array_equal(columns.values["when"], [0.0, seconds])
    assert any("seconds from the first" in told for told in columns.notes)


def test_words_are_no_stamps(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("mode;speed\nMay;1\nauto 2;2\n", "utf-8")
    assert np.isnan(_read(path).values["mode"]).all()


@pytest.mark.parametrize("encoding", ["gb18030", "utf-16", "utf-8-sig"])
def test_chinese_heads_are_read_as_they_are_written(tmp_path, encoding):
    path = tmp_path / "run.csv"
    path.write_bytes("时间(s),转速(r/min),进口油温(℃)\n0,1500,25\n1,1501,26\n".encode(encoding))
    assert list(_read(path).values) == ["时间(s)", "转速(r/min)", "进口油温(℃)"]


def test_western_heads_in_latin_1_stay_what_they_are(tmp_path):
    path = tmp_path / "run.csv"
    path.write_bytes("Größe;Öltemp. [°C];Durchfluß\n1,5;40,2;3,5\n".encode("latin-1"))
    assert list(_read(path).values) == ["Größe", "Öltemp. [°C]", "Durchfluß"]


def test_thousands_may_be_parted(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("speed;torque\n1.499,8;40,6\n998,2;40,7\n", "utf-8")
    assert np.array_equal(_read(path).values["speed"], [1499.8, 998.2])
    path.write_text('speed;torque\n"1,499.8";40.6\n998.2;40.7\n', "utf-8")
    assert np.array_equal(_read(path).values["speed"], [1499.8, 998.2])


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", "empty"),
        ("1,2\n3,4\n", "no head"),
        ("speed,speed\n1,2\n", "twice"),
        ("speed,torque\n1,2\n1,2\n1,2,3\n", "3 cells"),
        ("speed,torque\n", "no row"),
        ("a\0b", "no text"),
    ],
)
def test_what_is_no_table_is_refused(tmp_path, text, found):
    path = tmp_path / "steady.csv"
    path.write_text(text, "utf-8")
    with pytest.raises(TableFault, match=found):
        _read(path)


def test_absent_and_foreign_files_are_refused(tmp_path):
    (tmp_path / "steady.csv").write_text("a,b\n1,2\n", "utf-8")
    with pytest.raises(TableFault) as absent:
        _read(tmp_path / "stedy.csv")
    assert absent.value.nearest.endswith("steady.csv")
    (tmp_path / "steady.docx").write_bytes(b"")
    with pytest.raises(TableFault, match="docx"):
        _read(tmp_path / "steady.docx")
    for ending in ("mat", "xlsx", "parquet", "tdms", "mf4"):
        (tmp_path / f"broken.{ending}").write_bytes(b"no such thing" * 40)
        with pytest.raises(TableFault):
            _read(tmp_path / f"broken.{ending}")


@settings(max_examples=40, deadline=None)
@given(
    rows=st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS), min_size=1, max_size=6),
    form=st.sampled_from([(",", "."), (";", ","), (";", "."), ("\t", ",")]),
)
def test_any_numbers_come_back_from_text(tmp_path_factory, rows, form):
    separator, decimal = form
    path = tmp_path_factory.mktemp("fuzz") / "t.csv"
    lines = ["a b" + separator + "c" + separator + "d"]
    lines += [separator.join(repr(number).replace(".", decimal) for number in row) for row in rows]
    path.write_text("\n".join(lines), "utf-8")
    columns = _read(path, separator=separator, decimal=decimal)
    assert np.array_equal(np.stack([columns.values[k] for k in ("a b", "c", "d")], axis=1), rows)


@settings(max_examples=60, deadline=None)
@given(text=st.text(alphabet="1,;.\t\n ae-\"'#", max_size=60))
def test_any_text_is_read_or_refused(tmp_path_factory, text):
    path = tmp_path_factory.mktemp("fuzz") / "t.csv"
    path.write_text(text, "utf-8", newline="")
    try:
        columns = _read(path)
    except TableFault:
        return
    assert columns.rows > 0


@pytest.mark.parametrize("struct", [False, True])
def test_matlab_vectors_and_structs(tmp_path, struct):
    data = {"speed": SPEED, "torque": TORQUE[:, None]}
    savemat(tmp_path / "a.mat", {"run": data, "note": "x"} if struct else {**data, "k": 3.0})
    assert _are_same(_read(tmp_path / "a.mat", variable="run" if struct else ""))
    if struct:
        with pytest.raises(TableFault, match="no vector") as plain:
            _read(tmp_path / "a.mat")
        assert plain.value.nearest == "run"
        with pytest.raises(TableFault, match="ruin"):
            _read(tmp_path / "a.mat", variable="ruin")


def test_matlab_matrix_columns_are_numbered(tmp_path):
    savemat(tmp_path / "a.mat", {"M": np.stack([SPEED, TORQUE], axis=1)})
    assert _are_same(_read(tmp_path / "a.mat", variable="M"), ("M:1", "M:2"))


def test_matlab_v73(tmp_path):
    with h5py.File(tmp_path / "a.mat", "w", userblock_size=512) as file:
        run = file.create_group("run")
        run["speed"], run["torque"] = SPEED[None, :], TORQUE[None, :]  # as MATLAB stores columns
    with (tmp_path / "a.mat").open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(128))
    assert _are_same(_read(tmp_path / "a.mat", variable="run"))


def test_matlab_objects_are_refused_with_the_way_out(tmp_path):
    with h5py.File(tmp_path / "a.mat", "w") as file:
        file.create_dataset("T", data=np.zeros(6)).attrs["MATLAB_object_decode"] = 3
    with pytest.raises(TableFault, match="object") as refused:
        _read(tmp_path / "a.mat")
    assert "table2struct" in refused.value.nearest


def test_workbook(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "points"
    sheet.append(["speed", "torque"])
    for speed, torque in zip(SPEED, TORQUE, strict=True):
        sheet.append([float(speed), None if np.isnan(torque) else float(torque)])
    book.save(tmp_path / "a.xlsx")
    assert _are_same(_read(tmp_path / "a.xlsx"))
    book.create_sheet("notes")
    book.save(tmp_path / "a.xlsx")
    assert _are_same(_read(tmp_path / "a.xlsx", sheet="points"))
    with pytest.raises(TableFault, match="points, notes"):
        _read(tmp_path / "a.xlsx")


def test_parquet(tmp_path):
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow import parquet

    when = np.array([0, 1, 2, 3, 4], dtype="datetime64[s]")
    heads = {"speed": SPEED, "torque": TORQUE, "torque [lbf ft]": TORQUE}
    table = pyarrow.table({**heads, "name": list("abcde"), "when": when})
    parquet.write_table(table, tmp_path / "a.parquet")
    columns = _read(tmp_path / "a.parquet")
    assert _are_same(columns)
    assert columns.units == {"torque [lbf ft]": "lbf ft"}
    assert np.array_equal(columns.values["when"], np.arange(5.0))
    assert "'name' holds no numbers" in " ".join(columns.notes)


def _tdms(path, properties):
    nptdms = pytest.importorskip("nptdms")
    speed = nptdms.ChannelObject("run", "speed", SPEED, properties={"wf_increment": 0.5, **properties})
    with nptdms.TdmsWriter(path) as file:
        file.write_segment([speed, nptdms.ChannelObject("run", "torque", TORQUE)])


def test_tdms(tmp_path):
    _tdms(tmp_path / "a.tdms", {"wf_start_offset": 0.0, "wf_samples": 5, "unit_string": "1/min"})
    columns = _read(tmp_path / "a.tdms")
    assert _are_same(columns)
    assert columns.units == {"speed": "1/min"}
    assert np.array_equal(columns.values["time"], 0.5 * np.arange(5))


def test_tdms_scale_that_would_leave_raw_counts_is_refused(tmp_path, caplog):
    caplog.set_level(logging.CRITICAL)
    _tdms(tmp_path / "a.tdms", {"NI_Number_Of_Scales": 1, "NI_Scale[0]_Scale_Type": "Reciprocal"})
    with pytest.raises(TableFault, match="Reciprocal"):
        _read(tmp_path / "a.tdms")


def test_mdf(tmp_path):
    asammdf = pytest.importorskip("asammdf")
    time = 0.1 * np.arange(5)
    known = (("speed", SPEED, "rpm"), ("torque", TORQUE, ""))
    signals = [asammdf.Signal(samples=x, timestamps=time, name=name, unit=unit) for name, x, unit in known]
    with asammdf.MDF(version="4.10") as file:
        file.append(signals)
        file.save(tmp_path / "a.mf4")
    columns = _read(tmp_path / "a.mf4")
    assert _are_same(columns)
    assert columns.units["speed"] == "rpm"
    assert np.allclose(columns.values["time"], time)
