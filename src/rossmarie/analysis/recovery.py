"""Recoveries that conflict with their own rule or with another rule: a limit cuts their commands to
0.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.analysis.activity import propositions_of
from rossmarie.analysis.errors import RecoveryBlocked, Undecided
from rossmarie.analysis.finding import Finding, witness_note
from rossmarie.analysis.inquiry import Inquiry, QueryResult, both_active
from rossmarie.analysis.solver import Satisfiability
from rossmarie.ir import Machine
from rossmarie.ir.reactions import Bound, Limit, Publish, Task


def find_blocked(inquiry: Inquiry) -> Iterator[Finding]:
    """A warning for each command of a rule that a simultaneous limit sets to 0."""
    machine = inquiry.machine
    for rule, task, publish in _published(machine):
        for other, limit_task, bound in _limits(machine, publish):
            value = _cut(machine, publish, bound)
            if value is None:
                continue
            result = _both(inquiry, rule, other)
            if result.outcome is not Satisfiability.IMPOSSIBLE:
                yield _blocked(machine, rule, other, task, limit_task, bound, value, result)
                break


def _published(machine: Machine) -> Iterator[tuple[int, Task, Publish]]:
    for rule, plan in enumerate(machine.reactions.plans):
        for index in plan.tasks:
            task = machine.reactions.tasks[index]
            if isinstance(task.effect, Publish) and task.effect.command is not None:
                yield rule, task, task.effect


def _limits(machine: Machine, publish: Publish) -> Iterator[tuple[int, Task, Bound]]:
    """The bounds of all rules on the topic of a command, by rule and task."""
    for rule, plan in enumerate(machine.reactions.plans):
        for index in plan.tasks:
            task = machine.reactions.tasks[index]
            if isinstance(task.effect, Limit) and task.effect.topic == publish.command:
                yield from ((rule, task, bound) for bound in task.effect.bounds)


def _cut(machine: Machine, publish: Publish, bound: Bound) -> float | None:
    """The number of a command that a bound sets to 0; None if the bound leaves a part of it."""
    assert publish.command is not None
    path = machine.reactions.commands[publish.command].fields[bound.field].path
    for assignment in publish.assignments:
        value = assignment.value
        if assignment.path == path and isinstance(value, float) and value != 0.0:
            is_cut = bound.low == 0.0 if value < 0.0 else bound.high == 0.0
            return value if is_cut else None
    return None


def _both(inquiry: Inquiry, rule: int, other: int) -> QueryResult:
    if rule == other:
        return QueryResult(Satisfiability.POSSIBLE)
    plans = inquiry.machine.reactions.plans
    if other in plans[rule].unless or rule in plans[other].unless:
        return QueryResult(Satisfiability.IMPOSSIBLE)
    pair = inquiry.about(rule, other)
    return pair.decide(both_active(pair.machine))


def _blocked(
    machine: Machine,
    rule: int,
    other: int,
    task: Task,
    limit_task: Task,
    bound: Bound,
    value: float,
    result: QueryResult,
) -> Finding:
    publish = task.effect
    assert isinstance(publish, Publish)
    assert publish.command is not None
    name, limit = machine.rules[rule].name, machine.reactions.actions[limit_task.action].name
    by = f"its own `{limit}`" if rule == other else f"`{limit}` of `{machine.rules[other].name}`"
    field = machine.reactions.commands[publish.command].fields[bound.field]
    path = ".".join(str(step) for step in field.path)
    place = RecoveryBlocked.Limit().at(limit_task.span)
    if result.outcome is Satisfiability.UNDECIDED:
        query = f"can rule `{name}` publish {path} on {publish.topic} while {by} makes it 0?"
        open_one = Undecided(query=query, reason="it is undecided if both can be active")
        return Finding(open_one.at(task.span, place))
    finding = RecoveryBlocked(
        rule=name,
        field=path,
        value=f"{value:.6g} {field.unit}".rstrip(),
        topic=publish.topic,
        limit=by,
        low=f"{bound.low:.6g}",
        high=f"{bound.high:.6g}",
    )
    propositions = propositions_of(machine, (rule, other))
    witness = result.witness
    notes = () if witness is None else (witness_note(machine, witness, propositions),)
    return Finding(finding.at(task.span, place, notes=notes), witness)
