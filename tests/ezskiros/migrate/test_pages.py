"""The page of each finding of a migration: its example has it, what to write instead has none."""

from __future__ import annotations

import re

import pytest

from dslkit.diagnostics import Template
from ezskiros.catalog import CATALOG
from ezskiros.migrate import errors, implementation_errors
from ezskiros.migrate.module import migrate_text
from support.markdown import blocks

TEMPLATES = (*errors.ALL, *implementation_errors.ALL)
CODES = [each.code for each in TEMPLATES]
CAUSES = {"EZS737": ["EZS704"], "EZS738": ["EZS724"]}
"""The code that an example has as well, since its finding follows from that one."""
EXPECTED = re.compile(
    r"\s*#\s*(?P<carets>\^*) ?(?P<severity>\w+)\[(?P<code>\w+)\] \"(?P<text>.*)\""
)


def python(code: str, heading: str) -> str:
    found = blocks(CATALOG.page(code))
    (block,) = [each for each in found if (each.language, each.heading) == ("python", heading)]
    return block.text


@pytest.mark.parametrize("code", CODES)
def test_the_example_has_the_finding(code: str) -> None:
    text = python(code, "Example")
    diagnostics = migrate_text("skills.py", text).diagnostics
    assert [each.code for each in diagnostics] == [*CAUSES.get(code, []), code]
    found = diagnostics[-1]
    lines = text.split("\n")
    for number, line in enumerate(lines):
        if match := EXPECTED.fullmatch(line):
            assert (match["code"], match["severity"]) == (code, found.severity.value)
            assert match["text"] in found.title
            place = found.primary.span
            assert place.begin.line == number, (place.begin.line, number)
            if match["carets"]:  # what begins a line has no place for them
                columns = (place.begin.column - 1, place.finish.column - 1)
                assert columns == match.span("carets")
            return
    assert code == "EZS701"  # a comment would have to be Python


@pytest.mark.parametrize("code", CODES)
def test_what_to_write_instead_is_translated(code: str) -> None:
    found = migrate_text("skills.py", python(code, "Write instead"))
    assert found.translated == ["Drive"]
    assert not found.diagnostics


@pytest.mark.parametrize("template", TEMPLATES, ids=lambda template: template.code)
def test_the_texts_name_only_what_there_is(template: type[Template]) -> None:
    template.check_placeholders()
