"""The conditions of skills as facts and changes of the world, about the parameters of running
skills.

A primitive changes the world when it succeeds. So its pre-conditions stay true while it runs,
except for changes by other skills. A compound changes the world by the skills in its trees.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from crosscheck.robot import Robot
from crosscheck.situations import Situation
from crosscheck.trees import TreeRun
from dslkit.source import Span
from ezskiros.contracts.knowledge import How, NameKnowledge, Origin, WorldChange
from ezskiros.contracts.statements import conjuncts, renamed
from ezskiros.export.statements import statement_of
from ezskiros.ontology.statements import Statement
from rossmarie.skills import ChildSkill, Skill, SkillCondition

Names = Mapping[str, str]
"""The names of the individuals that the parameters of a skill stand for, by parameter."""


@dataclass(frozen=True)
class Said:
    """A statement of a condition, with new names for the parameters of the skill."""

    statement: Statement
    condition: SkillCondition
    span: Span


class UnreadableConditionError(Exception):
    """An invalid condition in the skills file. The message gives the skill and the reason."""


class Beliefs:
    """Reads the conditions of skills. Collects the new names, with their classes."""

    def __init__(self, robot: Robot, iris: Mapping[str, str]) -> None:
        self._robot, self._iris = robot, iris
        self.names: dict[str, NameKnowledge] = {}
        self.owners: dict[Span, str] = {}
        """The skills whose conditions were read, by the places of the conditions."""

    def names_of(self, skill: Skill, prefix: str, *, are_own: bool = False) -> Names:
        """New names for the parameters of a skill, such as `Drive.Target`. Two names stand for
        different individuals if `are_own` is true.
        """
        found = {name: f"{prefix}.{name}" for name in skill.parameters}
        for name, parameter in skill.parameters.items():
            iri = self._iris.get(parameter.type)
            if iri is not None:
                self.names[found[name]] = NameKnowledge(frozenset({iri}), are_own)
        return found

    def names_of_running(self, situation: Situation) -> dict[str, Names]:
        """The names for the parameters of the running skills, by skill name."""
        return {
            skill.name: self.names_of(skill, skill.name, are_own=number == 0)
            for number, skill in enumerate(situation.skills)
        }

    def names_of_tree(self, run: TreeRun, running: Mapping[str, Names]) -> Names:
        """The names for the parameters of a tree: names from running skills, and new ones."""
        own = self.names_of(run.skill, f"tree {run.skill.name}")
        passed = {
            name: running[skill][parameter]
            for name, (skill, parameter) in run.passed.items()
            if parameter in running.get(skill, {})
        }
        return {**own, **passed}

    def said(
        self, skill: Skill, conditions: Iterable[SkillCondition], names: Names
    ) -> Iterator[Said]:
        """The statements of conditions of a skill. Raises `UnreadableConditionError`."""
        for each in conditions:
            span = self._robot.span_of(each.place)
            self.owners[span] = skill.name
            try:
                found = statement_of(each.statement)
            except ValueError as problem:
                why = f"`{each.text}` of `{skill.name}` is not a condition: {problem}"
                raise UnreadableConditionError(why) from None
            for statement in conjuncts(found):
                yield Said(renamed(statement, names), each, span)

    def facts(
        self, skill: Skill, conditions: Iterable[SkillCondition], names: Names
    ) -> dict[Statement, Origin]:
        """The statements of a skill's conditions that are true."""
        said = self.said(skill, conditions, names)
        return {each.statement: Origin(each.span, "pre") for each in said}

    def changes(self, skill: Skill, names: Names, how: How) -> list[WorldChange]:
        """The changes that a skill makes when it succeeds."""
        return [
            WorldChange(each.statement, Origin(each.span, "post"), how)
            for each in self.said(skill, skill.conditions.post, names)
        ]

    def changes_below(self, skill: Skill, names: Names) -> list[WorldChange]:
        """The changes that the skills in the trees of a skill may have made."""
        found: dict[WorldChange, None] = {}
        known = {_key(skill, names)}
        waiting = [(skill, names)]
        while waiting:
            compound, above = waiting.pop()
            for child in compound.children:
                below = self._robot.skills.skills.get(child.skill)
                if below is None:
                    continue
                theirs = self._names_of_child(child, below, compound, above)
                if _key(below, theirs) not in known:
                    known.add(_key(below, theirs))
                    found |= dict.fromkeys(self.changes(below, theirs, How.FAILED))
                    waiting.append((below, theirs))
        return list(found)

    def _names_of_child(
        self, child: ChildSkill, skill: Skill, compound: Skill, above: Names
    ) -> Names:
        """The names of a child. A parameter that only children share has one name for each
        compound.
        """
        own = dict(self.names_of(skill, f"{compound.name}/{skill.name}"))
        for name in own:
            shared = child.arguments.get(name) or ""
            if shared in above:
                own[name] = above[shared]
        return own


def _key(skill: Skill, names: Names) -> tuple[str, frozenset[tuple[str, str]]]:
    return skill.name, frozenset(names.items())
