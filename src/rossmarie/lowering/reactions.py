"""The actions of rules -> what the rules do: plans of tasks, and what these refer to.

An action without a body contributes no task. Of escalations each place has tasks of its own.
"""

from __future__ import annotations

import dataclasses
from collections import deque
from dataclasses import dataclass, field

from rossmarie import ir
from rossmarie.check.model import CheckedEffect, CheckedProgram
from rossmarie.check.rules.plans import may_fail, reached_actions
from rossmarie.ir import reactions
from rossmarie.lowering.truths import Truths
from rossmarie.syntax import ast


@dataclass
class _Draft:
    """A task whose escalations are not known yet."""

    action: str
    checked: CheckedEffect
    otherwise: tuple[int, ...] = ()


@dataclass(frozen=True)
class _Escalation:
    """The task that may fail, the action that follows, and what follows if that fails."""

    task: int
    action: str
    last_resort: str | None


@dataclass
class Plans:
    """Lowers the plans of all rules; `watches` are the truths that confirmations ask."""

    program: CheckedProgram
    truths: Truths
    watches: list[int] = field(default_factory=list)
    _drafts: list[_Draft] = field(default_factory=list)

    def lower(self) -> ir.Reactions:
        """The reactions of the rules; truths are added to the machine for the confirmations."""
        plans = tuple(
            self._plan(rule, unless)
            for rule, unless in zip(self.program.rules, self.program.unless, strict=True)
        )
        if not self._drafts:
            return ir.NO_REACTIONS
        topics = {draft.checked.command for draft in self._drafts} - {None}
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

    def _plan(self, rule: ast.Rule, unless: tuple[int, ...]) -> reactions.Plan:
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
        return reactions.Plan(tuple(stage for stage in stages if stage), planned, unless)

    def _begin(
        self, action: str, last_resort: str | None, escalations: deque[_Escalation]
    ) -> tuple[int, ...]:
        """The tasks of an action; what follows if they fail is put to the `escalations`."""
        first = len(self._drafts)
        for checked in self.program.effects.get(action, ()):
            index = len(self._drafts)
            self._drafts.append(_Draft(action, checked))
            if checked.otherwise is not None:
                escalations.append(_Escalation(index, checked.otherwise, last_resort))
            elif last_resort is not None and may_fail(checked.effect):
                escalations.append(_Escalation(index, last_resort, None))
        return tuple(range(first, len(self._drafts)))

    # --- effects -----------------------------------------------------------------------------

    def _effect(self, checked: CheckedEffect, commands: dict[str, int]) -> reactions.Effect:
        """The effect with its indexes."""
        match checked.effect:
            case reactions.Limit() | reactions.Scale() as effect if checked.command is not None:
                return dataclasses.replace(effect, topic=commands[checked.command])
            case reactions.Publish(topic=topic) as effect:
                return dataclasses.replace(effect, command=commands.get(topic))
            case reactions.CancelGoal() as effect if checked.confirmation is not None:
                truth = self.truths.lower(checked.confirmation)
                if truth not in self.watches:
                    self.watches.append(truth)
                return dataclasses.replace(effect, confirmation=self.watches.index(truth))
            case (
                reactions.Limit() | reactions.Scale() | reactions.Call()
                | reactions.SetParameter() | reactions.SwitchControllers()
                | reactions.SendGoal() | reactions.CancelGoal() | reactions.Log()
                | reactions.Diagnose() | reactions.Hook() | reactions.Reset()
            ) as effect:  # fmt: skip
                return effect
