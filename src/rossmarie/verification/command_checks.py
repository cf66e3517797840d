"""Checks of the bounds on commands (R11, R12).

The input is the reactions of a machine; the result is C functions. The numbers come from the
effects as the rules state them, not from the tables that the generator makes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie.ir import reactions
from rossmarie.verification.check import Check, Passes, WrittenCheck
from rossmarie.verification.formulas import literal
from rossmarie.verification.program import obligation
from rossmarie.verification.reactor_invariants import in_force

ANY_REACTOR = """\
    reactor s = any();
    const reactor *const r = &s;
    const int64_t t_ns = nondet_instant();
    suppose_fit(r);"""
"""Any memory that satisfies the invariants, at any instant."""

_IN_RANGE = "    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);"

SAME = """\
/* Say whether both are the same number, or both are NaN. */
static bool spec_same(double a, double b) { return (isnan(a) && isnan(b)) || a == b; }
"""

CONTRACTS = """\
/* The checks of `moved` prove that its result is 0 or more, and 0 while the task is in force. */
double __CPROVER_uninterpreted_distance(unsigned, double);

double contract_moved(const reactor *r, unsigned task, double ramp, int64_t t_ns)
{
    const double moved_by = __CPROVER_uninterpreted_distance(task, ramp);
    __CPROVER_assert(task < TASKS, "the task exists");
    __CPROVER_assert(t_ns > EARLIEST && t_ns < LATEST, "the instant is in range");
    __CPROVER_assume(moved_by >= 0.0 && (r->state[task] != HOLDING || moved_by == 0.0));
    return moved_by;
}
"""

_MOVED = (("moved", "contract_moved"),)


@dataclass(frozen=True)
class _End:
    """The bounds that a task puts on a field while it is in force."""

    task: int
    low: float
    high: float
    ramp: float


class CommandChecks:
    """Writes these checks for one reactor."""

    def __init__(self, found: reactions.Reactions, name: str) -> None:
        self._found = found
        self._name = name

    def written(self) -> Iterator[WrittenCheck]:
        """All checks; none if the machine has no commands."""
        if not self._found.commands:
            return
        text = _BOUNDED.format(name=self._name)
        about = "a number of a command stays in its bounds"
        yield WrittenCheck(Check("bounded", about), text + _STAYS)
        about = "a number of a command is scaled, then bounded"
        yield WrittenCheck(Check("scaled", about, is_arithmetic=True), text + _IS_SCALED)
        for task, ramp in sorted(self._ramps()):
            about = f"the distance that a limit has moved: {self._said(task)}, ramp {ramp:g}"
            name = f"moved_{task}_{_word(ramp)}"
            yield WrittenCheck(Check(name, about), self._moved(task, ramp))
        for index, command in enumerate(self._found.commands):
            for place, field in enumerate(command.fields):
                path = ".".join(map(str, field.path))
                about = f"the bounds of {command.topic}.{path}"
                check = Check(f"bounds_{index}_{place}", about, _MOVED, self._loops(index))
                yield WrittenCheck(check, self._bounds(index, place))
            about = f"the bounds of {command.topic} are zero until the reactor is opened"
            yield WrittenCheck(
                Check(f"shut_{index}", about, _MOVED, self._loops(index)), self._shut(index)
            )
        about = "commands that do not exist have no bounds"
        yield WrittenCheck(Check("no_command", about, _MOVED), self._no_command())

    def _said(self, task: int) -> str:
        found = self._found.tasks[task]
        return f"{self._found.actions[found.action].name}, task {task}"

    # --- the numbers of the rules ------------------------------------------------------------

    def _limits(self, command: int, field: int) -> Iterator[_End]:
        for index, task in enumerate(self._found.tasks):
            if isinstance(task.effect, reactions.Limit) and task.effect.topic == command:
                for bound in task.effect.bounds:
                    if bound.field == field:
                        yield _End(index, bound.low, bound.high, bound.ramp or 0.0)

    def _scales(self, command: int) -> Iterator[tuple[int, reactions.Scale]]:
        for index, task in enumerate(self._found.tasks):
            if isinstance(task.effect, reactions.Scale) and task.effect.topic == command:
                yield index, task.effect

    def _ramps(self) -> set[tuple[int, float]]:
        """The tasks that bound commands, each with the rate at which its bound fades."""
        found: set[tuple[int, float]] = set()
        for command, each in enumerate(self._found.commands):
            for field in range(len(each.fields)):
                found |= {(end.task, end.ramp) for end in self._limits(command, field)}
            found |= {(task, scale.ramp or 0.0) for task, scale in self._scales(command)}
        return found

    # --- the checks --------------------------------------------------------------------------

    def _moved(self, task: int, ramp: float) -> str:
        holds = in_force(task)
        lines = [
            ANY_REACTOR,
            _IN_RANGE,
            f"    const double moved_by = moved(r, {task}, {literal(ramp)}, t_ns);",
            obligation("moved_by >= 0.0", "a bound moves by a distance of 0 or more"),
            obligation(
                f"!{holds} || moved_by == 0.0", "the bound of a task in force has not moved"
            ),
        ]
        return "\n".join(lines)

    def _call(self, command: int) -> str:
        size = len(self._found.commands[command].fields)
        return "\n".join(
            [
                f"    {self._name}_bounds b[{size}];",
                f"    {self._name}_bounds_of(r, t_ns, {command}, b);",
            ]
        )

    def _bounds(self, command: int, field: int) -> str:
        lines = [ANY_REACTOR, _IN_RANGE, "    __CPROVER_assume(r->opened);", self._call(command)]
        lines += self._field(command, field)
        return "\n".join(lines)

    def _field(self, command: int, field: int) -> Iterator[str]:
        b = f"b[{field}]"
        yield obligation(f"{b}.low <= 0.0 && 0.0 <= {b}.high", "zero lies within the bounds")
        yield obligation(
            f"0.0 <= {b}.factor && {b}.factor <= 1.0", "the factor lies between 0 and 1"
        )
        for end in self._limits(command, field):
            kept = f"{literal(end.low)} <= {b}.low && {b}.high <= {literal(end.high)}"
            yield obligation(
                f"!{in_force(end.task)} || ({kept})", "the bounds respect each limit in force"
            )
        for task, scale in self._scales(command):
            kept = f"{b}.factor <= {literal(scale.factor)}"
            yield obligation(
                f"!{in_force(task)} || {kept}", "the factor respects each scale in force"
            )
        if not any(self._limits(command, field)):
            free = f"{b}.low == -INFINITY && {b}.high == INFINITY"
            yield obligation(free, "a field without a limit has no bounds")

    def _loops(self, command: int) -> Passes:
        """The numbers of passes: each loop runs over fields, limits or scales."""
        fields = range(len(self._found.commands[command].fields))
        limits = sum(len(list(self._limits(command, field))) for field in fields)
        scales = len(list(self._scales(command)))
        called = f"{self._name}_bounds_of"
        return (
            (f"{called}.0", len(fields) + 1),
            (f"{called}.1", limits + 1),
            ("factor_of.0", scales + 1),
        )

    def _shut(self, command: int) -> str:
        shut = "    __CPROVER_assume(!r->opened || t_ns <= EARLIEST || t_ns >= LATEST);"
        lines = [ANY_REACTOR, shut, self._call(command)]
        for field in range(len(self._found.commands[command].fields)):
            zero = f"b[{field}].low == 0.0 && b[{field}].high == 0.0 && b[{field}].factor == 1.0"
            lines.append(obligation(zero, "the bounds let no command pass (R12)"))
        return "\n".join(lines)

    def _no_command(self) -> str:
        most = len(self._found.commands)
        return "\n".join(
            [
                ANY_REACTOR,
                "    const int command = nondet_integer();",
                f"    __CPROVER_assume(command < 0 || command >= {most});",
                f"    {self._name}_bounds_of(r, t_ns, command, NULL);",
            ]
        )


def _word(ramp: float) -> str:
    """A number in a name."""
    return ramp.hex().replace(".", "_").replace("+", "").replace("-", "m")


_BOUNDED = """\
    {name}_bounds b;
    b.factor = nondet_double();
    b.low = nondet_double();
    b.high = nondet_double();
    __CPROVER_assume(0.0 <= b.factor && b.factor <= 1.0 && b.low <= 0.0 && 0.0 <= b.high);
    const double x = nondet_double();
    const double found = {name}_bounded(b, x);
"""

_STAYS = """\
    __CPROVER_assert(isfinite(found), "the result is finite");
    __CPROVER_assert(b.low <= found && found <= b.high, "the result lies within the bounds");
    __CPROVER_assert(isfinite(x) || found == 0.0, "a number that is not finite becomes 0");"""

_IS_SCALED = """\
    const double scaled = x * b.factor;
    const double raised = b.low > scaled ? b.low : scaled;
    const double expected = b.high < raised ? b.high : raised;
    __CPROVER_assert(!isfinite(x) || spec_same(found, expected),
        "the result is the scaled, then bounded number (R11)");"""
