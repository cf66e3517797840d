"""Tests that demonstrate findings: the witnesses of a check as text in the rules language.

The tests are written as text and parsed again, so that their expectations fit the file.
"""

from __future__ import annotations

import dataclasses
import os
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.source import SourceFile
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.witness import Witness, views
from rossmarie.driver.analyze import Analysis
from rossmarie.driver.formatting import format_text
from rossmarie.driver.pipeline import compile_file
from rossmarie.ir import Machine
from rossmarie.ir.script import Script
from rossmarie.testing.run import expectations_of
from rossmarie.testing.shown import is_shown, script_of
from rossmarie.testing.write import own_name, write_script

_MARK = "// Written by `rossmarie check --witnesses`: "
_HEAD = """\
{mark}what shows its findings. Copy what you keep: the next check
// writes this file again.
import "{rules}";
"""


@dataclass(frozen=True)
class WitnessTests:
    """The text of a file of tests, its number of tests, and the findings that cannot be written as
    tests.
    """

    text: str
    count: int
    left_out: tuple[str, ...]


@dataclass(frozen=True)
class _Shown:
    """A script, its rules, and its witness."""

    script: Script
    rules: tuple[int, ...]
    witness: Witness


def witness_tests(
    analysis: Analysis,
    rules: Path,
    path: Path,
    *,
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
) -> WitnessTests | None:
    """A file of tests at `path` that demonstrates the findings on rules; None if there is none.
    Raises `RulesError`.
    """
    showing = list(_with_witness(analysis.findings))
    if analysis.compiled is None or not showing:
        return None
    machine, bases = analysis.compiled.machine, analysis.compiled.bases
    shown: list[_Shown] = []
    left_out: list[str] = []
    names: Counter[str] = Counter()
    for finding, witness in showing:
        name = own_name(f"{finding.diagnostic.code}: {finding.diagnostic.title}", names)
        about = _rules_of(machine, finding, witness)
        script = script_of(machine, witness, name, about)
        if script is None:
            left_out.append(name)
        else:
            shown.append(_Shown(script, about, witness))
    text = "\n".join(write_script(machine, each.script, bases) for each in shown)
    read = compile_file(
        rules,
        systems=systems,
        message_folders=message_folders,
        tests=SourceFile(str(path), text),
    )
    known = {script.name: script for script in read.tests}
    tests: list[str] = []
    for each in shown:
        script = known[each.script.name]
        if all(is_shown(read.machine, each.witness, script, rule) for rule in each.rules):
            expecting = _expecting(read.machine, each, script)
            tests.append(write_script(machine, expecting, bases))
        else:
            left_out.append(script.name)
    relative = Path(os.path.relpath(rules, path.parent)).as_posix()
    whole = "\n\n".join([_HEAD.format(mark=_MARK, rules=relative), *tests])
    return WitnessTests(format_text(whole), len(tests), tuple(left_out))


def _with_witness(findings: Sequence[Finding]) -> Iterator[tuple[Finding, Witness]]:
    for finding in findings:
        if finding.witness is not None:
            yield finding, finding.witness


def _rules_of(machine: Machine, finding: Finding, witness: Witness) -> tuple[int, ...]:
    """The rules that a finding points at, or else the rules that are active in its witness, or else
    all.
    """
    places = [finding.diagnostic.primary, *finding.diagnostic.labels]
    named = [
        index
        for index, rule in enumerate(machine.rules)
        if any(rule.span.contains(place.span) for place in places)
    ]
    everywhere = range(len(machine.rules))
    seen = list(views(machine, witness))
    active = [rule for rule in everywhere if any(view.active[rule] for view in seen)]
    return tuple(named or active or everywhere)


def _expecting(machine: Machine, shown: _Shown, script: Script) -> Script:
    """The script in the form in which it will be parsed, with the observed behavior as
    expectations.
    """
    expectations = [
        expected
        for rule in shown.rules
        for expected in expectations_of(machine, script, rule, shown.witness.end_ns)
    ]
    return dataclasses.replace(shown.script, expectations=tuple(expectations))
