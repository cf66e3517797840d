"""Checks of the task commands of a reactor, and of its state after them.

The input is the reactions of a machine; the result is C functions. Each part of a call has its own
check. In other checks a contract replaces the part; the contract states the facts that the check
has proved. The program counts the decisions of a call task by task. The check of `decide` proves
that the list has enough space for them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rossmarie.ir import model as ir
from rossmarie.verification.check import Check, Parts, Passes, WrittenCheck
from rossmarie.verification.invariants import Sentence
from rossmarie.verification.program import assertions, assumptions, obligation
from rossmarie.verification.reactor_definitions import releases, stages
from rossmarie.verification.reactor_invariants import ReactorInvariants
from rossmarie.verification.task_command_contracts import CONTRACTS, PERFORM, REPORTED
from rossmarie.verification.task_command_invariants import TaskCommandInvariants

_DECIDE = ("decide", "note_decided")
_ESCALATE = ("escalate", "contract_escalate")
_NOTE = ("append_started", "contract_append_started")
_CLOCK = ("set_clock", "contract_set_clock")
_RELEASES = (
    ("set_clock", "set_clock_within"),
    ("release", "contract_release"),
    ("pass_resources_on", "end_at_pass_on"),
)
_STEP = (
    ("escalate", "any_escalate"),
    ("is_stage_over", "is_over"),
    ("start_stage", "start_and_end"),
    ("give_task_commands", "end_at_give_task_commands"),
)
_PASSES = (
    ("escalate", "ignore_reactor"),
    ("is_stage_over", "is_over_or_not"),
    ("start_stage", "ignore_stage"),
    ("give_task_commands", "ignore_reactor"),
)
_STARTS = (
    _CLOCK,
    ("release", "disengage"),
    ("pass_resources_on", "any_pass_on"),
    ("start_stage", "start_looked_at"),
    ("settle", "end_at_settle"),
)


class TaskCommandChecks:
    """Writes these checks for one reactor."""

    def __init__(self, machine: ir.Machine, name: str) -> None:
        found = machine.reactions
        self._found = found
        self._name = name
        self._names = [rule.name for rule in machine.rules]
        self._task_commands = TaskCommandInvariants(found)
        self._invariants = ReactorInvariants(found)

    # --- predicates and contracts ------------------------------------------------------------

    def text(self) -> str:
        """The predicates and contracts that the checks use."""
        task_commands = self._task_commands
        within = [*self._invariants.always(), *task_commands.reported()]
        return "\n".join(
            [
                REPORTED.format(name=self._name),
                PERFORM.format(name=self._name),
                *_both("clock", _REACTOR, self._invariants.clock()),
                *_both("within", _REACTOR, within),
                *_both("listed", _REACTOR, task_commands.listed()),
                *_both("owned", _REACTOR, self._invariants.owned()),
                *_both("started", _REACTOR, self._invariants.started()),
                *_both("notable", f"{_REACTOR}, unsigned task", task_commands.notable()),
                *_both(
                    "noted",
                    "const reactor *r, const reactor *old, unsigned task",
                    task_commands.noted(),
                ),
                *_both("kept", _BEFORE, task_commands.kept()),
                *_both("escalated", _BEFORE, task_commands.escalated()),
                *_both("passed_on", _BEFORE, task_commands.passed_on()),
                *_both("stage_started", f"{_BEFORE}, unsigned rule", task_commands.stage_started()),
                *_both("startable", f"{_REACTOR}, unsigned rule", task_commands.startable()),
                *_both("releasable", f"{_REACTOR}, unsigned rule", task_commands.releasable()),
                *_both("unreported", _REACTOR, task_commands.unreported()),
                *_both("unbegun", f"{_REACTOR}, unsigned rule", task_commands.unbegun()),
                *_both("in_time", _REACTOR, self._invariants.in_time()),
                *_both("ended", "const reactor *r, const reactor *old", task_commands.ended()),
                stages(self._found),
                CONTRACTS.format(name=self._name, releases=releases(self._found)),
            ]
        )

    # --- the checks --------------------------------------------------------------------------

    def written(self) -> Iterator[WrittenCheck]:
        """All checks of task commands."""
        about = "a task command is kept until the end of a call"
        yield self._check("decide", about, (), self._decide())
        about = "each task command is given once, as decided"
        yield self._check("give_task_commands", about, (), _GIVE)
        for rule in range(len(self._found.plans)):
            yield self._release(rule)
            for stage in range(len(self._found.plans[rule].stages) + 1):
                yield self._start(rule, stage)
        yield self._check("stage_over", "the end of a stage", (), _STAGE_OVER)
        about = "a task that starts is recorded"
        yield self._check("append_started", about, (), _APPEND)
        about = "escalations follow failures"
        yield self._check("escalate", about, (_DECIDE, _NOTE), self._escalate())
        about = "resources are passed on"
        yield self._check("pass_on", about, (_DECIDE, _NOTE, _ESCALATE), _PASS_ON)
        yield from self._settle()
        yield from self._react()
        about = "the result of a task is reported"
        settle = ("settle", "end_at_judging")
        yield self._check("report", about, (_CLOCK, settle), _REPORT.format(name=self._name))

    def _settle(self) -> Iterator[WrittenCheck]:
        body = f"{_SETTLE}\n    settle(&s, NULL);"
        ends = (_DECIDE, ("escalate", "end_at_escalate"))
        yield self._check("settle_ends", "tasks end, until escalations start", ends, body)
        for rule, name in enumerate(self._names):
            about = f"the next stage of rule {name} starts"
            looked = f"    looked_at = {rule};\n{body}"
            yield self._check(f"settle_{rule}", about, _STEP, looked)
        yield self._check(
            "settle_passes", "the number of started stages is in range", _PASSES, body
        )

    def _react(self) -> Iterator[WrittenCheck]:
        about = "rules that are no longer engaged are released"
        yield self._check("react", about, _RELEASES, _REACT.format(name=self._name))
        for rule, name in enumerate(self._names):
            text = _REACTS.format(name=self._name, rule=rule)
            yield self._check(f"react_{rule}", f"rule {name} starts", _STARTS, text)

    def _check(self, name: str, about: str, parts: Parts, body: str) -> WrittenCheck:
        return WrittenCheck(Check(name, about, parts, self._loops()), body)

    def _loops(self) -> Passes:
        """The limits of loops: a rule's tasks, its stages, and the rules that claim the same
        resource.
        """
        plans, tasks = self._found.plans, self._found.tasks
        longest = max(len(plan.tasks) for plan in plans)
        started = [len(stage) for plan in plans for stage in plan.stages]
        started += [len(task.otherwise) for task in tasks]
        return (
            ("give_task_commands.0", 2 * len(tasks) + 1),
            ("append_started.0", longest + 1),
            ("release.0", longest + 1),
            ("release.1", longest + 1),
            ("overruler.0", len(plans) + 1),
            ("start.0", max(started) + 1),
            ("escalate.0", len(self._invariants.can_fail) + 1),
            ("settle.1", max(len(plan.stages) for plan in plans) + 1),
        )

    def _decide(self) -> str:
        tasks = range(len(self._found.tasks))
        counted = " + ".join(f"reported.count[{task}]" for task in tasks)
        few = " && ".join(f"reported.count[{task}] <= 2" for task in tasks)
        return _DECIDED.format(name=self._name, counted=counted, few=few)

    def _release(self, rule: int) -> WrittenCheck:
        about = f"rule {self._names[rule]} is released"
        lines = [_WITHIN, _RELEASABLE.format(rule=rule), _RELEASED.format(rule=rule)]
        its_tasks = "the tasks of the rule become idle, other tasks go on (R9)"
        tasks = range(len(self._found.tasks))
        lines += [
            obligation(text.format(index=each), its_tasks) for each in tasks for text in _ALIKE_TASK
        ]
        its_rule = "the rule is not engaged, other rules are unchanged (R9)"
        rules = range(len(self._found.plans))
        lines += [
            obligation(text.format(index=each), its_rule) for each in rules for text in _ALIKE_RULE
        ]
        return self._check(f"release_{rule}", about, (_DECIDE,), "\n".join(lines))

    def _start(self, rule: int, stage: int) -> WrittenCheck:
        about = f"stage {stage + 1} of rule {self._names[rule]} starts"
        if stage == len(self._found.plans[rule].stages):
            about = f"no stage follows the last stage of rule {self._names[rule]}"
        plan = self._found.plans[rule]
        lines = [_AT_STAGE.format(rule=rule, stage=stage)]
        lines.append("    suppose_startable(r, rule);\n    suppose_owned(r);")
        lines.append(_CALL.format(call="start_stage(&s, rule)"))
        lines.append(_STARTED)
        for task in plan.stages[stage] if stage < len(plan.stages) else ():
            free = f"spec_overruler(r, {task}) < 0"
            starts = f"({free}) == (reported.last[{task}] == START)"
            lines.append(
                obligation(starts, "a task starts exactly if its resource is free (R3, R7)")
            )
            lines.append(obligation(f"r->state[{task}] != IDLE", "no task is skipped (R3, R7)"))
        parts = (_DECIDE, _NOTE, _ESCALATE)
        return self._check(f"start_{rule}_{stage}", about, parts, "\n".join(lines))

    def _escalate(self) -> str:
        return "\n".join(
            [_WITHIN, "    suppose_listed(r);", _CALL.format(call="escalate(&s)"), _ESCALATED]
        )


_REACTOR = "const reactor *r"
_BEFORE = "const reactor *r, const reactor *old, const task_commands *was"


def _both(name: str, parameters: str, sentences: Iterable[Sentence]) -> Iterator[str]:
    """A predicate as an assumption and as an obligation."""
    found = list(sentences)
    unused = "".join(
        f"    (void){each.split()[-1].lstrip('*')};\n" for each in parameters.split(",")
    )
    for word, write in (("suppose", assumptions), ("must_be", assertions)):
        yield f"static void {word}_{name}({parameters})\n{{\n{unused}{write(found)}\n}}\n"


_WITHIN = """\
    reactor s = any();
    const reactor *const r = &s;
    reported = any_task_commands();
    suppose_within(r);"""

# The stage is set rather than assumed, so that the solver knows which tasks start.
_AT_STAGE = """\
    const unsigned rule = {rule};
    reactor s = any();
    const reactor *const r = &s;
    s.stage[rule] = {stage};
    reported = any_task_commands();
    suppose_within(r);
    __CPROVER_assume(r->failed_count == 0);"""

_CALL = """\
    const reactor old = s;
    const task_commands was = reported;
    {call};
    must_be_within(r);
    must_be_kept(r, &old, &was);
    __CPROVER_assert(r->failed_count == 0, "all escalations have started (R6)");
    __CPROVER_assert(r->now_ns == old.now_ns && r->opened == old.opened, "no time passes");
    __CPROVER_assert(r->perform == old.perform && r->user == old.user,
        "the receiver of task commands is unchanged");"""

_STARTED = """\
    must_be_owned(r);
    must_be_stage_started(r, &old, &was, rule);"""

_STAGE_OVER = f"""\
{_WITHIN}
    const unsigned rule = nondet_number();
    __CPROVER_assume(rule < RULES);
    __CPROVER_assert(is_stage_over(r, rule) == spec_is_over(r, rule),
        "a stage is over if all its tasks have begun and none runs (R5)");"""

_APPEND = """\
    reactor s = any();
    const reactor *const r = &s;
    const unsigned task = nondet_number();
    __CPROVER_assume(task < TASKS);
    suppose_started(r);
    suppose_notable(r, task);
    const reactor old = s;
    append_started(&s, task);
    must_be_noted(r, &old, task);
    reactor expected = old;
    copy_started(&expected, r);
    __CPROVER_assert(is_same(r, &expected), "nothing else changes");"""

_ESCALATED = """\
    must_be_escalated(r, &old, &was);"""

_PASS_ON = f"""\
{_WITHIN}
    suppose_unreported(r);
    __CPROVER_assume(r->failed_count == 0);
{_CALL.format(call="pass_resources_on(&s)")}
    must_be_owned(r);
    must_be_passed_on(r, &old, &was);"""

_SETTLE = f"""\
{_WITHIN}
    suppose_listed(r);
    suppose_owned(r);
    before = s;"""

_REACT = """\
    reactor s = any();
    const reactor *const r = &s;
    const int64_t t_ns = nondet_instant();
    suppose_fit(r);
    begin_call(r);
    before = s;
    {name}_react(&s, NULL, nondet_bool() ? exempted : NULL, t_ns);
    __CPROVER_assert(t_ns <= EARLIEST || t_ns >= LATEST,
        "a call is refused only at an instant out of range (R1)");
    must_fit(r);"""

_REACTS = """\
    reactor s = any();
    reported = any_task_commands();
    before = s;
    looked_at = {rule};
    is_awaited = true;
    {name}_react(&s, NULL, nondet_bool() ? exempted : NULL, nondet_instant());"""

_REPORT = """\
    reactor s = any();
    const reactor *const r = &s;
    const int64_t t_ns = nondet_instant();
    reported_of = nondet_integer();
    is_success = nondet_bool();
    suppose_fit(r);
    begin_call(r);
    before = s;
    {name}_report(&s, NULL, t_ns, reported_of, is_success);
    __CPROVER_assert(reported_of < 0 || reported_of >= TASKS || t_ns <= EARLIEST || t_ns >= LATEST,
        "a report is refused only if its task or instant is out of range");
    must_fit(r);"""

_RELEASABLE = """\
    suppose_unreported(r);
    suppose_releasable(r, {rule});"""

_RELEASED = """\
    const task_commands was = reported;
    reactor expected = s;
    spec_release(&expected, {rule});
    const task_commands wanted = reported;
    reported = was;
    release(&s, {rule});
    must_be_within(r);
    __CPROVER_assert(is_same(r, &expected), "nothing else changes (R9)");"""

_ALIKE_TASK = (
    "r->state[{index}] == expected.state[{index}]",
    "r->since_ns[{index}] == expected.since_ns[{index}]",
    "reported.count[{index}] == wanted.count[{index}]",
    "reported.last[{index}] == wanted.last[{index}]",
)

_ALIKE_RULE = (
    "r->engaged[{index}] == expected.engaged[{index}]",
    "r->started_count[{index}] == expected.started_count[{index}]",
    "r->stage[{index}] == expected.stage[{index}]",
)

_DECIDED = """\
    reactor s = any();
    const reactor *const r = &s;
    reported = any_task_commands();
    const unsigned task = nondet_number(), command = nondet_number(), other = nondet_number();
    const int by_rule = nondet_integer();
    __CPROVER_assume(task < TASKS && command <= GIVEN_UP && by_rule >= -1 && by_rule < RULES);
    __CPROVER_assume({few} && reported.count[task] < 2);
    __CPROVER_assume(r->decided == {counted} && other < r->decided);
    const reactor old = s;
    decide(&s, task, command, by_rule);
    __CPROVER_assert(r->decided == old.decided + 1, "the list has one more decision");
    const {name}_decision *made = &r->decisions[old.decided];
    __CPROVER_assert(made->task == task && made->command == command && made->by_rule == by_rule,
        "the decision is kept unchanged");
    __CPROVER_assert(r->decisions[other].task == old.decisions[other].task
        && r->decisions[other].command == old.decisions[other].command
        && r->decisions[other].by_rule == old.decisions[other].by_rule,
        "earlier decisions are kept");
    reactor expected = old;
    expected.decided = r->decided;
    expected.decisions[old.decided] = *made;
    __CPROVER_assert(is_same(r, &expected), "nothing else changes");"""

_GIVE = """\
    performing = any();
    reactor *const r = &performing;
    r->perform = perform_next;
    __CPROVER_assume(r->decided <= 2 * TASKS);
    reactor expected = performing;
    const unsigned decided = r->decided;
    performed = 0;
    give_task_commands(r);
    __CPROVER_assert(performed == decided, "each task command is given");
    __CPROVER_assert(r->decided == 0, "no task command is left");
    expected.decided = 0;
    __CPROVER_assert(is_same(r, &expected), "nothing else changes");"""
