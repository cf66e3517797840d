"""Converts a CheckedProgram to a Machine.

The input is a program without errors. The machine contains only the parts that its rules need.
Equal expressions are computed once, and constant expressions not at all. Every number is in SI.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.check.model import CheckedFeedback, CheckedProgram
from rossmarie.check.rules.rule_names import rule_names
from rossmarie.check.scopes.exemptions import exempted_by
from rossmarie.ir.calls import query_at
from rossmarie.lowering.calls import calls_of
from rossmarie.lowering.contracts import Contract, contract_of
from rossmarie.lowering.inputs import InputLowering
from rossmarie.lowering.margins import Margins
from rossmarie.lowering.nodes import Nodes
from rossmarie.lowering.prohibitions import with_prohibitions
from rossmarie.lowering.propositions import Propositions
from rossmarie.lowering.reactions import PlanLowering
from rossmarie.units import DIMENSIONLESS


@dataclass(frozen=True)
class Lowered:
    """A machine, and the builders that created it, so that more parts can be added."""

    machine: ir.Machine
    contracts: Sequence[Contract]
    inputs: InputLowering
    nodes: Nodes
    propositions: Propositions


def lower(program: CheckedProgram) -> ir.Machine:
    """The machine of a checked program."""
    return lowered(program).machine


def lowered(program: CheckedProgram) -> Lowered:
    """The machine of a checked program, with its builders."""
    inputs, nodes = InputLowering(program.gaps), Nodes()
    propositions = Propositions(program, inputs, nodes)
    contracts = [contract_of(rule, propositions, nodes, program) for rule in program.rules]
    plans = PlanLowering(program, propositions)
    reactions = plans.lower()
    # Margins come after everything that monitors need, so that `ir.without_margins` can cut them
    # off.
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
        propositions=tuple(nodes.propositions),
        rules=(),
        watches=tuple(plans.watches),
        readings=tuple(plans.readings),
        reactions=reactions,
        hazards=tuple(
            ir.Hazard(name, item.text.value, item.documentation, item.name.span)
            for name, item in program.hazards.items()
        ),
        left_out=program.left_out,
        calls=_calls(program, inputs),
    )
    machine = _with_rules(machine, program, contracts, feedback)
    machine = with_prohibitions(machine, program.skills)
    return Lowered(machine, contracts, inputs, nodes, propositions)


def _calls(program: CheckedProgram, inputs: InputLowering) -> tuple[ir.SkillCall, ...]:
    asked = (query_at(slot.path) for slot in inputs.slots)
    steps = dict.fromkeys(step for step in asked if step is not None)
    return () if program.skills is None else calls_of(program.skills, tuple(steps))


def _feedback(checked: CheckedFeedback, contract: Contract, margins: Margins) -> ir.Feedback:
    unit = checked.margin
    margin = None
    if unit is not None:
        symbol = "" if unit == DIMENSIONLESS else unit.symbol
        margin = ir.Margin(margins.of(contract.written), symbol, 1.0 / unit.scale)
    return ir.Feedback(checked.per_activation, checked.per_second, margin)


def _with_rules(
    machine: ir.Machine,
    program: CheckedProgram,
    contracts: list[Contract],
    feedback: list[ir.Feedback],
) -> ir.Machine:
    rests_on = ir.supports(machine).propositions
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
            always=rule.always is not None,
            exempts=_exemption(number, names, program),
        )
        for number, (name, rule, contract, taught, categories) in enumerate(
            zip(names, program.rules, contracts, feedback, program.categories, strict=True)
        )
    )
    return dataclasses.replace(machine, rules=rules)


def _exemption(number: int, names: list[str], program: CheckedProgram) -> ir.Exemption | None:
    """The exemption that a rule stands for."""
    exempted = exempted_by(program.rules, number)
    made_from = program.rules[number].made_from
    if exempted is None or made_from is None:
        return None
    asked = program.doing[made_from.doing]
    return ir.Exemption(names[exempted], asked.text, asked.permits)
