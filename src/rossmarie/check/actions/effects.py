"""The bodies of actions: each effect is checked separately.

The result is the effects of each action, with everything that lowering needs. Names of actions
after `else` are looked up here. `rules/plans.py` checks the chains of actions that `else` forms.
"""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic, Remark, listed
from dslkit.source import Span
from rossmarie.check.actions.assignments import assignments_of
from rossmarie.check.actions.commands import CommandChecker, command_of
from rossmarie.check.actions.errors import (
    ControllerConflict,
    DoesNothing,
    MissingTimeLimit,
    ReservedHook,
    UnguardedConfirmation,
    UnknownLevel,
    ValueMismatch,
)
from rossmarie.check.actions.numbers import period_ns, timeout_ns
from rossmarie.check.actions.reserved_hooks import CPLUSPLUS_WORDS
from rossmarie.check.actions.resources import declared_resources
from rossmarie.check.actions.retrace_errors import PosesInAll
from rossmarie.check.actions.retraces import checked_retrace
from rossmarie.check.actions.targets import TargetResolver, insertion
from rossmarie.check.actions.trees import checked_tree
from rossmarie.check.effects import (
    Awaited,
    CheckedCall,
    CheckedCancel,
    CheckedEffect,
    CheckedGoal,
    CheckedParameter,
    CheckedPublish,
    CheckedSwitch,
)
from rossmarie.check.expressions.decided import warn_of_decided
from rossmarie.check.expressions.infer import infer
from rossmarie.check.names.references import use_action
from rossmarie.check.operations.operands import require_condition, require_constant
from rossmarie.check.scopes.context import Context, ItemUses
from rossmarie.check.system.model import full_name
from rossmarie.check.units.errors import MisplacedUnit
from rossmarie.check.units.quantities import read_unit
from rossmarie.check.wording.describe import describe
from rossmarie.check.wording.suggestions import near_name, suggesting
from rossmarie.ir import reactions
from rossmarie.ir.limits import MOST_POSES_IN_ALL
from rossmarie.syntax import ast
from rossmarie.types import Boolean, InterfaceKind, Quantity, Text, Unknown
from rossmarie.units import DIMENSIONLESS


