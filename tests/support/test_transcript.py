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
