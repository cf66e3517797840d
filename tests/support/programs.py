"""Rules as text, to check them in memory."""

from __future__ import annotations

from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic, Severity
from dslkit.source import SourceFile
from rossmarie.check import CheckedProgram, CheckOptions, check
from rossmarie.check.instances.instantiate import instantiate
from rossmarie.check.instances.spaces import Imported
from rossmarie.syntax import ast, parse


def check_text(
    text: str, *, message_folders: tuple[Path, ...] = ()
) -> tuple[CheckedProgram | None, tuple[Diagnostic, ...]]:
    """The checked program of one file of rules, and all findings on it."""
    collector = Collector()
    module = parse(SourceFile("rules.ross", text), collector)
    modules, _ = instantiate([Imported(module, ())], collector)
    program = check(modules, CheckOptions(message_folders), collector)
    return program, collector.sorted()


def program_of(text: str, *, message_folders: tuple[Path, ...] = ()) -> CheckedProgram:
    """The checked program of rules that are right."""
    program, found = check_text(text, message_folders=message_folders)
    assert program is not None, [finding.title for finding in found]
    return program


def errors_of(text: str) -> list[tuple[str, str]]:
    """The code of each error, and the words that it is about."""
    _, found = check_text(text)
    return [
        (finding.code, finding.primary.span.text)
        for finding in found
        if finding.severity is Severity.ERROR
    ]


def condition(program: CheckedProgram, name: str) -> ast.Expression:
    """The expression of `entity.condition`."""
    entity, _, own = name.partition(".")
    return program.symbols.conditions[entity, own].expression
