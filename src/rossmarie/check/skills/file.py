"""The skills file that a program names."""

from __future__ import annotations

from pathlib import Path

from dslkit.diagnostics import Label
from dslkit.source import Span
from rossmarie.check.model import PERIODS_OF_TIMEOUT, CheckedSkills
from rossmarie.check.scopes.context import Context
from rossmarie.check.skills.errors import SeveralSkills, SkillsOutOfDate, SkillsUnreadable
from rossmarie.skills import UnreadableSkills, changed_source, parse_skills, read_text
from rossmarie.syntax import ast


def read_skills(context: Context) -> None:
    """Read the skills file into `context.skills`, with the default timeout. Reports a file that
    cannot be used, and a second, different file.
    """
    for item in context.declarations.items:
        if not isinstance(item, ast.Skills):
            continue
        context.names_skills = True
        found = _read(item, context)
        if found is None:
            continue
        if context.skills is None:
            context.skills = found
        elif found.file.digest != context.skills.file.digest:
            _report_second(item, "another skills file", context.skills.declaration, context)


def _read(item: ast.Skills, context: Context) -> CheckedSkills | None:
    path = Path(item.path.span.file.path).parent / item.path.value
    try:
        source = read_text(path)
        file = parse_skills(source)
    except UnreadableSkills as error:
        _report_unreadable(item, error, context)
        return None
    changed = changed_source(file, path.parent)
    if changed is not None:
        finding = SkillsOutOfDate(
            path=item.path.value, source=changed.path, problem=changed.problem
        )
        context.collector.add(finding.at(item.path.span))
        return None
    return CheckedSkills(file, source, item, PERIODS_OF_TIMEOUT * file.period_ns)


def _report_unreadable(item: ast.Skills, error: UnreadableSkills, context: Context) -> None:
    finding = SkillsUnreadable(path=item.path.value, problem=error.problem)
    labels: tuple[Label, ...] = ()
    if error.file is not None and error.offset is not None:
        place = Span(error.file, error.offset, min(error.offset + 1, len(error.file.text)))
        labels = (finding.Here().at(place),)
    context.collector.add(finding.at(item.path.span, *labels))


def _report_second(item: ast.Skills, found: str, first: ast.Skills, context: Context) -> None:
    finding = SeveralSkills(found=found)
    context.collector.add(finding.at(item.span, finding.First(found="the first").at(first.span)))


def report_second_timeout(item: ast.Skills, first: ast.Skills, context: Context) -> None:
    """Report that two items give one skills file different timeouts."""
    _report_second(item, "another timeout", first, context)
