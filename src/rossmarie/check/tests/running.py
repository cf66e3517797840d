"""The skills in a test that run or can start next: `at 1 sec doing Push, ahead Drive;`."""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie.check.model import CheckedSkills
from rossmarie.check.scopes.context import Context
from rossmarie.check.skills.doing import checked_doing, find_class, known_skills
from rossmarie.check.tests.errors import NothingBeside
from rossmarie.ir.script import ScriptedSkills
from rossmarie.ir.skills import RunningSkill, SkillArgument
from rossmarie.syntax import ast

NOTHING = "nothing"
"""The word after `doing` if no skill runs, unless a skill has this name."""


DOING = "doing"
"""The word that sends the running skills once more, unless an input has this name."""


def repeats_skills(setting: ast.Setting, context: Context) -> bool:
    """Say whether a setting is only the word `doing`."""
    first, *rest = setting.path.steps
    is_word = isinstance(first, ast.Name) and first.text == DOING and DOING not in context.inputs
    return is_word and not rest and setting.value is None and context.skills is not None


def running_of(written: Sequence[ast.Doing], context: Context) -> ScriptedSkills | None:
    """All skills that run, or can start next, from a statement on; None after reporting an
    error.
    """
    skills = known_skills(written[0], context)
    if skills is None:
        return None
    nothing = [each for each in written if _is_nothing(each, skills)]
    if nothing and len(written) > 1:
        context.collector.add(NothingBeside().at(nothing[0].span))
        return None
    if nothing:
        return ScriptedSkills(skills.file.topic, (), f"doing {NOTHING}")
    found: list[RunningSkill] = []
    words: list[str] = []
    for each in written:
        asked = checked_doing(each, context)
        if asked is not None:
            found.append(_running(each, skills, context))
            words.append(asked.text)
    if len(found) < len(written):
        return None
    return ScriptedSkills(skills.file.topic, tuple(found), ", ".join(words))


def _is_nothing(node: ast.Doing, skills: CheckedSkills) -> bool:
    is_plain = node.skill.text == NOTHING and not node.arguments and not node.is_ahead
    return is_plain and NOTHING not in skills.file.skills


def _running(node: ast.Doing, skills: CheckedSkills, context: Context) -> RunningSkill:
    """A skill whose individuals have the written classes, else the classes that the skill
    requires.
    """
    parameters = skills.file.skills[node.skill.text].parameters.values()
    types = {each.name: each.type for each in parameters if each.type in skills.file.classes}
    for argument in node.arguments:
        types[argument.parameter.text] = find_class(argument.kind, skills, context) or ""
    arguments = (SkillArgument(name, type=kind) for name, kind in sorted(types.items()))
    return RunningSkill(node.skill.text, tuple(arguments), node.is_ahead)
