"""A short run of the fuzzer, and every file that a long run ever found."""

from __future__ import annotations

import os
import random
import signal
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fuzz.engine.program import Call, DefectError, Program
from fuzz.mutation import mutate
from fuzz.targets import ENGINE, TARGETS
from rossmarie.driver import check_file
from support.c_compiler import needs_c
from support.depth import deep

FOUND = sorted((Path(__file__).parent / "found").glob("*/*"))
FILES = [name for name in TARGETS if name != ENGINE]
ROUNDS = 60


@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=[needs_c] if path.parent.name == ENGINE else []) for path in FOUND],
    ids=lambda path: f"{path.parent.name}-{path.name}",
)
def test_what_was_found_stays_mended(path: Path, tmp_path: Path) -> None:
    TARGETS[path.parent.name].try_bytes(path.read_bytes(), tmp_path)


@pytest.mark.parametrize("name", FILES)
def test_examples_are_read(name: str, tmp_path: Path) -> None:
    for content in TARGETS[name].seeds():
        TARGETS[name].try_bytes(content, tmp_path)


@pytest.mark.parametrize("name", FILES)
def test_damaged_examples_are_findings_not_crashes(name: str, tmp_path: Path) -> None:
    _try_damaged(name, tmp_path)


@needs_c
def test_the_engine_answers_as_its_models_do(tmp_path: Path) -> None:
    for content in TARGETS[ENGINE].seeds():
        TARGETS[ENGINE].try_bytes(content, tmp_path)
    _try_damaged(ENGINE, tmp_path)


@needs_c
def test_an_engine_that_dies_is_a_defect_with_its_last_words() -> None:
    program = Program("monitor.c")
    others = children_of_this_process()
    program.send([])
    (number,) = children_of_this_process() - others
    os.kill(number, signal.SIGKILL)
    os.waitid(os.P_PID, number, os.WEXITED | os.WNOWAIT)
    with pytest.raises(DefectError, match=r"monitor\.c ended"):
        program.send([Call(0)])


def children_of_this_process() -> set[int]:
    """The numbers of the processes that this one has started."""
    threads = Path("/proc/self/task").glob("*/children")
    return {int(number) for each in threads for number in each.read_text().split()}


def _try_damaged(name: str, tmp_path: Path) -> None:
    chance = random.Random(1 if os.environ.get("CI") else None)
    known = TARGETS[name].seeds()
    for _ in range(ROUNDS):
        content = mutate(chance.choice(known), known, chance)
        try:
            TARGETS[name].try_bytes(content, tmp_path)
        except Exception as error:
            raise AssertionError(f"this file: {content!r}") from error


@pytest.mark.parametrize("name", FILES)
@given(content=st.binary(max_size=200))
def test_any_bytes_are_findings_not_crashes(
    tmp_path_factory: pytest.TempPathFactory, name: str, content: bytes
) -> None:
    TARGETS[name].try_bytes(content, tmp_path_factory.getbasetemp())


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\0" * 4096,
        b"\xff\xfe" + "rule".encode("utf-16-le"),
        b"(" * 100_000,
        b"const a = " + b"not " * 50_000,
        b"const a = " + b"-" * 50_000 + b"1",
        b"const a = 1" + b" + 1" * 25_000,
        b"'''" + b"x" * 2_000_000,
        b"entity e { a : b.c" + b".d" * 50_000 + b"; }",
        b"rule " * 30_000,
        b"const a = 3 " + b"m" * 100_000,
        b"input x = topic " + b"/a" * 25_000,
        *deep(
            [
                b"const a = 1" + b" + 1" * 100_000,
                b"rule " * 150_000,
                b"input x = topic " + b"/a" * 100_000,
            ]
        ),
    ],
    ids=lambda content: content[:20].decode("latin-1"),
)
def test_files_made_to_hurt_get_a_located_answer(content: bytes, tmp_path: Path) -> None:
    TARGETS["rules"].try_bytes(content, tmp_path)
    (tmp_path / "again.ross").write_bytes(content)
    found = check_file(tmp_path / "again.ross").diagnostics
    assert all(one.primary.span.end <= len(one.primary.span.file.text) for one in found)
    assert found
