"""Mutations that keep a file's format: JSON values, arrays of NPZ, variables of HDF5, parts of a workbook."""

from __future__ import annotations

import io
import json
import math
import warnings
import zipfile
from random import Random
from typing import Any

import numpy as np

from .mutations import CANARY, CODE, MARKUP, PATHS, TEXT


class Runs:
    """Object whose unpickling leaves a file behind."""

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        import os

        return os.system, (f"touch {CANARY}",)


def json_value(data: bytes, draw: Random) -> bytes:
    """Return a JSON text with one of its values replaced, left out or renamed."""
    whole = json.loads(data)
    places: list[tuple[Any, Any]] = []

    def walk(node: Any) -> None:
        for key in list(node) if isinstance(node, dict) else range(len(node)):
            places.append((node, key))
            if isinstance(node[key], (dict, list)):
                walk(node[key])

    walk(whole)
    if not places:
        return b"[]"
    node, key = draw.choice(places)
    how = draw.randrange(8)
    if how == 0 and isinstance(node, dict):
        del node[key]
    elif how == 1 and isinstance(node, dict):
        node[draw.choice(MARKUP)] = node.pop(key)
    else:
        node[key] = draw.choice((
            None, math.nan, math.inf, -1, 0, 10**400, 1e308, True, "", [], {}, [[]], {"a": {}}, "text", [1, "a", None],
            *MARKUP, *CODE, *PATHS,
        ))  # fmt: skip
    text = json.dumps(whole)
    return text.replace("Infinity", draw.choice(("Infinity", "1e999"))).encode()


def arrays(data: bytes, draw: Random) -> bytes:
    """Return an NPZ with an array left out, of another shape or kind, of nan, pickled, or with a huge stated size."""
    with np.load(io.BytesIO(data)) as found:
        kept = {name: found[name] for name in found.files}
    name = draw.choice(sorted(kept))
    how = draw.randrange(8)
    old = kept[name]
    if how == 0:
        del kept[name]
    elif how < 6:
        kept[name] = (
            old.astype(str), np.full(old.shape, np.nan), old.ravel()[:1], np.array([Runs()], dtype=object),
            np.zeros((0, 3)),
        )[how - 1]  # fmt: skip
    else:
        kept[name] = np.full(old.shape, draw.choice((np.inf, -1.0, 1e300, 0.0)))
    out = io.BytesIO()
    np.savez(out, **kept)
    if how == 7:
        return _huge_member(out.getvalue(), f"{name}.npy")
    return out.getvalue()


def _huge_member(data: bytes, member: str) -> bytes:
    """Return an NPZ one of whose arrays states terabytes."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(out, "w") as new:
        for item in old.namelist():
            content = old.read(item)
            if item == member:
                head = io.BytesIO()
                stated = {"descr": "<f8", "fortran_order": False, "shape": (10**6, 10**6)}
                np.lib.format.write_array_header_1_0(head, stated)
                content = head.getvalue() + bytes(64)
            new.writestr(item, content)
    return out.getvalue()


def variables(data: bytes, draw: Random) -> bytes:
    """Return an HDF5 file with a variable left out, renamed, of nan, of another kind, huge, or linked outside."""
    import h5py

    out = io.BytesIO(data)
    with h5py.File(out, "r+") as file:
        names: list[str] = []
        file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
        name = draw.choice(names)
        old = file[name]
        how = draw.randrange(9)
        if how == 0:
            del file[name]
        elif how == 1:
            _again(file, name, np.full(old.shape, np.nan))
        elif how == 2:
            _again(file, name, np.array(["text"] * 3, dtype=h5py.string_dtype()))
        elif how == 3:
            del file[name]
            file.create_dataset(name, (10**6, 10**6), dtype="f8", chunks=(1000, 1000), compression="gzip")
        elif how == 4:
            del file[name]
            file[name] = h5py.ExternalLink("/etc/passwd", "/x")
        elif how == 5:
            del file[name]
            file[name] = h5py.SoftLink(f"/{name}")
        elif how == 6:
            _again(file, name, old[()].ravel()[:1])
        elif how == 7:
            for key in list(old.attrs):
                if key.isidentifier() and not key.isupper():
                    old.attrs[key] = draw.choice(MARKUP[:6])
            file.attrs["title"] = draw.choice(MARKUP[:6])
        else:
            file.move(name, draw.choice(MARKUP[:4]).replace("/", "|"))
    return out.getvalue()


def _again(file: Any, name: str, values: np.ndarray) -> None:
    del file[name]
    file[name] = values


def book_part(data: bytes, draw: Random) -> bytes:
    """Return a workbook with one of its parts mutated as text, left out, packed a thousandfold, or a bomb."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as new:
        names = old.namelist()
        changed, how = draw.choice(names), draw.randrange(6)
        sheet = next(name for name in names if "worksheets/sheet" in name)
        for name in names:
            content = old.read(name)
            if how == 0 and name == sheet:
                content = _far_cells(content, draw)
            elif how == 1 and name == changed:
                content = _bomb(content)
            elif how == 2 and name == changed:
                continue
            elif how == 3 and name == sheet:
                content = content.replace(b"</sheetData>", b"<row/>" * 10 + b" " * 40_000_000 + b"</sheetData>")
            elif how > 3 and name == changed:
                content = draw.choice(TEXT)(content, draw)
            with warnings.catch_warnings(action="ignore"):
                new.writestr(name, content)
    return out.getvalue()


def _far_cells(sheet: bytes, draw: Random) -> bytes:
    """Return a sheet with a cell in the last row and column, and a formula."""
    cell = draw.choice((
        b'<row r="1048576"><c r="XFD1048576"><v>1</v></c></row>',
        b'<row r="900"><c r="ZZZZZZ900"><v>1</v></c></row>',
        b'<row r="99999999999"><c r="A99999999999"><v>1</v></c></row>',
        f'<row r="3"><c r="A3"><f>{CODE[1]}</f><v>1</v></c></row>'.encode(),
        b'<row r="3"><c r="A3" t="s"><v>99999999</v></c></row>', b'<row r="3"><c r="A3" t="d"><v>x</v></c></row>',
    ))  # fmt: skip
    return sheet.replace(b"</sheetData>", cell + b"</sheetData>")


def _bomb(content: bytes) -> bytes:
    """Return XML with entities that grow a billionfold."""
    lines = "".join(f'<!ENTITY l{k} "{f"&l{k - 1};" * 10}">' for k in range(1, 10))
    head = f'<?xml version="1.0"?><!DOCTYPE b [<!ENTITY l0 "lol">{lines}]>'.encode()
    body = content.partition(b"?>")[2] or content
    return head + body.replace(b">", b">&l9;", 1)
