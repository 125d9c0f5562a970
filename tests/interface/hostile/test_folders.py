"""Run folders on a full disk, in a read-only folder, with links in them, and stopped at any moment."""

import errno
import json
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from reynolds.errors import NotConverged
from reynolds.numerics.files import append_whole, created, replaced
from swashfilm.__main__ import main
from swashfilm.console.schemas import write_new
from swashfilm.output.answer import Answer
from swashfilm.output.page import expect_files, keep_pictures, kept_pictures, kept_text, read_summary, write_page
from swashfilm.output.run_folder import run_folder, write_json
from system import InputFaults
from system.work.kept_results import KeptPoints
from system.work.tasks import PartOutcome, PartStatus

NOBODY = 65534


def failing(folder, number, words=""):
    """A run whose last file the disk does not take."""
    with run_folder("one", folder) as place:
        (place / "summary.json").write_text("{}")
        raise OSError(number, words or os.strerror(number), str(place / "results.nc"))


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EFBIG, errno.EROFS, errno.EACCES])
def test_a_disk_that_takes_no_more_is_told_and_nothing_remains(tmp_path, number):
    with pytest.raises(InputFaults, match=r"results\.nc") as told:
        failing(tmp_path / "mine", number)
    assert os.strerror(number) in str(told.value)
    assert not list(tmp_path.iterdir())


def test_another_fault_of_the_system_is_none_of_the_disk(tmp_path):
    with pytest.raises(FileNotFoundError):
        failing(tmp_path / "mine", errno.ENOENT)


def test_points_that_were_kept_are_told_on_a_full_disk(tmp_path):
    def run() -> None:
        with run_folder("one", tmp_path / "mine") as place:
            (place / "points").mkdir()
            (place / "points" / "a.json").write_text("{}")
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with pytest.raises(InputFaults) as told:
        run()
    assert "--resume" in "".join(told.value.__notes__)
    assert (tmp_path / "mine.partial" / "points" / "a.json").is_file()


def test_a_kept_point_that_was_changed_is_done_anew(tmp_path):
    store = KeptPoints(tmp_path)
    store.put(PartOutcome("a", PartStatus.SOLVED, "", {"flow": [1.5, 2.0], "name": "x"}, 1.0, "here"))
    assert store.get("a") is not None
    text = (tmp_path / "a.json").read_text()
    for changed in (text.replace("1.5", "1.6"), text.replace("1.5", '"1.5"'), text[:-20], text.replace("2.0", "NaN")):
        (tmp_path / "a.json").write_text(changed)
        assert store.get("a") is None


def test_a_result_that_is_not_finite_is_none(tmp_path):
    def run() -> None:
        with run_folder("one", tmp_path / "mine") as place:
            write_json(place / "summary.json", {"flow": {"case_m3_per_s": [1.0, math.inf]}})

    with pytest.raises(NotConverged, match=r"flow\.case_m3_per_s is inf"):
        run()
    assert not list(tmp_path.iterdir())


def test_a_file_is_whole_or_as_it_was(tmp_path):
    place = tmp_path / "a.json"
    place.write_text("old")

    def stopped() -> None:
        with replaced(place) as beside:
            beside.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        stopped()
    assert [path.name for path in tmp_path.iterdir()] == ["a.json"]
    assert place.read_text() == "old"
    with replaced(place) as beside:
        beside.write_text("new")
    assert place.read_text() == "new"


def test_a_new_file_takes_the_place_of_none(tmp_path):
    (tmp_path / "victim.txt").write_text("precious")
    (tmp_path / "new.toml").symlink_to("victim.txt")
    (tmp_path / "dangling.toml").symlink_to("nothing.txt")
    for name in ("new.toml", "dangling.toml", "victim.txt"):
        with pytest.raises(FileExistsError), created(tmp_path / name) as beside:
            beside.write_text("x")
    with pytest.raises(FileExistsError):
        write_new(tmp_path / "dangling.toml", "pump", "x = 1\n")
    assert (tmp_path / "victim.txt").read_text() == "precious"
    assert not (tmp_path / "nothing.txt").exists()


def test_a_row_is_added_whole_or_not_at_all(tmp_path):
    place = tmp_path / "a.csv"
    place.write_text("1, 2\n")
    append_whole(place, b"3, 4\n")
    code = (
        "import resource, sys; from pathlib import Path; from reynolds.numerics.files import append_whole\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (12, 12))\n"
        "try: append_whole(Path(sys.argv[1]), b'5, 6.12345\\n')\n"
        "except OSError: sys.exit(7)\n"
    )
    done = subprocess.run([sys.executable, "-c", code, str(place)], cwd=Path(__file__).parents[3], check=False)
    assert done.returncode == 7
    assert place.read_text() == "1, 2\n3, 4\n"


def in_read_only(folder: Path) -> int:
    """Exit code of a run into a folder that its user may not write to."""
    folder.chmod(0o555)
    if child := os.fork():
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    code = 1
    try:
        if os.geteuid() == 0:
            os.setuid(NOBODY)
        with run_folder("one", folder / "mine"):
            pass
    except InputFaults as told:
        code = 2 if "Permission denied" in str(told) else 1
    finally:
        os._exit(code)


def test_a_read_only_folder_is_told(tmp_path):
    for place in (tmp_path, *tmp_path.parents[:3]):
        place.chmod(place.stat().st_mode | 0o055)
    (tmp_path / "shut").mkdir()
    assert in_read_only(tmp_path / "shut") == 2


def finished(folder: Path) -> Path:
    """A folder with the least that a page takes."""
    folder.mkdir()
    (folder / "summary.json").write_text('{"kind": "film", "name": "one"}')
    return folder


