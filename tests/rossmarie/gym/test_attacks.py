"""Misuse of guards and guarded environments is refused, or has no effect on others."""

from __future__ import annotations

import pickle
import time
from concurrent.futures import ThreadPoolExecutor
from copy import copy, deepcopy
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium import spaces
from gymnasium.vector import AsyncVectorEnv, AutoresetMode, SyncVectorEnv

from rossmarie.guard import Guard, MappingError
from rossmarie.gym import GuardedEnv, GuardedVectorEnv
from support.c_compiler import needs_c
from support.carts import ACT, CHOICES, OBSERVE, PERIOD_NS, RULES, Cart
from support.policy_rules import guard_of

KINDS = [pytest.param("native", marks=needs_c), "python"]
CALM, FAST = np.array([0.0, 0.0, 2.0, 2.0]), np.array([1.5, 0.0, 2.0, 2.0])
HELD = np.array([0.0, 1.0, 2.0, 2.0])
WANTED = np.array([0.8, 0.1])


@pytest.fixture
def rules(tmp_path: Path) -> str:
    path = tmp_path / "cart.ross"
    path.write_text(RULES, encoding="utf-8")
    return str(path)


def guarded(rules: str, env: Any = None, **changed: Any) -> GuardedEnv:
    given: dict[str, Any] = {"period_ns": PERIOD_NS, "observe": OBSERVE, "act": ACT}
    return GuardedEnv(env or Cart(), rules, **{**given, **changed})


def fast() -> np.ndarray[Any, Any]:
    return np.ones(1, np.float32)


# --- copies ----------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("copied", [copy, deepcopy])
def test_a_copy_of_a_guard_knows_the_same_and_goes_its_own_way(
    kind: str, copied: Any, tmp_path: Path
) -> None:
    guard = guard_of(kind, tmp_path)
    fresh = copied(guard)
    guard.step(0, HELD, WANTED)
    other = copied(guard)
    assert other.step(1, CALM, WANTED).active == ("held_up",), "it is latched in the copy, too"
    guard.restart()
    assert guard.step(0, CALM, WANTED).active == ()
    assert other.step(2, CALM, WANTED).active == ("held_up",)
    assert fresh.step(0, CALM, WANTED).active == ()


@needs_c
def test_a_guard_goes_through_a_pickle(tmp_path: Path) -> None:
    guard = guard_of("native", tmp_path)
    guard.step(5, HELD, WANTED)
    other: Guard = pickle.loads(pickle.dumps(guard))
    assert other.step(6, CALM, WANTED).active == ("held_up",)
    with pytest.raises(ValueError, match="time goes back"):
        other.step(5, CALM, WANTED)


@needs_c
def test_a_guard_in_a_row_cannot_be_copied(tmp_path: Path) -> None:
    batch = guard_of("native", tmp_path).batch(2)
    for copied in (deepcopy, pickle.dumps):
        with pytest.raises(TypeError):
            copied(batch)


@needs_c
def test_a_copy_of_an_environment_has_a_guard_of_its_own(rules: str) -> None:
    env = guarded(rules, Cart(start=0.35))
    env.reset()
    other = deepcopy(env)
    assert other.guard is not env.guard
    for _ in range(12):
        reported = env.step(fast())[4]["guard"]
    assert reported["active"][1]
    assert not other.step(np.zeros(1, np.float32))[4]["guard"]["active"][1], "it stood still"
    assert other.unwrapped is not env.unwrapped
    again: GuardedEnv = pickle.loads(pickle.dumps(guarded(rules)))
    again.reset()
    assert not again.step(np.zeros(1, np.float32))[4]["guard"]["intervened"]


# --- threads and processes -------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_threads_wait_for_each_other(kind: str, tmp_path: Path) -> None:
    guard = guard_of(kind, tmp_path)
    guard.observe(0, FAST)

    def work(number: int) -> bool:
        for _ in range(200):
            if number % 2:
                guard.allows(np.array([[0.1, 0.0], [0.8, 0.0]]))
                guard.observe(0, FAST)
            elif guard.decide(WANTED).action.tolist() != [0.2, 0.1]:
                return False
        return True

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(work, range(4)))


class Watched:
    """A row of guards that only one thread may be in."""

    def __init__(self, row: Any) -> None:
        self._row = row
        self._inside = 0

    def __getattr__(self, name: str) -> Any:
        call = getattr(self._row, name)

        def alone(*given: Any) -> Any:
            self._inside += 1
            assert self._inside == 1
            time.sleep(0.001)
            found = call(*given)
            self._inside -= 1
            return found

        return alone


@needs_c
def test_threads_of_a_row_wait_for_each_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    batch = guard_of("native", tmp_path).batch(3)
    seen, wanted = np.tile(FAST, (3, 1)), np.tile(WANTED, (3, 1))
    batch.step(0, seen, wanted)
    monkeypatch.setattr(batch, "_row", Watched(batch._row))

    def work(number: int) -> bool:
        for _ in range(10):
            if number % 2:
                batch.allows(wanted)
                assert batch.margin.shape == (3, 2)
            elif (batch.step(0, seen, wanted).actions[:, 0] != 0.2).any():
                return False
        return True

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(work, range(4)))


