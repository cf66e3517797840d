"""Rules files through the whole check, compared with the expectations in them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic, apply_edits
from rossmarie.driver.analyze import analyze_file
from support import expectations

THOROUGH = "// rossmarie check --thorough"
"""The text in rules files for which all queries are run."""


def findings(path: Path) -> tuple[Diagnostic, ...]:
    """The findings of `rossmarie check` on a rules file."""
    text = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
    return analyze_file(path, thorough=THOROUGH in text).diagnostics


def compare_file(path: Path, *, bless: bool) -> list[str]:
    """The differences between the findings on a rules file and its expectations.

    Findings in imported files are compared with the expectations there.
    """
    found = findings(path)
    own = [one for one in found if one.primary.span.file.path == str(path)]
    text = path.read_bytes().decode("utf-8")
    if bless:
        path.write_bytes(expectations.bless(text, own).encode("utf-8"))
        return []
    problems = expectations.compare(text, own)
    for one in found:
        file = one.primary.span.file
        if one not in own and expectations.compare(file.text, [one]):
            problems.append(f"found, not expected, in {file.path}: {one.code}: {one.title}")
    return problems


def useless_fixes(path: Path) -> list[str]:
    """The findings on a rules file that are still there when their own fix has been applied."""
    useless = []
    for one in findings(path):
        edits = one.fix.edits if one.fix is not None else ()
        in_file = [edit for edit in edits if edit.span.file.path == str(path)]
        if not in_file or len(in_file) != len(edits):
            continue
        before = path.read_bytes()
        fixed = apply_edits(in_file[0].span.file.text, in_file)
        path.write_bytes(fixed.encode("utf-8"))
        after = findings(path)
        path.write_bytes(before)
        if _count(after, one) >= _count(findings(path), one):
            useless.append(f"{one.primary.span}: {one.code}: {one.title}: {one.fix}")
    return useless


def _count(found: Sequence[Diagnostic], like: Diagnostic) -> int:
    """The number of findings with the code of `like` about the same words."""
    words = like.primary.span.text
    return sum((one.code, one.primary.span.text) == (like.code, words) for one in found)
