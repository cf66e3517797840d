"""Learners behind a guard (thesis, chapter 6): whichever they are, they explore within bounds, by
the rules that hold in operation, and in whichever environment.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest

import rossmarie
from rossmarie.gym import GuardedEnv
from support.c_compiler import needs_c
from support.carts import CHOICES, OBSERVE, PERIOD_NS, RULES, Cart

pytestmark = needs_c
EPISODES = 30
Chance = np.random.Generator


@pytest.fixture
def rules(tmp_path: Path) -> str:
    path = tmp_path / "cart.ross"
    path.write_text(RULES, encoding="utf-8")
    return str(path)


class Watched(Cart):
    """A cart with choices that wants to be fast, and that notes where it was when it did what."""

    def __init__(self) -> None:
        super().__init__(start=0.75, steps=25, kind="choice")
        self.noted: list[tuple[float, float]] = []

    def step(self, action: Any) -> Any:
        before = self._distance
        found = super().step(action)
        self.noted.append((before, self.executed[-1]))
        return found


def state_of(observation: Any) -> int:
    return int(np.clip(observation[0] / 100.0, 0, 10))


def episode(env: GuardedEnv, choose: Callable[[int], int]) -> list[tuple[int, int, float, int]]:
    """State, choice, reward and next state of each step; nobody intervenes."""
    observation, _ = env.reset()
    found, is_over = [], False
    while not is_over:
        state = state_of(observation)
        choice = choose(state)
        observation, reward, terminated, truncated, _ = env.step(choice)
        found.append((state, choice, float(reward), state_of(observation)))
        is_over = terminated or truncated
    return found


def softmax_choice(preferences: np.ndarray[Any, Any], chance: Chance) -> int:
    likely = np.exp(preferences - preferences.max())
    return int(chance.choice(len(CHOICES), p=likely / likely.sum()))


def reinforce(env: GuardedEnv, chance: Chance) -> None:
    """On-policy: the gradient of whole returns."""
    table = np.zeros((11, len(CHOICES)))
    for _ in range(EPISODES):
        steps = episode(env, lambda state: softmax_choice(table[state], chance))
        total = sum(reward for _, _, reward, _ in steps)
        for state, choice, _, _ in steps:
            table[state, choice] += 0.05 * total


def sarsa(env: GuardedEnv, chance: Chance) -> None:
    """On-policy: differences along what was chosen."""
    values = np.zeros((11, len(CHOICES)))
    for _ in range(EPISODES):
        steps = episode(env, lambda state: softmax_choice(5.0 * values[state], chance))
        for (state, choice, reward, after), (_, then, _, _) in pairwise(steps):
            wanted = reward + 0.9 * values[after, then]
            values[state, choice] += 0.2 * (wanted - values[state, choice])


def q_learning(env: GuardedEnv, chance: Chance) -> None:
    """Off-policy: the best of what might be chosen, from a memory."""
    values = np.zeros((11, len(CHOICES)))
    memory: list[tuple[int, int, float, int]] = []

    def greedy(state: int) -> int:
        best = int(values[state].argmax())
        return int(chance.integers(len(CHOICES))) if chance.random() < 0.3 else best

    for _ in range(EPISODES):
        memory += episode(env, greedy)
        for place in chance.integers(len(memory), size=50):
            state, choice, reward, after = memory[place]
            wanted = reward + 0.9 * values[after].max()
            values[state, choice] += 0.2 * (wanted - values[state, choice])


def random_search(env: GuardedEnv, chance: Chance) -> None:
    """A black-box optimizer: it knows the parameters of a policy and the sum of its rewards."""
    best, most = np.zeros((11, len(CHOICES))), -np.inf
    for _ in range(EPISODES):
        tried = best + chance.normal(0.0, 1.0, best.shape)
        steps = episode(env, lambda state, tried=tried: int(tried[state].argmax()))  # type: ignore[misc]
        total = sum(reward for _, _, reward, _ in steps)
        if total > most:
            best, most = tried, total


@pytest.mark.parametrize("learn", [reinforce, sarsa, q_learning, random_search])
def test_each_learner_explores_within_the_bounds_of_the_rules(
    rules: str, learn: Callable[[GuardedEnv, Chance], None]
) -> None:
    cart = Watched()
    env = GuardedEnv(
        cart,
        rules,
        period_ns=PERIOD_NS,
        observe=OBSERVE,
        act={"linear.x": CHOICES},
    )
    learn(env, np.random.default_rng(3))
    assert len(cart.noted) > EPISODES
    assert any(distance >= 0.6 and speed > 0.05 for distance, speed in cart.noted), "it explores"
    near = [speed for distance, speed in cart.noted if distance < 0.6 - 1e-9]
    assert near
    assert max(near) <= 0.05, "in each step of the training"
    assert min(distance for distance, _ in cart.noted) > 0.25


def test_the_same_file_says_the_same_in_operation_and_in_training(rules: str) -> None:
    env = GuardedEnv(Cart(), rules, period_ns=PERIOD_NS, observe=OBSERVE, act={"linear.x": 0})
    monitor = rossmarie.load(rules)
    chance = np.random.default_rng(5)
    seen, _ = env.reset()
    walls, active = [seen[0] / 1000.0], [env.guard.observe(0, seen).tolist()]
    for _ in range(20):
        action = chance.uniform(-0.2, 1.0, 1).astype(np.float32)
        seen, _, _, _, info = env.step(action)
        walls.append(seen[0] / 1000.0)
        active.append(info["guard"]["active"].tolist())
    assert any(map(any, active))
    times_ns = np.arange(len(walls)) * PERIOD_NS
    run = monitor.run(times_ns, {"wall": np.array(walls)})
    assert run.active.tolist() == active, "of columns, as a replay has them"
    for at_ns, wall, wanted in zip(times_ns.tolist(), walls, active, strict=True):
        monitor.update(at_ns, {"wall": wall})
        found = [name in monitor.active for name in monitor.rules]
        assert found == wanted, "message by message, as on a robot"


BASE = """
system robot { topic /drive : geometry_msgs/Twist; node policy { publishes /drive; } }
action gently { limit /drive { linear.x in [-0.5, 0.5] m/s; }; }
"""
PUBLIC: list[tuple[str, str, dict[str, Any], dict[str, Any]]] = [
    (
        "Pendulum-v1",
        """input spin = topic /spin : std_msgs/Float64 .data in rad/s timeout 1 sec;
        rule swings: if spin not in [-1, 1] rad/s then { gently; } feedback margin in deg/s;""",
        {"spin": 2},
        {"linear.x": 0},
    ),
    (
        "MountainCarContinuous-v0",
        """input height = topic /place : std_msgs/Float64 .data in m timeout 1 sec;
        rule left: if height < -0.5 m then { gently; } feedback 1 per activation;""",
        {"height": (0, "m")},
        {"linear.x": 0},
    ),
    (
        "CartPole-v1",
        """input tilt = topic /tilt : std_msgs/Float64 .data in rad timeout 1 sec;
        rule tilts: if tilt > 1 deg then { gently; };""",
        {"tilt": (2, "rad")},
        {"linear.x": [-1.0, 0.4]},
    ),
]


@pytest.mark.parametrize(
    ("name", "text", "observe", "act"), PUBLIC, ids=[each[0] for each in PUBLIC]
)
def test_any_environment_is_guarded_by_a_mapping(
    tmp_path: Path, name: str, text: str, observe: dict[str, Any], act: dict[str, Any]
) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(BASE + text, encoding="utf-8")
    env = GuardedEnv(gymnasium.make(name), path, period_ns=20_000_000, observe=observe, act=act)
    env.reset(seed=1)
    env.action_space.seed(1)
    was_active, intervened = False, 0
    for _ in range(200):
        _, _, terminated, truncated, info = env.step(env.action_space.sample())
        reported = info["guard"]
        intervened += bool(reported["intervened"])
        if was_active and isinstance(env.action_space, gymnasium.spaces.Box):
            assert abs(float(reported["executed"][0])) <= 0.5
        elif was_active:
            assert reported["executed"] == 1
        was_active = bool(reported["active"].any())
        if terminated or truncated:
            env.reset()
            was_active = False
    assert intervened


def test_a_network_that_nobody_can_read_is_guarded(rules: str) -> None:
    chance = np.random.default_rng(9)
    first, second = chance.normal(size=(16, 2)), chance.normal(size=(1, 16))
    guard = rossmarie.load(rules).guard(observe={"wall": 0}, act={"linear.x": 0})
    changed = 0
    for number in range(300):
        wall = float(chance.uniform(0.0, 1.5))
        wanted = second @ np.tanh(first @ np.array([wall, number / 300]))
        decision = guard.step(number * PERIOD_NS, np.array([wall]), wanted)
        changed += decision.changed
        if "at_wall" in decision.active:
            assert decision.action.tolist() == [0.0]
        elif "close" in decision.active:
            assert -0.3 <= decision.action[0] <= 0.05
        else:
            assert decision.action.tobytes() == wanted.tobytes()
    assert changed
