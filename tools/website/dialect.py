"""Convert pages in GitHub's Markdown to the dialect of Python-Markdown, for the site's generator.

The dialects differ in three respects that matter for our pages. Python-Markdown needs four spaces
for each level of a list, a blank line before a list or a table, and the name of a file as an option
of a fence. The addresses of links also change, because the pages have other paths in the site.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from markdown_it import MarkdownIt
from markdown_it.token import Token

_PARSER = MarkdownIt("commonmark").enable("table")
_FENCE = re.compile(r"(?P<fence>`{3,})(?P<language>[\w+-]+) +(?P<name>[\w./-]+)\s*$")
_ITEM = re.compile(r"(?P<indent>\s*)(?P<marker>[-*+]|\d+[.)])(?P<gap>\s+|$)")
_LINK = re.compile(r"(?P<start>!?\[(?:[^\[\]]|\[[^\[\]]*\])*\]\()(?P<target>[^()\s]+)(?P<end>\))")
_DEFINITION = re.compile(r"^(?P<start>\[[^\]]+\]:\s*)(?P<target>\S+)(?P<end>)", re.MULTILINE)
_SOURCE = re.compile(
    r'(?P<start><(?:img|source|a)\b[^>]*?(?:src|href)=")(?P<target>[^"]+)(?P<end>")'
)
_CODE = re.compile(r"(?P<ticks>`+)(?!`).+?(?<!`)(?P=ticks)(?!`)", re.DOTALL)
_OPENS = {"bullet_list_open", "ordered_list_open", "table_open", "blockquote_open"}


def to_site(text: str, target: Callable[[str], str]) -> str:
    """A page for the site. `target` returns the new address for each address of a link."""
    lines = text.split("\n")
    tokens = _PARSER.parse(text)
    code = _lines_of_code(tokens)
    lines = _reindent(lines, tokens, code)
    return _address(_space(lines, tokens), target)


def title(text: str) -> str:
    """The first heading of a page as plain text; empty if the page has no heading."""
    found = re.search(r"^# +(.+)$", text, re.MULTILINE)
    return re.sub(r"[`*]", "", found[1]).strip() if found else ""


def _lines_of_code(tokens: list[Token]) -> set[int]:
    """The numbers, from 0, of the lines in blocks of code, without the lines that open fences."""
    found: set[int] = set()
    for token in tokens:
        if token.type == "fence" and token.map:
            found.update(range(token.map[0] + 1, token.map[1]))
        elif token.type == "code_block" and token.map:
            found.update(range(*token.map))
    return found


def _reindent(lines: list[str], tokens: list[Token], code: set[int]) -> list[str]:
    """The lines with four spaces for each level of a list, and options in place of names."""
    old = [0] * len(lines)
    new = [0] * len(lines)
    for token in tokens:
        if token.type != "list_item_open" or token.map is None:
            continue
        first, end = token.map
        item = _ITEM.match(lines[first][old[first] :])
        assert item is not None, lines[first]
        width = old[first] + item.end()
        level = new[first]
        old[first] += len(item["indent"])
        for number in range(first + 1, end):
            old[number], new[number] = width, level + 4
    return [_line(line, old[n], new[n], n in code) for n, line in enumerate(lines)]


def _line(line: str, old: int, new: int, is_code: bool) -> str:
    """A line with `new` spaces in place of at most `old` spaces."""
    blank = len(line) - len(line.lstrip(" "))
    content = line[min(old, blank) :]
    if not content:
        return ""
    if not is_code:
        content = _FENCE.sub(r'\g<fence>\g<language> title="\g<name>"', content)
    return " " * new + content


def _space(lines: list[str], tokens: list[Token]) -> list[str]:
    """The lines with a blank line before each outer list, table and quotation."""
    starts = {
        token.map[0] for token in tokens if token.type in _OPENS and token.level == 0 and token.map
    }
    spaced: list[str] = []
    for number, line in enumerate(lines):
        if number in starts and spaced and spaced[-1].strip():
            spaced.append("")
        spaced.append(line)
    return spaced


def _address(lines: list[str], target: Callable[[str], str]) -> str:
    """The text with new addresses; code in blocks and in lines does not change."""
    pieces: list[str] = []
    prose: list[str] = []
    fence = ""
    for line in lines:
        stripped = line.lstrip()
        if fence:
            pieces.append(line)
            fence = "" if stripped.rstrip() == fence else fence
        elif stripped.startswith("```"):
            pieces += [*_addressed(prose, target), line]
            prose = []
            fence = stripped[: len(stripped) - len(stripped.lstrip("`"))]
        else:
            prose.append(line)
    return "\n".join([*pieces, *_addressed(prose, target)])


def _addressed(prose: list[str], target: Callable[[str], str]) -> list[str]:
    """Lines of prose with new addresses."""
    kept: list[str] = []

    def keep(code: re.Match[str]) -> str:
        kept.append(code[0])
        return f"\0{len(kept) - 1}\0"

    def readdress(link: re.Match[str]) -> str:
        return f"{link['start']}{target(link['target'])}{link['end']}"

    text = _CODE.sub(keep, "\n".join(prose))
    for pattern in (_LINK, _DEFINITION, _SOURCE):
        text = pattern.sub(readdress, text)
    text = re.sub(r"\0(\d+)\0", lambda number: kept[int(number[1])], text)
    return text.split("\n") if prose else []
