"""The notation for expected findings: what it accepts, what it rejects, what it writes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dslkit.diagnostics import Diagnostic, Label, Severity
from dslkit.source import SourceFile, Span
from support import expectations


def finding(
    text: str,
    start: int,
    end: int,
    code: str = "ROSS301",
    title: str = "units do not match",
    labels: tuple[tuple[int, int, str], ...] = (),
) -> Diagnostic:
    file = SourceFile("rules.ross", text)
    return Diagnostic(
        code=code,
        name="some-name",
        severity=Severity.ERROR,
        title=title,
        primary=Label(Span(file, start, end), ""),
        labels=tuple(Label(Span(file, first, last), said) for first, last, said in labels),
    )


STATED = 'const f = 3 N/s\n//        ^^^^^ error[ROSS301] "do not"\n'


def test_carets_accept_exactly_their_span() -> None:
    assert expectations.compare(STATED, [finding(STATED, 10, 15)]) == []


@pytest.mark.parametrize(
    "other",
    [
        finding(STATED, 10, 14),
        finding(STATED, 9, 15),
        finding(STATED, 10, 15, code="ROSS302"),
        finding(STATED, 10, 15, title="something else"),
    ],
)
def test_any_difference_is_reported_from_both_sides(other: Diagnostic) -> None:
    problems = expectations.compare(STATED, [other])
    assert [problem.split(",")[0] for problem in problems] == ["expected", "found"]


def test_each_finding_needs_an_expectation_of_its_own() -> None:
    twice = [finding(STATED, 10, 15), finding(STATED, 10, 15)]
    (problem,) = expectations.compare(STATED, twice)
    assert problem.startswith("found, not expected")


def test_a_text_without_expectations_is_clean() -> None:
    assert expectations.compare("const n = 3\n", []) == []
    (problem,) = expectations.compare("const n = 3\n", [finding("const n = 3\n", 6, 7)])
    assert problem.endswith("//    ^ error[ROSS301]")


def test_the_tilde_form_is_for_a_whole_line() -> None:
    text = "const n = 3\n//~ error[ROSS301]\n"
    assert expectations.compare(text, [finding(text, 0, 5)]) == []
    assert expectations.compare(text, [finding(text, 6, 7)]) == []


def test_several_expectations_stand_under_one_line() -> None:
    text = "const n = m\n//    ^ error[ROSS101]\n//        ^ error[ROSS301]\n"
    found = [finding(text, 6, 7, "ROSS101"), finding(text, 10, 11)]
    assert expectations.compare(text, found) == []


def test_labels_are_compared_where_stated() -> None:
    text = 'const n = m\n//        ^ error[ROSS301]\n//    ~ note "this one"\n'
    assert expectations.compare(text, [finding(text, 10, 11, labels=((6, 7, "this one"),))]) == []
    (problem,) = expectations.compare(text, [finding(text, 10, 11, labels=((0, 5, "this one"),))])
    assert 'note "this one"' in problem


def test_a_span_over_lines_is_marked_on_its_first() -> None:
    text = "rule a: if b\n//      ^^^^ error[ROSS301]\nthen\n"
    assert expectations.compare(text, [finding(text, 8, len(text) - 2)]) == []


def test_the_end_of_the_file_belongs_to_the_last_line_of_code() -> None:
    text = "entity e {\n//~ error[ROSS001]\n"
    assert expectations.compare(text, [finding(text, len(text), len(text), "ROSS001")]) == []


def test_comments_of_other_languages_have_another_sign() -> None:
    text = "count = 3\n#       ^ error[EZS301]\n"
    found = [finding(text, 8, 9, "EZS301")]
    assert expectations.compare(text, found, "#") == []
    assert expectations.bless("count = 3\n", found, "#") == text
    assert expectations.parse(text) == expectations.parse(text.replace("#", "//"), "#") == ()


def test_blessing_keeps_the_texts_that_still_fit() -> None:
    old = 'const  f = 3 N/s\n//        ^^^^^ error[ROSS301] "do not"\n//~ error[ROSS999]\n'
    new = 'const  f = 3 N/s\n//         ^^^^^ error[ROSS301] "do not"\n'
    assert expectations.bless(old, [finding(old, 11, 16)]) == new


WORDS = st.text(st.sampled_from("ab \t\n"), max_size=40)


@given(WORDS, st.data())
def test_what_is_blessed_is_accepted(text: str, data: st.DataObject) -> None:
    offsets = st.integers(0, len(text))
    spans = data.draw(st.lists(st.tuples(offsets, offsets).map(sorted), max_size=4))
    found = [finding(text, start, end) for start, end in spans]
    blessed = expectations.bless(text, found)
    assert len(expectations.parse(blessed)) == len(found)
    moved = [finding(blessed, *_moved(text, blessed, start, end)) for start, end in spans]
    assert expectations.compare(blessed, moved) == []
    assert expectations.bless(blessed, moved) == blessed


def _moved(text: str, blessed: str, start: int, end: int) -> tuple[int, int]:
    """The position of a span of `text` in `blessed`, which has more lines but the same columns."""
    file = SourceFile("", blessed)
    code = [
        number
        for number, line in enumerate(blessed.split("\n"), start=1)
        if not line.startswith("//")
    ]
    places = (SourceFile("", text).position(offset) for offset in (start, end))
    first, last = (file.line_starts[code[at.line - 1] - 1] + at.column - 1 for at in places)
    return first, last
