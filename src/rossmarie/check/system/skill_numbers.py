"""Inputs that are numbers of skills: `input weight = doing Push.Object.Weight in kg;`."""

from __future__ import annotations

from dslkit.diagnostics import Fix, Remark, listed
from rossmarie.check.expressions.infer import infer
from rossmarie.check.model import CheckedInput, CheckedSkills
from rossmarie.check.operations.operands import duration_ns
from rossmarie.check.scopes.context import Context
from rossmarie.check.skills.doing import (
    find_parameter,
    find_skill,
    kind_of,
    known_skills,
    report_unlike,
)
from rossmarie.check.skills.errors import NoSkillNumber, UnknownSkillProperty
from rossmarie.check.skills.file import report_second_timeout
from rossmarie.check.system.model import contradicts
from rossmarie.check.units.errors import MisplacedUnit
from rossmarie.check.units.quantities import end_of_field, read_unit
from rossmarie.check.wording.gaps import without
from rossmarie.ir import Quantity as Query
from rossmarie.skills import IndividualProperty, SkillParameter, among
from rossmarie.syntax import ast
from rossmarie.types import Boolean, Quantity, Type, Unknown
from rossmarie.units import Unit, UnknownUnitError, parse_unit, si_unit

_NUMBERS = ("float", "int", "bool")


def resolve_number(
    declaration: ast.Input, number: ast.SkillNumber, context: Context
) -> CheckedInput:
    """The input for a number; its timeout follows later. Its type is `Unknown` after reporting."""
    skills = known_skills(number, context)
    found = None if skills is None else _find(number, skills, context)
    if skills is None or found is None:
        return CheckedInput(declaration, "", "", (), Unknown(), None)
    query, type_name, unit = found
    field = str(query)
    type_ = Boolean() if type_name == "bool" else _in_unit(declaration, field, unit, context)
    if isinstance(type_, Boolean) and declaration.unit is not None:
        finding = MisplacedUnit(reason=f"`{field}` is not a number")
        help = finding.LeaveOut(unit=declaration.unit.text)
        context.collector.add(finding.at(declaration.unit.span, help=help))
    file = skills.file
    return CheckedInput(declaration, file.topic, file.message_type, (), type_, None, query=query)


def resolve_context_timeout(context: Context) -> int | None:
    """Compute the timeout of the context of skills, which is also the timeout of its numbers.
    Reports a second `skills` with another time.
    """
    stated: dict[int, ast.Skills] = {}
    for item in context.declarations.items:
        if isinstance(item, ast.Skills) and item.timeout is not None:
            context.enter(None)
            infer(item.timeout, context)
            timeout_ns = duration_ns(item.timeout, "a timeout", context)
            if timeout_ns is None:
                continue
            if stated and timeout_ns not in stated:
                report_second_timeout(item, next(iter(stated.values())), context)
            stated[timeout_ns] = item
    return next(iter(stated), None)


def _find(
    number: ast.SkillNumber, skills: CheckedSkills, context: Context
) -> tuple[Query, str, str | None] | None:
    """The query, the type of the requested number, and its unit in the skills file."""
    skill = find_skill(number.skill, skills, context)
    if skill is None:
        return None
    first, *rest = number.steps
    parameter = find_parameter(first, skill, skills, context)
    if parameter is None:
        return None
    all_skills = skills.skills.below(skill.name)
    text = ".".join((skill.name, *(step.text for step in number.steps)))
    if parameter.type in skills.file.classes:
        asked = _property(number, parameter, rest, skills, context)
        if asked is None:
            return None
        query = Query(
            skills.file.digest, all_skills, parameter.name, asked.name, text, asked.type == "bool"
        )
        return query, asked.type, asked.unit
    if rest:
        extra = ".".join(("", *(step.text for step in rest)))
        finding = NoSkillNumber(field=text, found=f"a part of {kind_of(parameter.type)}")
        context.collector.add(finding.at(number.span, help=finding.LeaveOut(extra=extra)))
        return None
    if parameter.type not in _NUMBERS:
        finding = NoSkillNumber(field=text, found=kind_of(parameter.type))
        context.collector.add(finding.at(number.span, help=finding.Other()))
        return None
    is_boolean = parameter.type == "bool"
    return (
        Query(skills.file.digest, all_skills, parameter.name, None, text, is_boolean),
        parameter.type,
        None,
    )


def _property(
    number: ast.SkillNumber,
    parameter: SkillParameter,
    rest: list[ast.Name],
    skills: CheckedSkills,
    context: Context,
) -> IndividualProperty | None:
    """The property of the individual that is a parameter; None after reporting an error."""
    known = _properties_of(parameter.type, skills)
    finding: NoSkillNumber | UnknownSkillProperty
    if not rest:
        finding = NoSkillNumber(field=number.span.text, found=kind_of(parameter.type))
        numbers = [each.name for each in known.values() if each.type in _NUMBERS]
        help: Remark = finding.Properties(known=listed(numbers)) if numbers else finding.Other()
        context.collector.add(finding.at(number.span, help=help))
        return None
    written = ".".join(step.text for step in rest)
    found = among(written, known)
    if len(found) != 1:
        names = listed(found or tuple(known))
        finding = UnknownSkillProperty(
            identifier=written,
            owner=parameter.type,
            known=f"its properties are {names}" if names else "it has none",
        )
        place = ast.Name(written, rest[0].span.to(rest[-1].span))
        places = {each.name.rpartition(".")[2]: each.place for each in known.values()}
        report_unlike(finding, place, {} if found else places, skills, context)
        return None
    asked = known[found[0]]
    if asked.type not in _NUMBERS:
        finding = NoSkillNumber(field=number.span.text, found=kind_of(asked.type))
        context.collector.add(finding.at(number.span, help=finding.Other()))
        return None
    return asked


def _properties_of(class_name: str, skills: CheckedSkills) -> dict[str, IndividualProperty]:
    """The properties that individuals of a class have, or may have."""
    near = {*skills.classes.above(class_name), *skills.classes.below(class_name)}
    return {
        name: each for name, each in skills.file.properties.items() if not near.isdisjoint(each.of)
    }


def _in_unit(declaration: ast.Input, field: str, stated: str | None, context: Context) -> Type:
    """The type of a number. If the skills file has a unit, the number arrives in SI, else in the
    unit of the input.
    """
    known = _known_unit(stated)
    written = None if declaration.unit is None else read_unit(declaration.unit, context.collector)
    if declaration.unit is None or written is None:
        if declaration.unit is not None:
            return Unknown()
        return Quantity(None if known is None else si_unit(known.dimension))
    if known is None:
        return Quantity(written)
    contradiction = contradicts(known, written, field)
    if contradiction is None:
        return Quantity(si_unit(known.dimension))
    edits = without(end_of_field(declaration), "in", declaration.unit.span)
    fix = Fix(f"leave out `in {declaration.unit.text}`", edits)
    help = contradiction.OfSkill(found=contradiction.found, known=contradiction.known)
    context.collector.add(contradiction.at(declaration.unit.span, help=help, fix=fix))
    return Unknown()


def _known_unit(text: str | None) -> Unit | None:
    """The unit in the skills file; None if there is none, or if it is unknown here."""
    try:
        return None if text is None else parse_unit(text)
    except UnknownUnitError:
        return None
