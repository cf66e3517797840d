"""Conditions in words: read again, they have the values that the interpreter computes."""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.ir import TruthValue, kleene
from rossmarie.report.safety.conditions import ConditionWords
from rossmarie.report.safety.phrase import Phrase
from support.compiled import machine_of_condition, machine_of_rules
from support.drafts import SECOND, Draft
from support.machines import Case, cases, machines, take

Table = dict[tuple[str, ...], TruthValue]


def words(condition: str) -> str:
    """One condition in words, on one line."""
    machine = machine_of_rules(f"rule it: if {condition} then {{ stop; }};")
    found = ConditionWords(machine).phrase(machine.rules[0].condition)
    return " | ".join(line.strip().removeprefix("- ") for line in found.lines())


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("battery > 11 V", "battery is above 11 V"),
        ("not battery > 11 V", "battery is at most 11 V"),
        ("11 V > battery", "battery is below 11 V"),
        ("battery not in [10, 12] V", "battery is outside of 10 V to 12 V"),
        ("estop", "estop is true"),
        ("not estop", "estop is false"),
        ('mode == "docked"', 'mode is "docked"'),
        ('not (mode == "docked")', 'mode is other than "docked"'),
        ("age(battery) > 2 sec", "the last message of battery is more than 2 s old"),
        ("age(battery) >= 2 sec", "the last message of battery is at least 2 s old"),
        ("age(battery) < 2 sec", "the last message of battery is less than 2 s old"),
        ("age(battery) <= 2 sec", "the last message of battery is at most 2 s old"),
        ("estop for 2 sec", "estop has been true throughout the last 2 s"),
        ("(not estop) for 2 sec", "estop has been false throughout the last 2 s"),
        (
            "not (estop for 2 sec)",
            "it is not so that estop has been true throughout the last 2 s",
        ),
        ("estop and battery < 9 V", "estop is true and battery is below 9 V"),
        ("not (estop and battery < 9 V)", "estop is false or battery is at least 9 V"),
        (
            "imu.orientation.pitch() not in [-10, 10] deg",
            "the pitch of imu.orientation is outside of -10 deg to 10 deg",
        ),
        (
            "norm(imu.linear_acceleration) > 12 m/s^2",
            "the length of imu.linear_acceleration is above 12 m/s^2",
        ),
        ("rate(battery) < -1 V/s", "the rate of change of battery is below -1 V/s"),
        ("any(scan.ranges < 1 m)", "at least one element of scan.ranges is below 1 m"),
        ("not any(scan.ranges < 1 m)", "every element of scan.ranges is at least 1 m"),
        ("not all(scan.ranges < 1 m)", "at least one element of scan.ranges is at least 1 m"),
        (
            "any(scan.ranges - 1 m > 2 m)",
            "for at least one element of scan.ranges, (the element - 1 m) is above 2 m",
        ),
        (
            "any(scan.ranges < 1 m and scan.ranges > 0 m)",
            "at least one element of scan.ranges is such that "
            "((the element is below 1 m) and (the element is above 0 m))",
        ),
        (
            "count(scan.ranges < 1 m) >= 3",
            "the number of elements of scan.ranges with (the element is below 1 m) is at least 3",
        ),
        ("min(scan.ranges) < 1 m", "the least element of scan.ranges is below 1 m"),
        (
            "oscillates(battery, 4 times, within 2 sec, by 1 V)",
            "battery is oscillating (at least 4 turning points within 2 s, "
            "each after a swing of more than 1 V)",
        ),
        (
            "count(edges of estop or battery < 9 V within 2 sec) > 2",
            "this has become true at least 3 times within the last 2 s: | "
            "estop is true or battery is below 9 V",
        ),
        (
            "count(edges of estop within 2 sec) < 1",
            "this has not become true at least once within the last 2 s: | estop is true",
        ),
        (
            "changed(battery)",
            "battery is other than the sample before the last of battery",
        ),
        ("mean(battery, 1 sec) < 9 V", "the mean of battery over 1 s is below 9 V"),
        ("low_pass(battery, 1 sec) < 9 V", "battery behind a low pass of 1 s is below 9 V"),
        (
            "(estop or battery < 9 V) for 1 sec",
            "this has held throughout the last 1 s: | estop is true or battery is below 9 V",
        ),
    ],
)
def test_words(condition: str, expected: str) -> None:
    assert words(condition) == expected


MEANINGS: dict[str, Callable[[float, float], bool]] = {
    "above": operator.gt,
    "at least": operator.ge,
    "below": operator.lt,
    "at most": operator.le,
    "equal to": operator.eq,
    "other than": operator.ne,
}


@pytest.mark.parametrize("comparison", ir.Comparison)
@pytest.mark.parametrize("is_so", [True, False])
@pytest.mark.parametrize("is_constant_left", [True, False])
def test_the_word_of_a_comparison_means_it(
    comparison: ir.Comparison, is_so: bool, is_constant_left: bool
) -> None:
    draft = Draft()
    read, limit = draft.read(), draft.constant(1.0)
    sides = (limit, read) if is_constant_left else (read, limit)
    proposition = draft.proposition(ir.Compare(comparison, *sides))
    text = ConditionWords(draft.machine()).phrase(proposition, is_so).text
    (word,) = (word for word in MEANINGS if f" is {word} 1" in text)
    for value in (0.0, 1.0, 2.0):
        monitor = Interpreter(replace(draft.machine(), watches=(proposition,)))
        monitor.update(0, {0: ir.ChannelValues(slots={0: value}, arrays={})})
        holds = monitor.watches[0] is TruthValue.TRUE
        assert MEANINGS[word](value, 1.0) is (holds is is_so)