class EffectChecker:
    """Checks the bodies of all actions. `commands` are the topics that may pass through the safety
    filter; `confirmations` contains the place and the uses of each confirmation.
    """

    def __init__(self, targets: TargetResolver) -> None:
        self._targets = targets
        self._context: Context = targets.context
        self.commands: dict[str, reactions.CommandTopic] = {}
        self.confirmations: list[tuple[Span, ItemUses]] = []
        self._command_checker = CommandChecker(targets, self.commands)
        self._resources = declared_resources(targets)
        self._poses = 0
        self._published = {
            targets.full_name(InterfaceKind.MESSAGE, name)
            for system in self._context.declarations.systems
            for member in system.members
            if isinstance(member, ast.NodeDeclaration)
            for name in member.publishes
        }

    def check(self, action: ast.Action) -> tuple[CheckedEffect, ...]:
        """The effects of an action. Effects with errors are reported and left out."""
        uses = self._context.enter(None)
        found = [self._effect(effect, uses) for effect in action.effects]
        return tuple(effect for effect in found if effect is not None)

    def _effect(self, effect: ast.Effect, uses: ItemUses) -> CheckedEffect | None:
        match effect:
            case ast.Limit() | ast.Scale() | ast.Block():
                return self._command_checker.check(effect)
            case ast.Publish():
                return self._publish(effect)
            case ast.Retrace():
                return self._retrace(effect)
            case ast.Log() | ast.Diagnose():
                return self._words(effect)
            case ast.Hook(name=name):
                if name.text in CPLUSPLUS_WORDS:
                    self._add(ReservedHook(identifier=name.text).at(name.span))
                return CheckedEffect(effect, effect.span)
            case ast.Reset():
                return CheckedEffect(effect, effect.span)
            case (
                ast.CallService() | ast.SetParameter() | ast.SwitchControllers() | ast.SendGoal()
                | ast.CancelGoal() | ast.RunTree()
            ):  # fmt: skip
                return self._awaited(effect, uses)

    # --- messages ----------------------------------------------------------------------------

    def _publish(self, effect: ast.Publish) -> CheckedEffect | None:
        sent = self._targets.topic(effect.target)
        assignments = assignments_of(effect.assignments, sent, self._targets)
        period = None if effect.rate is None else period_ns(effect.rate, self._context)
        if sent is None or assignments is None or (effect.rate is not None and period is None):
            return None
        is_shared = sent.name in self._published
        if is_shared:
            command = command_of(sent, effect.target.name.span, self._targets)
            self.commands.setdefault(sent.name, command)
        found = CheckedPublish(sent.name, sent.type, assignments, period)
        filtered = sent.name if is_shared else None
        resource = self._resource(reactions.ExclusiveTarget("topic", sent.name))
        return CheckedEffect(found, effect.span, filtered, resource)

    def _retrace(self, effect: ast.Retrace) -> CheckedEffect | None:
        found = checked_retrace(effect, self._targets, self._published)
        if found is None:
            return None
        self._poses += found.most
        if self._poses > MOST_POSES_IN_ALL:
            finding = PosesInAll(most=MOST_POSES_IN_ALL, found=self._poses)
            self._add(finding.at(effect.most.span))
            return None
        resource = self._resource(reactions.ExclusiveTarget("topic", found.topic))
        return CheckedEffect(found, effect.span, None, resource)

    def _words(self, effect: ast.Log | ast.Diagnose) -> CheckedEffect | None:
        levels = [level.value for level in reactions.Level]
        if isinstance(effect, ast.Diagnose):
            levels.remove(reactions.Level.DEBUG.value)
        if not effect.text.value.strip():
            what = "diagnosis" if isinstance(effect, ast.Diagnose) else "log"
            finding = DoesNothing(what=what)
            self._add(finding.at(effect.text.span, help=finding.Words()))
        if effect.level.text not in levels:
            self._report_level(effect.level, tuple(levels))
            return None
        return CheckedEffect(effect, effect.span)

    def _report_level(self, name: ast.Name, known: tuple[str, ...]) -> None:
        near = {"warn": "warning", "information": "info", "err": "error"}.get(name.text.lower())
        near = near if near in known else near_name(name.text, known)
        finding = UnknownLevel(identifier=name.text, known=listed(known))
        if near is None:
            self._add(finding.at(name.span))
            return
        self._add(suggesting(finding, name, near))

    # --- effects whose end is awaited --------------------------------------------------------

    def _awaited(self, effect: ast.Awaited, uses: ItemUses) -> CheckedEffect | None:
        if effect.otherwise is not None:
            use_action(effect.otherwise, self._context)
        timeout = timeout_ns(effect.timeout, self._context)
        match effect:
            case ast.CallService():
                return self._call(effect, timeout)
            case ast.SetParameter():
                return self._set(effect, timeout)
            case ast.SwitchControllers():
                return self._switch(effect, timeout)
            case ast.SendGoal():
                return self._send(effect, timeout)
            case ast.CancelGoal():
                return self._cancel(effect, timeout, uses)
            case ast.RunTree():
                return self._run_tree(effect, timeout)

    def _call(self, effect: ast.CallService, timeout: int | None) -> CheckedEffect | None:
        sent = self._targets.sent(effect.target, InterfaceKind.SERVICE)
        assignments = assignments_of(effect.assignments, sent, self._targets)
        if sent is None or assignments is None or timeout is None:
            return None
        found = CheckedCall(sent.name, sent.type, assignments, timeout)
        return self._awaiting(found, reactions.ExclusiveTarget("service", sent.name), effect)

    def _set(self, effect: ast.SetParameter, timeout: int | None) -> CheckedEffect | None:
        value = self._parameter(effect)
        if value is None or timeout is None:
            return None
        node = full_name(effect.node.text)
        parameter = ".".join(name.text for name in effect.parameter)
        target = reactions.ExclusiveTarget("parameter", node, f".{parameter}")
        return self._awaiting(CheckedParameter(node, parameter, value, timeout), target, effect)

    def _parameter(self, effect: ast.SetParameter) -> reactions.Scalar | None:
        type_ = infer(effect.value, self._context)
        unit = None if effect.unit is None else read_unit(effect.unit, self._context.collector)
        if isinstance(type_, Unknown) or (unit is None and effect.unit is not None):
            return None
        if not require_constant(effect.value, "the value of a parameter", self._context):
            return None
        value = self._context.values[effect.value]
        if not isinstance(type_, Quantity):
            return self._plain_parameter(effect, type_)
        given = type_.unit or DIMENSIONLESS
        if given.dimension != (unit or DIMENSIONLESS).dimension:
            help: Remark
            if unit is None:
                reason = "a parameter is a plain number, and no declaration gives its unit"
                help = MisplacedUnit.OfParameter(unit=given.symbol)
                fix = insertion(effect.parameter[-1].span, f" in {given.symbol}")
            else:
                reason = f"the parameter is in {unit.symbol}, and this in {given.symbol}"
                help, fix = MisplacedUnit.Value(unit=unit.symbol), None
            finding = MisplacedUnit(reason=reason)
            self._add(finding.at(effect.value.span, help=help, fix=fix))
            return None
        return (unit or DIMENSIONLESS).from_si(value.numbers[0]) + 0.0

    def _plain_parameter(self, effect: ast.SetParameter, type_: object) -> reactions.Scalar | None:
        value = self._context.values[effect.value]
        is_plain = isinstance(type_, Boolean | Text)
        if is_plain and effect.unit is None:
            return value.boolean if value.boolean is not None else value.text
        name = ".".join(name.text for name in effect.parameter)
        expected = "a number, because it has a unit" if is_plain else "a number, boolean or string"
        found = describe(self._context.type_of(effect.value))
        finding = ValueMismatch(field=name, expected=expected, found=found)
        self._add(finding.at(effect.value.span))
        return None

    def _switch(self, effect: ast.SwitchControllers, timeout: int | None) -> CheckedEffect | None:
        if not effect.start and not effect.stop:
            empty = DoesNothing(what="switch")
            self._add(empty.at(effect.span, help=empty.Switch()))
        started = {name.text: name for name in effect.start}
        conflicts = [name for name in effect.stop if name.text in started]
        for name in conflicts:
            first, second = sorted((started[name.text], name), key=lambda one: one.span.start)
            finding = ControllerConflict(identifier=name.text)
            self._add(finding.at(second.span, finding.First().at(first.span)))
        if timeout is None or conflicts:
            return None
        start, stop = (
            tuple(dict.fromkeys(name.text for name in names))
            for names in (effect.start, effect.stop)
        )
        manager = full_name(effect.manager.text)
        target = reactions.ExclusiveTarget("controller manager", manager)
        return self._awaiting(CheckedSwitch(manager, start, stop, timeout), target, effect)

    # --- goals -------------------------------------------------------------------------------

    def _send(self, effect: ast.SendGoal, timeout: int | None) -> CheckedEffect | None:
        sent = self._targets.sent(effect.target, InterfaceKind.ACTION)
        assignments = assignments_of(effect.assignments, sent, self._targets)
        if effect.timeout is None:
            self._add(MissingTimeLimit(place="the action server").at(effect.target.span))
            return None
        if sent is None or assignments is None or timeout is None:
            return None
        interrupted = _interrupted(effect.interrupted)
        found = CheckedGoal(sent.name, sent.type, assignments, timeout, interrupted)
        return self._awaiting(found, reactions.ExclusiveTarget("action server", sent.name), effect)

    def _cancel(
        self, effect: ast.CancelGoal, timeout: int | None, uses: ItemUses
    ) -> CheckedEffect | None:
        if effect.confirmation is not None:
            infer(effect.confirmation, self._context)
            require_condition(effect.confirmation, self._context)
            warn_of_decided(effect.confirmation, self._context)
            self.confirmations.append((effect.confirmation.span, uses))
            if effect.otherwise is None:
                self._add(UnguardedConfirmation().at(effect.confirmation.span))
        if timeout is None:
            return None
        server = full_name(effect.server.text)
        stated = self._targets.stated.get((InterfaceKind.ACTION, server))
        kind = None if stated is None else stated.text.replace("/action/", "/")
        interrupted = _interrupted(effect.interrupted)
        found = CheckedCancel(server, kind, effect.confirmation, timeout, interrupted)
        return self._awaiting(found, reactions.ExclusiveTarget("action server", server), effect)

    # --- trees -------------------------------------------------------------------------------

    def _run_tree(self, effect: ast.RunTree, timeout: int | None) -> CheckedEffect | None:
        if effect.timeout is None:
            self._add(MissingTimeLimit(place="the tree").at(effect.skill.span))
            return None
        found = None if timeout is None else checked_tree(effect, timeout, self._context)
        if found is None:
            return None
        return self._awaiting(
            found, reactions.ExclusiveTarget("action server", found.server), effect
        )

    # --- resources ---------------------------------------------------------------------------

    def _awaiting(
        self, found: Awaited, target: reactions.ExclusiveTarget, effect: ast.Awaited
    ) -> CheckedEffect:
        otherwise = None if effect.otherwise is None else effect.otherwise.text
        return CheckedEffect(found, effect.span, None, self._resource(target), otherwise)

    def _resource(self, target: reactions.ExclusiveTarget) -> str:
        """The resource that an effect needs exclusively, with its name in the system model."""
        declared = self._resources.get(target.name)
        return str(target) if declared is None else f"resource {declared}"

    def _add(self, finding: Diagnostic) -> None:
        self._context.collector.add(finding)


def _interrupted(word: ast.Name | None) -> reactions.Interrupted:
    return reactions.Interrupted.DROP if word is None else reactions.Interrupted(word.text)
