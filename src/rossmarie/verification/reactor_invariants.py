"""Invariants of a reactor, between two calls and within one, as sentences over its memory.

The input is the reactions of a machine. The obligations follow the rules of
`docs/explanation/reactions.md`, not the tables that the generator makes.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from rossmarie.ir import overruled, reactions
from rossmarie.verification.invariants import Sentence


def in_force(task: int) -> str:
    """State that a task runs or holds."""
    return f"(r->state[{task}] == RUNNING || r->state[{task}] == HOLDING)"


def lacks(task: int) -> str:
    """State that a task waits for a resource that another rule owns (R7, R8, R15)."""
    return f"(r->state[{task}] == WAITING || r->state[{task}] == OVERDUE)"


def has_failed(task: int) -> str:
    """State that a task has failed, also while it waits (R6, R15)."""
    return f"(r->state[{task}] == FAILED || r->state[{task}] == OVERDUE)"


class ReactorInvariants:
    """Writes the invariants of one reactor. `r` is the reactor's memory."""

    def __init__(self, found: reactions.Reactions) -> None:
        self._found = found
        self._rules = {task: rule for rule, plan in enumerate(found.plans) for task in plan.tasks}
        self.can_fail = [task for task, each in enumerate(found.tasks) if overruled.can_fail(each)]
        """The tasks that can fail."""

    def is_listed(self, task: int) -> str:
        """State that a failure of a task is listed and its escalations have not started yet."""
        listed = [
            f"({place} < r->failed_count && r->failed[{place}] == {task})"
            for place in range(len(self.can_fail))
        ]
        return f"({' || '.join(listed)})" if task in self.can_fail else "false"

    def is_noted(self, task: int, memory: str = "r") -> str:
        """State that a task is in the list of started tasks of its rule."""
        rule = self._rules[task]
        first, count = self.first_started(rule), f"{memory}->started_count[{rule}]"
        noted = [
            f"({place} < {count} && {memory}->started[{first + place}] == {task})"
            for place in range(len(self._found.plans[rule].tasks))
        ]
        return f"({' || '.join(noted)})"

    def first_started(self, rule: int) -> int:
        """The index at which the list of a rule's started tasks begins."""
        return sum(len(plan.tasks) for plan in self._found.plans[:rule])

    def always(self) -> list[Sentence]:
        """The sentences that hold within a call as well."""
        rules, tasks = range(len(self._found.plans)), range(len(self._found.tasks))
        return [
            *self.clock(),
            *self.started(),
            *(each for rule in rules for each in self._stages(rule)),
            *(each for task in tasks for each in self._task(task)),
            *(each for task in tasks for each in self._escalations(task)),
        ]

    def at_rest(self) -> list[Sentence]:
        """The sentences that hold between two calls only."""
        return [
            Sentence(
                "no task command and no failure is left", "r->decided == 0 && r->failed_count == 0"
            ),
            *self.owned(),
            *self.in_time(),
        ]

    def clock(self) -> Iterator[Sentence]:
        """The sentences about instants."""
        yield Sentence("the clock is in range", "r->now_ns >= EARLIEST && r->now_ns < LATEST")
        for task in range(len(self._found.tasks)):
            since = f"r->since_ns[{task}]"
            past = f"({since} >= EARLIEST - LONGEST && {since} <= r->now_ns)"
            yield Sentence("a begun task began in the past", f"{since} == NEVER || {past}")

    def owned(self) -> Iterator[Sentence]:
        """R7, R8: the owners of the resources of tasks that are in force or wait."""
        for task, declared in enumerate(self._found.tasks):
            if declared.resource is None:
                continue
            free = f"spec_overruler(r, {task}) < 0"
            yield Sentence(
                "no other rule owns the resource of a task in force (R8)",
                f"!{in_force(task)} || {free}",
            )
            if reactions.waits(declared.effect):
                yield Sentence(
                    "a waiting task waits for another rule (R8)",
                    f"!{lacks(task)} || !({free})",
                )

    def in_time(self) -> Iterator[Sentence]:
        """A running task has not reached its timeout."""
        for task, declared in enumerate(self._found.tasks):
            if timeout := reactions.timeout_ns(declared.effect):
                in_time = f"r->since_ns[{task}] > r->now_ns - INT64_C({timeout})"
                runs = f"r->state[{task}] == RUNNING"
                yield Sentence("a running task has time left", f"!({runs}) || {in_time}")

    def started(self) -> Iterator[Sentence]:
        """A rule remembers the tasks that it has started: each only once, and only its own."""
        for rule in range(len(self._found.plans)):
            yield from self._started(rule)

    def _started(self, rule: int) -> Iterator[Sentence]:
        tasks, first = self._found.plans[rule].tasks, self.first_started(rule)
        count = f"r->started_count[{rule}]"
        yield from self.noted_once(rule)
        yield Sentence("a rule that is not engaged has started no task",
                       f"r->engaged[{rule}] || {count} == 0")  # fmt: skip
        for place in range(len(tasks)):
            own = " || ".join(
                f"(r->started[{first + place}] == {task} && r->state[{task}] != IDLE)"
                for task in tasks
            )
            yield Sentence("a rule has started only its own tasks", f"{place} >= {count} || {own}")
        for task in tasks:
            yield Sentence(
                "a task in force has started", f"!{in_force(task)} || {self.is_noted(task)}"
            )

    def noted_once(self, rule: int) -> Iterator[Sentence]:
        """The list of a rule's started tasks contains each task once."""
        first, count = self.first_started(rule), f"r->started_count[{rule}]"
        most = len(self._found.plans[rule].tasks)
        yield Sentence("the number of started tasks is in range", f"{count} <= {most}")
        for one, other in combinations(range(most), 2):
            differ = f"r->started[{first + one}] != r->started[{first + other}]"
            yield Sentence("a started task is recorded once", f"{other} >= {count} || {differ}")

    def _stages(self, rule: int) -> Iterator[Sentence]:
        stages = self._found.plans[rule].stages
        yield Sentence("a rule is at one of its stages", f"r->stage[{rule}] <= {len(stages)}")
        for place, stage in enumerate(stages):
            for task in stage:
                waits = f"r->stage[{rule}] >= {place} || r->state[{task}] == IDLE"
                yield Sentence("a stage waits for the stage before it", waits)

    def _task(self, task: int) -> Iterator[Sentence]:
        declared, state = self._found.tasks[task], f"r->state[{task}]"
        effect = declared.effect
        possible = ["IDLE", "DONE"]
        possible += ["FAILED"] if overruled.can_fail(declared) else []
        possible += ["HOLDING"] if reactions.is_lasting(effect) else []
        may_wait = reactions.waits(effect) and not overruled.fails_at_once(declared)
        possible += ["WAITING"] if may_wait else []
        possible += ["OVERDUE"] if overruled.may_be_overdue(declared) else []
        possible += ["RUNNING"] if reactions.timeout_ns(effect) else []
        fits = " || ".join(f"{state} == {each}" for each in possible)
        yield Sentence("a task is in a state that its effect permits", fits)
        yield Sentence("a rule that is not engaged has only idle tasks",
                       f"r->engaged[{self._rules[task]}] || {state} == IDLE")  # fmt: skip
        open_or_waits = f"({in_force(task)} || {state} == WAITING)"
        yield Sentence("a task that is in force or waits has begun",
                       f"!{open_or_waits} || r->since_ns[{task}] != NEVER")  # fmt: skip

    def _escalations(self, task: int) -> Iterator[Sentence]:
        """An OVERDUE task may start again; the escalations of its failure continue."""
        declared = self._found.tasks[task]
        for other in declared.otherwise:
            is_known = f"({has_failed(task)} && !{self.is_listed(task)})"
            begun = f"(r->state[{other}] != IDLE)"
            if overruled.may_be_overdue(declared):
                yield Sentence("an escalation starts after the failure (R6)",
                               f"!{is_known} || {begun}")  # fmt: skip
                yield Sentence("an escalation does not start before its task (R6)",
                               f"!{begun} || r->state[{task}] != IDLE")  # fmt: skip
            else:
                yield Sentence("an escalation starts after the failure, and only then (R6)",
                               f"{is_known} == {begun}")  # fmt: skip
