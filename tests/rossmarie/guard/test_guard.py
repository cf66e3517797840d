"""A guard of a policy, step by step: the same in C and in Python."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rossmarie.engines import start_guard
from rossmarie.guard import Decision, Guard, MappingError
from rossmarie.ir import TaskCommandKind, reactions
from rossmarie.native import monitor as native_monitor
from support.c_compiler import needs_c
from support.drafts import SECOND
from support.policy_rules import guard_of

Make = Callable[..., Guard]
CALM = (0.0, 0.0, 2.0, 2.0)
FAST = (1.5, 0.0, 2.0, 2.0)
NEAR = (0.0, 0.0, 2.0, 0.3)
FAR = (0.0, 0.0, 2.0, 6.0)
HELD = (0.0, 1.0, 2.0, 2.0)


@pytest.fixture(params=[pytest.param("native", marks=needs_c), "python"])
def make(request: pytest.FixtureRequest, tmp_path: Path) -> Make:
    return lambda **changed: guard_of(request.param, tmp_path, **changed)


def step(
    guard: Guard,
    at_ns: int,
    seen: tuple[float, ...] = CALM,
    wanted: tuple[float, ...] = (0.8, 0.1),
    dtype: type[Any] = np.float64,
) -> Decision:
    return guard.step(at_ns, np.array(seen, dtype), np.array(wanted, dtype))


def test_an_action_passes_while_no_rule_is_active(make: Make) -> None:
    decision = step(make(), 0)
    assert decision.action.tolist() == [0.8, 0.1]
    assert not decision.changed
    assert (decision.active, decision.changed_by, decision.requests) == ((), (), ())
    assert decision.why() == "no rule is active"


def test_a_rule_limits_an_action_and_lifts_the_limit_along_its_ramp(make: Make) -> None:
    guard = make()
    decision = step(guard, 0, FAST)
    assert decision.action.tolist() == [0.2, 0.1]
    assert (decision.changed, decision.active, decision.changed_by) == (True, ("fast",), ("fast",))
    after = step(guard, SECOND)
    assert (after.active, after.changed_by) == ((), ("fast",))
    assert step(guard, 2 * SECOND).action.tolist() == pytest.approx([0.3, 0.1])
    assert decision.active == ("fast",), "a decision does not change afterwards"


def test_the_reasons_are_reported_in_words(make: Make) -> None:
    lines = step(make(), 0, FAST).why().splitlines()
    assert lines[0].startswith("fast is active: speed = 1.5 m/s, > 1 m/s")
    assert lines[1:] == ["action[0] (linear.x): 0.8 became 0.2, by fast"]


def test_a_rule_that_commands_takes_the_place_of_the_policy(make: Make) -> None:
    guard = make()
    for second in range(3):
        decision = step(guard, second * SECOND, NEAR)
        assert decision.action.tolist() == [-0.1, 0.0]
        assert decision.changed_by == ("near",)
        assert decision.requests == ()
    assert step(guard, 3 * SECOND).action.tolist() == [0.8, 0.1]


def test_a_single_command_of_a_rule_takes_the_place_of_one_action(make: Make) -> None:
    guard = make()
    decision = step(guard, 0, FAR)
    assert decision.action.tolist() == [0.0, 0.5]
    assert decision.changed_by == ("far",)
    assert step(guard, 1, FAR).action.tolist() == [0.8, 0.1]


def test_a_number_that_is_not_finite_stops_its_command(make: Make) -> None:
    for bad in (np.nan, np.inf, -np.inf):
        decision = step(make(), 0, wanted=(0.1, bad))
        assert decision.action.tolist() == [0.0, 0.0]
        assert decision.changed
        assert decision.refused
        assert decision.changed_by == ()
        assert "not finite" in decision.why()


def test_an_input_that_is_never_observed_keeps_everything_back(make: Make) -> None:
    guard = make(observe={"speed": 0, "held": None, "scan": slice(2, 4)})
    decision = step(guard, 0)
    assert decision.action.tolist() == [0.0, 0.0]
    assert "before every input with a timeout has arrived" in decision.why()


def test_a_latched_rule_waits_for_an_operator(make: Make) -> None:
    guard = make()
    step(guard, 0, HELD)
    assert step(guard, 1).active == ("held_up",)
    guard.reset("held_up")
    decision = step(guard, 2)
    assert decision.active == ()
    assert decision.action.tolist() == [0.8, 0.1]
    with pytest.raises(ValueError, match="there is no rule `heldup`; did you mean `held_up`"):
        guard.reset("heldup")


def test_what_rules_want_done_is_for_the_caller(make: Make) -> None:
    guard = make()
    (request,) = step(guard, 0, FAST).requests
    assert (request.kind, request.rule, request.action) == (TaskCommandKind.START, "fast", "tell")
    assert request.effect == reactions.Log(reactions.Level.WARNING, "it is fast")
    assert step(guard, 1, FAST).requests == ()


REPORTED = """
system robot {
    topic /cmd_vel : geometry_msgs/Twist;
    node planner { publishes /cmd_vel; }
}
input speed = topic /speed : std_msgs/Float64 in m/s timeout 1 sec;
action slow { limit /cmd_vel { linear.x in [-0.2, 0.2] m/s; }; }
action ask { call /ask : std_srvs/Trigger within 2 sec else slow; }
rule fast: if speed > 1 m/s then { ask; };
"""


def test_what_follows_from_a_report_comes_with_the_next_decision(make: Make) -> None:
    guard = make(rules=REPORTED, observe={"speed": 0}, act={"linear.x": 0})
    with pytest.raises(ValueError, match="there is no step yet"):
        guard.report(0, success=True)
    (request,) = step(guard, 0, (1.5,), (0.8,)).requests
    guard.report(request, success=False)
    decision = step(guard, 1, (1.5,), (0.8,))
    assert decision.action.tolist() == [0.2]
    assert [each.kind for each in decision.requests] == [TaskCommandKind.FAILED]


def test_floats_of_32_bits_stay_so_and_never_exceed_a_limit(make: Make) -> None:
    guard = make()
    free = step(guard, 0, dtype=np.float32).action
    assert free.dtype == np.float32
    assert free.tolist() == np.array([0.8, 0.1], np.float32).tolist()
    for wanted, sign in ((0.8, 1), (-0.8, -1)):
        found = step(guard, 1, FAST, (wanted, 0.0), np.float32).action[0]
        assert 0.1999999 < sign * float(found) <= 0.2


def test_the_arrays_that_come_in_are_not_touched(make: Make) -> None:
    guard = make()
    seen, wanted = np.array([FAST, FAST]).T.copy().T[0], np.array([0.8, 0.1])
    guard.step(0, seen, wanted)
    every_second = np.zeros(8)
    every_second[::2] = FAST
    assert guard.step(1, every_second[::2], wanted).action.tolist() == [0.2, 0.1]
    assert wanted.tolist() == [0.8, 0.1]


def test_instants_may_be_of_numpy(make: Make) -> None:
    guard = make()
    decision = guard.step(np.int64(1), np.array(HELD), np.array([0.8, 0.1]))
    assert decision.active == ("held_up",)
    guard.step(np.int64(2), np.array(CALM), np.array([0.8, 0.1]))
    guard.reset()
    assert step(guard, 3).active == ()


def test_an_episode_begins_anew(make: Make) -> None:
    guard = make()
    step(guard, 5 * SECOND, HELD)
    guard.restart()
    assert step(guard, 0).active == ()


REFUSED: list[tuple[Any, Any, Any, type[Exception], str]] = [
    (
        1,
        np.zeros(5),
        np.zeros(2),
        MappingError,
        "the observation has 5 numbers, but had 4 at first",
    ),
    (1, np.zeros(4), np.zeros(3), MappingError, "the action has 3 numbers, but had 2 at first"),
    (1, np.zeros((1, 4)), np.zeros(2), MappingError, r"the shape \(1, 4\)"),
    (1, np.zeros(4, np.int64), np.zeros(2), MappingError, "holds int64, not float64 or float32"),
    (1, np.zeros(4), np.zeros(2, np.float16), MappingError, "the action holds float16"),
    (1, [0.0] * 4, np.zeros(2), TypeError, "the observation is a list"),
    (1, np.zeros(4), (0.0, 0.0), TypeError, "the action is a tuple"),
    (0, np.zeros(4), np.zeros(2), ValueError, "time goes back from 1 ns to 0 ns; call `restart`"),
    (2**63, np.zeros(4), np.zeros(2), ValueError, "out of range"),
    (2**62, np.zeros(4), np.zeros(2), ValueError, "out of range"),
    (1.5, np.zeros(4), np.zeros(2), TypeError, "integer"),
]


def test_what_does_not_fit_is_refused_and_changes_nothing(make: Make) -> None:
    guard = make()
    step(guard, 1, FAST)
    for at_ns, seen, wanted, kind, words in REFUSED:
        with pytest.raises(kind, match=words):
            guard.step(at_ns, seen, wanted)
    decision = step(guard, 1, FAST)
    assert decision.active == ("fast",)
    assert decision.requests == ()


def test_the_first_step_is_refused_as_well(make: Make) -> None:
    guard = make()
    with pytest.raises(MappingError, match=r"`scan` is observation\[2:4\], of 3 numbers"):
        guard.step(0, np.zeros(3), np.zeros(2))
    with pytest.raises(MappingError, match="holds int64"):
        guard.step(0, np.zeros(4), np.zeros(2, np.int64))
    with pytest.raises(ValueError, match="out of range"):
        guard.step(2**62, np.zeros(9), np.zeros(9))
    assert step(guard, 0).active == ()


def test_the_state_of_another_guard_is_refused(make: Make) -> None:
    guard, another = make(), make(rules=REPORTED, observe={"speed": 0}, act={"linear.x": 0})
    step(guard, 0, FAST)
    with pytest.raises(ValueError, match="the state is of a guard of other rules"):
        another.restore(guard.state())


@needs_c
def test_the_state_of_another_kind_of_guard_is_refused(tmp_path: Path) -> None:
    native, python = guard_of("native", tmp_path), guard_of("python", tmp_path)
    step(native, 0)
    with pytest.raises(ValueError, match="or of another version or kind"):
        python.restore(native.state())


@needs_c
def test_the_state_of_a_native_guard_is_pickled(tmp_path: Path) -> None:
    guard, another = guard_of("native", tmp_path), guard_of("native", tmp_path)
    step(guard, 0, FAST)
    another.restore(pickle.loads(pickle.dumps(guard.state())))
    decision = step(another, 1, FAST)
    assert decision.why() == step(guard, 1, FAST).why()
    assert decision.requests == ()


def test_the_state_before_the_first_step_is_that_of_a_new_guard(make: Make) -> None:
    guard = make()
    state = guard.state()
    step(guard, 5, HELD)
    guard.restore(state)
    assert step(guard, 0).active == ()


def test_an_observation_comes_first_and_an_action_after_it(make: Make) -> None:
    whole, guard = make(), make()
    for at_ns, seen in ((0, FAST), (1, NEAR), (2, FAR), (3, HELD)):
        wanted = np.array([0.8, 0.1], np.float32)
        decision = whole.step(at_ns, np.array(seen), wanted)
        active = guard.observe(at_ns, np.array(seen))
        assert tuple(np.array(guard.rules)[active]) == decision.active
        other = guard.decide(wanted)
        assert other.action.tolist() == decision.action.tolist()
        assert other.requests == decision.requests
        assert other.why() == decision.why()
    assert wanted.tolist() == np.array([0.8, 0.1], np.float32).tolist()


def test_a_second_action_at_one_instant_is_decided_by_the_same_bounds(make: Make) -> None:
    guard = make()
    guard.observe(0, np.array(FAST))
    for _ in range(2):
        assert guard.decide(np.array([0.8, 0.1])).action.tolist() == [0.2, 0.1]


def test_a_state_between_observation_and_action_is_kept(make: Make) -> None:
    guard, other = make(), make()
    guard.observe(0, np.array(FAST))
    other.restore(guard.state())
    assert other.decide(np.array([0.8, 0.1])).action.tolist() == [0.2, 0.1]
    assert other.decide(np.array([0.8, 0.1])).changed_by == ("fast",)


def test_what_does_not_fit_an_action_by_itself_is_refused(make: Make) -> None:
    guard = make()
    wrong: Any = [0.8, 0.1]
    with pytest.raises(ValueError, match="there is no step yet"):
        guard.decide(np.array(wrong))
    guard.observe(5, np.array(CALM))
    with pytest.raises(TypeError, match="the action is a list"):
        guard.decide(wrong)
    with pytest.raises(MappingError, match=r"`angular.z` is action\[1\], of 1 numbers"):
        guard.decide(np.zeros(1))
    guard.decide(np.zeros(2))
    with pytest.raises(MappingError, match="the action has 3 numbers, but had 2 at first"):
        guard.decide(np.zeros(3))
    with pytest.raises(MappingError, match="the observation has 3 numbers, but had 4"):
        guard.observe(6, np.zeros(3))
    with pytest.raises(ValueError, match="time goes back from 5 ns to 4 ns"):
        guard.observe(4, np.array(CALM))
    assert not guard.observe(6, np.array([CALM, CALM]).T[:, 0]).any(), "a column of a matrix fits"
    column = np.array([[0.8, 0.1]] * 2).T[:, 0]
    assert guard.decide(column).action.tolist() == column.tolist()


def test_rules_have_feedback_for_a_learner(make: Make) -> None:
    guard = make()
    assert step(guard, 0, NEAR).feedback.tolist() == [0.0] * 4, "nobody has acted yet"
    assert step(guard, SECOND // 2, FAST).feedback.tolist() == [2.0, 2.0, 0.0, 0.0]
    state = guard.state()
    after = step(guard, 3 * SECOND // 2)
    assert after.feedback.tolist() == [0.5, 0.0, 0.0, 0.0]
    guard.restore(state)
    assert step(guard, 3 * SECOND // 2).feedback.tolist() == [0.5, 0.0, 0.0, 0.0]
    guard.restart()
    assert step(guard, 0, FAST).feedback.tolist() == [0.0] * 4


def test_feedback_is_that_of_the_last_observation(make: Make) -> None:
    guard = make()
    guard.observe(0, np.array(CALM))
    guard.observe(SECOND, np.array(FAST))
    wanted = np.array([0.8, 0.1])
    assert guard.decide(wanted).feedback.tolist() == [2.0, 0.0, 0.0, 0.0]
    assert guard.decide(wanted).feedback.tolist() == [2.0, 0.0, 0.0, 0.0]


def test_feedback_of_several_observations_before_a_decision_is_summed(make: Make) -> None:
    guard = make()
    wanted = np.array([0.8, 0.1])
    guard.observe(0, np.array(CALM))
    guard.decide(wanted)
    for at_ns, seen in ((1, CALM), (2, FAST), (SECOND, CALM), (SECOND + 1, CALM)):
        guard.observe(at_ns, np.array(seen))
    state = guard.state()
    expected = [2.0 + 0.5 * (SECOND - 2) / SECOND, 0.0, 0.0, 0.0]
    assert guard.decide(wanted).feedback.tolist() == expected
    assert guard.decide(wanted).feedback.tolist() == expected
    assert step(guard, SECOND + 2).feedback.tolist() == [0.0] * 4
    guard.restore(state)
    guard.observe(SECOND + 2, np.array(FAST))
    assert guard.decide(wanted).feedback.tolist() == [2.0 + expected[0], 0.0, 0.0, 0.0]


def test_margins_are_distances_to_the_limits_in_the_units_of_the_rules(make: Make) -> None:
    guard = make()
    with pytest.raises(ValueError, match="there is no step yet"):
        _ = guard.margin
    decision = step(guard, 0)
    wanted = [3.6, 1500.0]
    assert guard.rules_with_margin == ("fast", "near")
    np.testing.assert_allclose(decision.margin, wanted)
    np.testing.assert_array_equal(guard.margin, decision.margin)
    np.testing.assert_allclose(step(guard, 1, FAST).margin[0], -1.8)
    state = guard.state()
    np.testing.assert_allclose(step(guard, 2, NEAR).margin, [3.6, -200.0])
    np.testing.assert_allclose(decision.margin, wanted, err_msg="it does not change afterwards")
    guard.restore(state)
    np.testing.assert_allclose(guard.margin[0], -1.8)


def test_a_margin_is_unknown_where_a_number_is(make: Make) -> None:
    guard = make()
    found = step(guard, 0, (np.nan, 0.0, np.inf, 0.3))
    assert found.active == ("fast", "near", "far")
    np.testing.assert_allclose(found.margin, [np.nan, -200.0])
    assert np.isnan(step(guard, 1, (0.0, 0.0, np.nan, 0.3)).margin[1])
    guard.observe(2, np.array(CALM))
    assert not np.isnan(guard.margin).any()


@needs_c
def test_without_the_headers_of_python_everything_is_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    quick = guard_of("native", tmp_path)
    monkeypatch.setattr(native_monitor, "_HEADERS", Path("/nowhere"))
    plain = guard_of("native", tmp_path)
    for at_ns, seen in enumerate((CALM, FAST, NEAR, FAR, HELD, CALM)):
        wanted, found = step(quick, at_ns, seen), step(plain, at_ns, seen)
        assert found.action.tobytes() == wanted.action.tobytes()
        assert found.margin.tobytes() == wanted.margin.tobytes()
        assert (found.active, found.why()) == (wanted.active, wanted.why())
    scan = plain.machine.inputs[[each.name for each in plain.machine.inputs].index("scan")].channel
    engines = [start_guard(plain.machine).engine, quick._engine.fresh()]
    for at_ns, ranges in enumerate(([2.0, 3.0], [0.25, 3.0], [2.0])):
        plainly, quickly = (each.watch_call(scan)(at_ns, np.array(ranges)) for each in engines)
        assert plainly == quickly
        assert repr(engines[0].take()) == repr(engines[1].take()), "NaN is not NaN"
