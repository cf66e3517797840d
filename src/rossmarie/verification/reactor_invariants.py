"""What holds of a reactor between two calls, as sentences over its memory.

Takes the reactions of a machine; what is claimed is read off them, by the rules of
`docs/explanation/reactions.md`, and not off the tables that the generator makes of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from rossmarie.ir import reactions
from rossmarie.verification.invariants import Sentence


def in_force(task: int) -> str:
    """Whether a task runs or holds."""
    return f"(r->state[{task}] == RUNNING || r->state[{task}] == HOLDING)"


class ReactorInvariants:
    """Writes the invariants of one reactor, of which `r` is the memory."""

    def __init__(self, found: reactions.Reactions) -> None:
        self._found = found
        self._rules = {task: rule for rule, plan in enumerate(found.plans) for task in plan.tasks}

    def sentences(self) -> list[Sentence]:
        """All of them."""
        rules, tasks = range(len(self._found.plans)), range(len(self._found.tasks))
        return [
            *self.clock(),
            *(each for rule in rules for each in self._started(rule)),
            *(each for rule in rules for each in self._stages(rule)),
            *(each for task in tasks for each in self._task(task)),
            *(each for task in tasks for each in self._escalations(task)),
        ]

    def clock(self) -> Iterator[Sentence]:
        """What holds of instants."""
        yield Sentence("its clock is in range", "r->now_ns >= EARLIEST && r->now_ns < LATEST")
        yield Sentence("no order is left to be given", "r->decided == 0 && r->failed_count == 0")
        for task in range(len(self._found.tasks)):
            since = f"r->since_ns[{task}]"
            past = f"({since} >= EARLIEST - LONGEST && {since} <= r->now_ns)"
            yield Sentence("what has begun began in the past", f"{since} == NEVER || {past}")

    def _started(self, rule: int) -> Iterator[Sentence]:
        """A rule remembers the tasks that it has started, each once, each of its own."""
        tasks = self._found.plans[rule].tasks
        first = sum(len(plan.tasks) for plan in self._found.plans[:rule])
        count = f"r->started_count[{rule}]"
        yield Sentence("no more tasks have started than there are", f"{count} <= {len(tasks)}")
        yield Sentence("a rule that is not engaged has started nothing",
                       f"r->engaged[{rule}] || {count} == 0")  # fmt: skip
        for place in range(len(tasks)):
            own = " || ".join(f"r->started[{first + place}] == {task}" for task in tasks)
            yield Sentence("a rule starts its own tasks", f"{place} >= {count} || {own}")
        for one, other in combinations(range(len(tasks)), 2):
            differ = f"r->started[{first + one}] != r->started[{first + other}]"
            yield Sentence("a task that started is noted once", f"{other} >= {count} || {differ}")
        for task in tasks:
            noted = " || ".join(
                f"({place} < {count} && r->started[{first + place}] == {task})"
                for place in range(len(tasks))
            )
            yield Sentence("what is in force has started", f"!{in_force(task)} || {noted}")

    def _stages(self, rule: int) -> Iterator[Sentence]:
        stages = self._found.plans[rule].stages
        yield Sentence("a rule is at one of its stages", f"r->stage[{rule}] <= {len(stages)}")
        for place, stage in enumerate(stages):
            for task in stage:
                waits = f"r->stage[{rule}] >= {place} || r->state[{task}] == IDLE"
                yield Sentence("a stage waits for the one before", waits)

    def _task(self, task: int) -> Iterator[Sentence]:
        effect, state = self._found.tasks[task].effect, f"r->state[{task}]"
        timeout = reactions.timeout_ns(effect)
        possible = ["IDLE", "DONE", "FAILED"]
        possible += ["HOLDING"] if reactions.is_lasting(effect) else []
        possible += ["WAITING"] if reactions.waits(effect) else []
        possible += ["RUNNING"] if timeout else []
        fits = " || ".join(f"{state} == {each}" for each in possible)
        yield Sentence("a task is in a state that its effect has", fits)
        yield Sentence("a rule that is not engaged has no task",
                       f"r->engaged[{self._rules[task]}] || {state} == IDLE")  # fmt: skip
        yield Sentence("what is in force has begun",
                       f"!{in_force(task)} || r->since_ns[{task}] != NEVER")  # fmt: skip
        if timeout:
            in_time = f"r->since_ns[{task}] > r->now_ns - INT64_C({timeout})"
            yield Sentence("what runs has time left", f"{state} != RUNNING || {in_time}")

    def _escalations(self, task: int) -> Iterator[Sentence]:
        for other in self._found.tasks[task].otherwise:
            yield Sentence("what follows a failure waits for it",
                           f"r->state[{task}] == FAILED || r->state[{other}] == IDLE")  # fmt: skip
