"""Entry point of the command: threads, exit codes and error messages. Imports nothing heavy."""

import gc
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from shlex import join
from types import TracebackType

EXIT_BAD_INPUT = 2
EXIT_NOT_CONVERGED = 3
EXIT_INTERRUPTED = 130
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code: 0, 2 bad input, 3 not converged, 130 interrupted.

    An internal error ends it with 1 and one line; `--debug` shows the traceback.
    """
    if "_ARGCOMPLETE" in os.environ:  # the shell requests completions
        from swashfilm.cli.completion import complete_line

        complete_line()
    words = list(sys.argv[1:] if arguments is None else arguments)
    if "--debug" in words:
        words.remove("--debug")
    elif arguments is None:
        sys.excepthook = _internal_error
    for name in _THREADS:  # films are small: threads cost more than they gain, and several runs share the cores
        os.environ.setdefault(name, "1")
    gc.set_threshold(20_000, 20, 20)  # a run makes many small objects that live to its end
    from reynolds.errors import InputError, NotConverged
    from reynolds.numerics.files import REFUSED_BY_DISK
    from swashfilm.cli.app import run_command
    from swashfilm.output.run_folder import Interrupted
    from system.inputs.faults import InputFaults

    try:
        return run_command(words)
    except (InputFaults, InputError) as reason:
        return _end("\n".join([str(reason), *_notes(reason)]), EXIT_BAD_INPUT)
    except NotConverged as reason:
        notes = _notes(reason) or ["No result was written."]
        return _end("\n".join([f"not converged: {reason}", *notes]), EXIT_NOT_CONVERGED)
    except Interrupted as stop:
        if stop.again:
            return _end(f"interrupted: {stop.again}", EXIT_INTERRUPTED)
        kept = f"the finished part is kept in {stop.kept}" if stop.kept else "nothing was kept"
        again = join(["swashfilm", *words])
        if stop.kept and (stop.kept / "points").is_dir():
            return _end(f"interrupted: {kept}. To continue: {_resuming(words, stop.kept)}", EXIT_INTERRUPTED)
        return _end(f"interrupted: {kept}. The same command starts again: {again}", EXIT_INTERRUPTED)
    except KeyboardInterrupt:
        return _end("interrupted: nothing was written", EXIT_INTERRUPTED)
    except BrokenPipeError:  # the reader of the output has ended, as in `swashfilm ... | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except OSError as reason:
        if reason.errno not in REFUSED_BY_DISK:
            raise
        place = reason.filename or "a file of this command"
        expected = "a disk with room, and files and folders that this user may read and write"
        return _end(
            "\n".join([f"{place}: found {reason.strerror}, expected {expected}", *_notes(reason)]), EXIT_BAD_INPUT
        )


def _resuming(words: list[str], kept: Path) -> str:
    """Return the command that continues from the kept points of a study."""
    before = [word for word in words if not word.startswith("--resume=")]
    if "--resume" in before:
        at = before.index("--resume")
        before[at : at + 2] = []
    return join(["swashfilm", *before, "--resume", str(kept)])


def _notes(reason: BaseException) -> list[str]:
    """Return the note of a run to its error: the place of the solved part."""
    return getattr(reason, "__notes__", [])


def _end(message: str, code: int) -> int:
    from system.inputs.faults import printable

    sys.stderr.write(printable(f"swashfilm: {message}\n"))
    return code


def _internal_error(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    where = trace
    while where is not None and where.tb_next is not None:
        where = where.tb_next
    place = f" ({where.tb_frame.f_code.co_filename}:{where.tb_lineno})" if where else ""
    notes = "".join(f"{note}\n" for note in _notes(error))
    sys.stderr.write(
        f"swashfilm: internal error, not in your input: {kind.__name__}: {error}{place}\n{notes}"
        "Please report it to the source of your copy of Swashfilm, with the command, its input file and the\n"
        "output of `swashfilm doctor`. The same command with --debug shows the whole traceback.\n"
    )


if __name__ == "__main__":
    sys.exit(main())