def test_a_page_follows_no_link(tmp_path):
    run, victim = finished(tmp_path / "run"), tmp_path / "victim.txt"
    victim.write_text("precious")
    (run / "report.html").symlink_to(victim)
    expect_files(run, ["summary.json"], "a run")
    write_page(run, "page", answer=Answer((), "text", None, ""))
    assert victim.read_text() == "precious"
    assert not (run / "report.html").is_symlink()


def test_pictures_that_are_drawn_again_wait_for_no_pipe_and_follow_no_link(tmp_path):
    from matplotlib.figure import Figure

    run, victim = finished(tmp_path / "run"), tmp_path / "victim.txt"
    victim.write_text("precious")
    figure = Figure()
    figure.subplots().plot([0.0, 1.0], [0.0, 1.0])
    [drawn] = {path.name for path in _drawn(run, figure)} - {"losses.json", "losses-1.touch"}
    for name in ("losses.json", drawn):
        (run / "plots" / name).unlink()
    os.mkfifo(run / "plots" / "losses.json")
    (run / "plots" / drawn).symlink_to(victim)
    assert all(path.is_file() and not path.is_symlink() for path in _drawn(run, figure))
    assert victim.read_text() == "precious"


def _drawn(run, figure):
    assert list(keep_pictures(run, "losses", {"a line": figure})) == ["a line"]
    return list((run / "plots").iterdir())


def test_links_out_of_a_run_are_refused(tmp_path, capsys):
    run, secret = finished(tmp_path / "run"), tmp_path / "secret.txt"
    secret.write_text("precious")
    (run / "plots").mkdir()
    (run / "plots" / "losses.json").write_text('{"../../secret.txt": "caption"}')
    with pytest.raises(InputFaults, match="outside its folder"):
        kept_pictures(run, "losses")
    with pytest.raises(InputFaults, match="outside its folder"):
        kept_text(run, "../secret.txt")
    (run / "resolved.toml").symlink_to(secret)
    with pytest.raises(InputFaults, match="leads out of the folder"):
        read_summary(run)
    assert main(["report", str(run)]) == 2
    assert "resolved.toml" in capsys.readouterr().err


@pytest.mark.parametrize("text", ['{"kind": "film"', '{"kind": NaN}', '{"kind": ["film"]}', "[]", '{"kind": "film"}'])
def test_a_damaged_summary_is_told_by_its_file(tmp_path, capsys, text):
    run = finished(tmp_path / "run")
    (run / "summary.json").write_text(text)
    for name in ("resolved.toml", "results.nc"):
        (run / name).write_text("format = 1\n")
    assert main(["report", str(run)]) == 2
    assert str(run) in capsys.readouterr().err


def test_a_summary_without_a_key_is_told_by_its_places(tmp_path, capsys):
    run = tmp_path / "run"
    assert main(["run", "ref90", "--fidelity", "lumped", "-o", str(run)]) == 0
    path = run / "summary.json"
    summary = json.loads(path.read_text())
    del summary["efficiency"]
    path.write_text(json.dumps(summary | {"fidelity": 3}))
    capsys.readouterr()
    assert main(["report", str(run)]) == 2
    told = capsys.readouterr().err
    assert "2 faults" in told
    assert "'efficiency' is a required property" in told
    assert "summary.json fidelity\n    found:    3 is not of type 'string'" in told


MAP = ("map", "ref90", "--fidelity", "lumped", "--speeds", "1000..2000rpm:3", "--pressures", "10..30MPa:3",
       "--displacements", "0.5,1.0", "--check", "2", "--workers", "1")  # fmt: skip


@pytest.mark.long
def test_a_map_killed_at_any_moment_loses_no_kept_point(tmp_path):
    """Each start goes on from the points of the last; those that were whole when it was killed are not solved again."""
    command, known, resume = [sys.executable, "-m", "swashfilm", *MAP], 0, []
    for number in range(40):
        out = tmp_path / f"m{number}"
        run = subprocess.Popen([*command, *resume, "-o", str(out)], stderr=subprocess.PIPE, text=True)
        partial = out.with_name(f"{out.name}.partial") / "points"
        start = time.monotonic()
        while run.poll() is None and len(list(partial.glob("*.json"))) < known + 4 and time.monotonic() < start + 120.0:
            time.sleep(0.037 * (number % 3 + 1))
        if run.poll() is not None:
            break
        os.kill(run.pid, signal.SIGKILL)
        run.wait()
        assert not out.exists()
        if found := len(list(partial.glob("*.json"))):
            assert found >= known
            known, resume = found, ["--resume", str(partial.parent)]
    assert run.wait() == 0
    assert known >= 10
    read_summary(out)


@pytest.mark.long
def test_a_run_on_a_full_disk_leaves_nothing_half(tmp_path):
    """Files may grow to less and less: each run is whole, or told and gone."""
    for most in (40_000, 120_000, 400_000, 50_000_000):
        code = (
            "import resource, sys; from swashfilm.__main__ import main\n"
            f"resource.setrlimit(resource.RLIMIT_FSIZE, ({most}, {most}))\n"
            "sys.exit(main(sys.argv[1:]))\n"
        )
        words = ["run", "ref90", "--fidelity", "lumped", "-o", str(tmp_path / "r")]
        done = subprocess.run([sys.executable, "-c", code, *words], capture_output=True, text=True, check=False)
        left = [path.name for path in tmp_path.iterdir()]
        assert "Traceback" not in done.stderr
        if done.returncode:
            assert done.returncode == 2
            assert "File too large" in done.stderr
            assert left == []
        else:
            assert left == ["r"]
            read_summary(tmp_path / "r")
            return
    raise AssertionError("a run within 50 MB is whole")