def read_again(phrase: Phrase, table: Table) -> TruthValue:
    """The value of a sentence; that of what is no list is looked up."""
    if phrase.text == "all of these hold:":
        return kleene.conjunction(read_again(part, table) for part in phrase.parts)
    if phrase.text == "at least one of these holds:":
        return kleene.disjunction(read_again(part, table) for part in phrase.parts)
    whole = tuple(phrase.lines())
    if whole in table:
        return table[whole]
    for sign, join in ((" and ", kleene.conjunction), (" or ", kleene.disjunction)):
        pieces = [(f"- {piece}",) for piece in phrase.text.split(sign)]
        if len(pieces) > 1 and all(piece in table for piece in pieces):
            return join(table[piece] for piece in pieces)
    raise AssertionError(f"nobody says what this is: {whole}")


def known(machine: ir.Machine, conditions: ConditionWords, monitor: Interpreter) -> Table:
    """The values of leaves and durations, and of what is only named, by their sentences."""
    table: Table = {("- always",): TruthValue.TRUE, ("- never",): TruthValue.FALSE}
    for index, proposition in enumerate(machine.propositions):
        value = monitor._memory.truth_values[index]
        if value is None:
            continue  # of an element
        for is_so in (True, False):
            own = value if is_so else kleene.negation(value)
            table[(f"- {conditions.name(index)} is {str(is_so).lower()}",)] = own
            if not isinstance(proposition.node, ir.And | ir.Or | ir.Not | ir.Literal):
                sentence = tuple(conditions.in_full(index, is_so).lines())
                # A random machine may have the same query in two contexts of skills.
                assume(table.setdefault(sentence, own) is own)
    return table


@given(cases())
def test_a_sentence_has_the_value_of_its_condition(case: Case) -> None:
    machine, trace = case
    monitor = Interpreter(machine)
    for step in trace:
        take(monitor, step)
    conditions = ConditionWords(machine)
    table = known(machine, conditions, monitor)
    for index in range(len(machine.propositions)):
        value = monitor._memory.truth_values[index]
        if value is None:
            continue  # of an element
        for is_so in (True, False):
            expected = value if is_so else kleene.negation(value)
            assert read_again(conditions.phrase(index, is_so), table) is expected


@given(machines(max_nodes=40), st.booleans())
def test_sentences_stay_short_however_much_is_shared(machine: ir.Machine, is_so: bool) -> None:
    conditions = ConditionWords(machine)
    for index in range(len(machine.rules)):
        phrase = conditions.phrase(machine.rules[index].condition, is_so)
        assert len(list(phrase.lines())) < 100


def test_what_is_doubled_again_and_again_is_named() -> None:
    draft = Draft()
    proposition = draft.proposition(ir.Flag(draft.read(kind=ir.FieldKind.FLAG)))
    number = draft.read()
    for _ in range(200):
        proposition = draft.proposition(
            ir.And((proposition, draft.proposition(ir.Not(proposition))))
        )
        number = draft.apply(ir.Function.ADD, number, number)
    conditions = ConditionWords(draft.machine())
    assert len(list(conditions.phrase(proposition).lines())) < 100
    assert len(conditions.numbers.words(number)) < 2000
    assert conditions.apart
    assert conditions.numbers.apart
    held = draft.proposition(ir.Held(proposition, 2 * SECOND))
    assert "throughout the last 2 s" in "\n".join(
        ConditionWords(draft.machine()).in_full(held).lines()
    )


@pytest.mark.parametrize(
    ("condition", "lines"),
    [
        (
            "estop since battery > 3 V",
            [
                "- the first of these is so, or it was and the second has been so ever since:",
                "  - battery is above 3 V",
                "  - estop is true",
            ],
        ),
        (
            "not once estop within 2 sec",
            [
                "- it is not so that this has been so at least once within the last 2 s:",
                "  - estop is true",
            ],
        ),
        (
            "after estop, battery < 3 V within 2 sec",
            [
                "- within 2 s after each instant at which the first of these is so, the second is:",
                "  - estop is true",
                "  - battery is below 3 V",
            ],
        ),
    ],
)
def test_what_looks_back_in_time(condition: str, lines: list[str]) -> None:
    machine = machine_of_condition(condition)
    assert list(ConditionWords(machine).phrase(machine.rules[0].condition).lines()) == lines


def test_what_looks_back_in_time_on_one_line() -> None:
    machine = machine_of_condition("once (estop since battery > 3 V) within 2 sec")
    assert ConditionWords(machine).inline(machine.rules[0].condition) == (
        "((battery is above 3 V), or it was and (estop is true) ever since) at least once within "
        "the last 2 s"
    )
    machine = machine_of_condition("not after estop, battery < 3 V within 2 sec")
    assert ConditionWords(machine).inline(machine.rules[0].condition) == (
        "not (within 2 s after each instant at which (estop is true), (battery is below 3 V))"
    )
