"""Skills that rules always stop. A planner must not use these skills when it searches for another
path (S68).

The queries of a rule are read from its condition, not proved. A query is a query about the running
skills, or an `or` with such a query as operand. So the result is certain for each named skill, but
does not cover all other skills.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

from rossmarie import ir
from rossmarie.check.actions.trees import AFTERWARDS, SERVER
from rossmarie.check.model import CheckedSkills
from rossmarie.ir import overruled, reactions
from rossmarie.ir.taking import taken
from rossmarie.skills import Control, Skill, SkillNode, SkillParameter, UseKind
from rossmarie.skills.trees import FIRST_FAILURE, FIRST_SUCCESS, RETRY, SELECTOR, SERIAL, TIMEOUT
from rossmarie.skills.trees import folded as folded_tree

WITHOUT = "without"
"""The field of a goal with the prohibitions."""
_REPLAN = "replan"

ParameterClasses = frozenset[tuple[str, str]]
"""Parameters, each with a class. A skill is stopped if all its individuals have these classes."""
_Taken = frozenset[tuple[UseKind, str]]

_RUNS_ALL = (*SERIAL, FIRST_FAILURE, RETRY, TIMEOUT)
"""Nodes that fail if one of their children fails."""
_RUNS_ONE = (*SELECTOR, FIRST_SUCCESS)
"""Nodes that succeed if one of their children succeeds."""
_MOST_ALTERNATIVES = 64
"""The most combinations of individuals of one skill that are reported. For other combinations, the
rule stops the skill during the run.
"""
_MOST_LEVELS = 64
"""The most levels of nested compounds that are searched."""


def with_prohibitions(machine: ir.Machine, skills: CheckedSkills | None) -> ir.Machine:
    """The machine, with goals that name the skills that a planner must not use."""
    tasks = machine.reactions.tasks
    if skills is None or not any(_replans(task.effect) for task in tasks):
        return machine
    found = tuple(prohibitions(machine, skills))
    reported = tuple(replace(task, effect=_telling(task.effect, found)) for task in tasks)
    return replace(machine, reactions=replace(machine.reactions, tasks=reported))


def prohibitions(machine: ir.Machine, skills: CheckedSkills) -> Iterator[str]:
    """The skills that the rules always stop: `Drive(Target=hall.SchoolCorridor)`, or `Drive`."""
    for name, alternatives in sorted(_stopped(machine, skills).items()):
        for individuals in sorted(map(sorted, _without_special_cases(alternatives))):
            limits = ", ".join(f"{parameter}={kind}" for parameter, kind in individuals)
            yield f"{name}({limits})" if limits else name


def _replans(effect: reactions.Effect) -> bool:
    return (
        isinstance(effect, reactions.SendGoal)
        and effect.server == SERVER
        and reactions.Assignment((AFTERWARDS,), _REPLAN) in effect.assignments
    )


def _telling(effect: reactions.Effect, found: tuple[str, ...]) -> reactions.Effect:
    if not isinstance(effect, reactions.SendGoal) or not _replans(effect):
        return effect
    reported = reactions.Assignment((WITHOUT,), found)
    return replace(effect, assignments=(*effect.assignments, reported))


def _without_special_cases(
    alternatives: Collection[ParameterClasses],
) -> Iterator[ParameterClasses]:
    """The combinations that no other combination covers."""
    return (each for each in alternatives if not any(other < each for other in alternatives))


# --- rules ---------------------------------------------------------------------------------------


def _stopped(
    machine: ir.Machine, skills: CheckedSkills
) -> Mapping[str, frozenset[ParameterClasses]]:
    """The individuals with which each skill is stopped."""
    found: dict[str, frozenset[ParameterClasses]] = {}
    for rule in range(len(machine.rules)):
        asked = [*_asked(machine, machine.rules[rule].condition)]
        lost = _lost(machine, rule)
        if not asked or not lost or machine.reactions.plans[rule].unless:
            continue
        needing = _needing(lost, skills.file.skills)
        for query in asked:
            individuals = _individuals(query, skills)
            for name in needing.intersection(query.skills):
                found[name] = found.get(name, frozenset()) | {individuals}
    return _with_compounds(found, skills.file.skills)


def _asked(machine: ir.Machine, condition: int) -> Iterator[ir.Doing]:
    """The queries about running skills. Each query alone makes the condition true."""
    waiting = [condition]
    while waiting:
        node = machine.propositions[waiting.pop()].node
        if isinstance(node, ir.Or):
            waiting += node.operands
        elif isinstance(node, ir.Flag):
            signal = machine.signals[node.signal].node
            path = machine.slots[signal.slot].path if isinstance(signal, ir.Read) else ()
            if path and isinstance(path[0], ir.Doing) and not path[0].is_ahead:
                yield path[0]


def _lost(machine: ir.Machine, rule: int) -> _Taken:
    """The resources that a rule takes away immediately, and while it is active. A stage begins
    after the stage before it. The delay is zero if no effect of the earlier stage can fail.
    """
    found = []
    for stage in machine.reactions.plans[rule].stages:
        tasks = [machine.reactions.tasks[index] for index in stage]
        found += [taken(machine, each.effect) for each in tasks if _lasts(each.effect)]
        if any(map(overruled.can_fail, tasks)):
            break
    return frozenset(each for each in found if each is not None)


def _lasts(effect: reactions.Effect) -> bool:
    """Say whether the effect takes a resource away permanently. A rule that sends a goal keeps the
    server.
    """
    return reactions.is_lasting(effect) or isinstance(effect, reactions.SendGoal)


def _individuals(query: ir.Doing, skills: CheckedSkills) -> ParameterClasses:
    """The classes that a query names. Of each argument, only the most general class is given."""
    below = skills.classes.below
    return frozenset(
        (parameter, next(each for each in classes if below(each) == classes))
        for parameter, classes in query.arguments
    )


# --- skills --------------------------------------------------------------------------------------


def _needing(lost: _Taken, skills: Mapping[str, Skill]) -> frozenset[str]:
    """The skills that need one of these resources on every path."""
    found = frozenset(
        name
        for name, skill in skills.items()
        if any((use.kind, use.name) in lost for use in skill.uses)
    )
    for _ in range(_MOST_LEVELS):
        known = found
        more = frozenset(name for name, each in skills.items() if _needs(each, known))
        if more <= found:
            break
        found |= more
    return found


def _needs(skill: Skill, known: Collection[str]) -> bool:
    """Say whether each tree of a skill needs one of the known skills."""

    def joined(node: Control, below: Sequence[bool]) -> bool:
        if node.kind in _RUNS_ONE:
            return bool(below) and all(below)
        return node.kind in _RUNS_ALL and any(below)

    trees = (folded_tree(each, lambda step: step.skill in known, joined) for each in skill.trees)
    return bool(skill.trees) and all(trees)


def _with_compounds(
    stopped: Mapping[str, frozenset[ParameterClasses]], skills: Mapping[str, Skill]
) -> Mapping[str, frozenset[ParameterClasses]]:
    """Add the compound skills in which every path leads through a stopped skill."""
    found = {name: stopped.get(name, frozenset()) for name in skills}
    for _ in range(_MOST_LEVELS):
        before = dict(found)
        for name, skill in skills.items():
            if skill.trees:
                found[name] = _few(found[name] | _through(skill, before))
        if found == before:
            break
    return {name: alternatives for name, alternatives in found.items() if alternatives}


def _through(
    skill: Skill, stopped: Mapping[str, frozenset[ParameterClasses]]
) -> frozenset[ParameterClasses]:
    """The combinations of individuals for which every path through each tree of a compound skill
    leads through stopped skills.
    """

    def of_step(step: SkillNode) -> frozenset[ParameterClasses]:
        alternatives = (
            _passed(each, step, skill.parameters) for each in stopped.get(step.skill, ())
        )
        return frozenset(each for each in alternatives if each is not None)

    def joined(
        node: Control, below: Sequence[frozenset[ParameterClasses]]
    ) -> frozenset[ParameterClasses]:
        if node.kind in _RUNS_ONE:
            return _all_of(below)
        return frozenset().union(*below) if node.kind in _RUNS_ALL else frozenset()

    return _all_of([folded_tree(each, of_step, joined) for each in skill.trees])


def _all_of(alternatives: Sequence[frozenset[ParameterClasses]]) -> frozenset[ParameterClasses]:
    """The combinations of individuals that are stopped on every path; none if there is no path."""
    if not alternatives:
        return frozenset()
    found = alternatives[0]
    for each in alternatives[1:]:
        found = _few(frozenset(one | other for one, other in itertools.product(found, each)))
    return found


def _few(alternatives: frozenset[ParameterClasses]) -> frozenset[ParameterClasses]:
    """The first combinations in a fixed order, the most general combination first."""
    general = frozenset(_without_special_cases(alternatives))
    if len(general) <= _MOST_ALTERNATIVES:
        return general
    return frozenset(
        sorted(general, key=lambda each: (len(each), sorted(each)))[:_MOST_ALTERNATIVES]
    )


def _passed(
    individuals: ParameterClasses, step: SkillNode, parameters: Mapping[str, SkillParameter]
) -> ParameterClasses | None:
    """The individuals of a step, expressed by parameters of the compound skill; None if the
    compound skill does not pass all of them.
    """
    names = {parameter: step.arguments.get(parameter) for parameter, _ in individuals}
    if not all(each in parameters for each in names.values()):
        return None
    return frozenset((name, kind) for parameter, kind in individuals if (name := names[parameter]))
