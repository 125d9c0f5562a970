"""Mutations of a good file: bytes, text, numbers, names, structure. The same seed gives the same file."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path
from random import Random

MARK = "swashfilm-hostile"
"""Word by which a page or a terminal shows that a file's text is interpreted as more than text."""
CANARY = "canary"
"""File that exists only where text or objects of a file have been run."""
MARKUP = (
    f"<script>window['{MARK}']=1</script>",
    f"</script><img src=x id={MARK} onerror=alert(1)>",
    f"</pre></details><b id={MARK}>",
    f'" onmouseover="alert(1)" id="{MARK}',
    f"{{{{ 7*7 }}}}{{% raw %}}<i id={MARK}>",
    f"\x1b]0;{MARK}\x07\x1b[31m",
    "$\\frac{1}{$ %s {0} \\input{x}",
    "\u202eevil\u0000name",
    f"]]><b id={MARK}>&unknown;",
)
CODE = (
    f"__import__('os').system('touch {CANARY}')",
    f"=cmd|'/c touch {CANARY}'!A1",
    f"$(touch {CANARY})`touch {CANARY}`",
    f"!!python/object/apply:os.system ['touch {CANARY}']",
    f"exec(\"open('{CANARY}','w')\")",
    "().__class__.__base__.__subclasses__()",
)
NUMBERS = (
    "nan", "inf", "-inf", "1e999", "-1e308", "1e-320", "0", "-0.0", "-1", "9" * 400, "9" * 5000, "1e29", "1e-29",
    "2147483648", "-9223372036854775809", "18446744073709551616", "0x7fffffff", "1_0", "1,5", "", "true", '"text"',
    "[]", "{}", "1" + "0" * 30, "٣",
)  # fmt: skip
PATHS = ("../../../../etc/passwd", "/etc/passwd", "/dev/zero", ".", "", "~", "http://127.0.0.1:9/x", "a" * 5000, "x\0y")
_NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
_WORD = re.compile(rb"[A-Za-z_][A-Za-z_0-9]{2,}")
_TEXT = re.compile(rb'"[^"\n]*"')

Mutation = Callable[[bytes, Random], bytes]


def truncated(data: bytes, draw: Random) -> bytes:
    """Return the first part of a file."""
    return data[: draw.randrange(len(data) or 1)]


def flipped(data: bytes, draw: Random) -> bytes:
    """Return a file with some bytes changed."""
    found = bytearray(data or b"\0")
    for _ in range(draw.choice((1, 1, 3, 10, 50))):
        found[draw.randrange(len(found))] = draw.randrange(256)
    return bytes(found)


def early_flipped(data: bytes, draw: Random) -> bytes:
    """Return a file with bytes of its first kilobyte changed, where headers and sizes are."""
    return flipped(data[:1024], draw) + data[1024:]


def large_words(data: bytes, draw: Random) -> bytes:
    """Return a file with whole numbers of 4 or 8 bytes made large."""
    found = bytearray(data)
    for _ in range(draw.choice((1, 2, 5))):
        size = draw.choice((4, 8))
        at = draw.randrange(0, max(len(found) - size, 1)) & ~3
        found[at : at + size] = draw.choice((b"\xff" * size, b"\x7f" + b"\xff" * (size - 1), bytes(size - 1) + b"\x7f"))
    return bytes(found)


def zeroed(data: bytes, draw: Random) -> bytes:
    """Return a file with a block of zeros."""
    at, size = draw.randrange(len(data) or 1), draw.choice((1, 16, 512, 4096))
    return data[:at] + bytes(size) + data[at + size :]


def repeated(data: bytes, draw: Random) -> bytes:
    """Return a file with a part of it twice."""
    at = draw.randrange(len(data) or 1)
    end = min(len(data), at + draw.choice((8, 200, 4000)))
    return data[:end] + data[at:end] + data[end:]


def foreign(data: bytes, draw: Random) -> bytes:
    """Return a file of another kind."""
    pickle = b"cos\nsystem\n(S'touch " + CANARY.encode() + b"'\ntR."
    return draw.choice((
        b"", b"\n", b"\0" * 100, pickle, b"\x89HDF\r\n\x1a\n" + bytes(100), b"PK\x03\x04" + data[:300], b"%PDF-1.7\n",
        b"\x1f\x8b\x08" + bytes(20), b"<?xml version='1.0'?><!DOCTYPE a [<!ENTITY b 'b'>]><a>&b;</a>",
        b"PAR1" + bytes(16) + b"PAR1", b"\x80\x04\x95" + pickle, b"{}", b"[]", b"null", b"\"text\"", b"format = 1\n",
        "format = 1\n".encode("utf-16"), bytes(range(256)) * 4,
    ))  # fmt: skip


