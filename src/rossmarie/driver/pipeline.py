"""The stages in order, from the text over the syntax tree and the checked program to the machine.

Each stage gets the result of the stage before it. Findings are collected, and no stage runs after a
stage with errors.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic, Severity
from dslkit.source import SourceFile
from rossmarie.check import CheckedProgram, CheckOptions, check, select
from rossmarie.check.instances.instantiate import instantiate
from rossmarie.check.instances.spaces import Imported, Instances
from rossmarie.check.instances.telling import reported
from rossmarie.driver.shortened import shortened
from rossmarie.driver.workspace import load_modules
from rossmarie.ir import Category, Machine, Requirement, verify, without_margins
from rossmarie.ir import Path as FieldPath
from rossmarie.ir.script import Script
from rossmarie.lowering import lower, lower_requirements, misdirected
from rossmarie.syntax import ast, parse
from rossmarie.targets.unsupported import unsupported


@dataclass(frozen=True)
class CheckResult:
    """The visible findings on one rules file. `program` is None if there are errors."""

    modules: Sequence[ast.Module]
    program: CheckedProgram | None
    diagnostics: tuple[Diagnostic, ...]
    instances: Instances = field(default_factory=Instances)


class RulesError(Exception):
    """The error for a rules file with errors. `diagnostics` are the visible errors, and the
    warnings.
    """

    def __init__(self, diagnostics: tuple[Diagnostic, ...]) -> None:
        self.diagnostics = diagnostics
        errors = [found for found in diagnostics if found.severity is Severity.ERROR]
        lines = [f"{found.primary.span}: [{found.code}] {found.title}" for found in errors]
        super().__init__("\n".join(lines))


def check_file(
    rules: Path,
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    tests: SourceFile | None = None,
    only: Sequence[Category] = (),
) -> CheckResult:
    """Parse and check a rules file and everything that it imports.

    `systems` are further system models; `message_folders` contain .msg files. A file `system.ross`
    beside the rules is an implicit system model. `tests` is a file of tests in memory: it is
    checked as if it imported the rules. `only` keeps the rules with these categories (all if it is
    empty).
    """
    collector = Collector()
    files = load_modules(rules, systems, collector)
    files += [] if tests is None else [Imported(parse(tests, collector), ())]
    modules, instances = instantiate(files, collector)
    options = CheckOptions(message_folders=tuple(message_folders))
    program = check(modules, options, collector)
    if program is not None:
        program = select(program, modules, only, collector)
    if program is not None and any(each.setting is not None for each in _inputs(modules)):
        collector.extend(misdirected(lower(program)))
        program = None if collector.has_errors else program
    found = shortened(reported(collector.sorted(), instances))
    return CheckResult(modules, program, found, instances)


@dataclass(frozen=True)
class Compiled:
    """A rules file without errors: its machine, its warnings, the folders of its message
    definitions, its tests, and for each input the path that its declaration selects. `sources` are
    all files that the machine depends on, each once, as they were read, the main file last.
    `with_margins` is the machine for learners, with the declared margins. `requirements` are the
    requirements of rules.
    """

    machine: Machine
    with_margins: Machine
    warnings: tuple[Diagnostic, ...]
    message_folders: tuple[Path, ...]
    tests: tuple[Script, ...]
    bases: Mapping[str, FieldPath]
    sources: tuple[SourceFile, ...]
    requirements: tuple[Requirement, ...]
    instances: Instances = field(default_factory=Instances)


def compile_file(
    rules: Path,
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    tests: SourceFile | None = None,
    only: Sequence[Category] = (),
) -> Compiled:
    """Check a rules file and lower it, with the arguments of `check_file`. Raises `RulesError`."""
    result = check_file(
        rules, systems=systems, message_folders=message_folders, tests=tests, only=only
    )
    return compile_checked(result, message_folders)


def compile_checked(result: CheckResult, message_folders: Sequence[Path] = ()) -> Compiled:
    """Lower the result of `check_file`, with the same folders. Raises `RulesError` for errors, and
    for features that no target supports.
    """
    if result.program is None:
        raise RulesError(result.diagnostics)
    machine = lower(result.program)
    verify(machine)
    if refused := tuple(unsupported(machine)):
        raise RulesError((*result.diagnostics, *reported(refused, result.instances)))
    folders = (*message_folders, *_declared_folders(result.modules))
    frames = {each.declaration.name.text: () for each in result.program.frame_inputs.values()}
    bases = frames | {name: used.base for name, used in result.program.symbols.inputs.items()}
    files = {module.file.path: module.file for module in reversed(result.modules)}
    return Compiled(
        machine=without_margins(machine),
        with_margins=machine,
        warnings=result.diagnostics,
        message_folders=folders,
        tests=result.program.tests,
        bases=bases,
        sources=(*result.program.read_files, *reversed(files.values())),
        requirements=lower_requirements(result.program),
        instances=result.instances,
    )


def _inputs(modules: Sequence[ast.Module]) -> Iterator[ast.Input]:
    return (item for each in modules for item in each.items if isinstance(item, ast.Input))


def _declared_folders(modules: Sequence[ast.Module]) -> Iterator[Path]:
    """The folders that system models name, relative to the declaring file."""
    for module in modules:
        for item in module.items:
            for member in item.members if isinstance(item, ast.System) else ():
                if isinstance(member, ast.MessagesDeclaration):
                    yield Path(module.file.path).parent / member.path.value
