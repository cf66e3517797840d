"""A behavior tree over time: the state of each of its skills."""

from __future__ import annotations

import enum
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from py_trees.behaviour import Behaviour

from ezskiros.engine.events import Event, Happened
from ezskiros.engine.skill import SkillChild
from ezskiros.skills.calls import SkillCall
from ezskiros.trees.tree import IndividualReference, ValueReference


class Status(enum.Enum):
    """The state of a skill that has started."""

    RUNNING = "running"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    PREEMPTED = "preempted"


class SkillSpan(NamedTuple):
    """The start and the end of a skill (s), and its status. There is no end while it runs."""

    start: float
    end: float | None
    status: Status


@dataclass(frozen=True)
class TreeSkill:
    """A skill of a tree, so many levels below the root; without spans, it never started."""

    label: str
    depth: int
    spans: tuple[SkillSpan, ...]


@dataclass(frozen=True)
class Begun:
    """A tree that has begun, by its root, after so many events of all trees."""

    root: SkillChild
    after: int


_ENDS = {
    Happened.SUCCEEDED: Status.SUCCEEDED,
    Happened.FAILED: Status.FAILED,
    Happened.PREEMPTED: Status.PREEMPTED,
}


def tree_over_time(
    trees: Sequence[Begun], events: Iterable[tuple[float, Event]]
) -> tuple[TreeSkill, ...]:
    """All skills of the trees that have run, parents before children. A later tree replaces an
    earlier tree, which may continue afterwards. If several trees contain a skill, an event belongs
    to the tree that began last.
    """
    skills = [list(_skills(each.root)) for each in trees]
    spans: list[dict[tuple[str, ...], list[SkillSpan]]] = [
        {skill.path: [] for skill in each} for each in skills
    ]
    for number, (at_s, event) in enumerate(events):
        begun = (known for each, known in zip(trees, spans, strict=True) if each.after <= number)
        *_, latest = (known[event.path] for known in begun if event.path in known)
        _note(latest, at_s, event.happened)
    return tuple(
        TreeSkill(_label(skill), len(skill.path) - 1, tuple(known[skill.path]))
        for each, known in zip(skills, spans, strict=True)
        for skill in each
    )


def running_of(tree: Sequence[TreeSkill], over: float) -> list[tuple[str, float, float]]:
    """Each run of a skill with nothing below it: its name, its begin and its end (s)."""
    below = [one.depth for one in tree[1:]]
    leaves = [one for one, depth in zip(tree, [*below, 0], strict=True) if depth <= one.depth]
    return [
        (one.label, span.start, over if span.end is None else span.end)
        for one in leaves
        for span in one.spans
    ]


def _skills(node: Behaviour) -> Iterator[SkillChild]:
    """A skill and the skills below it. Processors in between have no name."""
    if isinstance(node, SkillChild):
        yield node
        below = [] if node.tree is None else [node.tree]
    else:
        below = node.children
    for child in below:
        yield from _skills(child)


def _note(spans: list[SkillSpan], at_s: float, happened: Happened) -> None:
    if happened is Happened.STARTED:
        spans.append(SkillSpan(at_s, None, Status.RUNNING))
    elif happened in _ENDS:
        is_running = bool(spans) and spans[-1].end is None
        start = spans.pop().start if is_running else at_s  # one that fails before it starts
        spans.append(SkillSpan(start, at_s, _ENDS[happened]))


def _label(skill: SkillChild) -> str:
    """`Reach(above)`: the name of the skill, and its arguments in its tree."""
    name = skill.name.partition("#")[0]
    arguments = [] if skill.above is None else list(_arguments(skill.call))
    return f"{name}({', '.join(arguments)})" if arguments else name


def _arguments(call: SkillCall) -> Iterator[str]:
    for given in call.arguments.values():
        if isinstance(given, (IndividualReference, ValueReference)):
            yield given.parameter.name
        else:
            yield str(given)
