"""The scene of figure 4 as an environment, and what its rules change."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count
from typing import Any

import numpy as np
import pytest

from support.c_compiler import needs_c
from support.parts import MUJOCO, require

require(MUJOCO)

import gymnasium
from gymnasium.utils.env_checker import check_env

import heron.learning  # noqa: F401  # registers the environments
from heron.learning.arms import guarded, is_guarded
from heron.learning.environment import MOVES, PegInHole
from heron.learning.insertion import InsertionOutcome
from heron.variants import LearningArm
from support.insertions import Floats, Policy, into_the_fragile_part, wandering

NAMES = ("heron/PegInHole-v1", "heron/PegInHoleMoves-v1")
HOLE = np.array([-0.6, 0.0, 0.7])
V1 = ((-0.93, -0.13), (-0.6, 0.6), (0.6, 1.3))
V2 = ((-0.8, -0.2), (0.1, 0.5), (0.65, 1.3))


def made(name: str = NAMES[0]) -> gymnasium.Env[Any, Any]:
    return gymnasium.make(name, disable_env_checker=True)


def inserting(seen: Floats, step: int) -> Floats:
    """A policy that goes above the hole, then down, and searches in a small circle."""
    offset = seen[:3] - HOLE
    aside = float(np.hypot(*offset[:2]))
    speed = -3.0 * offset[:2]
    speed /= max(1.0, float(np.abs(speed).max()) / 0.3)
    if aside > 0.003 and offset[2] > 0.02:
        return np.array([*speed, -3.0 * (offset[2] - 0.05), 0.0])
    if offset[2] > 0.01:
        return np.array([*speed, -0.1, 0.0])
    turn = step / 4
    return np.array([*(speed + 0.02 * np.array([np.cos(turn), np.sin(turn)])), 0.0, -8.0])


def episode(env: Any, policy: Policy, seed: int) -> Iterator[tuple[Floats, Any]]:
    """The place of the peg after each step, and what the step reported."""
    seen, _ = env.reset(seed=seed)
    task = env.unwrapped
    for step in count():
        action = np.clip(policy(seen, step), env.action_space.low, env.action_space.high)
        seen, _, terminated, truncated, info = env.step(action.astype(np.float32))
        yield task.insertion.arm.place, info
        if terminated or truncated:
            return


def outcome(env: Any, policy: Policy, seed: int) -> InsertionOutcome:
    """Run an episode, and give its outcome."""
    *_, (_, info) = episode(env, policy, seed)
    found: InsertionOutcome = info["outcome"]
    return found


def is_inside(place: Floats, box: tuple[tuple[float, float], ...]) -> bool:
    return all(low < each < high for each, (low, high) in zip(place, box, strict=True))


# Actions have units here, and a contact may be of any force.
@pytest.mark.filterwarnings("ignore:.*(symmetric and normalized|probably too)")
@pytest.mark.parametrize("name", NAMES)
def test_it_is_an_environment(name: str) -> None:
    check_env(made(name).unwrapped, skip_render_check=True)


def test_the_same_seed_gives_the_same_episode() -> None:
    first, second = (list(episode(made(), wandering(1), seed=5)) for _ in range(2))
    assert [place.tolist() for place, _ in first] == [place.tolist() for place, _ in second]


@pytest.mark.parametrize("arm", [LearningArm.UNGUARDED, LearningArm.GUARD])
def test_the_peg_can_be_inserted_from_all_starts(arm: LearningArm) -> None:
    env = guarded(made(), arm)
    found = [outcome(env, inserting, seed) for seed in range(10)]
    assert all(each.inserted for each in found)
    assert not is_guarded(arm) or not any(each.violations for each in found)


def test_without_rules_the_fragile_part_breaks() -> None:
    assert outcome(made(), into_the_fragile_part, 1).broken


@needs_c
@pytest.mark.parametrize("seed", range(5))
def test_rules_keep_the_peg_where_it_may_be(seed: int) -> None:
    env = guarded(made(), LearningArm.GUARD)
    for policy in (wandering(seed), into_the_fragile_part):
        steps = list(episode(env, policy, seed))
        assert all(is_inside(place, V1) and not is_inside(place, V2) for place, _ in steps)
        found = steps[-1][1]["outcome"]
        assert found.violations == ()
        assert not found.broken


@needs_c
def test_an_episode_ends_with_a_violation() -> None:
    env = guarded(made(), LearningArm.ENDED)
    *_, (_, info) = episode(env, into_the_fragile_part, 1)
    assert "touched" in info["outcome"].violations
    assert info["outcome"].seconds < 12.0


@needs_c
def test_a_choice_may_always_be_to_stand() -> None:
    env = guarded(made(NAMES[1]), LearningArm.GUARD)
    env.reset(seed=2)
    chance = np.random.default_rng(2)
    for _ in range(200):
        _, _, _, truncated, info = env.step(int(chance.integers(len(MOVES))))
        assert info["action_mask"][0]
        if truncated:
            break


def test_actions_outside_of_the_space_are_bounded_or_refused() -> None:
    bounded, usual = made(), made()
    for env in (bounded, usual):
        env.reset(seed=4)
    greatest = usual.action_space.high  # type: ignore[attr-defined]
    assert np.array_equal(bounded.step(np.full(4, 1e9))[0], usual.step(greatest)[0])
    with pytest.raises(ValueError, match="four finite numbers, not"):
        bounded.step(np.array([0.0, np.nan, 0.0, 0.0]))


def test_physics_of_moves_are_those_of_commands() -> None:
    chosen, commanded = made(NAMES[1]), made()
    for env in (chosen, commanded):
        env.reset(seed=3)
    for move in (1, 4, 5, 13):
        seen = chosen.step(move)[0]
        assert np.array_equal(seen, commanded.step(np.array(MOVES[move]))[0])
    assert isinstance(chosen.unwrapped, PegInHole)
