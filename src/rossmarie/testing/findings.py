"""Findings for the failures of a test, at the lines of the test."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from decimal import Decimal

from dslkit.diagnostics import Diagnostic
from rossmarie.ir import Change, Machine, Verdict, explain
from rossmarie.ir.script import Script
from rossmarie.testing.errors import EnginesDiffer, ExpectationNotMet
from rossmarie.testing.run import FailedExpectation, judge


def seconds(at_ns: int) -> str:
    """An instant as `1.52 s`, with all its digits."""
    number = Decimal(at_ns).scaleb(-9).normalize()
    return f"{number:f} s"


def failures(machine: Machine, script: Script, verdicts: Sequence[Verdict]) -> Iterator[Diagnostic]:
    """A finding for each unmet expectation, with the actual events and their causes."""
    for failure in judge(script, verdicts):
        span = failure.expectation.span
        assert span is not None
        is_active = failure.expectation.is_active
        finding = ExpectationNotMet(
            rule=machine.rules[failure.expectation.rule].name,
            found="inactive" if is_active else "active",
            instant=seconds(failure.at_ns),
            expected="it to be active" if is_active else "it to be inactive",
            reason="; ".join(_reasons(machine, failure)),
        )
        yield finding.at(span)


def _reasons(machine: Machine, failure: FailedExpectation) -> Iterator[str]:
    if failure.cause is not None:
        yield reported(machine, failure.cause)
    if failure.following is not None:
        yield reported(machine, failure.following)
    if failure.cause is None and failure.following is None:
        yield "it never became active"


def reported(machine: Machine, verdict: Verdict) -> str:
    """`it became active at 1.52 s, because ...`."""
    cleared = verdict.change is Change.CLEARED
    word = "was cleared" if cleared else "became active"
    return f"it {word} at {seconds(verdict.at_ns)}, because {explain(machine, verdict).line()}"


def differences(
    machine: Machine, script: Script, expected: Sequence[Verdict], found: Sequence[Verdict]
) -> Iterator[Diagnostic]:
    """A finding for the first verdict in which two engines differ."""
    if [repr(one) for one in expected] == [repr(one) for one in found]:
        return
    pairs = zip([*expected, None], [*found, None], strict=False)
    first = next(pair for pair in pairs if repr(pair[0]) != repr(pair[1]))
    words = ["nothing more" if one is None else _short(machine, one) for one in first]
    assert script.span is not None
    finding = EnginesDiffer(test=script.name, expected=words[0], found=words[1])
    yield finding.at(script.span)


def _short(machine: Machine, verdict: Verdict) -> str:
    change = verdict.change.name.lower().replace("_", " ")
    return f"{machine.rules[verdict.rule].name} {change} at {seconds(verdict.at_ns)}"
