"""Invariants of the task commands of one call of a reactor, as sentences.

The input is the reactions of a machine. `r` is the memory of the reactor. `reported` counts the
task commands that the call has decided on so far, and stores the tasks in force at its beginning.
`old` and `was` are the two states before a part of the call.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from rossmarie.ir import overruled, reactions
from rossmarie.verification.invariants import Sentence
from rossmarie.verification.reactor_invariants import (
    ReactorInvariants,
    has_failed,
    in_force,
    lacks,
)


class TaskCommandInvariants:
    """Writes these sentences for one reactor."""

    def __init__(self, found: reactions.Reactions) -> None:
        self._found = found
        self._tasks = range(len(found.tasks))
        self._rules = {task: rule for rule, plan in enumerate(found.plans) for task in plan.tasks}
        invariants = ReactorInvariants(found)
        self._can_fail, self._is_listed = invariants.can_fail, invariants.is_listed
        self._invariants = invariants
        self._follows = {each for task in found.tasks for each in task.otherwise}

    # --- sentences within a call -------------------------------------------------------------

    def reported(self) -> Iterator[Sentence]:
        """The decisions so far agree with the states of the tasks."""
        for task in self._tasks:
            yield from self._counted(task)
            yield from self._silent(task)

    def _counted(self, task: int) -> Iterator[Sentence]:
        """Limits: no task gets more than two task commands, OVERRULED and FAILED."""
        state, count = f"r->state[{task}]", f"reported.count[{task}]"
        yield Sentence("no task gets more than two task commands", f"{count} <= 2")
        last = f"reported.last[{task}]"
        stops = f"{count} <= 1 && ({last} == NO_TASK_COMMAND || {last} == STOP)"
        engaged = f"r->engaged[{self._rules[task]}]"
        yield Sentence("a task of a rule that is not engaged gets no task command except stop",
                       f"{engaged} || ({stops})")  # fmt: skip
        yield Sentence("a task that has not begun has no task command",
                       f"!{engaged} || {state} != IDLE || {count} == 0")  # fmt: skip
        yield Sentence("only a task that fails gets two task commands",
                       f"{has_failed(task)} || {count} <= 1")  # fmt: skip
        fresh = f"(r->since_ns[{task}] == r->now_ns && !r->reported[{task}])"
        yield Sentence("a task with the task command to start starts now",
                       f"{state} != RUNNING || {count} == 0 || {fresh}")  # fmt: skip
        is_overruled = f"spec_overruler(r, {task}) >= 0"
        yield Sentence("a task that waits does so for another rule",
                       f"!{lacks(task)} || {count} == 0 || {is_overruled}")  # fmt: skip
        if task in self._can_fail:
            yield Sentence("a task with an unreported failure has at most one task command",
                           f"!{self._is_listed(task)} || {count} <= 1")  # fmt: skip

    def _silent(self, task: int) -> Iterator[Sentence]:
        """No task comes into force, or ends, without a task command."""
        last = f"reported.last[{task}]"
        yield Sentence(
            "task commands are counted",
            f"({last} == NO_TASK_COMMAND) == (reported.count[{task}] == 0)",
        )
        kept = f"({last} == NO_TASK_COMMAND && reported.was_in_force[{task}])"
        yield Sentence("a task in force has the task command to start",
                       f"!{in_force(task)} || {last} == START || {kept}")  # fmt: skip
        fine = [f"!reported.was_in_force[{task}]", in_force(task), f"{last} != NO_TASK_COMMAND"]
        fine += [f"r->state[{task}] == DONE", self._is_listed(task)]
        yield Sentence(
            "a task leaves force by a task command, as done, or as failed", " || ".join(fine)
        )
        fine = [f"!reported.was_holding[{task}]", f"r->state[{task}] == HOLDING"]
        fine.append(f"{last} != NO_TASK_COMMAND")
        yield Sentence("a task that holds does not end without a task command", " || ".join(fine))

    def listed(self) -> Iterator[Sentence]:
        """The failures whose escalations have not started yet."""
        most = len(self._can_fail)
        yield Sentence("the number of failures is in range", f"r->failed_count <= {most}")
        for place in range(most):
            failed = " || ".join(
                f"(r->failed[{place}] == {task} && {has_failed(task)})" for task in self._can_fail
            )
            yield Sentence("each listed task has failed", f"{place} >= r->failed_count || {failed}")
        for task in self._can_fail:
            if overruled.may_be_overdue(self._found.tasks[task]):
                waits = f"{self._is_listed(task)} && r->state[{task}] == OVERDUE"
                yield Sentence("an overdue task waits for another rule",
                               f"!({waits}) || spec_overruler(r, {task}) >= 0")  # fmt: skip
        for one, other in combinations(range(most), 2):
            differ = f"r->failed[{one}] != r->failed[{other}]"
            yield Sentence("no failure is listed twice", f"{other} >= r->failed_count || {differ}")

    # --- unchanged parts of a call -----------------------------------------------------------

    def kept(self) -> Iterator[Sentence]:
        """The sentences that are true after each part that follows the releases."""
        for rule in range(len(self._found.plans)):
            same = f"r->engaged[{rule}] == old->engaged[{rule}]"
            yield Sentence("engaged rules and stages are unchanged",
                           f"{same} && r->stage[{rule}] == old->stage[{rule}]")  # fmt: skip
        for task in self._tasks:
            same = f"old->state[{task}] == RUNNING && {_same(task)}"
            begins = f"r->since_ns[{task}] == r->now_ns && !r->reported[{task}]"
            yield Sentence("a running task ran before, or begins now",
                           f"r->state[{task}] != RUNNING || ({same}) || ({begins})")  # fmt: skip
            for other in self._found.tasks[task].otherwise:
                begins = f"old->state[{other}] == IDLE && r->state[{other}] != IDLE"
                yield Sentence("an escalation starts only after the failure (R6)",
                               f"!({begins}) || {has_failed(task)}")  # fmt: skip

    def notable(self) -> Iterator[Sentence]:
        """The sentences before `task` is recorded as started."""
        for rule, own in self._own():
            yield Sentence("a task of an engaged rule starts", f"!{own} || r->engaged[{rule}]")

    def noted(self) -> Iterator[Sentence]:
        """The sentences while `task` is recorded as the last task that its rule has started."""
        for rule, own in self._own():
            tasks = self._found.plans[rule].tasks
            first, count = self._invariants.first_started(rule), f"started_count[{rule}]"
            places = range(first, first + len(tasks))
            members = [count, *(f"started[{place}]" for place in places)]
            same = " && ".join(f"r->{each} == old->{each}" for each in members)
            yield Sentence("the started tasks of other rules are unchanged", f"{own} || ({same})")
            yield from self._invariants.noted_once(rule)
            for place in places:
                is_last = f"r->{count} == {place - first + 1}"
                yield Sentence("the new task is the last started task",
                               f"!({own} && {is_last}) || r->started[{place}] == task")  # fmt: skip
                is_own = " || ".join(f"r->started[{place}] == {each}" for each in tasks)
                yield Sentence("a rule has started only its own tasks",
                               f"{place - first} >= r->{count} || {is_own}")  # fmt: skip
            for each in tasks:
                now, before = (self._invariants.is_noted(each, m) for m in ("r", "old"))
                yield Sentence("only the new task is added to the started tasks",
                               f"{now} == ({before} || task == {each})")  # fmt: skip

    def _own(self) -> Iterator[tuple[int, str]]:
        """The condition that `task` belongs to a rule, for each rule."""
        for rule, plan in enumerate(self._found.plans):
            yield rule, f"({' || '.join(f'task == {each}' for each in plan.tasks) or '0'})"

    def escalated(self) -> Iterator[Sentence]:
        """The sentences that are true after escalations: only the started tasks and the reports
        about them change.
        """
        for task in self._tasks:
            begins = f"(old->state[{task}] == IDLE && r->state[{task}] != IDLE)"
            may_begin = begins if task in self._follows else "false"
            yield Sentence("a task that follows from no failure stays as it is",
                           f"{may_begin} || ({_same(task)})")  # fmt: skip
            was_listed = self._is_listed(task).replace("r->", "old->")
            yield Sentence("a task that has not failed gets no task command",
                           f"{may_begin} || {was_listed} || ({_unreported(task)})")  # fmt: skip
            if task in self._can_fail:
                yield Sentence("the last task command of a failed task is the failure (R6)",
                               f"!{was_listed} || reported.last[{task}] == GIVEN_UP")  # fmt: skip
            if task in self._follows:
                free = f"spec_overruler(r, {task}) < 0"
                fits = f"(!{in_force(task)} || {free}) && (!{lacks(task)} || !({free}))"
                yield Sentence("an escalation has its resource, or waits for it (R7)",
                               f"old->state[{task}] != IDLE || ({fits})")  # fmt: skip

    def passed_on(self) -> Iterator[Sentence]:
        """The sentences that are true after resources are passed on: no rule starts by this."""
        for plan in self._found.plans:
            idle = " && ".join(f"old->state[{task}] == IDLE" for task in plan.tasks)
            for task in plan.tasks:
                yield Sentence("no rule starts by passing resources on",
                               f"!({idle}) || r->state[{task}] == IDLE")  # fmt: skip

    def unreported(self) -> Iterator[Sentence]:
        """The sentences before resources are passed on."""
        for task in self._tasks:
            engaged = f"r->engaged[{self._rules[task]}]"
            yield Sentence("releases come first (R1)", f"!{engaged} || reported.count[{task}] == 0")

    def unbegun(self) -> Iterator[Sentence]:
        """The sentences before `rule` starts."""
        for task in self._tasks:
            yield Sentence("the tasks of a starting rule are idle (R3)",
                           f"rule != {self._rules[task]} || r->state[{task}] == IDLE")  # fmt: skip

    def stage_started(self) -> Iterator[Sentence]:
        """The sentences that are true after a stage of `rule` starts: only its tasks change."""
        for task in self._tasks:
            begins = f"(rule == {self._rules[task]} && old->state[{task}] == IDLE)"
            same = f"{_same(task)} && {_unreported(task)}"
            yield Sentence("other tasks stay as they are", f"{begins} || ({same})")

    def startable(self) -> Iterator[Sentence]:
        """The sentences before the stage of `rule` starts."""
        for rule, plan in enumerate(self._found.plans):
            yield Sentence("a stage of an engaged rule starts",
                           f"rule != {rule} || r->engaged[{rule}]")  # fmt: skip
            for place, stage in enumerate(plan.stages):
                for task in stage:
                    here = f"rule == {rule} && r->stage[{rule}] == {place}"
                    yield Sentence("a stage starts once",
                                   f"!({here}) || r->state[{task}] == IDLE")  # fmt: skip

    def releasable(self) -> Iterator[Sentence]:
        """The sentences before `rule` is released."""
        yield Sentence("no failure is listed yet", "r->failed_count == 0")
        for rule, plan in enumerate(self._found.plans):
            yield Sentence("an engaged rule is released",
                           f"rule != {rule} || r->engaged[{rule}]")  # fmt: skip
            for task in plan.tasks:
                forced = f"reported.was_in_force[{task}] == {in_force(task)}"
                held = f"reported.was_holding[{task}] == (r->state[{task}] == HOLDING)"
                yield Sentence("the tasks of the rule are as before the call",
                               f"rule != {rule} || ({forced} && {held})")  # fmt: skip

    # --- results of a call -------------------------------------------------------------------

    def ended(self) -> Iterator[Sentence]:
        """R4, R15: the sentences after tasks have ended."""
        for task, declared in enumerate(self._found.tasks):
            timeout = reactions.timeout_ns(declared.effect)
            if timeout:
                yield from self._ended(task, timeout)
            if reactions.waits(declared.effect):
                yield from self._waited(task, timeout)

    def _ended(self, task: int, timeout: int) -> Iterator[Sentence]:
        effect = self._found.tasks[task].effect
        due = f"(old->since_ns[{task}] + INT64_C({timeout}))"
        succeeds = f"(old->reported[{task}] && old->now_ns <= {due}{_confirmed(effect)})"
        end = "HOLDING" if reactions.is_lasting(effect) else "DONE"
        idle, state = f"old->state[{task}] != RUNNING", f"r->state[{task}]"
        is_over = f"old->now_ns >= {due}"
        yield Sentence("success in time ends a task (R4)",
                       f"{idle} || !{succeeds} || {state} == {end}")  # fmt: skip
        yield Sentence("a task fails at its timeout (R4)",
                       f"{idle} || {succeeds} || !({is_over}) || {state} == FAILED")  # fmt: skip
        yield Sentence("otherwise the task goes on running (R4)",
                       f"{idle} || {succeeds} || {is_over} || {state} == RUNNING")  # fmt: skip

    def _waited(self, task: int, timeout: int | None) -> Iterator[Sentence]:
        """A waiting task fails at its timeout, unless its purpose is fulfilled without it."""
        state, due = f"r->state[{task}]", f"(old->since_ns[{task}] + INT64_C({timeout}))"
        fails = f"(old->now_ns >= {due} && !{self._answered(task)})" if timeout else "false"
        waits = f"(old->state[{task}] == WAITING)"
        yield Sentence("a task that waits until its timeout fails (R15)",
                       f"!({waits} && {fails}) || {state} == OVERDUE")  # fmt: skip
        yield Sentence("otherwise the task goes on waiting (R15)",
                       f"!{waits} || {fails} || {state} == WAITING")  # fmt: skip
        yield Sentence("an overdue task stays overdue (R15)",
                       f"old->state[{task}] != OVERDUE || {state} == OVERDUE")  # fmt: skip

    def _answered(self, task: int) -> str:
        confirmation = reactions.confirmation(self._found.tasks[task].effect)
        if confirmation is not None:
            return f"watched[{confirmation}]"
        others = (f"r->state[{other}] == HOLDING" for other in self._answering(task))
        return f"({' || '.join(others) or 'false'})"

    def _answering(self, task: int) -> Iterator[int]:
        """The tasks of rules with the same effect and no other effect on the resource. Only an
        owner's hold counts (R8).
        """
        resource = self._found.tasks[task].resource
        for rule, plan in enumerate(self._found.plans):
            rivals = [each for each in plan.tasks if self._found.tasks[each].resource == resource]
            if rivals and overruled.does_the_same(self._found, task, rule):
                yield from rivals


def _same(task: int) -> str:
    parts = (f"{part}[{task}]" for part in ("state", "since_ns", "reported"))
    return " && ".join(f"r->{part} == old->{part}" for part in parts)


def _unreported(task: int) -> str:
    return " && ".join(
        f"reported.{each}[{task}] == was->{each}[{task}]" for each in ("count", "last")
    )


def _confirmed(effect: reactions.Effect) -> str:
    confirmation = reactions.confirmation(effect)
    return "" if confirmation is None else f" && watched[{confirmation}] "
