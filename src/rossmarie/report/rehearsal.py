"""A rehearsal: a reactor, driven by the monitor's events, shows the task commands that rules would
have given.

The input is the events of a monitor of a verified machine. The robot of a recording received no
task commands, so the recording contains no results of them. The rehearsal therefore assumes that
everything awaited is done at once, with success, and is confirmed. Only a task whose resource
another rule keeps times out. The effect `reset` does not act on the verdicts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from rossmarie.interpreter import Reactor
from rossmarie.ir import (
    Change,
    Event,
    Machine,
    TaskCommand,
    TaskCommandKind,
    TimeJump,
    TruthValue,
    Verdict,
    reactions,
)
from rossmarie.naming import effect_words


@dataclass(frozen=True)
class Rehearsed:
    """A task command. `after` is the place of the event before it; `later_ns` is its delay in ns
    after that event; `activation` is the place of the verdict that made its rule active.
    """

    command: TaskCommand
    rule: int
    after: int
    activation: int
    later_ns: int = 0


@dataclass(frozen=True)
class TaskSummary:
    """The outcome of one task over a whole replay; `overruled` counts how often each rule overruled
    it.
    """

    rule: str
    action: str
    effect: str
    starts: int
    overruled: tuple[tuple[str, int], ...]


def rehearse(
    machine: Machine, events: Sequence[Event], end_ns: int | None = None
) -> tuple[Rehearsed, ...]:
    """The task commands that follow from the events, in their order, up to the end of the
    recording. If the end is unknown, they reach up to the last event.
    """
    if not machine.reactions.tasks or not events:
        return ()
    end = _instant(events[-1]) if end_ns is None else end_ns
    return tuple(_Rehearsal(machine).of(events, end))


class _Rehearsal:
    """A reactor and the results that are reported to it."""

    def __init__(self, machine: Machine) -> None:
        self._tasks = machine.reactions.tasks
        self._reactor = Reactor(machine.reactions)
        self._confirmed = [TruthValue.TRUE] * len(machine.watches)
        self._engaged = [False] * len(machine.rules)
        self._activations = [0] * len(machine.rules)
        self._rules = {
            task: rule for rule, plan in enumerate(machine.reactions.plans) for task in plan.tasks
        }

    def of(self, events: Sequence[Event], end_ns: int) -> Iterator[Rehearsed]:
        looks = list(_looks(events))
        ends = [_left(events[look[0]]) for look in looks[1:]]
        for look, until_ns in zip(looks, [*ends, end_ns + 1], strict=True):
            for place in look:
                self._see(place, events[place])
            at_ns = _instant(events[look[-1]])
            yield from self._rehearsed(look[-1], at_ns, 0)
            while (wake_ns := self._reactor.next_wake()) is not None and wake_ns < until_ns:
                yield from self._rehearsed(look[-1], wake_ns, wake_ns - at_ns)

    def _rehearsed(self, after: int, at_ns: int, later_ns: int) -> Iterator[Rehearsed]:
        for command in self._task_commands(at_ns):
            rule = self._rules[command.task]
            yield Rehearsed(command, rule, after, self._activations[rule], later_ns)

    def _see(self, place: int, event: Event) -> None:
        if isinstance(event, Verdict):
            self._engaged[event.rule] = event.change is not Change.CLEARED
            if event.change is not Change.CLEARED:
                self._activations[event.rule] = place

    def _task_commands(self, at_ns: int) -> Iterator[TaskCommand]:
        """The task commands of one look, and the task commands that follow when awaited results
        succeed.
        """
        waiting = self._reactor.react(at_ns, self._engaged, self._confirmed)
        while waiting:
            command = waiting.pop(0)
            yield command
            effect = self._tasks[command.task].effect
            if command.kind is TaskCommandKind.START and reactions.timeout_ns(effect) is not None:
                waiting += self._reactor.report(at_ns, command.task, True, self._confirmed)


def _looks(events: Sequence[Event]) -> Iterator[list[int]]:
    """The places of the events that a reactor sees together: those of one instant (R1), up to the
    next change of the same rule or jump of time.
    """
    look: list[int] = []
    rules: set[int] = set()
    for place, event in enumerate(events):
        rule = event.rule if isinstance(event, Verdict) else None
        is_apart = isinstance(event, TimeJump) or rule in rules
        if look and (is_apart or _instant(event) != _instant(events[look[-1]])):
            yield look
            look, rules = [], set()
        look.append(place)
        rules |= set() if rule is None else {rule}
    if look:
        yield look


def _left(event: Event) -> int:
    """The instant from which time passes until an event."""
    return event.from_ns + 1 if isinstance(event, TimeJump) else event.at_ns


def _instant(event: Event) -> int:
    return event.to_ns if isinstance(event, TimeJump) else event.at_ns


# --- in words --------------------------------------------------------------------------------


def task_words(machine: Machine, task: int) -> tuple[str, str]:
    """The action of a task, and its effect in words."""
    found = machine.reactions.tasks[task]
    return machine.reactions.actions[found.action].name, effect_words(machine, found.effect)


def summarize_tasks(machine: Machine, rehearsed: Iterable[Rehearsed]) -> tuple[TaskSummary, ...]:
    """A summary of each task that was started or overruled, in the order of the file."""
    starts: Counter[int] = Counter()
    overruled: dict[int, Counter[str]] = {}
    rules: dict[int, str] = {}
    for each in rehearsed:
        task, by = each.command.task, each.command.by
        rules[task] = machine.rules[each.rule].name
        starts[task] += each.command.kind is TaskCommandKind.START
        if by is not None:
            overruled.setdefault(task, Counter())[machine.rules[by].name] += 1
    return tuple(
        TaskSummary(
            rules[task],
            *task_words(machine, task),
            starts[task],
            tuple(overruled.get(task, Counter()).most_common()),
        )
        for task in sorted(rules)
    )
