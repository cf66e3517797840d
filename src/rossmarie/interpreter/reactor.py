"""The executable semantics of reactions: the reference for the generated reactors.

The input is the reactions of a machine that `ir.verify` has accepted. The code follows
`docs/explanation/reactions.md` rule by rule (R1, R2, ... in the comments). The reactor decides and
remembers. Its owner carries out the task commands, and reports their results.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from rossmarie import ir
from rossmarie.interpreter.filter import Filter
from rossmarie.interpreter.retracing import Retracing
from rossmarie.ir import (
    FieldBounds,
    Reactions,
    TaskCommand,
    TaskCommandKind,
    TaskState,
    TruthValue,
    overruled,
    reactions,
)

_PASSED = frozenset((TaskState.HOLDING, TaskState.WAITING, TaskState.OVERDUE, TaskState.DONE))
_WANTED = frozenset((TaskState.WAITING, TaskState.OVERDUE))
_IN_FORCE = frozenset((TaskState.RUNNING, TaskState.HOLDING))


@dataclass
class Progress:
    """The memory of a task."""

    state: TaskState = TaskState.IDLE
    started_ns: int = 0
    is_reported: bool = False


@dataclass
class Engagement:
    """The memory of an engaged rule: its current stage, and its tasks in the order of their
    start.
    """

    stage: int = 0
    started: list[int] = field(default_factory=list)


class Reactor:
    """Derives task commands from active rules. Instants are nanoseconds on one clock, between
    `ir.EARLIEST_NS` and `ir.LATEST_NS`; `react` and `report` raise `ValueError` outside this range.

    `active` contains, for each rule, whether it is active and not exempted (R1). `watches` are the
    values of the confirmations of `cancel`, in the order of `Machine.watches`. `readings` are the
    numbers for memories of poses, in the order of `Machine.readings`; without them no pose is
    recorded.
    """

    def __init__(self, machine_reactions: Reactions) -> None:
        self._reactions = machine_reactions
        self._tasks = [Progress() for _ in machine_reactions.tasks]
        self._engagements: list[Engagement | None] = [None] * len(machine_reactions.plans)
        self._rules = {
            task: rule for rule, plan in enumerate(machine_reactions.plans) for task in plan.tasks
        }
        self._filter = Filter(machine_reactions)
        self._retracing = Retracing(machine_reactions)
        self._now_ns = ir.EARLIEST_NS
        self._task_commands: list[TaskCommand] = []
        self._failures: list[int] = []

    @property
    def states(self) -> tuple[TaskState, ...]:
        """The state of each task, by index."""
        return tuple(progress.state for progress in self._tasks)

    @property
    def since_ns(self) -> tuple[int, ...]:
        """The instant since which each task has been in its state. For an idle task it is
        `NEVER_NS`, unless the task is a limit or scale that was lifted.
        """
        return tuple(
            self._filter.lifted_ns(task)
            if progress.state is TaskState.IDLE
            else progress.started_ns
            for task, progress in enumerate(self._tasks)
        )

    def open(self) -> None:
        """Let commands pass: every input with a timeout has arrived once, or its grace period is
        over (R12).
        """
        self._filter.open()

    def react(
        self,
        at_ns: int,
        active: Sequence[bool],
        watches: Sequence[TruthValue],
        readings: Sequence[float] = (),
    ) -> list[TaskCommand]:
        """The task commands that follow from the active rules at an instant."""
        self._set_clock(at_ns)
        engaged = self._engaged(active)
        for rule, is_engaged in enumerate(engaged):
            if not is_engaged:
                self._release(rule)
        starting = [rule for rule in self._reactions.order if engaged[rule] and self._rests(rule)]
        for rule in starting:
            self._engagements[rule] = Engagement()
        self._retracing.record(at_ns, engaged, readings)
        self._pass_resources_on()
        for rule in starting:
            self._start_stage(rule)
        return self._settle(watches)

    def report(
        self, at_ns: int, task: int, success: bool, watches: Sequence[TruthValue]
    ) -> list[TaskCommand]:
        """The task commands that follow from the end of a task; none for a task that is not running
        (R6).
        """
        self._set_clock(at_ns)
        if self._tasks[task].state is TaskState.RUNNING:
            if success:
                self._tasks[task].is_reported = True
            else:
                self._fail(task)
        return self._settle(watches)

    def next_wake(self) -> int | None:
        """The earliest future instant at which a task times out, or sends a pose (R13); None if
        there is none.
        """
        ends = [due_ns for _, due_ns in self._deadlines(TaskState.RUNNING, TaskState.WAITING)]
        ends += self._retracing.wakes(self._holding())
        return min((due_ns for due_ns in ends if due_ns > self._now_ns), default=None)

    def bounds(self, at_ns: int, command: int) -> tuple[FieldBounds, ...]:
        """The bounds on the fields of a command topic at an instant (R11)."""
        return self._filter.bounds(at_ns, command)

    def _engaged(self, active: Sequence[bool]) -> list[bool]:
        """R1: for each rule, whether its plan is carried out."""
        return [
            active[rule] and not any(active[other] for other in plan.unless)
            for rule, plan in enumerate(self._reactions.plans)
        ]

    # --- time --------------------------------------------------------------------------------

    def _set_clock(self, at_ns: int) -> None:
        """R14: ages stay the same when the clock is set back."""
        ir.require_instant(at_ns)
        if at_ns < self._now_ns:
            for progress in self._tasks:
                progress.started_ns -= self._now_ns - at_ns
            self._filter.set_back(self._now_ns, at_ns)
            self._retracing.set_back(self._now_ns - at_ns)
        self._now_ns = at_ns

    def _deadlines(self, *states: TaskState) -> list[tuple[int, int]]:
        """The awaited tasks in these states, each with the instant of its timeout."""
        return [
            (task, progress.started_ns + timeout_ns)
            for task, progress in enumerate(self._tasks)
            if progress.state in states
            and (timeout_ns := reactions.timeout_ns(self._effect(task))) is not None
        ]

    # --- resources ---------------------------------------------------------------------------

    def _overruler(self, task: int) -> int | None:
        """R2: the engaged rule that owns the resource of a task. None if this is the task's own
        rule, or if the owner publishes the same message.
        """
        resource = self._reactions.tasks[task].resource
        if resource is None:
            return None
        owner = next(rule for rule in self._reactions.order if self._claims(rule, resource))
        is_own = owner == self._rules[task]
        return None if is_own or overruled.is_shared(self._reactions, task, owner) else owner

    def _claims(self, rule: int, resource: int) -> bool:
        tasks = self._reactions.plans[rule].tasks
        needed = (self._reactions.tasks[task].resource for task in tasks)
        return not self._rests(rule) and resource in needed

    def _pass_resources_on(self) -> None:
        """R8: first, tasks give up their resources; then the escalations start; then waiting tasks
        start again.
        """
        overruled = {
            task: by
            for task, progress in enumerate(self._tasks)
            if progress.state in _IN_FORCE and (by := self._overruler(task)) is not None
        }
        for task, by in overruled.items():
            self._command(TaskCommandKind.OVERRULED, task, by)
            self._give_up(task)
        self._escalate()
        for task, progress in enumerate(self._tasks):
            if progress.state in _WANTED and self._overruler(task) is None:
                self._begin(task)

    def _give_up(self, task: int) -> None:
        progress = self._tasks[task]
        if reactions.waits(self._effect(task)):
            self._wait(task)
        elif progress.state is TaskState.RUNNING:
            self._fail(task)
        else:
            progress.state = TaskState.DONE

    def _wait(self, task: int) -> None:
        """R7, R8: the time of a running task goes on. A task without a time limit but with an
        `else` fails at once.
        """
        progress = self._tasks[task]
        if progress.state is not TaskState.RUNNING:
            progress.started_ns = self._now_ns
        progress.state = TaskState.WAITING
        if overruled.fails_at_once(self._reactions.tasks[task]):
            self._fail(task, TaskState.OVERDUE)

    # --- plans -------------------------------------------------------------------------------

    def _start_stage(self, rule: int) -> None:
        """R3: start the current stage of a rule, unless the plan is finished."""
        stages = self._reactions.plans[rule].stages
        stage = self._engagement(rule).stage
        if stage < len(stages):
            self._start(stages[stage])
            self._escalate()

    def _start(self, tasks: Iterable[int]) -> None:
        """R4, R7: start tasks, except those whose resource another rule owns. An escalation that
        has followed an earlier failure does not follow again (R6).
        """
        for task in tasks:
            if self._tasks[task].state is not TaskState.IDLE:
                continue
            by = self._overruler(task)
            if by is None:
                self._begin(task)
                continue
            self._command(TaskCommandKind.OVERRULED, task, by)
            if reactions.waits(self._effect(task)):
                self._wait(task)
            else:
                self._fail(task)

    def _begin(self, task: int) -> None:
        effect = self._effect(task)
        started = self._engagement(self._rules[task]).started
        if task in started:
            started.remove(task)
        started.append(task)
        is_awaited = reactions.timeout_ns(effect) is not None
        after = TaskState.HOLDING if reactions.is_lasting(effect) else TaskState.DONE
        self._tasks[task] = Progress(TaskState.RUNNING if is_awaited else after, self._now_ns)
        self._command(TaskCommandKind.START, task)

    def _fail(self, task: int, state: TaskState = TaskState.FAILED) -> None:
        self._tasks[task].state = state
        self._failures.append(task)

    def _escalate(self) -> None:
        """R6: start the escalations of failed tasks, including the escalations of failed
        escalations.
        """
        while self._failures:
            task = self._failures.pop(0)
            self._command(TaskCommandKind.FAILED, task)
            self._start(self._reactions.tasks[task].otherwise)

    def _release(self, rule: int) -> None:
        """R9: undo everything that is in force, in reverse order of the start, and forget it."""
        if self._rests(rule):
            return
        for task in reversed(self._engagement(rule).started):
            if self._tasks[task].state in _IN_FORCE:
                self._command(TaskCommandKind.STOP, task)
        for task in self._reactions.plans[rule].tasks:
            self._tasks[task] = Progress()
        self._engagements[rule] = None

    def _settle(self, watches: Sequence[TruthValue]) -> list[TaskCommand]:
        """Handle the ends of tasks (R4, R15), then start the next stages (R5). Returns all task
        commands of the call.
        """
        for task, due_ns in self._deadlines(TaskState.RUNNING):
            is_over = self._tasks[task].is_reported and self._is_confirmed(task, watches)
            if is_over and self._now_ns <= due_ns:
                is_lasting = reactions.is_lasting(self._effect(task))
                self._tasks[task].state = TaskState.HOLDING if is_lasting else TaskState.DONE
            elif due_ns <= self._now_ns:
                self._fail(task)
        for task, due_ns in self._deadlines(TaskState.WAITING):
            if due_ns <= self._now_ns and not self._is_answered(task, watches):
                self._fail(task, TaskState.OVERDUE)
        self._escalate()
        for rule in self._reactions.order:
            while self._is_stage_over(rule):
                self._engagement(rule).stage += 1
                self._start_stage(rule)
        self._task_commands += self._retracing.task_commands(self._now_ns, self._holding())
        task_commands, self._task_commands = self._task_commands, []
        return task_commands

    def _holding(self) -> list[int]:
        states = enumerate(self._tasks)
        return [task for task, progress in states if progress.state is TaskState.HOLDING]

    def _is_stage_over(self, rule: int) -> bool:
        stages = self._reactions.plans[rule].stages
        if self._rests(rule) or self._engagement(rule).stage == len(stages):
            return False
        tasks = stages[self._engagement(rule).stage]
        return all(self._tasks[task].state in _PASSED for task in tasks)

    def _is_confirmed(self, task: int, watches: Sequence[TruthValue]) -> bool:
        confirmation = reactions.confirmation(self._effect(task))
        return confirmation is None or watches[confirmation] is TruthValue.TRUE

    def _is_answered(self, task: int, watches: Sequence[TruthValue]) -> bool:
        """R15: say whether the goal of a waiting task is reached without the task."""
        if reactions.confirmation(self._effect(task)) is not None:
            return self._is_confirmed(task, watches)
        owner = self._overruler(task)
        if owner is None or not overruled.does_the_same(self._reactions, task, owner):
            return False
        resource = self._reactions.tasks[task].resource
        return any(
            self._tasks[other].state is TaskState.HOLDING
            for other in self._reactions.plans[owner].tasks
            if self._reactions.tasks[other].resource == resource
        )

    # --- task commands -----------------------------------------------------------------------

    def _command(self, kind: TaskCommandKind, task: int, by: int | None = None) -> None:
        self._task_commands.append(TaskCommand(kind, task, by))
        match kind:
            case TaskCommandKind.START:
                self._filter.start(task)
                self._retracing.begin(task)
            case TaskCommandKind.STOP:
                self._filter.stop(task, self._now_ns)
            case TaskCommandKind.OVERRULED | TaskCommandKind.FAILED | TaskCommandKind.RETRACE:
                pass

    def _effect(self, task: int) -> reactions.Effect:
        return self._reactions.tasks[task].effect

    def _rests(self, rule: int) -> bool:
        """Say whether a rule is not engaged."""
        return self._engagements[rule] is None

    def _engagement(self, rule: int) -> Engagement:
        engagement = self._engagements[rule]
        assert engagement is not None, "only engaged rules have tasks"
        return engagement
