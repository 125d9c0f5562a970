"""Files read within bounds and written whole: limits on names and sizes, and safety against interruption."""

from __future__ import annotations

import errno
import json
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from math import isfinite
from pathlib import Path
from typing import Any

LARGEST_TEXT = 10_000_000
"""Largest size of a file written by a person, bytes."""
LARGEST_DATA = 500_000_000
"""Largest size of a file written by a program or a logger, bytes."""
LARGEST_CELLS = 30_000_000
"""Most numbers of a file of data, in all its columns."""
_WHOLE_DIGITS = 19
_KINDS = {
    stat.S_ISDIR: "a folder", stat.S_ISFIFO: "a pipe", stat.S_ISCHR: "a device", stat.S_ISBLK: "a device",
    stat.S_ISSOCK: "a socket",
}  # fmt: skip


REFUSED_BY_DISK = frozenset({
    errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EACCES, errno.EPERM, errno.EIO, errno.EMFILE,
    errno.ENFILE, errno.ENAMETOOLONG,
})  # fmt: skip
"""Reasons in the disk, the folder or their permissions for which a file cannot be written."""


class UnfitFile(OSError):
    """A file that is not read: a device, a pipe, or one that is too large; `strerror` says which."""

    def __init__(self, path: Path, what: str) -> None:
        super().__init__(None, what, str(path))

    def __str__(self) -> str:
        return str(self.strerror)


def expect_regular(path: Path, largest: int = LARGEST_DATA) -> None:
    """Raise OSError for a file that is absent, UnfitFile for a device, a pipe, a folder, and more than `largest` bytes.

    Reading a device or a pipe may never end.
    """
    status = path.stat()
    for is_kind, words in _KINDS.items():
        if is_kind(status.st_mode):
            raise UnfitFile(path, f"{words}, not a file")
    if status.st_size > largest:
        raise UnfitFile(path, f"{status.st_size / 1e6:.0f} MB, more than {largest / 1e6:.0f} MB")


def is_file(path: Path) -> bool:
    """Return True for a file that can be read to its end; False also for an invalid name."""
    try:
        return stat.S_ISREG(path.stat().st_mode)
    except (OSError, ValueError):  # ValueError: a name with a zero byte
        return False


def read_bounded(path: Path, largest: int = LARGEST_TEXT) -> bytes:
    """Return the content of a file; raise as `expect_regular`."""
    expect_regular(path, largest)
    return path.read_bytes()


def read_text(path: Path, largest: int = LARGEST_TEXT) -> str:
    """Return the text of a file in UTF-8, a byte order mark left out, lines ended by newlines.

    Raises as `expect_regular`, and UnicodeDecodeError.
    """
    text = read_bounded(path, largest).decode("utf-8-sig")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def read_json(path: Path) -> dict[str, Any]:
    """Return the table of a JSON file that a program wrote.

    Raises as `read_text`, and ValueError for text that is no JSON, nested too deep, or with a number that is not
    finite or of more than 64 bits.
    """
    try:
        found = json.loads(
            read_text(path, LARGEST_DATA), parse_constant=_no_number, parse_float=_finite, parse_int=_whole
        )
    except RecursionError:
        raise ValueError("nested too deep") from None
    if not isinstance(found, dict):
        raise ValueError(f"{type(found).__name__} in place of a table")
    return found


@contextmanager
def replaced(path: Path) -> Iterator[Path]:
    """Yield a name beside `path` to write to; afterwards the file is at `path`, in place of any other or of a link.

    After an error, or a stop at any moment, `path` is as it was: no reader finds a partial file.
    """
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    beside.unlink(missing_ok=True)
    try:
        yield beside
        os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def write_whole(path: Path, data: bytes) -> None:
    """Write a file as `replaced` does: a pipe, a device or a link of that name is replaced, never written to."""
    with replaced(path) as beside:
        beside.write_bytes(data)


@contextmanager
def created(path: Path) -> Iterator[Path]:
    """Yield a name beside `path` to write to; afterwards the file is at `path`.

    Raises FileExistsError where there is a file, or a link, of that name by then: none is overwritten.
    """
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    beside.unlink(missing_ok=True)
    try:
        yield beside
        _linked(beside, path)
    finally:
        beside.unlink(missing_ok=True)


def expect_room(folder: Path, size: int) -> None:
    """Raise OSError where a file of this size, in bytes, cannot be written into a folder."""
    place = folder / f".room.{os.getpid()}.part"
    try:
        with place.open("wb") as file:
            if hasattr(os, "posix_fallocate"):
                os.posix_fallocate(file.fileno(), 0, size)
            else:
                file.truncate(size)
    except OSError as reason:
        raise OSError(reason.errno, os.strerror(reason.errno or errno.ENOSPC), str(folder)) from None
    finally:
        place.unlink(missing_ok=True)


def append_whole(path: Path, data: bytes) -> None:
    """Add lines to the end of a file: all of them or, on a full disk, none.

    They begin on a line of their own. A program that is killed on the way may leave an unfinished last line. Raises
    OSError. Simultaneous data of several programs follow one another.
    """
    with path.open("ab+", buffering=0) as file:
        before = file.seek(0, os.SEEK_END)
        if before:
            file.seek(-1, os.SEEK_END)
            data = data if file.read(1) == b"\n" else b"\n" + data
        try:
            written = file.write(data)
            if written != len(data):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))
        except OSError:
            file.truncate(before)
            raise


def json_lines(path: Path) -> list[dict[str, Any]]:
    """Objects of a file of one JSON object a line, none where there is no file.

    A line that a killed program left unfinished is left out: it lacks its closing brace.
    """
    found = []
    for line in path.read_text("utf-8").splitlines() if path.is_file() else ():
        with suppress(json.JSONDecodeError):
            found.append(json.loads(line))
    return found


def _linked(beside: Path, path: Path) -> None:
    """Give a file its name; raise FileExistsError where the name is taken."""
    try:
        os.link(beside, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without links
        with path.open("xb") as file:
            file.write(beside.read_bytes())


def inside(folder: Path, name: str) -> Path:
    """Return the path of a file of a folder by a name that a file in it states.

    Raises UnfitFile for a name, or a link, that leads out of the folder.
    """
    if not leads_inside(folder, name):
        raise UnfitFile(folder / name, "outside its folder")
    return folder / name


def leads_inside(folder: Path, name: str) -> bool:
    """Return True for a name, or a link of that name, that does not lead out of the folder."""
    try:
        return (folder / name).resolve().is_relative_to(folder.resolve())
    except (OSError, ValueError, RuntimeError):  # a zero byte, or links in a circle
        return False


def _no_number(name: str) -> float:
    raise ValueError(f"{name} in place of a number")


def _finite(text: str) -> float:
    if not isfinite(number := float(text)):
        raise ValueError(f"{text[:40]} in place of a number")
    return number


def _whole(text: str) -> int:
    if len(text) > _WHOLE_DIGITS + 1:
        raise ValueError(f"a whole number of {len(text)} digits")
    return int(text)
