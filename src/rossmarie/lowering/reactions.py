"""Derives the reactions from the actions of rules: plans of tasks, and the data that tasks refer
to.

An action without a body contributes no task. Each place of an escalation has its own tasks.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field

from rossmarie import ir
from rossmarie.check.effects import (
    Awaited,
    CheckedCall,
    CheckedCancel,
    CheckedEffect,
    CheckedGoal,
    CheckedLimit,
    CheckedParameter,
    CheckedPublish,
    CheckedRetrace,
    CheckedScale,
    CheckedSwitch,
)
from rossmarie.check.model import CheckedProgram
from rossmarie.check.rules.plans import reached_actions
from rossmarie.ir import reactions
from rossmarie.lowering.propositions import Propositions
from rossmarie.syntax import ast


@dataclass
class _Draft:
    """A task whose escalations are not known yet."""

    action: str
    checked: CheckedEffect
    otherwise: tuple[int, ...] = ()


@dataclass(frozen=True)
class _Escalation:
    """The task that may fail, the following action, and the escalations of this action."""

    task: int
    action: str
    last_resort: str | None


@dataclass
class PlanLowering:
    """Lowers the plans of all rules. `watches` are the propositions that confirmations use,
    `readings` the signals that memories of poses use.
    """

    program: CheckedProgram
    propositions: Propositions
    watches: list[int] = field(default_factory=list)
    readings: list[int] = field(default_factory=list)
    _memories: dict[reactions.Memory, int] = field(default_factory=dict)
    _drafts: list[_Draft] = field(default_factory=list)

    def lower(self) -> ir.Reactions:
        """The reactions of the rules. Propositions for confirmations are added to the machine."""
        plans = tuple(
            self._plan(rule, unless)
            for rule, unless in zip(self.program.rules, self.program.unless, strict=True)
        )
        if not self._drafts:
            return ir.NO_REACTIONS
        topics = {draft.checked.command for draft in self._drafts}
        commands = [found for topic, found in self.program.commands.items() if topic in topics]
        resources = dict.fromkeys(
            draft.checked.resource for draft in self._drafts if draft.checked.resource is not None
        )
        actions = self._actions()
        indexes = {topic.topic: index for index, topic in enumerate(commands)}
        names = {action.name: index for index, action in enumerate(actions)}
        tasks = tuple(
            reactions.Task(
                action=names[draft.action],
                effect=self._effect(draft.checked, indexes),
                resource=None
                if draft.checked.resource is None
                else list(resources).index(draft.checked.resource),
                otherwise=draft.otherwise,
                span=draft.checked.span,
            )
            for draft in self._drafts
        )
        return ir.Reactions(
            tuple(commands),
            actions,
            tuple(resources),
            tasks,
            plans,
            self.program.order,
            self.program.priorities,
            tuple(self._memories),
        )

    def _actions(self) -> tuple[reactions.Action, ...]:
        """The actions that rules use, as declared."""
        used = {
            name
            for rule in self.program.rules
            for name in reached_actions(rule, self.program.effects)
        }
        return tuple(
            reactions.Action(name, action.documentation, action.name.span)
            for name, action in self.program.symbols.actions.items()
            if name in used
        )

    # --- plans -------------------------------------------------------------------------------

    def _plan(self, rule: ast.Rule, unless: tuple[int, ...]) -> reactions.RecoveryPlan:
        first = len(self._drafts)
        stages: list[tuple[int, ...]] = []
        escalations: deque[_Escalation] = deque()
        for step in rule.steps:
            last_resort = None if step.otherwise is None else step.otherwise.text
            tasks = self._begin(step.action.text, last_resort, escalations)
            if step.is_beside and stages:
                stages[-1] += tasks
            else:
                stages.append(tasks)
        while escalations:
            one = escalations.popleft()
            following = self._begin(one.action, one.last_resort, escalations)
            self._drafts[one.task].otherwise = following
        planned = tuple(range(first, len(self._drafts)))
        return reactions.RecoveryPlan(tuple(stage for stage in stages if stage), planned, unless)

    def _begin(
        self, action: str, last_resort: str | None, escalations: deque[_Escalation]
    ) -> tuple[int, ...]:
        """The tasks of an action. Its escalations are added to `escalations`."""
        first = len(self._drafts)
        for checked in self.program.effects.get(action, ()):
            index = len(self._drafts)
            self._drafts.append(_Draft(action, checked))
            if checked.otherwise is not None:
                escalations.append(_Escalation(index, checked.otherwise, last_resort))
            elif last_resort is not None and checked.may_fail:
                escalations.append(_Escalation(index, last_resort, None))
        return tuple(range(first, len(self._drafts)))

    # --- effects -----------------------------------------------------------------------------

    def _effect(self, checked: CheckedEffect, commands: Mapping[str, int]) -> reactions.Effect:
        """The effect. `commands` are the indices of command topics."""
        match checked.effect:
            case CheckedLimit(topic=topic, bounds=bounds):
                return reactions.Limit(commands[topic], bounds)
            case CheckedScale(topic=topic, factor=factor, ramp=ramp):
                return reactions.Scale(commands[topic], factor, ramp)
            case CheckedPublish(topic=topic) as sent:
                command = commands.get(topic)
                return reactions.Publish(
                    topic, sent.message_type, sent.assignments, sent.period_ns, command
                )
            case CheckedRetrace() as sent:
                return self._retrace(sent)
            case ast.Log(level=level, text=text):
                return reactions.Log(reactions.Level(level.text), text.value)
            case ast.Diagnose(level=level, text=text):
                return reactions.Diagnose(reactions.Level(level.text), text.value)
            case ast.Hook(name=name):
                return reactions.Hook(name.text)
            case ast.Reset():
                return reactions.Reset()
            case (
                CheckedCall() | CheckedParameter() | CheckedSwitch() | CheckedGoal()
                | CheckedCancel()
            ) as awaited:  # fmt: skip
                return self._awaited(awaited)

    def _retrace(self, sent: CheckedRetrace) -> reactions.Retrace:
        """The effect that retraces a memory. Poses with the same memory settings share a memory. A
        monitor keeps the values that it watches.
        """
        signals, known = self.propositions.pose(sent.pose)
        if known not in self.watches:
            self.watches.append(known)
        self.readings += [signal for signal in signals if signal not in self.readings]
        readings = tuple(map(self.readings.index, signals))
        memory = reactions.Memory(readings, sent.most, sent.apart, sent.apart_ns)
        number = self._memories.setdefault(memory, len(self._memories))
        message = sent.topic, sent.message_type, sent.assignments, sent.numbers
        return reactions.Retrace(*message, sent.period_ns, number)

    def _awaited(self, effect: Awaited) -> reactions.Effect:
        match effect:
            case CheckedCall(service, service_type, assignments, timeout_ns):
                return reactions.Call(service, service_type, assignments, timeout_ns)
            case CheckedParameter(node, parameter, value, timeout_ns):
                return reactions.SetParameter(node, parameter, value, timeout_ns)
            case CheckedSwitch(manager, start, stop, timeout_ns):
                return reactions.SwitchControllers(manager, start, stop, timeout_ns)
            case CheckedGoal(server, action_type, assignments, timeout_ns, interrupted):
                return reactions.SendGoal(server, action_type, assignments, timeout_ns, interrupted)
            case CheckedCancel(server, kind, confirmation, timeout_ns, interrupted):
                watch = None if confirmation is None else self._watch(confirmation)
                return reactions.CancelGoal(server, kind, watch, timeout_ns, interrupted)

    def _watch(self, confirmation: ast.Expression) -> int:
        """The index of a confirmation's proposition among the watched propositions."""
        proposition = self.propositions.lower(confirmation)
        if proposition not in self.watches:
            self.watches.append(proposition)
        return self.watches.index(proposition)
