"""Findings arrive as they were sent, and what is none is refused."""

from __future__ import annotations

import json
from dataclasses import astuple
from typing import Any

import pytest

from dslkit.diagnostics import Diagnostic, Edit, Fix, Label, Severity
from dslkit.diagnostics.render_text import render_text
from dslkit.diagnostics.wire import Receiver, Sender
from dslkit.source import SourceFile, Span

FILE = SourceFile("skill\udcff.py", "a\nbcd é\n", "\ufeff")
OTHER = SourceFile("other.py", "xyz")
FULL = Diagnostic(
    code="EZS999",
    name="name",
    severity=Severity.WARNING,
    title="title",
    primary=Label(Span(FILE, 2, 5), "here"),
    labels=(Label(Span(OTHER, 0, 3), "there"), Label(Span(FILE, 0, 1), "")),
    notes=("one", "two"),
    help="help",
    fix=Fix("fix", (Edit(Span(OTHER, 1, 2), "Y"), Edit(Span(FILE, 0, 0), ""))),
)
BARE = Diagnostic("EZS998", "bare", Severity.ERROR, "title", Label(Span(FILE, 0, 0), ""))


def sent(*found: Diagnostic) -> list[list[Any]]:
    messages: list[list[Any]] = []
    sender = Sender(lambda message: messages.append(json.loads(json.dumps(message))))
    for each in found:
        sender.send(each)
    return messages


def test_findings_arrive_as_they_were() -> None:
    messages = sent(FULL, BARE)
    receiver = Receiver()
    full, bare = filter(None, map(receiver.receive, messages))
    assert [each[0] for each in messages] == ["file", "file", "finding", "finding"]
    assert render_text([full, bare]) == render_text([FULL, BARE])
    assert full.fix is not None
    assert [each.replacement for each in full.fix.edits] == ["Y", ""]
    assert (full.code, full.name, full.notes, full.help) == ("EZS999", "name", FULL.notes, "help")
    assert full.primary.span.file is bare.primary.span.file
    assert astuple(bare.primary.span.file) == astuple(FILE)


@pytest.mark.parametrize(
    "message",
    [
        ["file"],
        ["file", 1, "path"],
        ["finding"],
        ["finding", *sent(BARE)[1][1:-1]],
        ["finding", ["EZS1", "n", "fatal", "t", None], [0, 0, 0, ""], [], [], None],
        ["finding", ["EZS1", "n", "error", "t", None], [7, 0, 0, ""], [], [], None],
        ["finding", ["EZS1", "n", "error", "t", None], "x", [], [], None],
    ],
)
def test_what_is_no_finding_is_refused(message: list[Any]) -> None:
    receiver = Receiver()
    receiver.receive(sent(BARE)[0])
    with pytest.raises(ValueError, match="no message about"):
        receiver.receive(message)
