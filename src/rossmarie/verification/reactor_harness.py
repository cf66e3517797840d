"""The program for CBMC about a reactor: the unchanged generated C, and the checks.

The input is a machine; the result is C text and the list of its checks. The reactor's inputs from
the monitor (active rules, true conditions) are arbitrary.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rossmarie.ir import model as ir
from rossmarie.ir import reactions
from rossmarie.verification.check import Check, WrittenCheck
from rossmarie.verification.command_checks import ANY_REACTOR, CONTRACTS, SAME, CommandChecks
from rossmarie.verification.harness import Harness
from rossmarie.verification.places import name_of
from rossmarie.verification.pose_checks import PoseChecks
from rossmarie.verification.program import PRELUDE, assertions, assumptions, obligation
from rossmarie.verification.reactor_definitions import overruler
from rossmarie.verification.reactor_invariants import ReactorInvariants
from rossmarie.verification.task_command_checks import TaskCommandChecks


def reactor_harness(machine: ir.Machine) -> Harness:
    """All obligations about the reactor of a machine."""
    return _Writer(machine).harness()


class _Writer:
    def __init__(self, machine: ir.Machine) -> None:
        self._machine = machine
        self._found = machine.reactions
        self._name = name_of(machine)
        self._invariants = ReactorInvariants(machine.reactions)
        self._task_commands = TaskCommandChecks(machine, self._name)
        self._poses = PoseChecks(machine)

    def harness(self) -> Harness:
        fit = [*self._invariants.always(), *self._invariants.at_rest()]
        written = [_prefixed(each) for each in self._written()]
        fields = [len(command.fields) for command in self._found.commands]
        parts = [
            PRELUDE,
            f'#include "{self._name}_reactor.c"\n',
            SAME,
            self._memory(),
            self._poses.comparison(),
            overruler(self._found),
            f"static void suppose_fit(const reactor *r)\n{{\n{assumptions(fit)}\n}}\n",
            f"static void must_fit(const reactor *r)\n{{\n{assertions(fit)}\n}}\n",
            self._contracts(),
            self._task_commands.text(),
            CONTRACTS if self._found.commands else "",
            self._poses.text(),
            *(each.text() for each in written),
        ]
        passes = max(len(self._found.tasks), len(self._found.plans), *fields) + 2
        checks = tuple(each.check for each in written)
        return Harness("\n".join(parts), checks, passes, "reactor_harness")

    def _written(self) -> Iterator[WrittenCheck]:
        yield from map(self._without_poses, self._of_tasks())
        yield from self._poses.written()

    def _of_tasks(self) -> Iterator[WrittenCheck]:
        yield from CommandChecks(self._found, self._name).written()
        yield from self._calls()
        yield from self._parts()
        yield from self._task_commands.written()

    def _without_poses(self, written: WrittenCheck) -> WrittenCheck:
        check = written.check
        return replace(
            written, check=replace(check, replaced=(*check.replaced, *self._poses.parts()))
        )

    def _calls(self) -> Iterator[WrittenCheck]:
        """The checks of functions that only set or report a value."""
        for name, about, lines in (
            ("init", "a reactor is initialized", _INIT),
            ("open", "a reactor is opened", _OPEN),
            ("task_state", "the state of a task is reported", _TASK_STATE),
        ):
            yield WrittenCheck(Check(name, about), lines.format(name=self._name))
        yield WrittenCheck(Check("next_wake", "the next wake of the reactor"), self._next_wake())

    def _next_wake(self) -> str:
        lines = [ANY_REACTOR, f"    const int64_t wake_ns = {self._name}_reactor_next_wake(r);"]
        lines.append(obligation("wake_ns > r->now_ns", "the next wake lies after the clock (R13)"))
        ends = ["wake_ns == NEVER"]
        for index, task in enumerate(self._found.tasks):
            if timeout := reactions.timeout_ns(task.effect):
                due = f"r->since_ns[{index}] + INT64_C({timeout})"
                is_open = f"(r->state[{index}] == RUNNING || r->state[{index}] == WAITING)"
                missed = f"{is_open} && {due} > r->now_ns && wake_ns > {due}"
                lines.append(obligation(f"!({missed})", "the end of no task is missed (R13)"))
                ends.append(f"({is_open} && wake_ns == {due})")
        lines.append(obligation(" || ".join(ends), "a task ends at the next wake (R13)"))
        return "\n".join(lines)

    def _parts(self) -> Iterator[WrittenCheck]:
        yield WrittenCheck(Check("set_clock", "the clock of the reactor is set"), self._set_clock())
        about = "the engaged rules before their tasks start"
        yield WrittenCheck(Check("engaged", about, _ENGAGING), self._engaged())

    def _engaged(self) -> str:
        """R1. Tasks are not part of this check: only `release` writes them."""
        lines = [ANY_REACTOR, _REACT.format(name=self._name)]
        for rule, plan in enumerate(self._found.plans):
            goes_on = " && ".join([_is_on(rule), *(f"!({_is_on(other)})" for other in plan.unless)])
            engaged = f"r->engaged[{rule}] == (is_looked ? {goes_on} : old.engaged[{rule}])"
            about = "a rule is engaged if it is active, not exempted and not suspended (R1)"
            lines.append(obligation(engaged, about))
        return "\n".join(lines)

    def _memory(self) -> str:
        watches = len(self._machine.watches)
        watched = _WATCHED.format(name=self._name, watches=watches) if watches else ""
        lines = [f"    watched[{index}] = nondet_bool();\n" for index in range(watches)]
        return _MEMORY.format(name=self._name, watches=watched, is_watched="".join(lines))

    def _contracts(self) -> str:
        return _CONTRACTS.format(name=self._name)

    def _set_clock(self) -> str:
        times = self._invariants.clock()
        lines = [ANY_REACTOR.replace("    suppose_fit(r);", assumptions(list(times))), _SET_CLOCK]
        for task in range(len(self._found.tasks)):
            since, before = f"r->since_ns[{task}]", f"old.since_ns[{task}]"
            forward = f"r->now_ns < old.now_ns || {since} == {before}"
            lines.append(obligation(forward, "instants are kept if time goes forward"))
            never = f"({before} == NEVER) == ({since} == NEVER)"
            lines.append(obligation(never, "no task begins, and begun tasks stay begun"))
            age = f"old.now_ns - {before}"
            kept = f"{since} == t_ns - ({age} < LONGEST ? {age} : LONGEST)"
            lines.append(
                obligation(
                    f"r->now_ns >= old.now_ns || {before} == NEVER || {kept}", "ages are kept (R14)"
                )
            )
        lines += [obligation(each.holds, each.about) for each in self._invariants.clock()]
        return "\n".join(lines)


def _prefixed(written: WrittenCheck) -> WrittenCheck:
    """The check with a prefix that distinguishes it from the checks of the monitor."""
    return replace(written, check=replace(written.check, name=f"reactor_{written.check.name}"))


def _is_on(rule: int) -> str:
    return f"active[{rule}] && !(is_reported && exempted[{rule}] != 0)"


_MEMORY = """\
reactor nondet_reactor(void);
int64_t nondet_instant(void);
unsigned nondet_number(void);
int nondet_integer(void);
double nondet_double(void);
_Bool nondet_bool(void);

