"""Tests written from rules: proposals that reach something, with what the interpreter says.

The proposals are written as text and read again, so that every number is the one that is in the
file.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.source import SourceFile
from rossmarie.driver.formatting import format_text
from rossmarie.driver.pipeline import Compiled, compile_file
from rossmarie.driver.testing import tests_beside
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Machine
from rossmarie.ir.script import Expectation, Script
from rossmarie.testing.coverage import Watcher
from rossmarie.testing.goals import Goal
from rossmarie.testing.play import steps_of
from rossmarie.testing.propose import Proposal, propose
from rossmarie.testing.run import run, stretches
from rossmarie.testing.write import write_script

_HEAD = """\
// Written by `rossmarie test {rules} --write`: what these rules do at their boundaries. Not
// meant to be edited: write it again, and look at the difference.
import "{rules}";
"""


@dataclass(frozen=True)
class Written:
    """The text of a file of tests, where it belongs, and how many tests it has."""

    path: Path
    text: str
    count: int


def generate_tests(
    rules: Path, *, systems: Sequence[Path] = (), message_folders: Sequence[Path] = ()
) -> Written:
    """Tests of all boundaries of the rules. Raises `RulesError`."""
    compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    proposals = list(_renamed(propose(compiled.machine)))
    path = tests_beside(rules)
    texts = [write_script(compiled.machine, each.script, compiled.bases) for each in proposals]
    read = compile_file(
        rules,
        systems=systems,
        message_folders=message_folders,
        tests=SourceFile(str(path), "\n".join(texts)),
    )
    known = {script.name: script for script in read.tests}
    tests = []
    for proposal in _telling(read, proposals, known):
        script = known[proposal.script.name]
        expectations = tuple(_expectations(read.machine, script, proposal.rule))
        expecting = dataclasses.replace(proposal.script, expectations=expectations)
        tests.append(write_script(compiled.machine, expecting, compiled.bases))
    text = format_text("\n\n".join([_HEAD.format(rules=rules.name), *tests]))
    return Written(path, text, len(tests))


def _renamed(proposals: Iterator[Proposal]) -> Iterator[Proposal]:
    """Each with a name of its own."""
    seen: dict[str, int] = {}
    for proposal in proposals:
        name = proposal.script.name
        seen[name] = seen.get(name, 0) + 1
        if seen[name] > 1:
            script = dataclasses.replace(proposal.script, name=f"{name} ({seen[name]})")
            yield dataclasses.replace(proposal, script=script)
        else:
            yield proposal


def _telling(
    compiled: Compiled, proposals: Sequence[Proposal], known: dict[str, Script]
) -> Iterator[Proposal]:
    """Those that show something of their rule that none before them shows."""
    reached: set[Goal] = set()
    for proposal in proposals:
        script = known[proposal.script.name]
        watcher = Watcher(compiled.machine)
        watcher.watch(steps_of(compiled.machine, script), script.end_ns)
        new = {goal for goal in watcher.reached if goal.rule == proposal.rule} - reached
        reached |= new
        if new:
            yield proposal


def _expectations(machine: Machine, script: Script, rule: int) -> list[Expectation]:
    """What the interpreter says of a rule."""
    verdicts = run(Interpreter(machine), machine, script)
    changes = [verdict for verdict in verdicts if verdict.rule == rule]
    end_ns = script.end_ns
    expectations: list[Expectation] = []
    for stretch in stretches(changes):
        last_ns = end_ns if stretch.end_ns is None else stretch.end_ns - 1
        if expectations and expectations[-1].is_active is stretch.is_active:
            first_ns = expectations.pop().first_ns
        else:
            first_ns = stretch.first_ns
        expectations.append(Expectation(rule, stretch.is_active, first_ns, last_ns, None))
    return expectations