@needs_c
def test_environments_in_processes(rules: str) -> None:
    given: dict[str, Any] = {"period_ns": PERIOD_NS, "observe": OBSERVE, "act": ACT}
    made = partial(GuardedEnv, Cart(), rules, **given)
    for envs in (
        AsyncVectorEnv([made] * 2, context="spawn"),
        GuardedVectorEnv(AsyncVectorEnv([Cart] * 2, context="spawn"), rules, **given),
    ):
        envs.reset()
        for _ in range(6):
            infos = envs.step(np.ones((2, 1), np.float32))[4]
        assert infos["guard"]["intervened"].tolist() == [True, True]
        envs.close()


# --- environments and policies that go wrong ---------------------------------------------------


class Broken(Cart):
    """A cart whose simulation fails, or whose observations become others."""

    trouble: Any = None

    def step(self, action: Any) -> Any:
        seen, *rest = super().step(action)
        if isinstance(self.trouble, Exception):
            raise self.trouble
        return (seen if self.trouble is None else self.trouble), *rest


@needs_c
def test_after_an_environment_has_raised_another_episode_is_guarded(rules: str) -> None:
    cart = Broken(start=0.35)
    env = guarded(rules, cart)
    env.reset()
    cart.trouble = RuntimeError("the simulation diverges")
    for _ in range(3):
        with pytest.raises(RuntimeError, match="diverges"):
            env.step(fast())
    assert max(cart.executed) <= np.float32(0.05), "the guard has bounded what was executed"
    cart.trouble = None
    env.reset()
    assert env.step(fast())[4]["guard"]["intervened"]


@needs_c
@pytest.mark.parametrize(
    ("trouble", "words"),
    [
        (np.zeros(3), "has 3 numbers, but had 2 at first"),
        (np.zeros(0), "has 0 numbers, but had 2 at first"),
        (np.array(["a", "b"]), None),
        (None, None),
    ],
)
def test_an_observation_of_another_space_is_refused(
    rules: str, trouble: Any, words: str | None
) -> None:
    cart = Broken()
    env = guarded(rules, cart)
    env.reset()
    if trouble is None:
        cart.trouble, env.observation_space = {"range": 1.0}, spaces.Dict({})
    else:
        cart.trouble = trouble
    with pytest.raises((MappingError, ValueError, TypeError), match=words):
        env.step(fast())


@needs_c
def test_observations_that_are_not_numbers_hold_the_robot(rules: str) -> None:
    cart = Broken()
    env = guarded(rules, cart)
    env.reset()
    cart.trouble = np.full(2, np.nan)
    env.step(fast())
    assert env.step(fast())[4]["guard"]["executed"] == 0.0


@needs_c
def test_steps_before_the_first_reset_are_refused(rules: str) -> None:
    env = guarded(rules)
    with pytest.raises(ValueError, match="there is no step yet"):
        env.step(fast())


# --- sizes -----------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_a_row_of_one_is_a_guard_and_a_row_of_none_is_refused(kind: str, tmp_path: Path) -> None:
    guard = guard_of(kind, tmp_path)
    for count in (0, -1):
        with pytest.raises(ValueError, match="at least one guard"):
            guard.batch(count)
    batch = guard.batch(1)
    for at_ns, seen in enumerate((CALM, FAST, HELD, CALM)):
        alone = guard.step(at_ns, seen, WANTED)
        found = batch.step(at_ns, seen[None], WANTED[None])
        assert found.actions[0].tobytes() == alone.action.tobytes()
        assert [rule in alone.active for rule in guard.rules] == found.active[0].tolist()
    assert batch.allows(np.zeros((0, 2))).shape == (1, 0)


@pytest.mark.parametrize("kind", KINDS)
def test_actions_that_are_not_numbers_become_zero_in_their_row_only(
    kind: str, tmp_path: Path
) -> None:
    batch = guard_of(kind, tmp_path).batch(3)
    wanted = np.array([[0.5, 0.1], [np.nan, 0.1], [np.inf, np.nan]], np.float32)
    found = batch.step(0, np.tile(CALM, (3, 1)), wanted)
    np.testing.assert_array_equal(found.actions, np.array([[0.5, 0.1], [0, 0], [0, 0]], np.float32))
    assert found.changed.tolist() == [False, True, True]
    assert batch.allows(wanted).tolist() == [[True, False, False]] * 3


@needs_c
@pytest.mark.parametrize("mode", list(AutoresetMode))
@pytest.mark.parametrize("kind", ["speed", "choice"])
def test_episodes_of_no_length_and_of_one_step(rules: str, kind: str, mode: AutoresetMode) -> None:
    act: Any = ACT if kind == "speed" else {"linear.x": CHOICES}
    carts = [lambda: Cart(start=0.35, steps=1, kind=kind)] * 2
    envs = GuardedVectorEnv(
        SyncVectorEnv(carts, autoreset_mode=mode), rules, period_ns=PERIOD_NS, observe=OBSERVE,
        act=act,
    )  # fmt: skip
    wanted = np.ones((2, 1), np.float32) if kind == "speed" else np.array([3, 3])
    for _ in range(3):
        envs.reset()  # and nothing was done in the episode before
    for _ in range(5):
        _, _, terminated, truncated, infos = envs.step(wanted)
        done = infos["guard"]["_executed"]
        assert (infos["guard"]["executed"].ravel()[done] <= (0.05 if kind == "speed" else 2)).all()
        assert not infos["guard"]["active"][:, 1].any(), "0.345 m at the most: it begins anew"
        if mode is AutoresetMode.DISABLED:
            envs.reset(options={"reset_mask": terminated | truncated})
