"""The check: it turns syntax trees into a checked program. It resolves names, checks types and
units, and computes constants.

The input is the trees of the main file and of all its imports. One run finds all errors. An
expression that depends on an error is skipped silently.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from dslkit.diagnostics import Collector, Label
from dslkit.source import SourceFile
from rossmarie.check.actions.commands import CommandChecker
from rossmarie.check.actions.effects import EffectChecker
from rossmarie.check.actions.targets import TargetResolver
from rossmarie.check.effects import CheckedEffect
from rossmarie.check.expressions.decided import warn_of_decided, warn_of_never_cleared
from rossmarie.check.expressions.infer import infer
from rossmarie.check.expressions.parameters import fits_parameter, values_of
from rossmarie.check.foresight.kept import check_kept
from rossmarie.check.foresight.motions import check_motions
from rossmarie.check.model import (
    CheckedProgram,
    ConditionKey,
    Gaps,
    Symbols,
    Value,
)
from rossmarie.check.names.references import use_actions
from rossmarie.check.names.unused import warn_of_unused
from rossmarie.check.operations.operands import duration_ns, require_condition, require_constant
from rossmarie.check.rules.categories import check_categories
from rossmarie.check.rules.errors import MissingTimeout
from rossmarie.check.rules.exemptions import check_exemptions
from rossmarie.check.rules.feedback import check_feedback
from rossmarie.check.rules.hazards import declared_hazards
from rossmarie.check.rules.last_resorts import check_last_resorts
from rossmarie.check.rules.missing import (
    warn_of_empty_braces,
    warn_of_missing_rules,
    warn_of_missing_timeouts,
)
from rossmarie.check.rules.order import LONGEST_CIRCLE, circle_of, in_order
from rossmarie.check.rules.plans import check_escalations, check_latches, check_size
from rossmarie.check.rules.priorities import order_of_rules
from rossmarie.check.rules.unless import giving_way
from rossmarie.check.scopes.context import Context, ItemUses
from rossmarie.check.scopes.declarations import collect
from rossmarie.check.scopes.errors import CircularCondition, CircularConstant
from rossmarie.check.scopes.exemptions import is_of_exempted
from rossmarie.check.scopes.trees import constant_of
from rossmarie.check.skills.file import read_skills
from rossmarie.check.system.field_units import check_read_units
from rossmarie.check.system.frames import read_frames, resolve_frames
from rossmarie.check.system.inputs import resolve_inputs, resolve_timeouts
from rossmarie.check.system.message_rates import message_gaps
from rossmarie.check.system.model import read_system_model
from rossmarie.check.system.node_parameters import resolve_node_parameters
from rossmarie.check.tests.statements import check_tests
from rossmarie.check.zones.zones import check_zones
from rossmarie.ir.reactions import CommandTopic
from rossmarie.ir.script import Script
from rossmarie.syntax import ast
from rossmarie.syntax.walk import walk
from rossmarie.types import Unknown


@dataclass(frozen=True)
class CheckOptions:
    """`message_folders` contain .msg files, `PACKAGE/msg/TYPE.msg`, in addition to those of system
    models.
    """

    message_folders: Sequence[Path] = ()


@dataclass(frozen=True)
class _Actions:
    """The results for actions. `confirmations` are the conditions that the actions depend on."""

    effects: Mapping[str, tuple[CheckedEffect, ...]]
    commands: Mapping[str, CommandTopic]
    confirmations: tuple[tuple[Label, ItemUses], ...]
    order: tuple[int, ...]
    unless: tuple[tuple[int, ...], ...]
    priorities: tuple[tuple[int, int], ...]


def check(
    modules: Sequence[ast.Module], options: CheckOptions, collector: Collector
) -> CheckedProgram | None:
    """Check a program, main module last. Returns None if the check or the parser found errors.

    Unused names and missing rules are not reported if parsing failed: a part that could not be read
    may contain the missing part.
    """
    was_parsed = not collector.has_errors
    declarations = collect(modules, collector)
    context = Context(collector, declarations)
    model = read_system_model(declarations, options.message_folders, context.suggestions, collector)
    context.messages = model.messages
    read_skills(context)
    read_frames(context)
    stated_units = resolve_inputs(model, context)
    _check_constants(context)
    resolve_node_parameters(context)
    resolve_timeouts(context)
    resolve_frames(context)
    check_zones(context)
    check_motions(context)
    gaps = message_gaps(context)
    conditions = _check_conditions(context)
    resting = [_check_rule(rule, context) for rule in declarations.rules]
    feedback = tuple(check_feedback(rule, context) for rule in declarations.rules)
    keeps = tuple(check_kept(rule, context) for rule in declarations.rules)
    categories = tuple(check_categories(rule, context) for rule in declarations.rules)
    targets = TargetResolver(model, context, was_parsed)
    actions = _check_actions(targets, context)
    _check_circles(conditions, context)
    check_read_units(stated_units, context)
    tests = check_tests(CommandChecker(targets, {}), context, is_parsed=was_parsed)
    if was_parsed:
        warn_of_unused(context)
        warn_of_missing_rules(context)
        warn_of_empty_braces(context)
    warn_of_missing_timeouts((*resting, *actions.confirmations), conditions, context)
    hazards = declared_hazards(context, is_parsed=was_parsed)
    if collector.has_errors:
        return None
    return replace(
        _program(actions, hazards, gaps, tests, context),
        feedback=feedback,
        categories=categories,
        keeps=keeps,
        read_files=(*model.messages.read_files, *_skill_files(context)),
    )


def _skill_files(context: Context) -> tuple[SourceFile, ...]:
    return () if context.skills is None else (context.skills.source,)


def _check_constants(context: Context) -> None:
    """Check each constant after the constants that it uses."""
    constants = context.declarations.constants
    by_name = {
        constant.name.text: constant
        for constant in constants
        if context.declarations.names[constant.name.text] is constant
    }
    needs = {constant: _constants_in(constant, context) for constant in constants}
    order, circles = in_order(needs)
    for circle in circles:
        for constant in circle:
            context.constants[constant.name.text] = Unknown()
        _report_circular_constant(circle, context)
    in_circles = {constant for circle in circles for constant in circle}
    for constant in order:
        if constant not in in_circles:
            _check_constant(constant, constant is by_name.get(constant.name.text), context)
    for circle in circles:
        context.used_names.update(constant.name.text for constant in circle)


def _constants_in(constant: ast.Constant, context: Context) -> list[ast.Constant]:
    parts = (part for value in values_of(constant) for part in walk(value))
    found = [constant_of(part, context.declarations) for part in parts]
    return [needed for needed in found if needed is not None]


def _report_circular_constant(circle: Sequence[ast.Constant], context: Context) -> None:
    names = [constant.name.text for constant in circle]
    finding = CircularConstant(identifier=names[0], cycle=circle_of(names))
    labels = [finding.Part().at(other.name.span) for other in circle[1:LONGEST_CIRCLE]]
    context.collector.add(finding.at(circle[0].name.span, *labels))


def _check_constant(constant: ast.Constant, is_first: bool, context: Context) -> None:
    context.enter(None)
    type_ = infer(constant.value, context)
    kind = "a constant" if constant.parameter is None else "the value of a parameter"
    is_known = isinstance(type_, Unknown) or require_constant(constant.value, kind, context)
    is_known = is_known and fits_parameter(constant, type_, context)
    if is_first:
        context.constants[constant.name.text] = type_ if is_known else Unknown()


def _check_conditions(context: Context) -> dict[ConditionKey, ItemUses]:
    found: dict[ConditionKey, ItemUses] = {}
    for entity in context.declarations.entities:
        for condition in entity.conditions:
            uses = context.enter(entity.name.text)
            _check_condition(condition.expression, context)
            found.setdefault((entity.name.text, condition.name.text), uses)
    return found


def _check_condition(expression: ast.Expression, context: Context) -> None:
    infer(expression, context)
    require_condition(expression, context)
    warn_of_decided(expression, context)


def _check_rule(rule: ast.Rule, context: Context) -> tuple[Label, ItemUses]:
    """Check a rule. Returns its place and its uses. Parts that an exemption takes over from the
    exempted rule are checked with the exempted rule.
    """
    uses = context.enter(None)
    if not is_of_exempted(rule):
        _check_condition(rule.condition, context)
    if rule.made_from is None:
        check_exemptions(rule, context)
    use_actions(rule, context)
    for contract in rule.contracts:
        if isinstance(contract, ast.ClearWhen):
            _check_condition(contract.condition, context)
            warn_of_never_cleared(rule, contract, context)
        elif isinstance(contract, ast.ClearFor):
            infer(contract.duration, context)
            duration_ns(contract.duration, "the time after `clear for`", context)
    return MissingTimeout.Rule().at(rule.head), uses


def _check_actions(targets: TargetResolver, context: Context) -> _Actions:
    """The effects of all actions, and their combined results."""
    targets.gather()
    checker = EffectChecker(targets)
    effects: dict[str, tuple[CheckedEffect, ...]] = {}
    for item in context.declarations.items:
        if isinstance(item, ast.Action):
            effects.setdefault(item.name.text, checker.check(item))
    order: tuple[int, ...] = ()
    priorities: tuple[tuple[int, int], ...] = ()
    unless = giving_way(context)
    if check_escalations(effects, context) and check_size(effects, context):
        check_latches(effects, context)
        order, priorities = order_of_rules(context)
        check_last_resorts(effects, order, unless, checker.commands, context)
    resting = MissingTimeout.Confirmation()
    confirmations = tuple((resting.at(span), uses) for span, uses in checker.confirmations)
    return _Actions(effects, checker.commands, confirmations, order, unless, priorities)


def _check_circles(conditions: dict[ConditionKey, ItemUses], context: Context) -> None:
    _, circles = in_order({key: tuple(uses.conditions) for key, uses in conditions.items()})
    for circle in circles:
        names = [".".join(key) for key in circle]
        finding = CircularCondition(identifier=names[0], cycle=circle_of(names))
        steps = zip(circle, (*circle[1:], circle[0]), strict=True)
        first, *others = [conditions[key].conditions[needed] for key, needed in steps]
        labels = [finding.Next().at(span) for span in others[:LONGEST_CIRCLE]]
        context.collector.add(finding.at(first, *labels))


def _program(
    found: _Actions,
    hazards: Mapping[str, ast.Hazard],
    gaps: Mapping[str, Gaps],
    tests: tuple[Script, ...],
    context: Context,
) -> CheckedProgram:
    declarations = context.declarations
    constants: dict[str, Value] = {}
    actions: dict[str, ast.Action] = {}
    for name, item in declarations.names.items():
        if isinstance(item, ast.Constant):
            constants[name] = context.values[item.value]
        elif isinstance(item, ast.Action):
            actions[name] = item
    conditions = {
        (entity, name): condition
        for entity, members in declarations.conditions.items()
        for name, condition in members.items()
    }
    return CheckedProgram(
        name=Path(declarations.main.file.path).stem,
        symbols=Symbols(constants, context.inputs, conditions, actions),
        rules=declarations.rules,
        types=context.types,
        values=context.values,
        effects=found.effects,
        commands=found.commands,
        order=found.order,
        unless=found.unless,
        hazards=hazards,
        gaps=gaps,
        skills=context.skills,
        doing=context.doing,
        regions=context.regions,
        motions=context.motions,
        frames=context.frames,
        frame_inputs=context.frame_inputs,
        tests=tests,
        priorities=found.priorities,
    )
