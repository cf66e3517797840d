"""The contracts of rules: the condition for activation, and the condition for clearing."""

from __future__ import annotations

from dataclasses import dataclass

from rossmarie.check.model import CheckedProgram
from rossmarie.check.rules.plans import latch_of
from rossmarie.lowering.durations import duration_ns
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.lowering.propositions import Propositions
from rossmarie.lowering.wording import words
from rossmarie.syntax import ast


@dataclass(frozen=True)
class Contract:
    """The conditions for activation and clearing of a rule. `release` is None if only a reset
    clears the rule. `written` is the condition in the rules file, without skills of scopes and
    exemptions.
    """

    condition: int
    release: int | None
    text: str
    written: int


@dataclass(frozen=True)
class _Condition:
    """The condition of a rule, also in words. `ends` contains, in words, the other conditions that
    make the condition false.
    """

    proposition: int
    stated: str
    written: int
    ends: str = ""


def contract_of(
    rule: ast.Rule, propositions: Propositions, nodes: Nodes, program: CheckedProgram
) -> Contract:
    """The contract of a rule, with its propositions."""
    found = _condition_of(rule, propositions, nodes)
    condition, stated, written = found.proposition, found.stated, found.written
    on_reset = f"clears on reset while {stated} is false{found.ends}"
    if latch_of(rule, program.effects, program.symbols.actions) is not None:
        return Contract(condition, None, on_reset, written)
    contract = rule.contracts[0] if len(rule.contracts) == 1 else None
    match contract:
        case ast.ClearWhen(condition=release):
            text = f"clears when {stated} is false and {_stated(release)} is true"
            return Contract(condition, propositions.lower(release), text, written)
        case ast.ClearFor(duration=duration, span=span):
            opposite = Shown(f"not {stated}", rule.condition.span)
            over = nodes.negation(condition, opposite)
            calm = Shown(f"{opposite.text} for {words(duration.span)}", span)
            release_index = nodes.held(over, duration_ns(program.values[duration]), calm)
            text = f"clears when {stated} has been false for {words(duration.span)}"
            return Contract(condition, release_index, text, written)
        case ast.LatchedUntilReset():
            return Contract(condition, None, on_reset, written)
        case None:
            always = nodes.literal(True, Shown("true", rule.span))
            text = f"clears when {stated} is false{found.ends}"
            return Contract(condition, always, text, written)


def _condition_of(rule: ast.Rule, propositions: Propositions, nodes: Nodes) -> _Condition:
    """S60: the written condition while a skill of the scope runs and no exempted skill runs. For a
    rule that stands for an exemption: while the skill of the exemption runs.
    """
    written = propositions.lower(rule.condition)
    skills = propositions.skills
    text = words(rule.condition.span)
    parts = [written]
    if rule.scope:
        scope = " or ".join(map(skills.text, rule.scope))
        asked = tuple(map(skills.asked, rule.scope))
        parts.append(nodes.disjunction(asked, Shown(scope, rule.scope[0].span)))
        text += f" while {', '.join(map(skills.text, rule.scope))}"
    for exemption in rule.exemptions:
        exempted = skills.text(exemption.doing)
        asked_for = skills.asked(exemption.doing)
        parts.append(nodes.negation(asked_for, Shown(f"not {exempted}", exemption.doing.span)))
        text += f" unless {exempted}"
    if rule.made_from is None:
        if len(parts) == 1:
            return _Condition(written, _stated(rule.condition), written)
        whole = nodes.conjunction(tuple(parts), Shown(text, rule.condition.span))
        return _Condition(whole, f"({text})", written)
    doing = rule.made_from.doing
    parts.append(skills.kept(doing))
    shown = Shown(f"{text} and {skills.text(doing)}", rule.condition.span)
    ends = f" or {skills.text(doing)} ends"
    stated = f"({text})" if rule.scope else _stated(rule.condition)
    return _Condition(nodes.conjunction(tuple(parts), shown), stated, written, ends)


def _stated(condition: ast.Expression) -> str:
    """The words of a condition, in parentheses if the surrounding sentence would be ambiguous."""
    text = words(condition.span)
    is_one_word = isinstance(
        condition,
        ast.Reference | ast.Member | ast.Call | ast.ListFold | ast.Oscillates | ast.Parenthesized,
    )
    return text if is_one_word else f"({text})"
