"""The C and C++ compilers of this system, for tests of generated code."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

STRICT = ("-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Werror", "-ffp-contract=off")

C_COMPILERS = [name for name in ("gcc", "clang") if shutil.which(name)]
CPP_COMPILERS = [name for name in ("g++", "clang++") if shutil.which(name)]

needs_c = pytest.mark.skipif(not C_COMPILERS, reason="there is no C compiler on this system")


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
