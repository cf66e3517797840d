"""The topics of an observation arrive together, or one after the other; and who hears verdicts."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rossmarie.guard import Guard
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Event, Verdict
from support.c_compiler import needs_c
from support.depth import examples
from support.policy_rules import guard_of

RULES = """
system robot { topic /cmd_vel : geometry_msgs/Twist; node planner { publishes /cmd_vel; } }
input left = topic /left : std_msgs/Float64 in m timeout 1 sec;
input right = topic /right : std_msgs/Float64 in m timeout 1 sec;
action slow { limit /cmd_vel { linear.x in [-0.2, 0.2] m/s; }; }
action tell { log warning "both"; }
rule both: if left > 1 m and right > 1 m then { slow; tell; } clear for 0.3 sec;
rule either: if (left > 1 m or right > 1 m) for 0.2 sec then { slow; };
"""
KINDS = [pytest.param("native", marks=needs_c), "python"]
STEP_NS = 100_000_000


def guard(kind: str, folder: Path) -> Guard:
    observe = {"left": 0, "right": 1}
    return guard_of(kind, folder, rules=RULES, observe=observe, act={"linear.x": 0})


def events_of(made: Guard, seen: list[list[float]], *, one_by_one: bool) -> list[Event]:
    """The verdicts about observations, each a step after the one before."""
    events: list[Event] = []
    made.on_event = events.append
    for number, numbers in enumerate(seen):
        made.observe(number * STEP_NS, np.array(numbers), one_by_one=one_by_one)
    return events


def interpreted(made: Guard, seen: list[list[float]]) -> list[Event]:
    """The same for the interpreter, to which the topics are reported one by one after the first."""
    monitor = Interpreter(made.machine)
    events = monitor.update(
        0, {0: ChannelValues({0: seen[0][0]}), 1: ChannelValues({1: seen[0][1]})}
    )
    for number, (one, other) in enumerate(seen[1:], 1):
        left, right = {0: ChannelValues({0: one})}, {1: ChannelValues({1: other})}
        events += monitor.update(number * STEP_NS, left)
        events += monitor.update(number * STEP_NS, right)
    return events


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_true_between_two_messages_is_seen_one_by_one_only(
    kind: str, tmp_path: Path
) -> None:
    seen = [[0.0, 2.0], [2.0, 0.0]]
    together = events_of(guard(kind, tmp_path), seen, one_by_one=False)
    one_by_one = events_of(guard(kind, tmp_path), seen, one_by_one=True)
    assert [each.rule for each in together if isinstance(each, Verdict)] == []
    assert [each.rule for each in one_by_one if isinstance(each, Verdict)] == [0]


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=examples(0.3))
@given(
    seen=st.lists(st.lists(st.sampled_from([0.0, 2.0, np.nan]), min_size=2, max_size=2), min_size=1)
)
def test_one_by_one_is_what_the_interpreter_says_of_messages(
    kind: str, seen: list[list[float]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    made = guard(kind, tmp_path_factory.mktemp("rules"))
    said = events_of(made, seen, one_by_one=True)
    assert list(map(repr, said)) == list(map(repr, interpreted(made, seen)))
    assert made.observe(len(seen) * STEP_NS, np.zeros(2), one_by_one=True).shape == (2,)


@pytest.mark.parametrize("kind", KINDS)
def test_verdicts_are_heard_at_once_and_requests_come_with_the_decision(
    kind: str, tmp_path: Path
) -> None:
    made, heard = guard(kind, tmp_path), list[Event]()
    made.on_event = heard.append
    made.observe(0, np.zeros(2))
    made.observe(STEP_NS, np.full(2, 2.0))
    (verdict,) = heard
    assert isinstance(verdict, Verdict)
    assert (verdict.rule, verdict.at_ns) == (0, STEP_NS)
    decision = made.decide(np.array([1.0]))
    assert [each.action for each in decision.requests] == ["tell"]
    assert "both is active: " in decision.why()
    assert len(heard) == 1


def test_copies_are_not_heard_by_those_who_hear_the_original(tmp_path: Path) -> None:
    made, heard = guard("python", tmp_path), list[Event]()
    made.on_event = heard.append
    made.observe(0, np.zeros(2))
    copy.copy(made).observe(STEP_NS, np.full(2, 2.0))
    assert heard == []


@needs_c
def test_a_guard_that_is_heard_goes_through_a_pickle(tmp_path: Path) -> None:
    made, heard = guard("native", tmp_path), list[Event]()
    made.on_event = heard.append
    made.observe(0, np.zeros(2), one_by_one=True)
    another = pickle.loads(pickle.dumps(made))
    another.observe(STEP_NS, np.full(2, 2.0), one_by_one=True)
    assert heard == []


@pytest.mark.parametrize("kind", KINDS)
def test_what_does_not_fit_is_refused_before_any_topic_arrives(kind: str, tmp_path: Path) -> None:
    made = guard(kind, tmp_path)
    made.observe(STEP_NS, np.zeros(2))
    for wrong in (np.zeros(3), np.zeros((2, 1))):
        with pytest.raises(ValueError, match="observation"):
            made.observe(2 * STEP_NS, wrong, one_by_one=True)
    with pytest.raises(ValueError, match="time goes back"):
        made.observe(0, np.zeros(2), one_by_one=True)
    strided = np.array([[0.0, 9.0], [2.0, 9.0]])[:, 0]
    assert made.observe(STEP_NS, strided, one_by_one=True).tolist() == [False, False]
