"""One environment behind a guard."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import SyncVectorEnv

import rossmarie
from rossmarie.guard import MappingError
from rossmarie.gym import GuardedEnv
from support.c_compiler import needs_c
from support.carts import ACT, CHOICES, OBSERVE, PERIOD_NS, RULES, Cart

pytestmark = needs_c
CHOICE_ACT = {"linear.x": CHOICES}


@pytest.fixture
def rules(tmp_path: Path) -> str:
    path = tmp_path / "cart.ross"
    path.write_text(RULES, encoding="utf-8")
    return str(path)


def guarded(rules: Any, env: Any = None, **changed: Any) -> GuardedEnv:
    given: dict[str, Any] = {"period_ns": PERIOD_NS, "observe": OBSERVE, "act": ACT}
    return GuardedEnv(env or Cart(), rules, **{**given, **changed})


def fast(value: float = 1.0) -> np.ndarray[Any, Any]:
    return np.array([value], np.float32)


def test_only_what_rules_allow_is_executed(rules: str) -> None:
    cart = Cart()
    env = guarded(rules, cart)
    env.reset()
    reported = [env.step(fast())[4] for _ in range(8)]
    assert cart.executed[:4] == [1.0] * 4
    assert max(cart.executed[5:]) <= 0.05
    assert [each["guard"]["intervened"] for each in reported] == [False] * 5 + [True] * 3
    assert reported[5]["guard"]["proposed"] == fast()
    assert reported[5]["guard"]["executed"].dtype == np.float32
    assert [each["cost"] for each in reported] == [0.0] * 4 + [1.0] * 4
    assert reported[4]["guard"]["active"].tolist() == [True, False]
    assert env.rules == ("close", "at_wall")
    assert env.decision is not None
    assert env.decision.changed_by == ("close",)


def test_rules_that_are_not_enforced_are_watched(rules: str) -> None:
    cart = Cart()
    env = guarded(rules, cart, enforce=False)
    env.reset()
    reported = [env.step(fast())[4]["guard"] for _ in range(8)]
    assert cart.executed == [1.0] * 8
    assert [each["executed"] for each in reported] == [fast()] * 8
    assert [each["intervened"] for each in reported] == [False] * 5 + [True] * 3
    assert env.decision is not None
    assert env.decision.changed_by


def test_an_episode_forgets_the_one_before(rules: str) -> None:
    env = guarded(rules, Cart(start=0.25))
    for _ in range(2):
        env.reset()
        assert env.step(fast())[4]["guard"]["executed"] == 0.0


def test_a_latched_rule_holds_the_robot_or_ends_the_episode(rules: str) -> None:
    for latched, is_over in (("hold", False), ("truncate", True)):
        env = guarded(rules, Cart(start=0.31), latched=latched)
        env.reset()
        _, _, terminated, truncated, info = env.step(fast(0.05))
        assert not terminated
        assert not truncated
        while not info["guard"]["active"][1]:
            _, _, terminated, truncated, info = env.step(fast(0.05))
        assert not terminated
        assert truncated is is_over


def test_choices_are_masked_and_replaced_by_the_nearest_that_pass(rules: str) -> None:
    cart = Cart(start=0.5, kind="choice")
    env = guarded(rules, cart, act=CHOICE_ACT)
    _, info = env.reset()
    assert info["action_mask"].tolist() == [1, 1, 1, 0]
    assert info["action_mask"].dtype == np.int8
    assert env.action_masks().tolist() == [True, True, True, False]
    _, _, _, _, info = env.step(3)
    assert cart.executed == [0.05]
    assert (info["guard"]["proposed"], info["guard"]["executed"]) == (3, 2)
    assert info["guard"]["intervened"]
    assert env.action_space.sample(info["action_mask"]) != 3
    with pytest.raises(TypeError, match="actions are vectors"):
        guarded(rules).action_masks()


def test_where_no_choice_passes_the_nearest_is_taken(rules: str) -> None:
    cart = Cart(start=0.2, kind="choice")
    env = guarded(rules, cart, act={"linear.x": [0.1, 0.2, 0.3, -0.4]})
    _, info = env.reset()
    assert info["action_mask"].tolist() == [0, 0, 0, 0]
    assert info["no_choice_passes"] is True
    _, _, _, _, info = env.step(2)
    assert info["guard"]["executed"] == 0
    assert info["no_choice_passes"] is True
    env = guarded(rules, Cart(start=0.2, kind="choice"), act=CHOICE_ACT)
    assert env.reset()[1]["no_choice_passes"] is False, "one of them stands still"


def test_a_target_is_held_by_a_block_and_moves_no_faster_than_a_limit(rules: str) -> None:
    cart = Cart(start=0.9, kind="place")
    env = guarded(rules, cart, act={"linear.x": (0, "m")}, targets={"linear.x": 1}, latched="hold")
    env.reset()
    seen, _, _, _, info = env.step(fast(0.35))
    assert info["guard"]["executed"] == fast(0.35), "nothing is active: it is the same number"
    assert seen[0] == pytest.approx(550.0)
    seen, _, _, _, info = env.step(fast(0.8))
    assert float(info["guard"]["executed"][0]) == pytest.approx(0.355)
    assert float(info["guard"]["executed"][0]) <= np.float64(np.float32(0.35)) + 0.05 * 0.1
    near = Cart(start=0.25, kind="place")
    env = guarded(rules, near, act={"linear.x": (0, "m")}, targets={"linear.x": 1})
    env.reset()
    _, _, _, _, info = env.step(fast(0.1))
    assert info["guard"]["executed"] == 0.0, "the place where it was when the episode began"
    assert near.executed == [0.0]


def test_entries_of_a_dictionary_are_observed_by_their_keys(rules: str) -> None:
    env = guarded(rules, Cart(as_dictionary=True), observe={"wall": ("range", 0, "mm")})
    env.reset()
    reported = [env.step(fast())[4]["guard"]["intervened"] for _ in range(7)]
    assert reported == [False] * 5 + [True] * 2


def test_gymnasium_finds_nothing_wrong(rules: str) -> None:
    for env in (
        guarded(rules),
        guarded(rules, Cart(kind="choice"), act=CHOICE_ACT),
        guarded(rules, Cart(as_dictionary=True), observe={"wall": ("range", 0, "mm")}),
    ):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message=".*(different from the unwrapped|Box).*")
            check_env(env, skip_render_check=True)


def test_a_specification_makes_the_same_environment(rules: str) -> None:
    gymnasium.register("Cart-v0", entry_point="support.carts:Cart", max_episode_steps=30)
    try:
        env = guarded(rules, gymnasium.make("Cart-v0"))
        assert env.spec is not None
        text = env.spec.to_json()
        for spec in (env.spec, gymnasium.envs.registration.EnvSpec.from_json(text)):
            made = gymnasium.make(spec)
            assert isinstance(made, GuardedEnv)
            made.reset()
            reported = [made.step(fast())[4]["guard"]["intervened"] for _ in range(6)]
            assert reported == [False] * 5 + [True]
    finally:
        del gymnasium.registry["Cart-v0"]


def test_guarded_environments_fit_into_a_vector(rules: str) -> None:
    envs = SyncVectorEnv([lambda: guarded(rules) for _ in range(3)])
    envs.reset()
    for _ in range(6):
        infos = envs.step(np.ones((3, 1), np.float32))[4]
    assert infos["guard"]["intervened"].tolist() == [True] * 3
    assert infos["guard"]["active"].shape == (3, 2)
    assert infos["cost"].tolist() == [1.0] * 3


def test_time_is_counted_in_steps(rules: str, tmp_path: Path) -> None:
    path = tmp_path / "late.ross"
    path.write_text(RULES.replace("wall < 0.6 m then", "wall < 2 m for 0.3 sec then"))
    env = guarded(path)
    env.reset()
    reported = [env.step(fast(0.1))[4]["guard"]["active"][0] for _ in range(4)]
    assert reported == [False, False, True, True]
    env.reset()
    assert not env.step(fast(0.1))[4]["guard"]["active"][0]


WRONG: list[tuple[dict[str, Any], Any, str]] = [
    ({"period_ns": 0}, None, "a period is a positive number of ns, not 0"),
    ({"latched": "stop"}, None, '`latched` is "hold" or "truncate", not \'stop\''),
    ({"observe": {"wal": 0}}, None, "did you mean `wall`"),
    ({"observe": {"wall": ("rnge", 0)}}, Cart(as_dictionary=True), "did you mean `range`"),
    ({"observe": {"wall": ("range", 2)}}, Cart(as_dictionary=True), r"range\[2\], of 2 numbers"),
    ({"observe": {"wall": (0, "N")}}, None, "`wall` is in m, not in N"),
    ({"act": {"linear.x": [1.0]}}, Cart(kind="choice"), "a list of 4 finite numbers"),
    ({"act": {"linear.x": 0}}, Cart(kind="choice"), "a list of 4 finite numbers"),
    ({"act": {"linear.x": (0, "m")}}, None, "`linear.x` is in m/s, not in m"),
    ({"targets": {"linear.x": 9}}, None, "9 is not a single number of an observation"),
    ({"targets": {"linear.z": 0}}, None, "`linear.z` is a target, so `act` needs"),
    ({}, Cart(dtype=np.int32), "a guard bounds a Box of floats, or a Discrete choice"),
]


@pytest.mark.parametrize(("changed", "env", "words"), WRONG)
def test_what_does_not_fit_is_refused_before_the_first_step(
    rules: str, changed: dict[str, Any], env: Any, words: str
) -> None:
    with pytest.raises(MappingError, match=words):
        guarded(rules, env, **changed)


def test_feedback_is_reported_and_taken_from_the_reward_on_request(rules: str) -> None:
    for with_feedback in (False, True):
        env = guarded(rules, with_feedback=with_feedback)
        env.reset()
        steps = [env.step(fast()) for _ in range(7)]
        reported = [info["guard"]["feedback"].tolist() for *_, info in steps]
        assert reported == [*[[0.0, 0.0]] * 4, [1.0, 0.0], [0.5, 0.0], [0.5, 0.0]]
        speeds = [float(info["guard"]["executed"][0]) for *_, info in steps]
        losses = [sum(each) if with_feedback else 0.0 for each in reported]
        rewards = [speed - loss for speed, loss in zip(speeds, losses, strict=True)]
        assert [reward for _, reward, *_ in steps] == pytest.approx(rewards)


def test_margins_are_those_of_the_new_observation(rules: str) -> None:
    env = guarded(rules)
    env.reset()
    reported = [env.step(fast())[4]["guard"]["margin"] for _ in range(5)]
    assert env.rules_with_margin == ("close",)
    np.testing.assert_allclose(reported, [[300.0], [200.0], [100.0], [0.0], [-100.0]], atol=1e-4)


def test_what_only_substeps_see_is_guarded_against(rules: str) -> None:
    for substeps, wanted in ((1, [0.1, 0.1]), (4, [0.1, 0.0])):
        cart = Cart(start=2.0)
        env = guarded(rules, cart, substeps=substeps)
        env.reset()
        if substeps > 1:
            cart.dips, cart.on_substep = [1.0, 0.2, 1.0], env.observe_substep
        seen, _, _, _, info = env.step(fast(0.1))
        assert seen[0] == pytest.approx(1990.0), "at the end of the step nothing is near"
        assert info["guard"]["active"].tolist() == [False, substeps > 1], "one is latched"
        assert info["cost"] == float(substeps > 1)
        assert info["guard"]["feedback"].tolist() == [1.125 if substeps > 1 else 0.0, 0.0]
        assert env.decision is not None
        env.step(fast(0.1))
        assert cart.executed == pytest.approx(wanted)
        assert (env.decision.changed_by == ("at_wall",)) is (substeps > 1)


def test_substeps_take_their_share_of_a_step(tmp_path: Path) -> None:
    path = tmp_path / "late.ross"
    path.write_text(RULES.replace("wall < 0.6 m then", "wall < 0.6 m for 0.05 sec then"))
    for dips, is_seen in (([0.5, 0.5], False), ([0.5, 0.5, 0.5], True), ([1.0] * 4, False)):
        cart = Cart(start=2.0)
        env = guarded(path, cart, substeps=4)
        env.reset()
        cart.dips, cart.on_substep = dips, env.observe_substep
        assert env.step(fast(0.1))[4]["cost"] == is_seen
        assert env.step(fast(0.1))[4]["cost"] == is_seen, "time goes on from the whole step"


def test_substeps_are_counted(rules: str) -> None:
    cart = Cart()
    env = guarded(rules, cart, substeps=2)
    env.reset()
    with pytest.raises(ValueError, match=r"no step now, or it has more than 2 substeps"):
        env.observe_substep(np.zeros(2))
    cart.dips, cart.on_substep = [1.0] * 3, env.observe_substep
    with pytest.raises(ValueError, match="no step now, or it has more"):
        env.step(fast())
    cart.dips = [1.0] * 2
    env.reset()
    env.step(fast())
    for substeps in (0, -1, PERIOD_NS + 1):
        with pytest.raises(MappingError, match="at least one substep"):
            guarded(rules, substeps=substeps)


def test_an_index_beyond_the_spaces_is_refused_at_once(rules: str) -> None:
    with pytest.raises(MappingError, match=r"observation\[7\], of 2 numbers"):
        guarded(rules, observe={"wall": 7})
    with pytest.raises(MappingError, match=r"action\[1\], of 1 numbers"):
        guarded(rules, act={"linear.x": 1})


def test_what_is_no_action_is_refused_and_not_executed(rules: str) -> None:
    chosen = Cart(kind="choice")
    env = guarded(rules, chosen, act=CHOICE_ACT)
    env.reset()
    for wrong in (-1, 4, 1.0, np.array([0, 7])):
        with pytest.raises(ValueError, match="an action is a choice from 0 to 3, not"):
            env.step(wrong)
    driven = Cart()
    env = guarded(rules, driven)
    env.reset()
    for shape in ((2,), ()):
        with pytest.raises(ValueError, match=r"an action has the shape \(1,\), not"):
            env.step(np.zeros(shape, np.float32))
    assert chosen.executed == driven.executed == []


def test_a_monitor_may_stand_for_its_rules(rules: str) -> None:
    env = guarded(rossmarie.load(rules))
    env.reset()
    assert not env.step(fast(0.1))[4]["guard"]["intervened"]
    Path(rules).write_text("rule", encoding="utf-8")
    with pytest.raises(rossmarie.RulesError):
        guarded(rules)
