"""CheckedProgram -> Machine.

Takes a program without errors. The machine holds what its rules rest on and nothing else; equal
expressions are computed once, constant ones not at all, and every number is in SI.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.check.model import CheckedFeedback, CheckedProgram
from rossmarie.check.rules.plans import latch_of
from rossmarie.check.rules.rule_names import rule_names
from rossmarie.lowering.durations import duration_ns
from rossmarie.lowering.inputs import Inputs
from rossmarie.lowering.margins import Margins
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.lowering.reactions import Plans
from rossmarie.lowering.truths import Truths
from rossmarie.lowering.wording import words
from rossmarie.syntax import ast
from rossmarie.units import DIMENSIONLESS


def lower(program: CheckedProgram) -> ir.Machine:
    """The machine of a checked program."""
    inputs, nodes = Inputs(program.gaps), Nodes()
    truths = Truths(program, inputs, nodes)
    contracts = [_contract(rule, truths, nodes, program) for rule in program.rules]
    plans = Plans(program, truths)
    reactions = plans.lower()
    # Behind all that monitors need, so that these can do without (`ir.without_margins`).
    margins = Margins(nodes)
    feedback = [
        _feedback(each, contract, margins)
        for each, contract in zip(program.feedback, contracts, strict=True)
    ]
    machine = ir.Machine(
        name=program.name,
        channels=tuple(inputs.channels),
        inputs=tuple(inputs.inputs),
        slots=tuple(inputs.slots),
        arrays=tuple(inputs.arrays),
        lists=tuple(inputs.lists),
        texts=tuple(inputs.texts),
        signals=tuple(nodes.signals),
        truths=tuple(nodes.truths),
        rules=(),
        watches=tuple(plans.watches),
        readings=tuple(plans.readings),
        reactions=reactions,
        hazards=tuple(
            ir.Hazard(name, item.text.value, item.documentation, item.name.span)
            for name, item in program.hazards.items()
        ),
        left_out=program.left_out,
    )
    return _with_rules(machine, program, contracts, feedback)


@dataclass(frozen=True)
class _Contract:
    """When a rule becomes active, and what clears it; `release` is None if only a reset does."""

    condition: int
    release: int | None
    text: str


def _contract(rule: ast.Rule, truths: Truths, nodes: Nodes, program: CheckedProgram) -> _Contract:
    condition = truths.lower(rule.condition)
    stated = _stated(rule.condition)
    if latch_of(rule, program.effects, program.symbols.actions) is not None:
        return _Contract(condition, None, f"clears on reset while {stated} is false")
    contract = rule.contracts[0] if len(rule.contracts) == 1 else None
    match contract:
        case ast.ClearWhen(condition=release):
            text = f"clears when {stated} is false and {_stated(release)} is true"
            return _Contract(condition, truths.lower(release), text)
        case ast.ClearFor(duration=duration, span=span):
            opposite = Shown(f"not {stated}", rule.condition.span)
            over = nodes.negation(condition, opposite)
            calm = Shown(f"{opposite.text} for {words(duration.span)}", span)
            release_index = nodes.held(over, duration_ns(program.values[duration]), calm)
            text = f"clears when {stated} has been false for {words(duration.span)}"
            return _Contract(condition, release_index, text)
        case ast.LatchedUntilReset():
            return _Contract(condition, None, f"clears on reset while {stated} is false")
        case None:
            always = nodes.literal(True, Shown("true", rule.span))
            return _Contract(condition, always, f"clears when {stated} is false")


def _feedback(checked: CheckedFeedback, contract: _Contract, margins: Margins) -> ir.Feedback:
    unit = checked.margin
    margin = None
    if unit is not None:
        symbol = "" if unit == DIMENSIONLESS else unit.symbol
        margin = ir.Margin(margins.of(contract.condition), symbol, 1.0 / unit.scale)
    return ir.Feedback(checked.per_activation, checked.per_second, margin)


def _stated(condition: ast.Expression) -> str:
    """The words of a condition, in parentheses where a sentence around them would be misread."""
    text = words(condition.span)
    is_one_word = isinstance(
        condition,
        ast.Reference | ast.Member | ast.Call | ast.ListFold | ast.Oscillates | ast.Parenthesized,
    )
    return text if is_one_word else f"({text})"


def _with_rules(
    machine: ir.Machine,
    program: CheckedProgram,
    contracts: list[_Contract],
    feedback: list[ir.Feedback],
) -> ir.Machine:
    rests_on = ir.supports(machine).truths
    hazards = {name: index for index, name in enumerate(program.hazards)}
    names = rule_names(program.rules)
    rules = tuple(
        ir.Rule(
            name=name,
            condition=contract.condition,
            release=contract.release,
            actions=tuple(dict.fromkeys(action.text for action in rule.actions)),
            contract=contract.text,
            documentation=rule.documentation,
            terms=ir.rule_terms(machine, contract.condition),
            signals=ir.rule_signals(machine, contract.condition),
            inputs=tuple(sorted(rests_on[contract.condition].inputs)),
            span=rule.span,
            head=rule.head,
            hazards=tuple(dict.fromkeys(hazards[hazard.text] for hazard in rule.mitigates)),
            feedback=taught,
            categories=categories,
        )
        for name, rule, contract, taught, categories in zip(
            names, program.rules, contracts, feedback, program.categories, strict=True
        )
    )
    return dataclasses.replace(machine, rules=rules)
