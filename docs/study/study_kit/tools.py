"""Runs our tools and the plain ones over files, and says when they find something."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from study_kit.faults import TASKS, Condition

EXAMPLE = TASKS.parents[2] / "examples" / "pick_place"
"""The example that has the ontology of the skills, and its stub for type checkers."""
_SECONDS = 300


def lay_out(condition: Condition, text: str, folder: Path) -> Path:
    """Copy the files of a condition into a new folder; return the file that has the text."""
    shutil.copytree(condition.folder, folder)
    if condition.task == "rules":
        shutil.copy(TASKS / "rules" / "trace.csv", folder)
    if condition.name == "ezskiros":
        shutil.copytree(EXAMPLE / "ontology", folder / "ontology")
        shutil.copy(EXAMPLE / "skills" / "world.pyi", folder)
    file = folder / condition.file
    file.write_text(text, encoding="utf-8")
    return file


def codes(condition: Condition, file: Path) -> Sequence[str]:
    """The codes of the errors and warnings that a check of our language reports."""
    done = _run(file.parent, sys.executable, "-m", condition.name, "check", "--format=json", file)
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stdout + done.stderr)
    found = json.loads(done.stdout)["diagnostics"]
    return [each["code"] for each in found if each["severity"] != "note"]


def mypy_accepts(file: Path, *, is_strict: bool) -> bool:
    """Say whether mypy accepts a Python file; SkiROS2 has no types for it."""
    cache = file.parent / ".mypy_cache"
    done = _run(
        file.parent,
        *(sys.executable, "-m", "mypy", "--config-file=", f"--cache-dir={cache}"),
        "--strict" if is_strict else "--ignore-missing-imports",
        file.name,
    )
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stdout + done.stderr)
    return done.returncode == 0


def python_runs(folder: Path) -> bool:
    """Say whether the plain Python program of the rover comes to the end of the trace."""
    return _drive_python(folder).returncode == 0


def cpp_builds(folder: Path) -> bool:
    """Say whether g++ builds the plain C++ program of the rover without a warning."""
    words = ("g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-o", "run", "run.cpp")
    return _run(folder, *words).returncode == 0


def output(condition: Condition, folder: Path) -> str:
    """The commands of a plain program of the rover on the trace, one for each row."""
    if condition.name == "cpp":
        cpp_builds(folder)
        return _drive_cpp(folder).stdout
    return _drive_python(folder).stdout


def _drive_python(folder: Path) -> subprocess.CompletedProcess[str]:
    return _run(folder, sys.executable, "run.py", "trace.csv")


def _drive_cpp(folder: Path) -> subprocess.CompletedProcess[str]:
    return _run(folder, folder / "run", "trace.csv")


def plain_stage(condition: Condition, file: Path) -> str:
    """The first stage at which plain tools find a fault: check, build, run or never."""
    if condition.name == "cpp":
        if not cpp_builds(file.parent):
            return "build"
        return "never" if _drive_cpp(file.parent).returncode == 0 else "run"
    if not mypy_accepts(file, is_strict=condition.name == "python"):
        return "check"
    if condition.name == "python" and not python_runs(file.parent):
        return "run"
    return "never"


def _run(folder: Path, *words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        list(map(str, words)),
        cwd=folder,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        timeout=_SECONDS,
        check=False,
    )
