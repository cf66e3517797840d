"""Plays a script on an engine and judges its expectations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from rossmarie.interpreter import Interpreter
from rossmarie.ir import Change, ChannelValues, Event, Machine, Verdict
from rossmarie.ir.script import Expectation, Script
from rossmarie.testing.play import InstantEvents, steps_of


class Engine(Protocol):
    """The common interface of the interpreter and a monitor in C."""

    def update(self, at_ns: int, messages: Mapping[int, ChannelValues]) -> list[Event]:
        """Process arriving messages."""

    def advance(self, at_ns: int) -> list[Event]:
        """Let time pass."""

    def reset(self, at_ns: int, rule: int | None = None) -> list[Event]:
        """Reset one rule, or all rules if `rule` is None, as an operator does."""


@dataclass(frozen=True)
class FailedExpectation:
    """An expectation that was not met at `at_ns`. `cause` is the last change of the rule until
    then; `following` is the first change after it. Both are None if there is no such change.
    """

    expectation: Expectation
    at_ns: int
    cause: Verdict | None
    following: Verdict | None


@dataclass(frozen=True)
class Stretch:
    """A stretch in which a rule is active, or inactive: from `first_ns` up to, not including,
    `end_ns`. An `end_ns` of None means the end of the test.
    """

    is_active: bool
    first_ns: int
    end_ns: int | None


def play(engine: Engine, steps: Iterable[InstantEvents], end_ns: int) -> list[Verdict]:
    """All verdicts of a fresh engine, from 0 s to the end. A test begins at 0 s (S12)."""
    events: list[Event] = []
    now_ns = None
    for step in steps:
        if now_ns is None and step.at_ns > 0:
            events += engine.advance(0)
        now_ns = step.at_ns
        if step.messages:
            events += engine.update(step.at_ns, step.messages)
        for rule in step.resets:
            events += engine.reset(step.at_ns, rule)
    events += engine.advance(0) if now_ns is None else []
    events += engine.advance(end_ns)
    return [event for event in events if isinstance(event, Verdict)]


def run(engine: Engine, machine: Machine, script: Script) -> list[Verdict]:
    """All verdicts of a script."""
    return play(engine, steps_of(machine, script), script.end_ns)


def judge(script: Script, verdicts: Sequence[Verdict]) -> Iterator[FailedExpectation]:
    """The unmet expectations in their order, each with the first instant at which it is unmet."""
    for expected in script.expectations:
        changes = [verdict for verdict in verdicts if verdict.rule == expected.rule]
        at_ns = _first_violation(expected, changes)
        if at_ns is not None:
            before = [change for change in changes if change.at_ns <= at_ns]
            after = [change for change in changes if change.at_ns > at_ns]
            yield FailedExpectation(
                expected, at_ns, before[-1] if before else None, next(iter(after), None)
            )


def _first_violation(expected: Expectation, changes: Sequence[Verdict]) -> int | None:
    for stretch in stretches(changes):
        end_ns = expected.last_ns + 1 if stretch.end_ns is None else stretch.end_ns
        first_ns = max(stretch.first_ns, expected.first_ns)
        last_ns = min(end_ns - 1, expected.last_ns)
        if first_ns <= last_ns and stretch.is_active is not expected.is_active:
            return first_ns
    return None


def stretches(changes: Sequence[Verdict]) -> Iterator[Stretch]:
    """The stretches of one rule, from its changes. The last of several changes at one instant
    counts.
    """
    is_active, first_ns = False, 0
    for change in changes:
        now_active = change.change is not Change.CLEARED
        if change.at_ns > first_ns and now_active is not is_active:
            yield Stretch(is_active, first_ns, change.at_ns)
        if now_active is not is_active:
            first_ns = change.at_ns
        is_active = now_active
    yield Stretch(is_active, first_ns, None)


def expectations_of(machine: Machine, script: Script, rule: int, end_ns: int) -> list[Expectation]:
    """The expectations that follow from the interpreter's verdicts on a rule, up to an instant."""
    verdicts = play(Interpreter(machine), steps_of(machine, script), end_ns)
    changes = [verdict for verdict in verdicts if verdict.rule == rule]
    expectations: list[Expectation] = []
    for stretch in stretches(changes):
        last_ns = end_ns if stretch.end_ns is None else stretch.end_ns - 1
        if expectations and expectations[-1].is_active is stretch.is_active:
            first_ns = expectations.pop().first_ns
        else:
            first_ns = stretch.first_ns
        expectations.append(Expectation(rule, stretch.is_active, first_ns, last_ns, None))
    return expectations
