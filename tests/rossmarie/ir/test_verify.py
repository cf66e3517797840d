"""Machines that `verify` accepts, and its message for each defect."""

import dataclasses
import math
from typing import Any

import pytest
from hypothesis import given, settings

from rossmarie import ir
from support.depth import examples
from support.drafts import SECOND, Draft
from support.machines import machines


@settings(max_examples=examples(4))
@given(machines())
def test_machines_that_grow_by_the_rules_pass(machine: ir.Machine) -> None:
    ir.verify(machine)


def refused(draft: Draft) -> str:
    with pytest.raises(ir.MalformedMachine) as refusal:
        ir.verify(draft.machine())
    return str(refusal.value)


def signal_after(*nodes: ir.SignalNode) -> str:
    """The message about the last of some signals, on a machine with a number and an array."""
    draft = Draft()
    draft.read()
    draft.elements()
    for node in nodes:
        draft.signal(node)
    return refused(draft)


@pytest.mark.parametrize(
    ("node", "said"),
    [
        (ir.Constant(math.inf), "signal 2 (Constant): inf is not finite"),
        (ir.Constant(math.nan), "signal 2 (Constant): nan is not finite"),
        (ir.Read(1), "signal 2 (Read): there is no slot 1"),
        (ir.Read(-1), "signal 2 (Read): there is no slot -1"),
        (ir.Element(1), "signal 2 (Element): there is no array 1"),
        (
            ir.Sampled(ir.Sampling.RATE, 2),
            "signal 2 (Sampled): operand 2 does not stand before its user",
        ),
        (
            ir.Sampled(ir.Sampling.PREVIOUS, -1),
            "signal 2 (Sampled): operand -1 does not stand before its user",
        ),
        (ir.Count(0), "signal 2 (Count): there is no proposition 0"),
        (ir.Apply(ir.Function.ADD, (0,)), "signal 2 (Apply): add of 1 operands"),
        (ir.Apply(ir.Function.NORM, ()), "signal 2 (Apply): norm of 0 operands"),
        (ir.Apply(ir.Function.ROLL, (0, 0, 0)), "signal 2 (Apply): roll of 3 operands"),
        (ir.Sampled(ir.Sampling.RATE, 1), "signal 2 (Sampled): operand 1 is elementwise"),
        (ir.Fold(ir.Folding.MINIMUM, 0), "signal 2 (Fold): folds no elements"),
    ],
)
def test_signals(node: ir.SignalNode, said: str) -> None:
    assert signal_after(node) == said


def test_beside_elements_stand_numbers_of_slots_and_constants() -> None:
    sampled, summed = ir.Sampled(ir.Sampling.RATE, 0), ir.Apply(ir.Function.ADD, (2, 1))
    said = "signal 3 (Apply): operand 2 is neither elementwise nor of slots and constants"
    assert signal_after(sampled, summed) == said
    folded = ir.Fold(ir.Folding.MINIMUM, 1)
    assert signal_after(folded, summed) == said
    nested = ir.Apply(ir.Function.ABSOLUTE, (2,)), ir.Apply(ir.Function.ADD, (1, 3))
    assert signal_after(sampled, *nested) == (
        "signal 4 (Apply): operand 3 is neither elementwise nor of slots and constants"
    )


@pytest.mark.parametrize(
    ("node", "said"),
    [
        (ir.Not(1), "proposition 1 (Not): operand 1 does not stand before its user"),
        (ir.Flag(2), "proposition 1 (Flag): there is no signal 2"),
        (ir.And((0,)), "proposition 1 (And): 1 operands"),
        (ir.Or(()), "proposition 1 (Or): 0 operands"),
        (ir.Held(0, 0), "proposition 1 (Held): a duration of 0 ns"),
        (ir.Held(0, 2**61), f"proposition 1 (Held): a duration of {2**61} ns"),
        (ir.AgeReaches(2, 1), "proposition 1 (AgeReaches): there is no input 2"),
        (ir.AgeReaches(0, 0), "proposition 1 (AgeReaches): a duration of 0 ns"),
        (ir.Recurs(1, 1, 1), "proposition 1 (Recurs): operand 1 does not stand before its user"),
        (ir.Recurs(0, 0, 1), "proposition 1 (Recurs): 0 edges"),
        (ir.Recurs(0, 1, 0), "proposition 1 (Recurs): a duration of 0 ns"),
        (ir.Oscillates(0, 0, 1, 0.0), "proposition 1 (Oscillates): 0 turning points"),
        (ir.Oscillates(0, 1, -1, 0.0), "proposition 1 (Oscillates): a duration of -1 ns"),
        (ir.Oscillates(0, 1, 1, -1.0), "proposition 1 (Oscillates): a swing of -1.0"),
        (ir.Oscillates(0, 1, 1, math.inf), "proposition 1 (Oscillates): inf is not finite"),
        (ir.Oscillates(1, 1, 1, 0.0), "proposition 1 (Oscillates): operand 1 is elementwise"),
        (ir.Quantified(ir.Quantifier.ANY, 0), "proposition 1 (Quantified): quantifies no elements"),
        (ir.Flag(0), "proposition 1 (Flag): tests a real"),
    ],
)
def test_propositions(node: ir.PropositionNode, said: str) -> None:
    draft = Draft()
    x = draft.read()
    draft.elements()
    draft.proposition(ir.Compare(ir.Comparison.LESS, x, x))
    draft.proposition(node)
    assert refused(draft) == said


