"""Diagnostics declared as classes, and their collector."""

from __future__ import annotations

from typing import ClassVar

import pytest

from dslkit.diagnostics import (
    Collector,
    DidYouMean,
    Error,
    Fix,
    Label,
    Remark,
    Severity,
    Template,
    Warning,
)
from dslkit.source import SourceFile, Span

FILE = SourceFile("x.ross", "const a = 1\nconst b = 2\n")


class Mismatch(Error, code="ROSS999", name="mismatch"):
    title = "`{found}` is not `{wanted}`"
    label = "this is {found}"
    note = "they differ"
    help = "write {wanted}"
    found: str
    wanted: str

    class Result(Remark):
        says = "and so {result} are lost"
        result: str

    class Misspelt(Remark):
        says = "{resutl}"
        result: str


class Unused(Warning, code="ROSS998", name="unused"):
    title = "not used"


class Misspelt(Error, code="ROSS997", name="misspelt"):
    title = "`{fuond}`"
    found: str


class Addressed(Template):
    title = "from `{by}` to `{to}` at {at_s}"
    by: str
    to: str


class Sent(Addressed, Error, code="ROSS996", name="sent"):
    kind: ClassVar[str] = "letter"
    at_s: int


class Late(Template):
    help = "{advice}"
    advice: str = "ask the post"


class Delayed(Late, Addressed, Error, code="ROSS995", name="delayed"):
    at_s: int


def span(start: int) -> Span:
    return Span(FILE, start, start + 1)


def test_the_fields_fill_the_texts() -> None:
    other = Label(span(0), "the other")
    fix = Fix("do", ())
    found = Mismatch(found="m", wanted="s").at(
        span(6), other, fix=fix, notes=(Mismatch.Result(result="all"),)
    )
    assert (found.code, found.name, found.severity) == ("ROSS999", "mismatch", Severity.ERROR)
    assert (found.title, found.help) == ("`m` is not `s`", "write s")
    assert found.primary == Label(span(6), "this is m")
    assert (found.labels, found.notes, found.fix) == (
        (other,),
        ("they differ", "and so all are lost"),
        fix,
    )


def test_a_help_at_hand_replaces_the_general_one() -> None:
    found = Mismatch(found="m", wanted="s").at(span(6), help=DidYouMean(near="s"))
    assert found.help == "did you mean `s`?"


def test_braces_in_values_are_left_alone() -> None:
    assert Mismatch(found="{x}", wanted="}").at(span(0)).title == "`{x}` is not `}`"


def test_a_misspelt_placeholder_is_found() -> None:
    Mismatch.check_placeholders()
    with pytest.raises(ValueError, match="fuond"):
        Misspelt.check_placeholders()


def test_a_misspelt_placeholder_of_a_remark_is_found() -> None:
    Mismatch.Result.check_placeholders()
    with pytest.raises(ValueError, match=r"Mismatch\.Misspelt.*resutl"):
        Mismatch.Misspelt.check_placeholders()


def test_a_remark_is_a_label_where_it_gets_a_place() -> None:
    result = Mismatch(found="m", wanted="s").Result(result="{all}")
    assert result.at(span(3)) == Label(span(3), "and so {all} are lost")
    assert result == Mismatch.Result(result="{all}") != Mismatch.Result(result="none")
    with pytest.raises(TypeError, match="'result'"):
        Mismatch.Result(found="m")  # type: ignore[call-arg]


def test_fields_are_those_of_all_bases_and_have_to_be_given() -> None:
    assert Sent(by="a", to="b", at_s=1).at(span(0)).title == "from `a` to `b` at 1"
    with pytest.raises(TypeError, match="'at_s', 'by', 'to'"):
        Sent(by="a", to="b")  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="'at_s', 'by', 'to'"):
        Sent(by="a", to="b", at_s=1, more=2)  # type: ignore[call-arg]


def test_a_field_may_have_a_default() -> None:
    assert Delayed(by="a", to="b", at_s=3).at(span(0)).help == "ask the post"
    assert Delayed(by="a", to="b", at_s=3, advice="wait").at(span(0)).help == "wait"


def test_templates_are_values() -> None:
    one, same, other = (Mismatch(found="m", wanted=each) for each in ("s", "s", "kg"))
    assert one == same != other
    assert len({one, same, other}) == 2
    assert repr(one) == "Mismatch(found='m', wanted='s')"
    with pytest.raises(AttributeError, match="found"):
        one.found = "s"  # type: ignore[misc]
    with pytest.raises(AttributeError, match="found"):
        del one.found
    assert one == same


def test_the_collector_keeps_each_finding_once_and_in_order() -> None:
    collector = Collector()
    collector.extend([Unused().at(span(6)), Unused().at(span(0)), Unused().at(span(6))])
    assert [found.primary.span.start for found in collector.sorted()] == [0, 6]
    assert not collector.has_errors
    collector.add(Mismatch(found="a", wanted="b").at(span(3)))
    assert collector.has_errors
