"""Comparing what a page shows of a terminal with what is printed."""

from __future__ import annotations

from pathlib import Path

import pytest

from support import transcript
from support.markdown import Block, blocks, replace_block


@pytest.mark.parametrize(
    ("shown", "actual", "fits"),
    [
        ("a\nb\n", "a\nb\n", True),
        ("a\nb\n", "a\nb  \n\n", True),
        ("a\n", "a\nb\n", False),
        ("a\n...\nz\n", "a\nz\n", True),
        ("a\n...\nz\n", "a\nb\nc\nz\n", True),
        ("a\n...\n", "b\n", False),
        ("took ... s\n", "took 1.25 s\n", True),
        ("took ... s\n", "took 1.25 min\n", False),
        ("a.c\n", "abc\n", False),
    ],
)
def test_dots_stand_for_anything(shown: str, actual: str, *, fits: bool) -> None:
    assert transcript.shows(shown, actual) is fits


def test_commands_run_in_order_and_are_compared(tmp_path: Path) -> None:
    text = "$ python -c 'print(1); exit(3)'\n1\n$ echo $?\n3\n$ make nothing\nanything\n"
    assert transcript.run(text, tmp_path) == []
    (problem,) = transcript.run(text.replace("\n1\n", "\n2\n"), tmp_path)
    assert "printed\n1\n" in problem


def test_a_command_without_shown_output_has_to_succeed(tmp_path: Path) -> None:
    assert transcript.run("$ python -c 'pass'\n", tmp_path) == []
    (problem,) = transcript.run("$ python -c 'exit(3)'\n", tmp_path)
    assert "ended with 3" in problem


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("rossmarie check a.ross", ["rossmarie", "check", "a.ross"]),
        (
            "rossmarie fmt --check ../a.ross -o=b",
            ["rossmarie", "fmt", "--check", "../a.ross", "-o=b"],
        ),
        (
            """ezskiros plan --goal "(at 'x' y)" z""",
            ["ezskiros", "plan", "--goal", "(at 'x' y)", "z"],
        ),
        ("rossmarie test a.ross 'nobody *'", ["rossmarie", "test", "a.ross", "nobody *"]),
        ("rossmarie check *.ross", None),
        ("rossmarie check a.ross > a.json", None),
        ("rossmarie check a.ross | head; echo", None),
        ('rossmarie check "$HOME/a.ross"', None),
        (r"rossmarie check a\ b.ross", None),
        ("rossmarie check ~/a.ross # all", None),
        ("rossmarie explain 'a", None),
        ("python a.py", None),
        ("rossmarie-like a", None),
    ],
)
def test_simple_commands_do_without_a_shell(command: str, words: list[str] | None) -> None:
    assert transcript.words_of(command) == words


def test_with_and_without_a_shell_the_same_is_printed(tmp_path: Path) -> None:
    text = "$ rossmarie check none.ross\nerror[ROSS801]...\n...\n$ echo $?\n2\n"
    assert transcript.run(text, tmp_path) == []
    assert transcript.run(text.replace("none.ross", "none.ross | cat; false"), tmp_path) != []
    assert transcript.run(text.replace("none.ross", "none.ross || exit $?"), tmp_path) == []


PAGE = (
    "# Title\n\n```ross a.ross\nrule\n```\n\n- item\n  ```console\n  $ x\n  ```\n## End\n```\n```\n"
)


def test_blocks_of_a_page() -> None:
    assert blocks(PAGE) == [
        Block("ross", "a.ross", "rule\n", "Title", 4),
        Block("console", "", "$ x\n", "Title", 9),
        Block("", "", "\n", "End", 13),
    ]


def test_a_block_is_replaced() -> None:
    replaced = replace_block(PAGE, blocks(PAGE)[0], "one\ntwo\n")
    assert replaced == PAGE.replace("rule", "one\ntwo")
