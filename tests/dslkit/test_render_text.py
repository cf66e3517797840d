"""Findings on a terminal: as they look, and for whatever text and place."""

from __future__ import annotations

import io
import unicodedata
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from dslkit.diagnostics import Diagnostic, Edit, Fix, Label, Severity, summary
from dslkit.diagnostics.render_text import render_text
from dslkit.source import SourceFile, Span
from support.effort import takes_at_most
from support.findings import AWKWARD_TEXT, any_finding, place, unit_mismatch, warning
from support.golden import assert_golden

GOLDEN = Path(__file__).parent / "golden"

RULES = SourceFile(
    "arm.ross",
    "input force = topic /ft/wrench : geometry_msgs/Wrench .force\n"
    "\n"
    "const maximum = 3 N/sec\n"
    "entity arm {\n"
    "\tpushed : norm(force) > maximum;\n"
    "}\n",
)
SYSTEM = SourceFile(
    "system.ross", "system arm {\n    topic /ft/wrench : geometry_msgs/Wrench;\n}\n"
)


def several_places() -> Diagnostic:
    entity = place(RULES, "entity arm")
    return Diagnostic(
        code="ROSS105",
        name="declared-twice",
        severity=Severity.ERROR,
        title="`arm` is declared twice",
        primary=Label(Span(RULES, entity.start, len(RULES.text)), "this entity"),
        labels=(
            Label(place(RULES, "norm(force)"), "with this"),
            Label(place(RULES, "maximum;"), "and this"),
            Label(place(SYSTEM, "arm"), "first declared here"),
        ),
        notes=("names are unique\nacross all files",),
    )


def insertion_and_deletion() -> Diagnostic:
    semicolon = place(RULES, ";")
    edits = (
        Edit(place(RULES, " maximum"), ""),
        Edit(Span(RULES, 0, 0), "// one\n// two\n"),
        Edit(Span(RULES, semicolon.start, semicolon.start), " timeout 1 sec"),
    )
    fix = Fix("rewrite it", edits)
    found = warning(semicolon)
    return Diagnostic(found.code, found.name, found.severity, found.title, found.primary, fix=fix)


CASES = {
    "everything": unit_mismatch(RULES),
    "several_places": several_places(),
    "insertion_and_deletion": insertion_and_deletion(),
    "end_of_file": warning(Span(RULES, len(RULES.text), len(RULES.text))),
    "no_text": warning(Span(SourceFile("gone.ross", ""), 0, 0), "no such file"),
    "windows_line_ends": warning(place(SourceFile("w.ross", "const a\r\nconst b\r\n"), "a\r\n")),
    "wide_characters": warning(place(SourceFile("w.ross", 'x == "名前ｅ\u0301" or y'), "or y")),
    "hidden_characters": warning(place(SourceFile("h.ross", "a\x1b[31m\u202e b \x00c"), "b")),
    "long_line": warning(place(SourceFile("l.ross", "x" * 500 + " here " + "y" * 500), "here")),
}


@pytest.mark.parametrize("name", CASES)
def test_it_looks_as_it_did_when_somebody_looked(name: str, bless: bool) -> None:
    assert_golden(GOLDEN / f"{name}.txt", render_text([CASES[name]]).plain, bless=bless)


def printed(found: Diagnostic, *, terminal: bool) -> str:
    stream = io.StringIO()
    console = Console(
        file=stream,
        force_terminal=terminal,
        color_system="standard" if terminal else "auto",
        width=80,
    )
    console.print(render_text([found]), soft_wrap=True, end="")
    return stream.getvalue()


def test_colours_are_for_terminals() -> None:
    assert "\x1b[" in printed(unit_mismatch(RULES), terminal=True)
    assert "\x1b" not in printed(unit_mismatch(RULES), terminal=False)


@given(any_finding(), st.integers(10, 120))
def test_any_finding_can_be_shown(found: Diagnostic, width: int) -> None:
    text = render_text([found], width=width).plain
    text.encode()
    hidden = {"Cc", "Cf", "Cs", "Cn", "Zl", "Zp"}
    assert not {c for c in text if c != "\n" and unicodedata.category(c) in hidden}
    assert printed(found, terminal=False) == render_text([found]).plain


