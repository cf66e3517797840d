"""Behavior trees as reactions of rules: `tree Reroute(Target: "kitchen") within 20 sec`.

A tree is a skill in the skills file. The program that runs the skills offers the action server
`/recovery`, which runs the tree while the task waits. So a tree is like any other goal that a rule
sends.
"""

from __future__ import annotations

from dslkit.diagnostics import listed
from rossmarie.check.actions.tree_errors import MissingTreeArgument, UnfitTreeArgument
from rossmarie.check.effects import CheckedGoal
from rossmarie.check.expressions.infer import infer
from rossmarie.check.model import CheckedSkills
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.scopes.context import Context
from rossmarie.check.skills.doing import (
    find_parameter,
    find_skill,
    kind_of,
    known_skills,
    report_repeated,
)
from rossmarie.check.wording.describe import describe
from rossmarie.ir import reactions
from rossmarie.skills import Skill, SkillParameter
from rossmarie.syntax import ast
from rossmarie.types import Boolean, Quantity, Text, Type, Unknown
from rossmarie.units import DIMENSIONLESS

SERVER = "/recovery"
ACTION = "skill_context_msgs/Recover"
PASSED = "@"
"""The prefix of a value that is a parameter of a running skill: `@Drive.Target`."""
AFTERWARDS = "afterwards"
"""The field of a goal that describes how the task continues."""
_USUALLY = "resume"
_NUMBERS = frozenset({"float", "int"})
_TEXTS = frozenset({"str", "enum"})


def checked_tree(effect: ast.RunTree, timeout_ns: int, context: Context) -> CheckedGoal | None:
    """The goal for a tree; None after reporting an error."""
    skills = known_skills(effect, context)
    skill = None if skills is None else find_skill(effect.skill, skills, context)
    if skills is None or skill is None:
        return None
    given: dict[str, str] = {}
    is_right = True
    first: dict[str, ast.Name] = {}
    for each in effect.arguments:
        name = each.parameter
        if first.setdefault(name.text, name) is not name:
            report_repeated(name, first[name.text], "leave one of the two out", context)
            is_right = False
            continue
        value = _argument(each, skill, skills, context)
        is_right = is_right and value is not None
        given[name.text] = value or ""
    if not is_right or not _has_all(effect, skill, given, context):
        return None
    afterwards = _USUALLY if effect.afterwards is None else effect.afterwards.text
    fields: dict[str, str | tuple[str, ...]] = {
        "digest": skills.file.digest,
        "skill": skill.name,
        "arguments": tuple(f"{name}={value}" for name, value in sorted(given.items())),
        AFTERWARDS: afterwards,
    }
    assignments = tuple(reactions.Assignment((name,), value) for name, value in fields.items())
    return CheckedGoal(SERVER, ACTION, assignments, timeout_ns, reactions.Interrupted.DROP)


def _argument(
    argument: ast.TreeArgument, skill: Skill, skills: CheckedSkills, context: Context
) -> str | None:
    """A value as text; None after reporting an error."""
    parameter = find_parameter(argument.parameter, skill, skills, context)
    if isinstance(argument.value, ast.Passed):
        return _passed(argument.value, parameter, skill, skills, context)
    type_ = infer(argument.value, context)
    if parameter is None or isinstance(type_, Unknown):
        return None
    if not _fits(parameter, type_):
        _report(parameter, skill, describe(type_), argument.value, context)
        return None
    if not require_constant(argument.value, f"`{parameter.name}`", context):
        return None
    value = context.values[argument.value]
    if value.text is not None:
        return value.text
    if value.boolean is not None:
        return str(value.boolean).lower()
    number = value.numbers[0]
    if parameter.type == "int" and not number.is_integer():
        _report(parameter, skill, f"{number:g}", argument.value, context)
        return None
    return str(int(number)) if parameter.type == "int" else repr(number)


def _fits(parameter: SkillParameter, type_: Type) -> bool:
    if parameter.type in _NUMBERS:
        return isinstance(type_, Quantity) and type_.unit in (None, DIMENSIONLESS)
    if parameter.type == "bool":
        return isinstance(type_, Boolean)
    return isinstance(type_, Text)


def _passed(
    value: ast.Passed,
    parameter: SkillParameter | None,
    skill: Skill,
    skills: CheckedSkills,
    context: Context,
) -> str | None:
    """`@Drive.Target`: the program that runs the tree replaces it by the parameter of the running
    `Drive`.
    """
    running = find_skill(value.skill, skills, context)
    theirs = None if running is None else find_parameter(value.parameter, running, skills, context)
    if parameter is None or theirs is None:
        return None
    classes = skills.file.classes
    if parameter.type in classes and theirs.type in classes:
        is_right = skills.classes.are_related(theirs.type, parameter.type)
    else:
        is_right = parameter.type == theirs.type
    if not is_right:
        _report(parameter, skill, kind_of(theirs.type), value, context)
        return None
    return f"{PASSED}{value.skill.text}.{value.parameter.text}"


def _report(
    parameter: SkillParameter,
    skill: Skill,
    found: str,
    place: ast.Expression | ast.Passed,
    context: Context,
) -> None:
    finding = UnfitTreeArgument(
        parameter=parameter.name, skill=skill.name, expected=kind_of(parameter.type), found=found
    )
    span = None if context.skills is None else context.skills.span_at(parameter.place)
    labels = () if span is None else (finding.Declared(parameter=parameter.name).at(span),)
    context.collector.add(finding.at(place.span, *labels))


def _has_all(effect: ast.RunTree, skill: Skill, given: dict[str, str], context: Context) -> bool:
    """Say whether a tree has all values that it needs. The world model infers some, and a number
    may have a default.
    """
    missing = [
        name
        for name, each in skill.parameters.items()
        if each.is_given and each.default is None and name not in given
    ]
    if missing:
        finding = MissingTreeArgument(
            skill=skill.name,
            missing=listed(missing),
            form=", ".join(f"{name}: VALUE" for name in missing),
            first=missing[0],
        )
        context.collector.add(finding.at(effect.skill.span))
    return not missing
