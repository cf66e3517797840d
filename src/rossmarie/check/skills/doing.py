"""Queries about the running skills: `doing Push(Object: Fragile)`."""

from __future__ import annotations

from collections.abc import Iterable

from dslkit.diagnostics import Label, Remark, Template, listed
from rossmarie.check.model import CheckedDoing, CheckedSkills
from rossmarie.check.scopes.context import Context
from rossmarie.check.skills.errors import (
    ImpossibleClass,
    InSkills,
    Known,
    NoIndividual,
    NoSkills,
    RepeatedSkillParameter,
    UnknownSkill,
    UnknownSkillClass,
    UnknownSkillParameter,
)
from rossmarie.check.wording.suggestions import near_name, suggesting
from rossmarie.skills import Skill, SkillParameter, SourcePlace, among
from rossmarie.syntax import ast
from rossmarie.types import Boolean, Type, Unknown


def type_of_doing(node: ast.Doing, context: Context) -> Type:
    """The type of a query, a boolean. The query is recorded in `context.doing`."""
    found = checked_doing(node, context)
    if found is None:
        return Unknown()
    context.doing[node] = found
    return Boolean()


def checked_doing(node: ast.Doing, context: Context) -> CheckedDoing | None:
    """The skill and the classes of a query, closed under derivation; None after reporting."""
    skills = known_skills(node, context)
    skill = None if skills is None else find_skill(node.skill, skills, context)
    if skills is None or skill is None:
        return None
    arguments: dict[str, tuple[str, ...]] = {}
    words: list[str] = []
    is_right = True
    first: dict[str, ast.SkillArgument] = {}
    for each in node.arguments:
        name = each.parameter.text
        if first.setdefault(name, each) is not each:
            skill_name = node.skill.text
            advice = (
                f"join two queries instead: `doing {skill_name}(...) and doing {skill_name}(...)`"
            )
            report_repeated(each.parameter, first[name].parameter, advice, context)
            is_right = False
            continue
        class_name = _class_of(each, skill, skills, context)
        is_right = is_right and class_name is not None
        if class_name is not None:
            arguments[name] = skills.classes.below(class_name)
            words.append(f"{name}: {each.kind.text}")
    if not is_right:
        return None
    limits = f"({', '.join(words)})" if words else ""
    return CheckedDoing(
        skills=skills.skills.below(skill.name),
        arguments=tuple(sorted(arguments.items())),
        text=f"{'ahead' if node.is_ahead else 'doing'} {skill.name}{limits}",
        permits=tuple(dict.fromkeys(map(str, skill.permits))),
    )


def known_skills(
    node: ast.Doing | ast.SkillNumber | ast.Keeps | ast.RunTree, context: Context
) -> CheckedSkills | None:
    """The skills file; None, after reporting, if the program names none."""
    if context.skills is None and not context.names_skills and context.declarations.is_whole:
        context.collector.add(NoSkills().at(node.span))
    return context.skills


def find_skill(name: ast.Name, skills: CheckedSkills, context: Context) -> Skill | None:
    """The skill with this name; None after reporting that there is none."""
    found = skills.file.skills.get(name.text)
    if found is None:
        finding = UnknownSkill(identifier=name.text, path=skills.declaration.path.value)
        places = {each.name: each.place for each in skills.file.skills.values()}
        report_unlike(finding, name, places, skills, context)
    return found


def find_parameter(
    name: ast.Name, skill: Skill, skills: CheckedSkills, context: Context
) -> SkillParameter | None:
    """The parameter with this name; None after reporting that the skill has none."""
    found = skill.parameters.get(name.text)
    if found is None:
        finding = UnknownSkillParameter(
            skill=skill.name,
            identifier=name.text,
            known=_has("its parameters are", skill.parameters),
        )
        places = {each.name: each.place for each in skill.parameters.values()}
        report_unlike(
            finding, name, places, skills, context, _declared(skill.name, skill.place, skills)
        )
    return found


def _has(intro: str, known: Iterable[str]) -> str:
    names = tuple(known)
    return f"{intro} {listed(names)}" if names else "it has none"


def report_unlike(
    finding: Template,
    name: ast.Name,
    places: dict[str, SourcePlace | None],
    skills: CheckedSkills,
    context: Context,
    around: tuple[Label, ...] = (),
) -> None:
    """Report a name that is not among the known names, with the name that the user probably
    meant.
    """
    may_suggest = context.suggestions.take(len(places))
    near = near_name(name.text, places) if may_suggest else None
    if near is None:
        context.collector.add(finding.at(name.span, *around, notes=_known(finding, places)))
        return
    labels = _declared(near, places[near], skills)
    context.collector.add(suggesting(finding, name, near, *(labels or around)))


def _known(finding: Template, places: Iterable[str]) -> tuple[Remark, ...]:
    """The known names, unless the finding already lists them."""
    names = tuple(places)
    says_nothing = isinstance(finding, UnknownSkill | UnknownSkillClass)
    return (Known(known=listed(names)),) if names and says_nothing else ()


def _declared(what: str, place: SourcePlace | None, skills: CheckedSkills) -> tuple[Label, ...]:
    span = skills.span_at(place)
    return () if span is None else (InSkills(what=f"`{what}` stands").at(span),)


# --- classes -------------------------------------------------------------------------------------


def _class_of(
    argument: ast.SkillArgument, skill: Skill, skills: CheckedSkills, context: Context
) -> str | None:
    """The full name of the class that an argument must have."""
    parameter = find_parameter(argument.parameter, skill, skills, context)
    if parameter is None:
        return None
    labels = _declared(parameter.name, parameter.place, skills)
    if parameter.type not in skills.file.classes:
        no_class = NoIndividual(
            identifier=parameter.name, skill=skill.name, found=kind_of(parameter.type)
        )
        context.collector.add(no_class.at(argument.kind.span, *labels))
        return None
    name = find_class(argument.kind, skills, context)
    if name is None or skills.classes.are_related(name, parameter.type):
        return name
    finding = ImpossibleClass(
        identifier=parameter.name, skill=skill.name, found=name, expected=parameter.type
    )
    context.collector.add(finding.at(argument.kind.span, *labels))
    return None


def find_class(name: ast.Name, skills: CheckedSkills, context: Context) -> str | None:
    """The full name of a class. A unique name needs no namespace."""
    found = among(name.text, skills.file.classes)
    if len(found) == 1:
        return found[0]
    if found:
        finding = UnknownSkillClass(identifier=name.text, reason="several classes have this name")
        help = finding.Several(known=listed(found))
        context.collector.add(finding.at(name.span, help=help))
        return None
    finding = UnknownSkillClass(
        identifier=name.text, reason="the skills file has no class of this name"
    )
    places = {each.name: each.place for each in skills.file.classes.values()}
    if "." not in name.text:
        places = {full.rpartition(".")[2]: place for full, place in places.items()}
    report_unlike(finding, name, places, skills, context)
    return None


def kind_of(type_: str) -> str:
    """The type of a parameter in words."""
    words = {
        "float": "a number",
        "int": "a whole number",
        "bool": "a boolean",
        "str": "a text",
        "enum": "one of several words",
    }
    return words.get(type_, f"an individual of the class {type_}")


def report_repeated(again: ast.Name, first: ast.Name, advice: str, context: Context) -> None:
    """Report a parameter that is named twice. `advice` describes the fix."""
    finding = RepeatedSkillParameter(identifier=again.text, advice=advice)
    context.collector.add(finding.at(again.span, finding.First().at(first.span)))
