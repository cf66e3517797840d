"""Hand-made findings, to test what is done with findings."""

from __future__ import annotations

from hypothesis import strategies as st

from dslkit.diagnostics import Diagnostic, Edit, Fix, Label, Severity
from dslkit.source import SourceFile, Span


def place(file: SourceFile, text: str) -> Span:
    """The first place where a file says `text`."""
    start = file.text.index(text)
    return Span(file, start, start + len(text))


def unit_mismatch(file: SourceFile) -> Diagnostic:
    """A finding with everything that one can have, in a file that says `3 N/sec` and `force`."""
    value = place(file, "3 N/sec")
    return Diagnostic(
        code="ROSS301",
        name="unit-mismatch",
        severity=Severity.ERROR,
        title="units do not match",
        primary=Label(value, "this is in N/s"),
        labels=(Label(place(file, "force"), "this is in N"),),
        notes=("a force is in N, not in N/s",),
        help="write a value in N",
        fix=Fix("write `3 N`", (Edit(value, "3 N"),)),
    )


def warning(span: Span, label: str = "here") -> Diagnostic:
    """The least that a finding is: a title and a place."""
    return Diagnostic("ROSS401", "unused", Severity.WARNING, "not used", Label(span, label))


# Letters, and everything that is hard to show: tabs, line ends, wide and combining characters,
# controls, invisible and unassigned characters, halves of surrogate pairs.
AWKWARD_TEXT = st.text(
    st.one_of(
        st.sampled_from("ab \t\n\r\x00\x1b\x7f\x85\u0301\u200b\u202e\u2028\u540d\uff21\U0001f916"),
        st.characters(),
    ),
    max_size=60,
)

# Of the surrogates, only those by which Python stands for undecodable bytes of a path.
PATHS = st.text(st.characters(exclude_categories=["Cs"]) | st.just("\udcff"), max_size=20)


@st.composite
def any_finding(draw: st.DrawFn) -> Diagnostic:
    """A finding with arbitrary texts at arbitrary places of two arbitrary files."""
    files = [SourceFile(draw(PATHS), draw(AWKWARD_TEXT)) for _ in range(2)]

    def span(file: SourceFile) -> Span:
        offset = st.integers(0, len(file.text))
        start, end = sorted(draw(st.tuples(offset, offset)))
        return Span(file, start, end)

    labels = draw(st.lists(st.sampled_from(files), max_size=3))
    edit = Edit(span(files[0]), draw(AWKWARD_TEXT))
    return Diagnostic(
        code="ROSS999",
        name="anything",
        severity=draw(st.sampled_from(Severity)),
        title=draw(AWKWARD_TEXT),
        primary=Label(span(files[0]), draw(AWKWARD_TEXT)),
        labels=tuple(Label(span(file), draw(AWKWARD_TEXT)) for file in labels),
        notes=tuple(draw(st.lists(AWKWARD_TEXT, max_size=2))),
        help=draw(st.none() | AWKWARD_TEXT),
        fix=draw(st.none() | st.just(Fix(draw(AWKWARD_TEXT), (edit,)))),
    )
