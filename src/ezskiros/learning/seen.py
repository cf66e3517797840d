"""Alignment of a trace with its verdicts: the skills that ran when a rule became active."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from ezskiros.learning.runs import TaskRun
from ezskiros.learning.traces import Execution
from ezskiros.learning.verdicts import Activation


@dataclass(frozen=True, eq=False)
class Hit:
    """An activation with the running executions: the `innermost` ones, and all their parents.
    `lost_s` is the time for which it stayed active within the run (s). If several rules are active,
    the time counts for the first.
    """

    activation: Activation
    running: Sequence[Execution]
    innermost: Sequence[Execution]
    lost_s: float


def hits(run: TaskRun) -> Iterator[Hit]:
    """The activations of a run with the skills that the rules monitored, in the order of time."""
    found = [each for each in activations(run) if not each.is_stale]
    covered = run.trace.start_ns
    stamps = (each.start_ns for each in found)
    for each, running in zip(found, _running_at(run.trace.executions, stamps), strict=True):
        end = min(each.end_ns, run.trace.end_ns)
        lost = max(0, end - max(each.start_ns, covered))
        covered = max(covered, end)
        yield Hit(each, running, _innermost(running), lost / 1e9)


def activations(run: TaskRun) -> Iterator[Activation]:
    """The activations during the task of a run."""
    for each in run.verdicts.activations:
        if run.trace.start_ns <= each.start_ns <= run.trace.end_ns:
            yield each


def _running_at(
    executions: Iterable[Execution], stamps: Iterable[int]
) -> Iterator[Sequence[Execution]]:
    """The executions at each of some instants that never decrease. An execution that is preempted
    at the same instant counts as running, because the rule requested the preemption.
    """
    waiting = sorted(executions, key=lambda each: each.start_ns, reverse=True)
    running: list[Execution] = []
    for at in stamps:
        while waiting and waiting[-1].start_ns <= at:
            running.append(waiting.pop())
        running = [each for each in running if _ran_at(each, at)]
        yield _of_one_tree(running, at)


def _ran_at(execution: Execution, at: int) -> bool:
    is_stopped = execution.outcome == "preempted" and execution.end_ns == at
    return execution.end_ns > at or is_stopped


def _of_one_tree(running: Sequence[Execution], at: int) -> Sequence[Execution]:
    """The executions of the tree that started last, because a recovery runs instead of the task. A
    tree that starts at the same instant as the activation is its consequence, if another tree runs.
    """
    roots = [each for each in running if len(each.path) == 1]
    if not roots:
        return running
    earlier = [each for each in roots if each.start_ns < at]
    last = max(earlier or roots, key=lambda each: each.start_ns)
    return [each for each in running if each.path[0] == last.path[0]]


def _innermost(running: Sequence[Execution]) -> Sequence[Execution]:
    above = {each.path[:-1] for each in running}
    return [each for each in running if each.path not in above]
