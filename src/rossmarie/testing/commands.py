"""The bounds of the commands that the safety filter passes in a test, on the interpreter.

The filter opens after every input with a timeout has arrived. A test gives no replies: services,
action servers and parameters time out.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from dslkit.diagnostics import Diagnostic
from rossmarie import ir
from rossmarie.interpreter import Interpreter, Reactor
from rossmarie.ir import FieldBounds, InputState
from rossmarie.ir.script import CommandExpectation, Script
from rossmarie.testing.errors import CommandNotWithin
from rossmarie.testing.findings import seconds
from rossmarie.testing.play import steps_of

_EVERYTHING = FieldBounds(1.0, -math.inf, math.inf)


def command_failures(machine: ir.Machine, script: Script) -> Iterator[Diagnostic]:
    """A finding for each unmet expectation of a command, at the first instant at which it is
    unmet.
    """
    if not script.commands:
        return
    guard = _Guard(machine, script)
    guard.play()
    for expected in script.commands:
        if expected in guard.failed:
            yield guard.failed[expected]


class _Guard:
    """A monitor with its reactor. The bounds only widen from one event to the next, so the first
    and the last instant between two events are enough.
    """

    def __init__(self, machine: ir.Machine, script: Script) -> None:
        self.failed: dict[CommandExpectation, Diagnostic] = {}
        self._machine = machine
        self._script = script
        self._monitor = Interpreter(machine)
        self._reactor = Reactor(machine.reactions)
        self._now_ns = 0
        self._active = self._monitor.active
        self._places = {
            (command.topic, field.path): (number, place)
            for number, command in enumerate(machine.reactions.commands)
            for place, field in enumerate(command.fields)
        }

    def play(self) -> None:
        """Play the whole script."""
        steps = list(steps_of(self._machine, self._script))
        if not steps or steps[0].at_ns > 0:
            self._monitor.advance(0)
            self._react(0)
        for step in steps:
            self._pass_to(step.at_ns)
            if step.messages:
                self._monitor.update(step.at_ns, step.messages)
            for rule in step.resets:
                self._monitor.reset(step.at_ns, rule)
            self._react(step.at_ns)
        self._pass_to(self._script.end_ns + 1)
        self._look(self._script.end_ns + 1)

    def _pass_to(self, at_ns: int) -> None:
        """Process all timers that are due before an instant."""
        while (wake_ns := self._next_wake()) is not None and wake_ns < at_ns:
            self._monitor.advance(wake_ns)
            self._react(wake_ns)

    def _next_wake(self) -> int | None:
        wakes = (self._monitor.next_wake(), self._reactor.next_wake())
        return min((wake_ns for wake_ns in wakes if wake_ns is not None), default=None)

    def _react(self, at_ns: int) -> None:
        self._look(at_ns)
        states = zip(self._machine.inputs, self._monitor.input_states, strict=True)
        if all(used.timeout_ns is None or state is not InputState.NEVER for used, state in states):
            self._reactor.open()
        self._reactor.react(at_ns, self._monitor.active, self._monitor.watches)
        self._now_ns, self._active = at_ns, self._monitor.active

    def _look(self, end_ns: int) -> None:
        """Compare the commands since the last event with the expectations, up to `end_ns`."""
        for expected in self._script.commands:
            first_ns = max(self._now_ns, expected.first_ns)
            last_ns = min(end_ns - 1, expected.last_ns)
            for at_ns in (first_ns, last_ns) if first_ns <= last_ns else ():
                bounds = self._bounds(expected, at_ns)
                is_met = expected.low <= bounds.low and bounds.high <= expected.high
                if not is_met and expected not in self.failed:
                    self.failed[expected] = self._finding(expected, at_ns, bounds)

    def _bounds(self, expected: CommandExpectation, at_ns: int) -> FieldBounds:
        place = self._places.get((expected.topic, expected.path))
        if place is None:
            return _EVERYTHING
        bounds = self._reactor.bounds(at_ns, place[0])[place[1]]
        return FieldBounds(0.0, 0.0, 0.0) if bounds.factor == 0.0 else bounds

    def _finding(self, expected: CommandExpectation, at_ns: int, bounds: FieldBounds) -> Diagnostic:
        active = [
            rule.name
            for rule, is_active in zip(self._machine.rules, self._active, strict=True)
            if is_active
        ]
        if (expected.topic, expected.path) not in self._places:
            reason = f"no rule starts an action that limits commands on {expected.topic}"
        elif active:
            reason = f"active then: {', '.join(active)}"
        else:
            is_lifted = not math.isinf(bounds.high)
            reason = "no rule is active then" + "; a limit is being lifted" * is_lifted
        finding = CommandNotWithin(
            field=".".join(map(str, expected.path)),
            topic=expected.topic,
            found=_range(bounds.low, bounds.high, expected.unit),
            instant=seconds(at_ns),
            expected=_range(expected.low, expected.high, expected.unit),
            reason=reason,
        )
        return finding.at(expected.span)


def _range(low: float, high: float, unit: str) -> str:
    if low == -math.inf and high == math.inf:
        return "anything"
    ends = ("no limit" if math.isinf(end) else f"{end:.9g}" for end in (low, high))
    return f"[{', '.join(ends)}] {unit}".strip()
