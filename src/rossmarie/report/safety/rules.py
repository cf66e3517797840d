"""The meaning of each rule of a machine, in sentences.

The input is a machine that `ir.verify` has accepted. The sentences follow S35 to S38 and R1 to R8
of the documentation. Each states one fact, so that a reader can sign it or strike it out
separately.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dslkit.source import Span
from rossmarie import ir
from rossmarie.ir import reactions
from rossmarie.ir.duration_text import duration_text
from rossmarie.report.safety.conditions import ConditionWords
from rossmarie.report.safety.effects import Effects
from rossmarie.report.safety.phrase import Phrase, listed


@dataclass(frozen=True)
class RuleText:
    """One rule in sentences.

    `when` are the conditions for activation, `stale` the activation because of stale inputs,
    `unknown` the cases without effect. `steps` are the reactions, `order` the priorities, `ends`
    the release.
    """

    name: str
    documentation: str | None
    span: Span
    when: Phrase
    stale: tuple[str, ...]
    unknown: tuple[str, ...]
    steps: tuple[Phrase, ...]
    order: tuple[str, ...]
    ends: Phrase
    contract: str
    hazards: tuple[int, ...]
    categories: tuple[ir.Category, ...]

    def lines(self) -> Iterator[str]:
        """The sentences as lines of text."""
        yield f"{self.name}:"
        yield from Phrase("When", (self.when,)).lines()
        yield from (f"- {sentence}" for sentence in (*self.stale, *self.unknown))
        yield from Phrase("then", self.steps).lines()
        yield from (f"- {sentence}" for sentence in self.order)
        yield from self.ends.lines()


def rule_texts(machine: ir.Machine, conditions: ConditionWords) -> tuple[RuleText, ...]:
    """The sentences of each rule, in the order of the machine."""
    writer = _Writer(machine, conditions)
    return tuple(writer.rule(index) for index in range(len(machine.rules)))


class _Writer:
    """Writes about the rules of one machine."""

    def __init__(self, machine: ir.Machine, conditions: ConditionWords) -> None:
        self._machine = machine
        self._conditions = conditions
        self._effects = Effects(machine, conditions)
        self._supports = ir.supports(machine)

    def rule(self, index: int) -> RuleText:
        rule = self._machine.rules[index]
        return RuleText(
            name=rule.name,
            documentation=rule.documentation,
            span=rule.span,
            when=self._conditions.phrase(rule.condition),
            stale=tuple(self._stale(rule)),
            unknown=tuple(self._unknown(rule)),
            steps=tuple(self._steps(index)),
            order=tuple(self._order(index)),
            ends=self._ends(rule),
            contract=rule.contract,
            hazards=rule.hazards,
            categories=rule.categories,
        )

    # --- when --------------------------------------------------------------------------------

    def _stale(self, rule: ir.Rule) -> Iterator[str]:
        """S30, S35: the inputs that activate the rule if they are stale."""
        values, ages = self._looked_at(rule.condition)
        guarded = [each for each in values if self._timeout(each) is not None]
        if guarded:
            names = listed(tuple(map(self._with_timeout, guarded)), "or")
            yield (
                "The rule fails closed. It also becomes active if the condition is unknown because "
                f"of {names}: not received yet, silent for longer than the time in brackets, or "
                "without a usable number."
            )
        aged = [each for each in ages if self._timeout(each) is not None and each not in guarded]
        if aged:
            names = listed(tuple(self._machine.inputs[each].name for each in aged), "or")
            yield (
                "The rule fails closed. It also becomes active if the condition is unknown because "
                f"{names} has not been received yet."
            )

    def _unknown(self, rule: ir.Rule) -> Iterator[str]:
        """S37: the inputs that may be missing without any effect."""
        bare = [each for each in rule.inputs if self._timeout(each) is None]
        if bare:
            names = listed(tuple(self._machine.inputs[each].name for each in bare), "or")
            yield (
                f"While the condition is unknown because of {names} (no timeout), the rule keeps "
                "its state."
            )

    def _looked_at(self, condition: int) -> tuple[list[int], list[int]]:
        """The inputs whose values the condition uses, and the inputs whose ages it uses."""
        values: set[int] = set()
        ages: set[int] = set()
        for leaf in ir.leaf_propositions(self._machine, condition):
            node = self._machine.propositions[leaf].node
            found = ages if isinstance(node, ir.AgeReaches) else values
            found |= self._supports.propositions[leaf].inputs
        return sorted(values), sorted(ages)

    def _timeout(self, used: int) -> int | None:
        return self._machine.inputs[used].timeout_ns

    def _with_timeout(self, used: int) -> str:
        declared = self._machine.inputs[used]
        assert declared.timeout_ns is not None, "asked before"
        return f"{declared.name} ({duration_text(declared.timeout_ns)})"

    # --- then --------------------------------------------------------------------------------

    def _steps(self, index: int) -> Iterator[Phrase]:
        """R3 to R6: the stages in order, then the actions without a body."""
        plan = self._plan(index)
        stages = [stage for stage in plan.stages if stage]
        for number, stage in enumerate(stages, start=1):
            tasks = tuple(map(self._effects.phrase, stage))
            if len(stages) == 1:
                yield from tasks
            elif number == 1:
                yield Phrase("first:", tasks)
            else:
                yield Phrase("then, when all of these are done, in force or waiting:", tasks)
        tasks_of = self._machine.reactions.tasks
        actions = self._machine.reactions.actions
        bodies = {actions[tasks_of[task].action].name for task in plan.tasks}
        for name in self._machine.rules[index].actions:
            if name not in bodies:
                yield Phrase(f"{name} is only reported, because the action has no body")
        if not stages and not self._machine.rules[index].actions:
            yield Phrase("nothing is done; the activation is reported")

    def _plan(self, index: int) -> reactions.RecoveryPlan:
        plans = self._machine.reactions.plans
        return plans[index] if plans else reactions.RecoveryPlan((), ())

    def _order(self, index: int) -> Iterator[str]:
        """R1, R2, S60: the rules to which the rule gives way, and the exemption that it stands
        for.
        """
        rule = self._machine.rules[index]
        if rule.always:
            yield "The rule always applies: neither a skill nor an operator can exempt it."
        if rule.exempts is not None:
            name, doing = rule.exempts.rule, rule.exempts.doing
            yield f"The rule is part of an exemption: it applies instead of {name} while {doing}."
        unless = tuple(self._machine.rules[other].name for other in self._plan(index).unless)
        if unless:
            yield (
                f"While {listed(unless, 'or')} is active, none of these effects happen. The rule "
                "stays active, and its effects start again afterwards."
            )
        for resource, rules in claims(self._machine).items():
            if index in rules and len(rules) > 1:
                yield self._turn(resource, rules, rules.index(index))

    def _turn(self, resource: int, rules: tuple[int, ...], place: int) -> str:
        names = tuple(self._machine.rules[rule].name for rule in rules)
        turn = []
        if place:
            turn.append(f"after {listed(names[:place])}")
        if place + 1 < len(names):
            turn.append(f"before {listed(names[place + 1 :])}")
        what = self._machine.reactions.resources[resource]
        return f"The rule needs {what} exclusively, and gets it {listed(tuple(turn))}."

    # --- until -------------------------------------------------------------------------------

    def _ends(self, rule: ir.Rule) -> Phrase:
        """S36 to S38: the release of the rule."""
        over = self._conditions.phrase(rule.condition, is_so=False)
        if rule.release is None:
            return Phrase(
                "The rule is cleared only if an operator resets it while this is known to be true:",
                (over,),
            )
        release = self._machine.propositions[rule.release].node
        if isinstance(release, ir.Literal) and release.value:
            return Phrase("The rule is cleared as soon as this is known to be true:", (over,))
        calm_ns = self._calm_ns(rule.condition, release)
        if calm_ns is not None:
            head = (
                "The rule is cleared when this has been true throughout the last "
                f"{duration_text(calm_ns)}:"
            )
            return Phrase(head, (over,))
        both = (over, self._conditions.phrase(rule.release))
        return Phrase("The rule is cleared when both of these are known to be true:", both)

    def _calm_ns(self, condition: int, release: ir.PropositionNode) -> int | None:
        """The time in ns for which the condition has to be false, if the release is such a time;
        else None.
        """
        if not isinstance(release, ir.Held):
            return None
        node = self._machine.propositions[release.operand].node
        is_opposite = isinstance(node, ir.Not) and node.operand == condition
        return release.duration_ns if is_opposite else None


def claims(machine: ir.Machine) -> dict[int, tuple[int, ...]]:
    """The rules that need each resource, including escalations, in the order in which they get it
    (R2).
    """
    found = machine.reactions
    return {
        resource: tuple(
            rule
            for rule in found.order
            if any(found.tasks[task].resource == resource for task in found.plans[rule].tasks)
        )
        for resource in range(len(found.resources))
    }
