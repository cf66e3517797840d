"""Tests generated from rules: proposed messages that reach a goal, with the verdicts of the
interpreter.

The proposals are written as text and parsed again, so that every number is the number in the file.
"""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.source import SourceFile
from rossmarie.check.instances.telling import spelled
from rossmarie.driver.formatting import format_text
from rossmarie.driver.pipeline import Compiled, compile_file
from rossmarie.driver.testing import tested_rules, tests_beside
from rossmarie.ir.script import Script
from rossmarie.testing.coverage import Watcher
from rossmarie.testing.goals import TraceGoal
from rossmarie.testing.left_out import points_left_out
from rossmarie.testing.play import steps_of
from rossmarie.testing.propose import ProposedScript, propose
from rossmarie.testing.run import expectations_of
from rossmarie.testing.write import own_name, write_script

_HEAD = """\
// Written by `rossmarie test {rules} --write`: tests of these rules at their boundaries. Do
// not edit this file. Generate it again, and review the difference.
import "{rules}";
"""


@dataclass(frozen=True)
class Written:
    """The text of a file of tests, its path, and its number of tests. `left_out` names the
    conditions on points for which there is no test.
    """

    path: Path
    text: str
    count: int
    left_out: tuple[str, ...] = ()


def generate_tests(
    rules: Path, *, systems: Sequence[Path] = (), message_folders: Sequence[Path] = ()
) -> Written:
    """Tests of all boundaries of the rules. Rules of the library are left out, because the library
    contains their tests. Raises `RulesError`.
    """
    compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    proposals = list(_renamed(propose(compiled.machine, tested_rules(compiled.machine, rules))))
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
    reached: set[TraceGoal] = set()
    for proposal in _telling(read, proposals, known, reached):
        script = known[proposal.script.name]
        expectations = tuple(expectations_of(read.machine, script, proposal.rule, script.end_ns))
        expecting = dataclasses.replace(proposal.script, expectations=expectations)
        tests.append(write_script(compiled.machine, expecting, compiled.bases))
    written = spelled("\n\n".join(tests), compiled.instances)
    text = format_text(f"{_HEAD.format(rules=rules.name)}\n\n{written}")
    return Written(path, text, len(tests), tuple(points_left_out(read.machine, reached)))


def _renamed(proposals: Iterator[ProposedScript]) -> Iterator[ProposedScript]:
    """The proposals with unique names."""
    seen: Counter[str] = Counter()
    for proposal in proposals:
        script = dataclasses.replace(proposal.script, name=own_name(proposal.script.name, seen))
        yield dataclasses.replace(proposal, script=script)


def _telling(
    compiled: Compiled,
    proposals: Sequence[ProposedScript],
    known: dict[str, Script],
    reached: set[TraceGoal],
) -> Iterator[ProposedScript]:
    """The proposals that cover a new goal of their rule. `reached` gives the goals that a proposal
    covers.
    """
    for proposal in proposals:
        script = known[proposal.script.name]
        watcher = Watcher(compiled.machine)
        watcher.watch(steps_of(compiled.machine, script), script.end_ns)
        new = {goal for goal in watcher.reached if goal.rule == proposal.rule} - reached
        reached.update(new)
        if new:
            yield proposal
