"""Completion by the shell: commands, options, listed values, pumps."""

import os
import subprocess
import sys

import pytest


def completed(line: str, folder) -> list[str]:
    """Return what the program answers to a shell that asks how a line may go on."""
    answer = folder / "answer"
    asked = {
        "COMP_LINE": line, "COMP_POINT": str(len(line)), "COMP_TYPE": "9",
        "_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_SUPPRESS_SPACE": "1", "_ARGCOMPLETE_STDOUT_FILENAME": str(answer),
    }  # fmt: skip
    words = [sys.executable, "-c", "from swashfilm.__main__ import main; main()"]
    subprocess.run(words, env=os.environ | asked, cwd=folder, check=True, capture_output=True)
    return answer.read_text("utf-8").split("\n")


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("swashfilm tra", {"transient"}),
        ("swashfilm run --fid", {"--fidelity"}),
        ("swashfilm run --fidelity ", {"lumped", "fixed", "floating", "table"}),
        ("swashfilm map --units ", {"MPa", "bar"}),
        ("swashfilm run re", {"ref90"}),
    ],
)
def test_the_shell_gets_the_words_that_may_follow(line, words, tmp_path):
    assert words <= {word.strip() for word in completed(line, tmp_path)}
