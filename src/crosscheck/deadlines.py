"""Deadlines of the steps of behavior trees that rules run, compared with the time limits of the
rules.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from crosscheck import longest
from crosscheck.longest import Longest, Time
from crosscheck.recovery_errors import DeadlinesTooLong, NoDeadline
from crosscheck.robot import Robot
from crosscheck.trees import TreeRun, tree_runs
from dslkit.diagnostics import Diagnostic, listed
from rossmarie.ir.duration_text import duration_text
from rossmarie.skills import Control, Node, Skill, SkillNode, SourcePlace
from rossmarie.skills.trees import (
    FIRST_FAILURE,
    FIRST_SUCCESS,
    INVERTER,
    NO_FAIL,
    RETRY,
    SELECTOR,
    SERIAL,
    TIMEOUT,
    folded,
    steps,
)

_MOST_LEVELS = 32
"""The most levels of nested compounds that are searched. Deeper steps have no known deadline."""
_FEW = 2
"""The number of steps without a deadline at which one step can use up the time of another."""

Values = Mapping[str, float | None]
"""The numbers of parameters; None for unknown ones."""


def find_without_deadline(robot: Robot) -> Iterator[Diagnostic]:
    """A warning for each step that can use up all the time of the rule, if other steps need time,
    too.
    """
    open_steps = _OpenSteps(robot.skills.skills)
    reported: set[tuple[str, SourcePlace | None]] = set()
    for run in tree_runs(robot):
        found = open_steps.of(run.skill)
        for step in found.steps if found.number >= _FEW else ():
            if (step.skill, step.place) not in reported:
                reported.add((step.skill, step.place))
                yield _without_deadline(robot, run, step)


def find_too_long(robot: Robot) -> Iterator[Diagnostic]:
    """An error for each tree whose deadlines exceed the time limit of the rule in total."""
    for run in tree_runs(robot):
        given = {name: _number(text) for name, text in run.arguments.items()}
        try:
            time = _Times(robot.skills.skills).of(run.skill, _values(run.skill, given)).end
        except _UnknownLimitError:
            continue
        if math.isfinite(time.seconds) and time.seconds * 1e9 > run.goal.timeout_ns:
            yield _too_long(robot, run, time)


def _without_deadline(robot: Robot, run: TreeRun, step: SkillNode) -> Diagnostic:
    rule, within = robot.machine.rules[run.rule].name, duration_text(run.goal.timeout_ns)
    found = NoDeadline(step=step.skill, tree=run.skill.name, rule=rule, within=within)
    return found.at(
        robot.span_of(step.place),
        NoDeadline.Runs(tree=run.skill.name, within=within).at(run.task.span),
    )


def _too_long(robot: Robot, run: TreeRun, time: Time) -> Diagnostic:
    rule, within = robot.machine.rules[run.rule].name, duration_text(run.goal.timeout_ns)
    found = DeadlinesTooLong(
        tree=run.skill.name, rule=rule, most=f"{time.seconds:g} s", within=within
    )
    parts = " + ".join(f"{seconds:g} s ({words})" for words, seconds in time.parts)
    return found.at(
        run.task.span,
        DeadlinesTooLong.Stands(tree=run.skill.name).at(robot.span_of(run.skill.place)),
        notes=[DeadlinesTooLong.Parts(most=f"{time.seconds:g} s", parts=parts)],
    )


# --- steps without a deadline --------------------------------------------------------------------


@dataclass(frozen=True)
class _Open:
    """Steps without a deadline, each once. `number` is the largest number of them on one path."""

    number: int
    steps: tuple[SkillNode, ...]


_NONE = _Open(0, ())


@dataclass
class _OpenSteps:
    """Finds the primitives in trees without a timeout above them."""

    skills: Mapping[str, Skill]
    _known: dict[str, _Open] = field(default_factory=dict)

    def of(self, skill: Skill, level: int = 0) -> _Open:
        """The open steps of a compound; none for a primitive, which has no tree that could bound
        it.
        """
        if skill.name not in self._known:
            self._known[skill.name] = _NONE  # a compound inside itself
            alternatives = [self._in_tree(each, level) for each in skill.trees]
            number = max((each.number for each in alternatives), default=0)
            self._known[skill.name] = _Open(number, _once(alternatives))
        return self._known[skill.name]

    def _in_tree(self, tree: Control, level: int) -> _Open:
        found = [
            self._of_step(step, level + 1)
            for step, above in steps(tree)
            if all(each.kind != TIMEOUT for each in above)
        ]
        return _Open(min(sum(each.number for each in found), _FEW), _once(found))

    def _of_step(self, step: SkillNode, level: int) -> _Open:
        skill = self.skills.get(step.skill)
        if skill is None or not skill.trees or level > _MOST_LEVELS:
            return _Open(1, (step,))
        return self.of(skill, level)


def _once(found: Sequence[_Open]) -> tuple[SkillNode, ...]:
    """All steps, those at the same place once."""
    return tuple({(each.skill, each.place): each for one in found for each in one.steps}.values())


# --- deadlines that add up -----------------------------------------------------------------------


class _UnknownLimitError(Exception):
    """A deadline, a number of tries, or a node that is unknown before the tree runs."""


@dataclass
class _Times:
    """The longest times of skills with values. Raises `_UnknownLimitError`."""

    skills: Mapping[str, Skill]
    _known: dict[tuple[str, tuple[tuple[str, float | None], ...]], Longest] = field(
        default_factory=dict
    )

    def of(self, skill: Skill, values: Values, level: int = 0) -> Longest:
        """The longest time of a skill; infinite for a primitive."""
        if not skill.trees or level > _MOST_LEVELS:
            return longest.STEP
        key = skill.name, tuple(sorted(values.items()))
        if key not in self._known:
            self._known[key] = longest.STEP  # a compound inside itself
            alternatives = [self._in_tree(each, values, level + 1) for each in skill.trees]
            self._known[key] = longest.either(alternatives)
        return self._known[key]

    def _in_tree(self, tree: Control, values: Values, level: int) -> Longest:
        def of_step(step: SkillNode) -> Longest:
            skill = self.skills.get(step.skill)
            if skill is None:
                return longest.STEP
            return self.of(skill, _passed(step, skill, values), level)

        return folded(tree, of_step, lambda node, below: _joined(node, below, values))


def _joined(node: Control, below: Sequence[Longest], values: Values) -> Longest:
    kind = node.kind
    if kind in _OF_MANY:
        return _OF_MANY[kind](below)
    if len(below) != 1:
        raise _UnknownLimitError
    if kind == TIMEOUT:
        return longest.within(_limit(node, values), below[0], _words(node))
    if kind == RETRY:
        return longest.again(int(_limit(node, values)), below[0], _words(node))
    if kind == INVERTER:
        return longest.turned(below[0])
    raise _UnknownLimitError


_OF_MANY: dict[str, Callable[[Sequence[Longest]], Longest]] = {
    **dict.fromkeys(SERIAL, longest.in_turn),
    **dict.fromkeys(SELECTOR, longest.until_one),
    NO_FAIL: longest.never_failing,
    FIRST_FAILURE: longest.at_once,
    FIRST_SUCCESS: longest.until_first,
}


def _limit(node: Control, values: Values) -> float:
    limit = values.get(node.limit) if isinstance(node.limit, str) else node.limit
    if limit is None or not limit > 0:
        raise _UnknownLimitError
    return limit


def _words(node: Node) -> str:
    """The skills below a node."""
    return listed([*dict.fromkeys(step.skill for step, _ in steps(node))])


def _values(skill: Skill, given: Values) -> Values:
    """The numbers of all parameters: the given values, otherwise the defaults."""
    return {name: given.get(name, each.default) for name, each in skill.parameters.items()}


def _passed(step: SkillNode, skill: Skill, values: Values) -> Values:
    """The numbers that a step gets from its compound."""
    given = {
        name: None if text is None else values[text] if text in values else _number(text)
        for name, text in step.arguments.items()
    }
    return _values(skill, given)


def _number(text: str) -> float | None:
    try:
        found = float(text)
    except ValueError:
        return None
    return found if math.isfinite(found) else None
