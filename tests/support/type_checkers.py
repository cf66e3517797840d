"""mypy and pyright as users run them: which lines of which files they refuse."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from support.parts import PYRIGHT, needs

Refused = set[tuple[str, int]]
"""Names of files, and lines."""


def mypy(folder: Path) -> Refused:
    """The errors of mypy in a folder, with its default settings."""
    options = ("--config-file=", "--output=json", "--cache-dir=.mypy_cache", ".")
    lines = _run(folder, "mypy", *options).splitlines()
    found = [json.loads(line) for line in lines if line.startswith("{")]
    return {(each["file"], each["line"]) for each in found if each["severity"] == "error"}


def pyright(folder: Path) -> Refused:
    """The errors of pyright in a folder, with its default settings."""
    printed = _run(folder, "pyright", "--pythonpath", sys.executable, "--outputjson", ".")
    found = json.loads(printed)["generalDiagnostics"]
    return {
        (Path(each["file"]).relative_to(folder).as_posix(), each["range"]["start"]["line"] + 1)
        for each in found
        if each["severity"] == "error"
    }


def _run(folder: Path, module: str, *options: str) -> str:
    """The output of a checker. Raises `AssertionError` if the checker itself failed."""
    done = subprocess.run(
        [sys.executable, "-m", module, *options],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "PYRIGHT_PYTHON_IGNORE_WARNINGS": "1"},
        timeout=300,
        check=False,
    )
    assert done.returncode in (0, 1), done.stdout + done.stderr
    return done.stdout


Checker = Callable[[Path], Refused]
each_checker = pytest.mark.parametrize(
    "checker", [mypy, pytest.param(pyright, marks=needs(PYRIGHT))], ids=lambda each: each.__name__
)
