"""Compiled code during a mutation: kernels that may contain the edited line are compiled anew, and restored."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import grimp

from .sample import SHARES


@contextmanager
def anew(place: Path, file: str) -> Iterator[None]:
    """Within: no compiled code of the module or of a kernel that imports it; afterwards the code as before."""
    modules = {file, *(_file(name) for name in imports().find_downstream_modules(module_name(file)))}
    kernels = [place / module for module in modules if _is_kernel(place / module)]
    with tempfile.TemporaryDirectory() as aside:
        for number, kernel in enumerate(kernels):
            for old in _caches(kernel):
                (Path(aside) / str(number)).mkdir(exist_ok=True)
                shutil.move(old, Path(aside) / str(number) / old.name)
        try:
            yield
        finally:
            for number, kernel in enumerate(kernels):
                for new in _caches(kernel):
                    new.unlink()
                for old in (Path(aside) / str(number)).glob("*"):
                    shutil.move(old, kernel.parent / "__pycache__" / old.name)


@cache
def imports() -> grimp.ImportGraph:
    """Imports between the modules of the four packages."""
    return grimp.build_graph(*SHARES, cache_dir=None)


def _is_kernel(path: Path) -> bool:
    return path.exists() and "jit" in path.read_text("utf-8")


def _caches(kernel: Path) -> list[Path]:
    return list((kernel.parent / "__pycache__").glob(f"{kernel.stem}.*.nb[ic]"))


def module_name(file: str) -> str:
    """Dotted name of a module by its file."""
    return file.removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def _file(module: str) -> str:
    return f"{module.replace('.', '/')}.py"