static bool active[RULES];
static unsigned char exempted[RULES];
{watches}
bool {name}_is_active(const {name}_monitor *m, int rule)
{{
    (void)m;
    __CPROVER_assert(rule >= 0 && rule < RULES, "the rule exists");
    return active[rule];
}}

static void perform(void *user, int task, enum {name}_task_command command, int by_rule)
{{
    (void)user;
    __CPROVER_assert(task >= 0 && task < TASKS, "the task of a task command exists");
    __CPROVER_assert(by_rule >= -1 && by_rule < RULES, "`by_rule` is a rule or -1");
    (void)command;
}}

/* Arbitrary bits in memory, within the limits of C: a bool is 0 or 1, and a callback is valid. */
static reactor any_reactor(void)
{{
    reactor r = nondet_reactor();
    r.opened = nondet_bool();
    for (unsigned i = 0; i != TASKS; i++)
        r.reported[i] = nondet_bool();
    for (unsigned i = 0; i != RULES; i++)
        r.engaged[i] = nondet_bool();
    r.perform = perform;
    r.user = NULL;
    return r;
}}

/* Compare two reactors at an arbitrary byte. So the result holds for each byte. */
static bool is_same_byte(const reactor *a, const reactor *b)
{{
    const unsigned byte = nondet_number();
    __CPROVER_assume(byte < sizeof *a);
    return ((const unsigned char *)a)[byte] == ((const unsigned char *)b)[byte];
}}

