"""The meaning of a name: constants, inputs and conditions; the probable meaning of an undeclared
name.

A name that is similar to an undeclared name counts as used. Otherwise each misspelling would also
be reported as an unused declaration. If a file could not be read, no name is undeclared, because
that file may declare it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from dslkit.diagnostics import DeclaredHere, DidYouMean, Edit, Fix, NamedHere, Remark, Write, listed
from rossmarie.check.names.errors import (
    Declared,
    UndeclaredAction,
    UndeclaredEntity,
    UndeclaredName,
    UnknownCondition,
    WrongKindOfName,
)
from rossmarie.check.names.fields import select
from rossmarie.check.names.frames import is_left_in_its_frame
from rossmarie.check.names.message_constants import names_a_message, type_of_message_constant
from rossmarie.check.names.regions import classes_for, type_of_class
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.declarations import ARTICLES, Named, kind_of
from rossmarie.check.scopes.trees import text_of
from rossmarie.check.units.spaced_units import is_rest_of_unit
from rossmarie.check.wording.suggestions import near_name, rename, suggesting
from rossmarie.syntax import ast
from rossmarie.types import Boolean, List, Motion, Type, Unknown


def type_of_reference(node: ast.Reference, context: Context) -> Type:
    """The type of a name that stands alone. The value of a constant is recorded."""
    name = node.name
    fold = context.folds_around(node).get(name.text)
    if fold is not None:
        its_list = context.type_of(fold.list)
        return its_list.element if isinstance(its_list, List) else Unknown()
    declared = context.declarations.names.get(name.text)
    own = context.entity
    # A condition with the name of a value is already reported. The value is used.
    hides = is_value_name(name.text, context)
    if own is not None and not hides and _has_condition(own, name.text, context):
        _use_condition(own, name, context)
        return Boolean()
    if declared is None and (region := type_of_class(node, context)) is not None:
        return region
    if declared is None:
        if context.declarations.is_whole and not is_rest_of_unit(node, context):
            _report_undeclared(node, context)
        return Unknown()
    context.used_names.add(name.text)
    if isinstance(declared, ast.Constant):
        value = context.values.get(declared.value)
        if value is not None:
            context.values[node] = value
        return context.constants.get(name.text, Unknown())
    if isinstance(declared, ast.Input):
        context.uses.inputs.add(name.text)
        found = context.inputs.get(name.text)
        return Unknown() if found is None else found.type
    if isinstance(declared, ast.Motion):
        return _motion_of(name.text, context)
    if isinstance(declared, ast.Zone):
        return _zone_of(node, context)
    report_wrong_kind(name, declared, "a value", context)
    return Unknown()


def _motion_of(name: str, context: Context) -> Type:
    found = context.motions.get(name)
    if found is None:
        return Unknown()
    context.uses.inputs.update(found.inputs)
    return Motion(name)


def _zone_of(node: ast.Reference, context: Context) -> Type:
    """The shapes of a zone, recorded in `context.regions`."""
    found = context.zones.get(node.name.text)
    if found is None:
        return Unknown()
    context.regions[node], type_ = found
    return type_


def type_of_member(node: ast.Member, context: Context) -> Type:
    """The type of a condition of an entity, or of a field."""
    if is_value(node, context):
        type_, text, place = context.type_of(node.value), text_of(node.value), node.value.span
        found = select(type_, node.member, text, place, context.collector)
        return Unknown() if is_left_in_its_frame(node, found, context) else found
    name = node.value.name if isinstance(node.value, ast.Reference) else node.member
    declared = context.declarations.names.get(name.text)
    if isinstance(declared, ast.Entity):
        context.used_names.add(name.text)
        return _condition_of(name.text, node.member, context)
    if declared is not None:
        context.used_names.add(name.text)
        report_wrong_kind(name, declared, "an entity or an input", context)
    elif (region := type_of_class(node, context)) is not None:
        return region
    elif names_a_message(name.text, context):
        return type_of_message_constant(node, name, context)
    elif context.declarations.is_whole:
        _report_undeclared_entity(name, node, context)
    return Unknown()


def is_value(member: ast.Member, context: Context) -> bool:
    """Say whether the expression before a dot has a type. An entity has none."""
    node = member.value
    if not isinstance(node, ast.Reference):
        return True
    name = node.name.text
    if name in context.folds_around(member):
        return True
    if context.entity is not None and _has_condition(context.entity, name, context):
        return not isinstance(context.declarations.names.get(name), ast.Entity)
    return is_value_name(name, context)


def is_value_name(name: str, context: Context) -> bool:
    """Say whether a name stands for a constant or an input."""
    return isinstance(context.declarations.names.get(name), ast.Constant | ast.Input)


def use_actions(rule: ast.Rule, context: Context) -> None:
    """Look up the actions of a rule."""
    for step in rule.steps:
        use_action(step.action, context)
        if step.otherwise is not None:
            use_action(step.otherwise, context)


def use_action(name: ast.Name, context: Context) -> None:
    """Look up an action."""
    declared = context.declarations.names.get(name.text)
    if isinstance(declared, ast.Action):
        context.used_names.add(name.text)
    elif declared is not None:
        report_wrong_kind(name, declared, "an action", context)
    elif context.declarations.is_whole:
        _report_undeclared_action(name, context)


def _has_condition(entity: str, name: str, context: Context) -> bool:
    return name in context.declarations.conditions.get(entity, {})


def _use_condition(entity: str, name: ast.Name, context: Context) -> None:
    context.used_names.add(entity)
    context.used_conditions.add((entity, name.text))
    context.uses.conditions.setdefault((entity, name.text), name.span)


def _condition_of(entity: str, name: ast.Name, context: Context) -> Type:
    if _has_condition(entity, name.text, context):
        _use_condition(entity, name, context)
        return Boolean()
    known = context.declarations.conditions.get(entity, {})
    near = near_name(name.text, known) if context.may_suggest() else None
    finding = UnknownCondition(identifier=name.text, entity=entity)
    if near is not None:
        context.used_conditions.add((entity, near))
        place = NamedHere(name=near).at(known[near].name.span)
        context.collector.add(suggesting(finding, name, near, place))
    elif known:
        known_ones = finding.Known(known=listed(tuple(known)))
        context.collector.add(finding.at(name.span, help=known_ones))
    else:
        context.collector.add(finding.at(name.span, help=finding.NoneThere()))
    return Boolean()


def _report_capitals(name: ast.Name, context: Context) -> None:
    """Report `True`, because the language writes `true`."""
    finding = UndeclaredName(identifier=name.text)
    help = Write(meant=name.text.lower())
    fix = Fix(str(help), (Edit(name.span, name.text.lower()),))
    context.collector.add(finding.at(name.span, help=help, fix=fix))


def _report_undeclared(node: ast.Reference, context: Context) -> None:
    name = node.name
    if name.text.lower() in ("true", "false"):
        _report_capitals(name, context)
        return
    if not context.may_suggest():
        context.collector.add(UndeclaredName(identifier=name.text).at(name.span))
        return
    own = context.declarations.conditions.get(context.entity or "", {})
    values = _named(context, ast.Constant, ast.Input, ast.Motion, ast.Zone)
    finding = UndeclaredName(identifier=name.text)
    elsewhere = _entity_with(name.text, context)
    elements = context.folds_around(node)
    classes = classes_for(node, context)
    near = near_name(name.text, [*elements, *values, *own, *classes])
    if near in classes:
        context.collector.add(suggesting(finding, name, near))
    elif near in elements:
        place = NamedHere(name=near).at(elements[near].variable.span)
        context.collector.add(suggesting(finding, name, near, place))
    elif near is not None:
        _use_guess(near, context)
        declared = own[near].name if near in own else values[near]
        place, fix = NamedHere(name=near).at(declared.span), rename(name, near)
        unsure = finding.Unsure(near=near, identifier=name.text)
        help = DidYouMean(near=near) if fix is not None else unsure
        context.collector.add(finding.at(name.span, place, help=help, fix=fix))
    elif elsewhere is not None:
        context.used_names.add(elsewhere)
        context.used_conditions.add((elsewhere, name.text))
        meant = f"{elsewhere}.{name.text}"
        fix = Fix(f"write `{meant}`", (Edit(name.span, meant),))
        context.collector.add(finding.at(name.span, help=DidYouMean(near=meant), fix=fix))
    else:
        context.collector.add(finding.at(name.span, notes=_declared(values)))


def _declared(known: Mapping[str, object]) -> tuple[Remark, ...]:
    return (Declared(known=listed(tuple(known))),) if known else ()


def _use_guess(name: str, context: Context) -> None:
    if context.entity is not None and _has_condition(context.entity, name, context):
        context.used_conditions.add((context.entity, name))
    else:
        context.used_names.add(name)
        if isinstance(context.declarations.names[name], ast.Input):
            context.uses.inputs.add(name)


def _report_undeclared_entity(name: ast.Name, node: ast.Member, context: Context) -> None:
    member = node.member
    finding = UndeclaredEntity(identifier=name.text)
    if not context.may_suggest():
        context.collector.add(finding.at(name.span))
        return
    elements = {each: fold.variable for each, fold in context.folds_around(node).items()}
    known = {**_named(context, ast.Entity, ast.Input), **elements}
    near = near_name(name.text, known)
    if near is None:
        context.collector.add(finding.at(name.span, notes=_declared(known)))
        return
    if near not in elements:
        context.used_names.add(near)
    if _has_condition(near, member.text, context):
        context.used_conditions.add((near, member.text))
        if context.entity is None:
            context.uses.conditions.setdefault((near, member.text), name.span)
    place = NamedHere(name=near).at(known[near].span)
    notes = (finding.OtherCase(),) if near.lower() == name.text.lower() else ()
    context.collector.add(suggesting(finding, name, near, place, notes=notes))


def _report_undeclared_action(name: ast.Name, context: Context) -> None:
    finding = UndeclaredAction(identifier=name.text)
    if not context.may_suggest():
        context.collector.add(finding.at(name.span))
        return
    known = _named(context, ast.Action)
    near = near_name(name.text, known)
    if near is None:
        context.collector.add(finding.at(name.span, notes=_declared(known)))
        return
    context.used_names.add(near)
    place = NamedHere(name=near).at(known[near].span)
    context.collector.add(suggesting(finding, name, near, place))


def report_wrong_kind(
    name: ast.Name,
    declared: Named,
    expected: str,
    context: Context,
) -> None:
    """Report a name of another kind than the expected kind."""
    finding = WrongKindOfName(
        identifier=name.text, found=ARTICLES[kind_of(declared)], expected=expected
    )
    place = DeclaredHere().at(declared.name.span)
    context.collector.add(finding.at(name.span, place, help=_instead(declared, expected, context)))


def _instead(declared: object, expected: str, context: Context) -> Remark | None:
    if not context.may_suggest():
        return None
    if isinstance(declared, ast.Entity) and expected == "a value":
        name = declared.name.text
        conditions = context.declarations.conditions.get(name, {})
        meant = [f"{name}.{condition}" for condition in conditions]
        if meant:
            return WrongKindOfName.OfEntity(conditions=listed(meant))
        return WrongKindOfName.EmptyEntity()
    if expected == "an action":
        return WrongKindOfName.NoAction(actions=listed(tuple(_named(context, ast.Action))))
    return WrongKindOfName.NoValue()


def _named(context: Context, *kinds: type[object]) -> dict[str, ast.Name]:
    names = context.declarations.names
    return {name: item.name for name, item in names.items() if isinstance(item, kinds)}


def _entity_with(condition: str, context: Context) -> str | None:
    """The entity with a condition of this name, if exactly one entity has it."""
    entities: Iterable[str] = context.declarations.conditions
    found = [entity for entity in entities if _has_condition(entity, condition, context)]
    return found[0] if len(found) == 1 else None
