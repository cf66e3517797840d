"""The fenced blocks of a Markdown page."""

from __future__ import annotations

import re
from dataclasses import dataclass

_FENCE = re.compile(r"(?P<indent> *)(?P<fence>```+)(?P<language>\w*) *(?P<name>\S*)\s*")


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, its text, the heading above it.

    `line` is the number, from 1, of its first line of text. `name` stands behind the language, if
    anything does: the file that later blocks of the page know it as.
    """

    language: str
    name: str
    text: str
    heading: str
    line: int


def blocks(page: str) -> list[Block]:
    """The fenced blocks of a page, in order."""
    found = []
    heading = ""
    lines = page.split("\n")
    number = 0
    while number < len(lines):
        line = lines[number]
        number += 1
        fence = _FENCE.fullmatch(line)
        if fence:
            first = number
            while number < len(lines) and lines[number].strip() != fence["fence"]:
                number += 1
            indent = len(fence["indent"])
            text = "\n".join(inner[indent:] for inner in lines[first:number])
            found.append(Block(fence["language"], fence["name"], text + "\n", heading, first + 1))
            number += 1
        elif line.startswith("#"):
            heading = line.lstrip("# ").strip()
    return found


def replace_block(page: str, block: Block, text: str) -> str:
    """The page with another text in an unindented `block`."""
    lines = page.split("\n")
    start = block.line - 1
    end = start + block.text.count("\n")
    return "\n".join([*lines[:start], *text.rstrip("\n").split("\n"), *lines[end:]])