static reactor any(void)
{{
    for (unsigned i = 0; i != RULES; i++) {{
        active[i] = nondet_bool();
        exempted[i] = (unsigned char)nondet_number();
    }}
{is_watched}    return any_reactor();
}}
"""

_WATCHED = """
static bool watched[{watches}];

enum {name}_truth_value {name}_watch(const {name}_monitor *m, int watch)
{{
    (void)m;
    __CPROVER_assert(watch >= 0 && watch < {watches}, "the confirmation exists");
    return watched[watch] ? {name}_TRUE : {name}_UNKNOWN;
}}
"""

_ENGAGING = (
    ("release", "disengage"),
    ("pass_resources_on", "ignore_resources"),
    ("start_stage", "ignore_stage"),
    ("settle", "ignore_settle"),
)

_CONTRACTS = """\
void disengage(reactor *r, unsigned rule) {{ r->engaged[rule] = false; }}

void ignore_resources(reactor *r) {{ (void)r; }}

void ignore_stage(reactor *r, unsigned rule)
{{
    (void)r;
    (void)rule;
}}

void ignore_settle(reactor *r, const {name}_monitor *m)
{{
    (void)r;
    (void)m;
}}
"""

_REACT = """\
    const reactor old = s;
    const bool is_looked = t_ns > EARLIEST && t_ns < LATEST;
    const bool is_reported = nondet_bool();
    {name}_react(&s, NULL, is_reported ? exempted : NULL, t_ns);"""

_INIT = """\
    reactor s = any();
    const reactor *const r = &s;
    const char *const fault = {name}_reactor_init(&s, perform, NULL);
    __CPROVER_assert(!fault, "the arithmetic is IEEE 754");
    __CPROVER_assert(!r->opened, "the reactor is not open (R12)");
    must_fit(r);"""

_OPEN = f"""\
{ANY_REACTOR}
    (void)t_ns;
    {{name}}_reactor_open(&s);
    __CPROVER_assert(r->opened, "the reactor is open");
    must_fit(r);"""

_TASK_STATE = f"""\
{ANY_REACTOR}
    (void)t_ns;
    const int task = nondet_integer();
    const int state = {{name}}_task_state(r, task);
    if (task < 0 || task >= TASKS)
        __CPROVER_assert(state == IDLE, "a task that does not exist is idle");
    else
        __CPROVER_assert(state == r->state[task], "the state of the task is reported");"""

_SET_CLOCK = """\
    const reactor old = s;
    const bool is_set = set_clock(&s, t_ns);
    __CPROVER_assert(is_set == (t_ns > EARLIEST && t_ns < LATEST),
        "an instant out of range is refused");
    __CPROVER_assert(r->now_ns == (is_set ? t_ns : old.now_ns), "the clock is set, or unchanged");
    __CPROVER_assert(is_set || is_same(r, &old), "a refused instant changes nothing");
    if (!is_set)
        return;
    reactor expected = old;
    expected.now_ns = t_ns;
    for (unsigned i = 0; i != TASKS; i++)
        expected.since_ns[i] = r->since_ns[i];
    __CPROVER_assert(is_same(r, &expected), "nothing else changes");"""