def test_elementwise_propositions_stay_below_folds() -> None:
    draft = Draft()
    element = draft.elements()
    on_elements = draft.above(element, 0.0)
    draft.proposition(ir.Held(on_elements, 1))
    assert refused(draft) == "proposition 1 (Held): operand 0 is elementwise"
    draft.propositions[-1] = dataclasses.replace(draft.propositions[-1], node=ir.Literal(True))
    draft.proposition(ir.And((on_elements, 1)))
    ir.verify(draft.machine())
    draft.proposition(ir.AgeReaches(0, 1))
    draft.proposition(ir.And((on_elements, 3)))
    assert refused(draft) == "proposition 4 (And): operand 3 is not elementwise"


def test_elements_of_two_arrays_do_not_meet() -> None:
    draft = Draft()
    draft.apply(ir.Function.ADD, draft.elements(), draft.elements())
    assert refused(draft) == "elementwise: elements of 2 arrays meet"


def test_what_is_counted_stands_before_the_count() -> None:
    draft = Draft()
    element = draft.elements()
    counted = draft.above(element, 0.0)
    draft.signal(ir.Count(counted))
    ir.verify(draft.machine())
    draft.signals[1], draft.signals[2] = draft.signals[2], draft.signals[1]
    draft.propositions[0] = dataclasses.replace(
        draft.propositions[0], node=ir.Compare(ir.Comparison.GREATER, element, 2)
    )
    assert refused(draft) == "signal 1 (Count): operand 2 does not stand before its user"


def test_texts_are_compared_with_literals_only() -> None:
    draft = Draft(texts=("docked",))
    one, other = (draft.read(kind=ir.FieldKind.TEXT) for _ in range(2))
    literal = draft.constant(0.0)
    draft.proposition(ir.Compare(ir.Comparison.EQUAL, one, literal))
    ir.verify(draft.machine())
    for comparison, right in ((ir.Comparison.LESS, literal), (ir.Comparison.EQUAL, other)):
        draft.proposition(ir.Compare(comparison, one, right))
        assert refused(draft) == "proposition 1 (Compare): operand 0 is a text"
        draft.propositions.pop()


def test_flags_are_no_numbers() -> None:
    draft = Draft()
    draft.signal(ir.Sampled(ir.Sampling.RATE, draft.read(kind=ir.FieldKind.FLAG)))
    assert refused(draft) == "signal 1 (Sampled): operand 0 is a flag"


def test_inputs() -> None:
    draft = Draft()
    draft.input(0)
    assert refused(draft) == "input 0: there is no channel 0"
    draft.channel()
    draft.slot(1)
    assert refused(draft) == "slot 0: there is no input 1"
    draft.slots[0] = dataclasses.replace(draft.slots[0], input=0, kind=ir.FieldKind.TEXT, scale=2.0)
    assert refused(draft) == "slot 0: a scaled text"
    draft.slots[0] = dataclasses.replace(draft.slots[0], scale=math.nan)
    assert refused(draft) == "slot 0: nan is not finite"
    draft.slots.clear()
    draft.input(0, timeout_ns=0)
    assert refused(draft) == "input 1: a duration of 0 ns"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"condition": 9}, "there is no proposition 9"),
        ({"release": -1}, "there is no proposition -1"),
        ({"condition": 0}, "proposition 0 is elementwise"),
        ({"terms": ()}, "wrong terms"),
        ({"signals": (0,)}, "wrong signals"),
        ({"inputs": ()}, "wrong inputs"),
    ],
)
def test_rules(change: dict[str, Any], said: str) -> None:
    draft = Draft()
    some = draft.proposition(ir.Quantified(ir.Quantifier.ANY, draft.above(draft.elements(), 0.0)))
    draft.rule(draft.proposition(ir.Held(some, SECOND)))
    ir.verify(draft.machine())
    draft.rules[0] = dataclasses.replace(draft.rules[0], **change)
    assert refused(draft) == f"rule 0 (rule_1): {said}"


def test_rule_names_are_unique() -> None:
    draft = Draft()
    for _ in range(2):
        draft.rule(draft.proposition(ir.Literal(True)))
    draft.rules[1] = dataclasses.replace(draft.rules[1], name="rule_1")
    assert refused(draft) == "rule rule_1: there are 2 of this name"
