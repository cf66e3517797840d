"""The part of a random machine that depends on a threshold behaves alone as in the whole
machine.
"""

from __future__ import annotations

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.testing.cone import cone_of, reported_by
from rossmarie.testing.coverage import Watcher
from rossmarie.testing.margins import Reported, moved, thresholds
from rossmarie.testing.places import compared_with_constants, seen_by
from rossmarie.testing.play import InstantEvents
from support.depth import examples
from support.growing import NUMBERS, TICK
from support.machines import Update, machines, traces
from support.testing import compiled


def reference(machine: ir.Machine, trace: list[Update], end_ns: int) -> list[Reported]:
    interpreter = Interpreter(machine)
    events = [event for step in trace for event in interpreter.update(step.at_ns, step.messages)]
    events += interpreter.advance(end_ns)
    return [
        (event.rule, int(event.change), event.at_ns)
        for event in events
        if isinstance(event, ir.Verdict)
    ]


RULES = """\
rule old: if age(fix) > 0.3 sec or (speed > 1 m/s for 0.3 sec) then { slow; };
rule near: if any(ranges < 1 m) and not (speed > 0.5 m/s for 0.2 sec) then { slow; }
    clear for 0.4 sec;
rule clear: if all(p in path: p.pose.position.x > 0.5 m) then { slow; };
rule between: if all(ranges in [0.25, 2] m) then { stop; } clear when age(fix) < 0.2 sec;
rule sunk: if (speed in [-1, 0.25] m/s for 0.2 sec) and ok then { stop; } latched until reset;
"""


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> ir.Machine:
    return compiled(tmp_path_factory.mktemp("rules"), RULES).machine


def assert_same(machine: ir.Machine, data: st.DataObject) -> None:
    found = [
        each for each in thresholds(machine) if cone_of(machine, each.propositions) is not None
    ]
    assume(found)
    threshold = data.draw(st.sampled_from(found))
    trace = [step for step in data.draw(traces(machine)) if isinstance(step, Update)]
    assume(trace)
    end_ns = trace[-1].at_ns + data.draw(st.integers(0, 8)) * TICK
    watcher = Watcher(machine, kept=compared_with_constants(machine))
    steps = [InstantEvents(step.at_ns, step.messages) for step in trace]
    history = watcher.watch(steps, end_ns, from_zero=False)
    cone = cone_of(machine, threshold.propositions)
    assert cone is not None
    if threshold.constant is None:
        value = data.draw(st.integers(1, 12)) * TICK / 1e9
    else:
        seen = seen_by(machine, threshold, history)
        value = data.draw(st.sampled_from(seen) if seen else st.sampled_from(NUMBERS))
    candidate = moved(machine, threshold, value)
    usual, wanted = (reference(each, trace, end_ns) for each in (machine, candidate))
    assert list(reported_by(cone, candidate, history)) == [
        reported for reported in wanted if reported[0] in cone.rules
    ]
    assert [reported for reported in wanted if reported[0] not in cone.rules] == [
        reported for reported in usual if reported[0] not in cone.rules
    ]


@settings(max_examples=examples(4))
@given(st.data())
def test_a_moved_threshold_makes_the_same_verdicts(data: st.DataObject) -> None:
    assert_same(data.draw(machines()), data)


@settings(max_examples=examples(4))
@given(data=st.data())
def test_so_it_does_with_ages_elements_and_durations(
    machine: ir.Machine, data: st.DataObject
) -> None:
    assert_same(machine, data)