def recoded(data: bytes, draw: Random) -> bytes:
    """Return a text in another encoding."""
    text = data.decode("latin-1")
    name = draw.choice(("utf-16", "utf-32", "utf-8-sig", "utf-7", "latin-1", "surrogate", "cp500", "cr", "overlong"))
    if name == "latin-1":
        return b"\xe9\xff" + data
    if name == "surrogate":
        return data[:40] + b"\xed\xa0\x80" + data[40:]
    if name == "overlong":
        return data[:40] + b"\xc0\xaf" + data[40:]
    if name == "cr":
        return data.replace(b"\n", b"\r")
    return text.encode(name, errors="replace")


def lines_changed(data: bytes, draw: Random) -> bytes:
    """Return a text with a line left out, twice, moved or joined."""
    lines = data.split(b"\n")
    at, to = draw.randrange(len(lines)), draw.randrange(len(lines))
    how = draw.randrange(4)
    if how == 0:
        del lines[at]
    elif how == 1:
        lines.insert(to, lines[at])
    elif how == 2:
        lines[at], lines[to] = lines[to], lines[at]
    else:
        lines[at] = lines[at] + lines[to]
    return b"\n".join(lines)


def number_changed(data: bytes, draw: Random) -> bytes:
    """Return a text with a number in it replaced."""
    return _replaced(_NUMBER, data, draw, draw.choice(NUMBERS).encode())


def word_changed(data: bytes, draw: Random) -> bytes:
    """Return a text with a word replaced: by markup, code, a path, a slip of spelling, or nothing."""
    choice = draw.choice((draw.choice(MARKUP), draw.choice(CODE), draw.choice(PATHS), "nmae", "", "é", "="))
    return _replaced(_WORD, data, draw, choice.encode("utf-8", "surrogatepass"))


def text_changed(data: bytes, draw: Random) -> bytes:
    """Return a text with a quoted text in it replaced."""
    new = draw.choice(
        (draw.choice(MARKUP), draw.choice(CODE), draw.choice(PATHS), draw.choice(NUMBERS) + " mm", "5 kg")
    )
    quoted = new.replace("\\", "\\\\").replace('"', '\\"').replace("\0", "\\u0000").replace("\x1b", "\\u001b")
    return _replaced(_TEXT, data, draw, f'"{quoted}"'.replace("\x07", "\\u0007").encode())


def nested(data: bytes, draw: Random) -> bytes:
    """Return a text with deep nesting: lists, tables, brackets, dotted names, a long line."""
    deep = draw.choice((60, 2000, 100_000))
    dotted = min(deep, 20_000)
    new = draw.choice((
        "[" * deep + "]" * deep, "(" * deep + "1" + ")" * deep, '{"a":' * deep + "1" + "}" * deep,
        ".".join(["a"] * dotted), "-" * deep + "1", "1" + "**9" * min(deep, 400), "x" * deep,
        "sin(" * 90 + "x" + ")" * 90,
        "\n[a" + ".b" * dotted + "]\n", "\nq = " + "[" * deep + "]" * deep + "\n", "{a=" * deep + "1" + "}" * deep,
    )).encode()  # fmt: skip
    return _replaced(draw.choice((_NUMBER, _WORD, _TEXT)), data, draw, new)


def doubled(data: bytes, draw: Random) -> bytes:
    """Return a file that is long: its lines, or its last one, many times."""
    lines = data.split(b"\n")
    block = draw.choice((data, lines[len(lines) // 2] + b"\n", b"\n", b"a" * 80, b","))
    return data + block * (draw.choice((200_000, 2_000_000)) // max(len(block), 1))


def _replaced(pattern: re.Pattern[bytes], data: bytes, draw: Random, new: bytes) -> bytes:
    places = [match.span() for match in pattern.finditer(data)]
    if not places:
        return data + new
    start, end = draw.choice(places)
    return data[:start] + new + data[end:]


BINARY: tuple[Mutation, ...] = (truncated, flipped, early_flipped, large_words, zeroed, repeated, foreign)
TEXT: tuple[Mutation, ...] = (
    truncated, flipped, foreign, recoded, lines_changed, lines_changed, number_changed, number_changed, number_changed,
    word_changed, word_changed, text_changed, text_changed, nested, doubled,
)  # fmt: skip


def placed(path: Path, draw: Random, secret: Path) -> str:
    """Replace the file by another object or a link; return its name.

    secret: a file outside, which a link points to.
    """
    path.unlink()
    what = draw.choice(
        ("nothing", "folder", "link to itself", "link outside", "endless device", "pipe", "empty device")
    )
    if what == "folder":
        path.mkdir()
    elif what == "link to itself":
        path.symlink_to(path.name)
    elif what == "link outside":
        path.symlink_to(secret)
    elif what == "endless device":
        path.symlink_to("/dev/zero")
    elif what == "empty device":
        path.symlink_to("/dev/null")
    elif what == "pipe":
        os.mkfifo(path)
    return what
