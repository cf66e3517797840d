"""The C and C++ compilers of this system, for tests of generated code."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from support.parts import C_COMPILER, CLANG, GCC, GXX, needs

STRICT = ("-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Werror", "-ffp-contract=off")

C_COMPILERS = [name for name in ("gcc", "clang") if shutil.which(name)]

needs_c = needs(C_COMPILER)
each_c_compiler = pytest.mark.parametrize(
    "compiler",
    [pytest.param("gcc", marks=needs(GCC)), pytest.param("clang", marks=needs(CLANG))],
)
each_cpp_compiler = pytest.mark.parametrize(
    "compiler",
    [pytest.param("g++", marks=needs(GXX)), pytest.param("clang++", marks=needs(CLANG))],
)


def write(files: Mapping[str, str], folder: Path) -> None:
    """Put generated files into a folder."""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def run(command: Sequence[str | Path], given: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    """Run a command; its complaints are the message of the failure."""
    done = subprocess.run([str(part) for part in command], input=given, capture_output=True)
    assert done.returncode == 0, done.stderr.decode("utf-8", "replace")
    return done
