"""Findings as JSON messages between processes. Unlike a pickle, JSON runs no code of its sender."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from dslkit.diagnostics.model import Diagnostic, Edit, Fix, Label, Severity
from dslkit.source import SourceFile, Span


class Sender:
    """Converts findings to messages. A file is sent once, before the first finding in it."""

    def __init__(self, send: Callable[[list[Any]], object]) -> None:
        self._send = send
        self._files: dict[SourceFile, int] = {}

    def send(self, found: Diagnostic) -> None:
        """Send a finding, and the files that it refers to."""
        for span in _spans(found):
            if span.file not in self._files:
                number = self._files[span.file] = len(self._files)
                self._send(["file", number, span.file.path, span.file.text, span.file.mark])
        fix = found.fix and [found.fix.title, [self._edit(each) for each in found.fix.edits]]
        primary, *labels = (self._label(each) for each in (found.primary, *found.labels))
        words = [found.code, found.name, found.severity.value, found.title, found.help]
        self._send(["finding", words, primary, labels, [*found.notes], fix])

    def _label(self, label: Label) -> list[Any]:
        return [*self._place(label.span), label.text]

    def _edit(self, edit: Edit) -> list[Any]:
        return [*self._place(edit.span), edit.replacement]

    def _place(self, span: Span) -> tuple[int, int, int]:
        return self._files[span.file], span.start, span.end


class Receiver:
    """Converts messages to findings. A message of another format raises `ValueError`."""

    def __init__(self) -> None:
        self._files: dict[int, SourceFile] = {}

    def receive(self, message: list[Any]) -> Diagnostic | None:
        """The finding in a message; None if the message is a file for later findings."""
        try:
            if message[0] == "file":
                _, number, path, text, mark = message
                self._files[number] = SourceFile(path, text, mark)
                return None
            _, words, primary, labels, notes, fix = message
            code, name, severity, title, help = words
            return Diagnostic(
                code=code,
                name=name,
                severity=Severity(severity),
                title=title,
                primary=self._label(primary),
                labels=tuple(map(self._label, labels)),
                notes=tuple(notes),
                help=help,
                fix=fix and Fix(fix[0], tuple(map(self._edit, fix[1]))),
            )
        except (IndexError, KeyError, TypeError, ValueError) as problem:
            raise ValueError("this is no message about a finding") from problem

    def _label(self, label: list[Any]) -> Label:
        return Label(self._span(label), label[3])

    def _edit(self, edit: list[Any]) -> Edit:
        return Edit(self._span(edit), edit[3])

    def _span(self, place: list[Any]) -> Span:
        return Span(self._files[place[0]], place[1], place[2])


def _spans(found: Diagnostic) -> Iterator[Span]:
    yield found.primary.span
    yield from (label.span for label in found.labels)
    yield from (edit.span for edit in (found.fix.edits if found.fix else ()))
