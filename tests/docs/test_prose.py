"""The pages are in plain English, as far as a machine can tell."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.prose import LONGEST, RULES, docstring_findings, findings, sentences

ROOT = Path(__file__).parents[2]
PAGES = sorted(
    [
        *ROOT.glob("*.md"),
        *(ROOT / "docs").rglob("*.md"),
        *(ROOT / "src").glob("*/catalog/pages/*.md"),
    ]
)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_is_in_plain_english(page: Path) -> None:
    found = list(findings(page.read_text(encoding="utf-8")))
    assert not found, {rule.name: rule.instead for rule in RULES}


PACKAGES = sorted(path.parent.name for path in (ROOT / "src").glob("*/__init__.py"))


@pytest.mark.parametrize("package", PACKAGES)
def test_docstrings_are_in_plain_english(package: str) -> None:
    found = [
        (str(module.relative_to(ROOT)), *each)
        for module in sorted((ROOT / "src" / package).rglob("*.py"))
        for each in docstring_findings(module.read_text(encoding="utf-8"))
    ]
    assert not found


@pytest.mark.parametrize(
    ("source", "found"),
    [
        ('"""By whom it is done."""\n', [(1, "opening word", "By whom it is done.")]),
        ('"""All of it."""\nx = 1\n"""Kept so long as `x` is."""\n',
         [(3, "so long as", "Kept so long as Code is.")]),
        ('def f():\n    """One.\n\n        so long as\n\n    Whoever."""\n',
         [(2, "whoever", "Whoever.")]),
        ("x = 'so long as'\n# so long as\n", []),
    ],
)  # fmt: skip
def test_docstrings_are_found_with_their_lines(
    source: str, found: list[tuple[int, str, str]]
) -> None:
    assert list(docstring_findings(source)) == found


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("What comes of it is told.", ["clause as subject", "what comes of", "is told"]),
        ("Use it so long as `x` is\n  there.", ["so long as"]),
        ("What does it do? It waits.", []),
        ("# What is left\n\n| What holds | so long as |\n", []),
        ("```\nso long as\n```\n", []),
        ("Whoever starts `whoever`.", ["whoever"]),
        ("word " * (LONGEST + 1) + ".", ["long sentence"]),
        ("word " * LONGEST, []),
    ],
)
def test_each_rule_sees_its_construction(text: str, names: list[str]) -> None:
    assert [name for name, _ in findings(text)] == names


def test_lists_and_paragraphs_end_a_sentence() -> None:
    page = "One thing. Another\nthing.\n\n- A `b. C` d.\n- E [f](g.md) h\n"
    assert list(sentences(page)) == ["One thing.", "Another thing.", "A Code d.", "E f h"]
