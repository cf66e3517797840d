"""The tests of a rules file, run on the interpreter and in C."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from dslkit.source import SourceFile, Span, is_file
from rossmarie.driver.pipeline import Compiled, compile_file
from rossmarie.driver.workspace import LIBRARY
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Machine
from rossmarie.ir.script import Script
from rossmarie.native import BuildError, NativeMonitor, NoCompilerError, load_native
from rossmarie.targets import c99
from rossmarie.testing.commands import command_failures
from rossmarie.testing.coverage import Coverage, cover
from rossmarie.testing.errors import NoTests, NotRunInC
from rossmarie.testing.findings import differences, failures
from rossmarie.testing.goals import TraceGoal
from rossmarie.testing.run import run
from rossmarie.testing.unreachable import unreachable
from rossmarie.testing.unread import unread

SUFFIX = ".tests.ross"
"""The suffix of test files: `rules.tests.ross` beside `rules.ross` contains the tests of
`rules.ross`.
"""


@dataclass(frozen=True)
class Ran:
    """One test: its failed expectations, and its run time in seconds."""

    script: Script
    found: tuple[Diagnostic, ...]
    seconds: float


@dataclass(frozen=True)
class RanTests:
    """The tests that ran, their common coverage, and further findings. `has_c` is False if there
    was no C compiler. `reasons` maps goals to the reasons why they cannot be reached.
    """

    machine: Machine
    ran: tuple[Ran, ...]
    coverage: Coverage
    findings: tuple[Diagnostic, ...]
    has_c: bool
    reasons: Mapping[TraceGoal, str]


class UnknownTestError(Exception):
    """No test has the requested name."""

    def __init__(self, wanted: str, known: Sequence[str]) -> None:
        self.wanted = wanted
        self.known = tuple(known)
        super().__init__(f"there is no test `{wanted}`")


def tests_beside(rules: Path) -> Path:
    """The path of the file with the tests of a rules file. The file need not exist."""
    return rules if rules.name.endswith(SUFFIX) else rules.with_name(rules.stem + SUFFIX)


def run_test_file(
    rules: Path,
    names: Sequence[str] = (),
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    in_c: bool = True,
) -> RanTests:
    """Run the tests of a rules file and of the file of tests beside it, on the interpreter and, if
    `in_c`, in C. Only tests run whose name matches one of `names`, in which `*` stands for any
    text. The coverage is about `tested_rules`.

    Raises `RulesError` and `UnknownTestError`.
    """
    beside = tests_beside(rules)
    main = beside if is_file(beside) else rules
    compiled = compile_file(main, systems=systems, message_folders=message_folders)
    scripts = tuple(_chosen(compiled.tests, names))
    findings = [*compiled.warnings, *unread(compiled.machine, scripts)]
    if not scripts:
        start = Span(SourceFile(str(rules), ""), 0, 0)
        findings.append(NoTests(beside=beside.name, path=str(rules)).at(start))
    outcome = run_tests(compiled, scripts, tuple(findings), in_c=in_c)
    tested = {*tested_rules(compiled.machine, rules)}
    goals = tuple(goal for goal in outcome.coverage.goals if goal.rule in tested)
    return replace(outcome, coverage=replace(outcome.coverage, goals=goals))


def tested_rules(machine: Machine, rules: Path) -> Sequence[int]:
    """The numbers of the rules that the tests of a rules file are about. Rules of imported library
    files are left out, because the library has tests for them.
    """
    is_shipped = LIBRARY in rules.resolve().parents
    return [
        index
        for index, rule in enumerate(machine.rules)
        if is_shipped or LIBRARY not in Path(rule.span.file.path).resolve().parents
    ]


def _chosen(scripts: Sequence[Script], names: Sequence[str]) -> Iterator[Script]:
    for name in names:
        if not any(fnmatchcase(script.name, name) for script in scripts):
            raise UnknownTestError(name, [script.name for script in scripts])
    for script in scripts:
        if not names or any(fnmatchcase(script.name, name) for name in names):
            yield script


def run_tests(
    compiled: Compiled,
    scripts: Sequence[Script],
    findings: tuple[Diagnostic, ...] = (),
    *,
    in_c: bool = True,
) -> RanTests:
    """Run scripts on their machine."""
    machine = compiled.machine
    native = _native(machine) if scripts and in_c else None
    if isinstance(native, str):
        start = Span(machine.rules[0].span.file, 0, 0) if machine.rules else scripts[0].span
        assert start is not None
        findings = (*findings, NotRunInC(reason=native).at(start))
    monitor = native if isinstance(native, NativeMonitor) else None
    ran = tuple(_run(machine, script, monitor) for script in scripts)
    coverage = cover(machine, scripts)
    missing = [goal for goal in coverage.goals if goal not in coverage.reached]
    reasons = unreachable(machine, missing)
    return RanTests(machine, ran, coverage, findings, monitor is not None, reasons)


def _native(machine: Machine) -> NativeMonitor | str:
    """The machine in C, or the reason why it cannot be built."""
    refused = next(iter(c99.unsupported(machine)), None)
    if refused is not None:
        return refused.title
    try:
        return load_native(machine, c99.generate_loadable(machine))
    except (NoCompilerError, BuildError, OSError) as error:
        return str(error).partition("\n")[0]


def _run(machine: Machine, script: Script, native: NativeMonitor | None) -> Ran:
    start = time.perf_counter()
    verdicts = run(Interpreter(machine), machine, script)
    found = (*failures(machine, script, verdicts), *command_failures(machine, script))
    if native is not None:
        in_c = run(native.fresh(), machine, script)
        found += tuple(differences(machine, script, verdicts, in_c))
    return Ran(script, found, time.perf_counter() - start)