LINES = st.text(st.sampled_from("ab\t名\uff45\u0301\x00\u202e"), max_size=30)


@given(LINES, st.data())
def test_carets_stand_under_exactly_the_span(line: str, data: st.DataObject) -> None:
    offsets = st.integers(0, len(line))
    start, end = sorted(data.draw(st.tuples(offsets, offsets)))
    file = SourceFile("x.ross", f"\n{line}|\n")
    text = render_text([warning(Span(file, start + 1, end + 1), "")], width=1000).plain
    source, carets = text.split("\n")[3:5]
    before, marked = (_screen_width(part) for part in _shown(line, start, end))
    assert carets.rstrip() == "  | " + " " * before + "^" * max(marked, 1)
    assert _screen_width(source) == 4 + _screen_width(_shown(line, len(line), len(line))[0]) + 1


def _shown(line: str, start: int, end: int) -> tuple[str, str]:
    """The visible text before and in `[start, end)`: tabs stop every 4 columns, other control
    characters are named.
    """
    before = marked = ""
    for index, character in enumerate(line[:end]):
        stop = 4 - _screen_width(before + marked) % 4
        seen = {"\t": " " * stop, "\x00": "␀", "\u202e": "<U+202E>"}.get(character, character)
        if index < start:
            before += seen
        else:
            marked += seen
    return before, marked


def _screen_width(text: str) -> int:
    return len(text) + sum((c in "名\uff45") - (c == "\u0301") for c in text)


@given(st.integers(0, 400), st.integers(0, 400), st.integers(1, 30), st.integers(40, 120))
def test_long_lines_are_cut_around_what_matters(
    before: int, after: int, length: int, width: int
) -> None:
    file = SourceFile("x.ross", "." * before + "x" * length + "." * after)
    found = warning(Span(file, before, before + length), "")
    source, carets = render_text([found], width=width).plain.split("\n")[3:5]
    assert len(source) <= width + len("1 | ……")
    assert carets.index("^") == source.index("x")
    assert carets.count("^") == source.count("x") == length


@given(AWKWARD_TEXT)
def test_a_mark_on_each_line_is_never_lost(text: str) -> None:
    file = SourceFile("x.ross", f"{text}z{'-' * 200}w")
    ends = (Label(place(file, "w"), "last"), Label(Span(file, 0, 0), "first"))
    found = Diagnostic("ROSS999", "x", Severity.ERROR, "t", warning(place(file, "z")).primary, ends)
    shown = render_text([found], width=60).plain
    for mark in ("^ here", "- first", "- last"):
        assert mark in shown


def test_marks_far_apart_share_a_line_that_fits() -> None:
    file = SourceFile("x.ross", f"a{'.' * 70}b")
    ends = (Label(place(file, "b"), "last"),)
    found = Diagnostic("ROSS999", "x", Severity.ERROR, "t", Label(place(file, "a"), ""), ends)
    assert render_text([found], width=80).plain.count("a...") == 1


def test_a_huge_line_is_not_read_again_for_each_finding() -> None:
    short, huge = (SourceFile("x.ross", "x " * length) for length in (5_000, 500_000))
    on_short, on_huge = (
        [unit_fix(file, len(file.text) - before) for before in range(2, 10_000, 100)]
        for file in (short, huge)
    )
    # A hundred times as much text. Its copy with a fix is made in C, for little each time.
    assert takes_at_most(40, render_text, on_short, on_huge)


def unit_fix(file: SourceFile, offset: int) -> Diagnostic:
    span = Span(file, offset, offset + 1)
    edit = Edit(span, "yy")
    label = Label(span, "")
    return Diagnostic("ROSS999", "x", Severity.ERROR, "t", label, fix=Fix("f", (edit,)))


def test_the_summary_counts() -> None:
    error = unit_mismatch(RULES)
    unused = warning(place(RULES, "force"))
    assert summary([error, error, unused], 3) == "2 errors, 1 warning in 3 files"
    assert summary([unused], 1) == "1 warning in 1 file"
    assert summary([], 2) == "no errors in 2 files"
