"""Compiling, and the cache of what was compiled."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rossmarie.native import BuildError, NoCompilerError, build
from support.c_compiler import needs_c

pytestmark = needs_c

FILES = {"main.c": '#include "number.h"\nint number(void) { return NUMBER; }\n', "number.h": ""}


def files(number: int) -> dict[str, str]:
    return {**FILES, "number.h": f"#define NUMBER {number}\n"}


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "cache" / "rossmarie"


@pytest.fixture
def counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A compiler that notes each of its calls in a file."""
    calls = tmp_path / "calls"
    calls.write_text("")
    script = tmp_path / "counted-cc"
    script.write_text(f'#!/bin/sh\necho called >> {calls}\nexec cc "$@"\n')
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    return calls


def test_same_text_is_compiled_once(cache: Path, counted: Path) -> None:
    first = build(files(1), "main.c")
    assert build(files(1), "main.c") == first
    assert first.startswith(b"\x7fELF")
    assert counted.read_text().count("called") == 1


def test_other_text_and_other_options_are_compiled_apart(cache: Path) -> None:
    made = {build(files(1), "main.c"), build(files(2), "main.c"), build(files(1), "main.c", "-g")}
    assert len(made) == 3


def test_rebuild_compiles_again(cache: Path, counted: Path) -> None:
    made = build(files(1), "main.c")
    assert build(files(1), "main.c", rebuild=True) == made
    assert counted.read_text().count("called") == 2


def test_leaves_nothing_but_the_library(cache: Path) -> None:
    made = build(files(1), "main.c")
    (kept,) = cache.iterdir()
    assert kept.read_bytes().endswith(made)


def test_what_the_compiler_says_is_reported(cache: Path) -> None:
    with pytest.raises(BuildError, match="expected"):
        build({"main.c": "int number(void) { return }\n"}, "main.c")
    assert list(cache.iterdir()) == []


def test_no_compiler(cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(NoCompilerError, match="cc gcc clang"):
        build(files(1), "main.c")


def test_a_compiler_that_is_named_but_not_there(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CC", "no-such-compiler -m64")
    with pytest.raises(NoCompilerError, match="no-such-compiler"):
        build(files(1), "main.c")


def test_a_compiler_with_an_open_quote(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", 'gcc "')
    with pytest.raises(NoCompilerError, match="No closing quotation"):
        build(files(1), "main.c")


def test_a_compiler_that_speaks_another_encoding(
    cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script = tmp_path / "latin-cc"
    script.write_bytes(b"#!/bin/sh\necho 'main.c: erreur fatale \xe9' >&2\nexit 1\n")
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    with pytest.raises(BuildError, match="erreur fatale"):
        build(files(1), "main.c")


def test_a_compiler_with_a_name_that_is_not_utf_8(
    cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script = tmp_path / os.fsdecode(b"cc-\xe9")
    script.write_text('#!/bin/sh\nexec cc "$@"\n')
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    assert build(files(1), "main.c")


def test_without_a_home_it_is_compiled_each_time(
    cache: Path, counted: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    for variable in ("XDG_CACHE_HOME", "XDG_STATE_HOME"):
        monkeypatch.delenv(variable)
    monkeypatch.setattr(Path, "home", homeless)
    assert build(files(1), "main.c") == build(files(1), "main.c")
    assert counted.read_text().count("called") == 2
    assert not cache.exists()


def test_several_processes_build_the_same_at_once(cache: Path) -> None:
    program = (
        "import hashlib; from rossmarie.native import build;"
        f"print(hashlib.sha256(build({files(7)!r}, 'main.c')).hexdigest())"
    )
    running = [
        subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
        for _ in range(3)
    ]
    made = {process.communicate()[0].strip() for process in running}
    assert all(process.returncode == 0 for process in running)
    assert len(made) == 1
    assert made == {hashlib.sha256(build(files(7), "main.c")).hexdigest()}
