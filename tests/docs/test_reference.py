"""The reference pages say all there is to say, and nothing that is no longer so."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path

import pytest
import typer

import rossmarie.syntax
from crosscheck.catalog import CATALOG as CROSSCHECK
from crosscheck.cli.main import app as crosscheck_app
from dslkit.catalog import Catalog
from dslkit.diagnostics import Template
from ezskiros.catalog import CATALOG as EZSKIROS
from ezskiros.cli.main import app as ezskiros_app
from rossmarie.catalog import CATALOG as ROSSMARIE
from rossmarie.check.operations.edges import MOST_EDGES
from rossmarie.check.operations.functions import MOST_TURNING_POINTS, USAGES
from rossmarie.check.rules.plans import MOST_TASKS
from rossmarie.check.system.bounds import MOST_ELEMENTS
from rossmarie.cli.main import app
from rossmarie.core import MOST_SAMPLES
from rossmarie.driver import check_file
from rossmarie.ir import MOST_EVALUATIONS
from rossmarie.syntax import limits
from rossmarie.syntax.words import RESERVED
from support.markdown import Block, blocks, replace_block
from support.rule_skills import put_skills

DOCS = Path(__file__).parents[2] / "docs"
LANGUAGE = DOCS / "reference" / "language.md"
COMMANDS = DOCS / "reference" / "command-line.md"
EZSKIROS_COMMANDS = DOCS / "reference" / "ezskiros-command-line.md"
CODES = {
    ROSSMARIE: DOCS / "reference" / "diagnostics.md",
    EZSKIROS: DOCS / "reference" / "ezskiros-diagnostics.md",
    CROSSCHECK: DOCS / "reference" / "crosscheck.md",
}
SEMANTICS = DOCS / "explanation" / "semantics.md"
RULE = "| --- | --- | --- | --- |"
GRAMMAR = Path(rossmarie.syntax.__file__).with_name("ross.lark")


def read(page: Path) -> str:
    return page.read_text(encoding="utf-8")


# --- the language ----------------------------------------------------------------------------


def grammar_rules() -> str:
    """The grammar without the comments at its head."""
    text = read(GRAMMAR)
    return text[text.index("%declare") :]


def test_the_grammar_on_the_page_is_the_grammar(bless: bool) -> None:
    (block,) = (block for block in blocks(read(LANGUAGE)) if block.language == "lark")
    if bless:
        LANGUAGE.write_text(replace_block(read(LANGUAGE), block, grammar_rules()), "utf-8")
        return
    assert block.text == grammar_rules()


def programs() -> list[Block]:
    return [block for block in blocks(read(LANGUAGE)) if block.language == "ross"]


def test_the_programs_of_the_page_have_no_findings_at_all(tmp_path: Path) -> None:
    put_skills(tmp_path)
    for block in programs():
        path = tmp_path / (block.name or "rules.ross")
        path.write_text(block.text, encoding="utf-8")
        found = [f"{one.primary.span}: {one.title}" for one in check_file(path).diagnostics]
        assert found == [], f"language.md:{block.line}"


def quoted_words(before: str) -> set[str]:
    """The words in the quotation that stands right behind `before` on the page."""
    quotation = re.match(r"(?:>.*\n)+", read(LANGUAGE).split(before, 1)[1])
    assert quotation is not None
    return set(re.findall(r"`(\w+)`", quotation.group()))


def test_the_words_of_the_language_are_listed() -> None:
    all_words = set(re.findall(r'"([a-z]+)"', grammar_rules()))
    assert quoted_words("are reserved and cannot be names:\n\n") == RESERVED
    assert quoted_words("Elsewhere they can be names:\n\n") == all_words - RESERVED


def test_every_function_has_a_row() -> None:
    rows = re.findall(r"^\| (`\w+\(.*?) \|", read(LANGUAGE), flags=re.MULTILINE)
    named = {name for row in rows for name in re.findall(r"`(\w+)\(", row)}
    assert named == {operator.value for operator in USAGES} | {"oscillates"}


def test_the_limits_are_those_of_the_compiler() -> None:
    section = read(LANGUAGE).split("\n## Limits\n")[1].split("\n## ")[0]
    stated = [
        cell for line in section.split("\n") if line.startswith("| ") for cell in line.split(" | ")
    ]
    assert stated[7::3][:10] == [
        f"{limits.MAXIMUM_FILE_SIZE // 2**20} MiB, {spaced(limits.MAXIMUM_TOKENS)} tokens",
        f"{limits.MAXIMUM_NESTING} levels",
        f"{limits.MAXIMUM_DEPTH} levels",
        spaced(limits.MAXIMUM_LENGTH),
        str(limits.MAXIMUM_ERRORS),
        str(MOST_TURNING_POINTS),
        str(MOST_EDGES),
        str(MOST_SAMPLES),
        spaced(MOST_EVALUATIONS),
        spaced(MOST_TASKS),
    ]
    assert spaced(MOST_ELEMENTS) in stated


def spaced(number: int) -> str:
    """`300 000`."""
    return f"{number:,}".replace(",", " ")


@pytest.mark.parametrize("page", sorted(DOCS.glob("**/*.md")), ids=lambda page: page.name)
def test_rules_of_the_semantics_that_pages_refer_to_exist(page: Path) -> None:
    numbered = set(re.findall(r"^\*\*(S\d+)\.", read(SEMANTICS), flags=re.MULTILINE))
    assert set(re.findall(r"\bS\d{1,2}\b", read(page))) - numbered == set()


@pytest.mark.parametrize("page", sorted(DOCS.glob("**/*.md")), ids=lambda page: page.name)
def test_codes_that_pages_refer_to_exist(page: Path) -> None:
    outside_of_examples = re.sub(
        r"^```console\n.*?^```", "", read(page), flags=re.MULTILINE | re.DOTALL
    )
    named = set(re.findall(r"\b(?:ROSS|EZS|CHK)\d{3}\b", outside_of_examples))
    assert named - {found.code for catalog in CODES for found in catalog.diagnostics} == set()


# --- the command line ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("tool", "page", "command_line"),
    [
        ("rossmarie", COMMANDS, app),
        ("ezskiros", EZSKIROS_COMMANDS, ezskiros_app),
        ("crosscheck", CODES[CROSSCHECK], crosscheck_app),
    ],
)
def test_every_command_and_option_is_described(
    tool: str, page: Path, command_line: typer.Typer
) -> None:
    text = read(page)
    for name, command in typer.main.get_command(command_line).commands.items():  # type: ignore[attr-defined]
        section = text.split(f"\n## {tool} {name}\n")[1].split("\n## ")[0]
        synopsis = blocks(section)[0].text
        for option in command.params:
            spellings = [spelling for spelling in option.opts if spelling.startswith("--")]
            assert [spelling for spelling in spellings if spelling not in synopsis] == []


# --- the codes -------------------------------------------------------------------------------


def row(catalog: Catalog, found: type[Template]) -> str:
    """A line of the table; what depends on the case is shown in capitals."""
    title = re.sub(r"\{(\w+)\}", lambda field: field[1].upper(), found.title)
    link = f"[{found.code}](../../src/{catalog.tool}/catalog/pages/{found.code}.md)"
    return f"| {link} | {found.severity.value} | `{found.name}` | {title} |"


def hundreds(catalog: Catalog) -> Iterator[tuple[str, Sequence[str]]]:
    """`3xx` and the rows of its codes."""
    ordered = sorted(catalog.diagnostics, key=lambda found: found.code)
    for hundred, found in groupby(ordered, key=lambda found: f"{found.code[-3]}xx"):
        yield hundred, [row(catalog, one) for one in found]


def table_of(page: str, hundred: str) -> re.Match[str]:
    """The rows in the section of a hundred, below the head of its table."""
    head = rf"^## {hundred}\b(?:(?!\n## ).)*?\n{re.escape(RULE)}\n"
    rows = r"(?P<rows>(?:\|[^\n]*\n)*)"
    found = re.search(head + rows, page, flags=re.MULTILINE | re.DOTALL)
    assert found is not None, f"no table for {hundred}"
    return found


@pytest.mark.parametrize("catalog", CODES, ids=lambda catalog: catalog.tool)
def test_every_code_has_its_row(catalog: Catalog, bless: bool) -> None:
    page = read(CODES[catalog])
    for hundred, rows in hundreds(catalog):
        start, end = table_of(page, hundred).span("rows")
        expected = "".join(f"{line}\n" for line in rows)
        if bless:
            page = page[:start] + expected + page[end:]
        assert page[start:][: len(expected)] == expected
    if bless:
        CODES[catalog].write_text(page, encoding="utf-8")
    assert len(re.findall(r"^\| \[[A-Z]+\d", page, flags=re.MULTILINE)) == len(catalog.diagnostics)
