"""ROSS78x: reports that cannot go into a safety file."""

from __future__ import annotations

from pathlib import Path

from dslkit.diagnostics import Diagnostic, Error, Template, Warning
from dslkit.source import SourceFile, Span


class EvidenceError(Exception):
    """A report cannot be used. `diagnostic` gives the reason."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        self.diagnostic = diagnostic
        super().__init__(f"[{diagnostic.code}] {diagnostic.title}")


def at_file(finding: Template, path: Path) -> Diagnostic:
    """A finding about a report as a whole."""
    return finding.at(Span(SourceFile(str(path), ""), 0, 0))


class EvidenceUnreadable(Error, code="ROSS780", name="evidence-unreadable"):
    """A report that the operating system cannot open."""

    title = "the {kind} report cannot be read: {reason}"
    help = "check the path and the read permission of the file"
    kind: str
    reason: str


class NotEvidence(Error, code="ROSS781", name="not-evidence"):
    """A file that is not a report of the requested kind."""

    title = "this is not a {kind} report: {reason}"
    help = "give a {kind} report in JSON"
    kind: str
    reason: str


class EvidenceOfOtherRules(Warning, code="ROSS782", name="evidence-of-other-rules"):
    """A report about another text of the rules."""

    title = "the {kind} report is about another version of the rules"
    note = "the report does not contain the SHA-256 of {files}"
    help = "create the report again"
    kind: str
    files: str


ALL: tuple[type[Template], ...] = (EvidenceUnreadable, NotEvidence, EvidenceOfOtherRules)
