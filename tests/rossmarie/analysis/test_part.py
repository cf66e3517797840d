"""A part of a machine does what its rules do in the whole."""

from __future__ import annotations

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.analysis.part import part_below, part_of
from rossmarie.interpreter import Interpreter
from support.machines import machines, take, traces


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(machines(), st.data())
def test_a_part_does_what_its_rules_do_in_the_whole(
    machine: ir.Machine, data: st.DataObject
) -> None:
    numbers = st.integers(0, len(machine.rules) - 1)
    rules = data.draw(st.lists(numbers, min_size=1, max_size=2, unique=True))
    part = part_of(machine, rules)
    ir.verify(part)
    whole, alone = Interpreter(machine), Interpreter(part)
    for step in data.draw(traces(machine)):
        if getattr(step, "rule", None) is not None:
            continue  # the reset of a rule that has another number in the part
        take(whole, step)
        take(alone, step)
        assert alone.active == tuple(whole.active[rule] for rule in rules)


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(machines(), st.data())
def test_the_last_proposition_of_what_lies_below_one_is_that_one(
    machine: ir.Machine, data: st.DataObject
) -> None:
    rule = data.draw(st.sampled_from(machine.rules))
    part = part_below(machine, rule.condition)
    ir.verify(part)
    assert part.propositions[-1].text == machine.propositions[rule.condition].text
    assert len(part.propositions) <= len(machine.propositions)
