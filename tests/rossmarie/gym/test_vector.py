"""Many environments behind guards: as each one by itself, in all ways to begin anew."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorEnv

from rossmarie.guard import MappingError
from rossmarie.gym import GuardedEnv, GuardedVectorEnv
from support.c_compiler import needs_c
from support.carts import ACT, CHOICES, OBSERVE, PERIOD_NS, RULES, Cart

pytestmark = needs_c
COUNT = 4
MODES = list(AutoresetMode)


@pytest.fixture
def rules(tmp_path: Path) -> str:
    path = tmp_path / "cart.ross"
    path.write_text(RULES, encoding="utf-8")
    return str(path)


def carts(kind: str, mode: AutoresetMode) -> SyncVectorEnv:
    """Carts whose episodes end at different steps."""

    def make(number: int) -> Any:
        return lambda: Cart(start=0.5 + 0.2 * number, steps=6 + number, kind=kind)

    return SyncVectorEnv([make(number) for number in range(COUNT)], autoreset_mode=mode)


def declared(kind: str) -> dict[str, Any]:
    act: Any = {"linear.x": CHOICES} if kind == "choice" else ACT
    targets = None
    if kind == "place":
        act, targets = {"linear.x": (0, "m")}, {"linear.x": 1}
    return {
        "period_ns": PERIOD_NS,
        "observe": OBSERVE,
        "act": act,
        "targets": targets,
        "with_feedback": True,
    }


def wanted_actions(kind: str, steps: int) -> Iterator[Any]:
    chance = np.random.default_rng(7)
    for _ in range(steps):
        if kind == "choice":
            yield chance.integers(0, len(CHOICES), COUNT)
        else:
            yield chance.uniform(-0.5, 1.5, (COUNT, 1)).astype(np.float32)


def alone(
    rules: str, kind: str, steps: int, mode: AutoresetMode, *, enforce: bool = True
) -> list[list[Any]]:
    """The actions and reports of separate environments, for each step and each environment."""
    envs = [
        GuardedEnv(cart, rules, **declared(kind), enforce=enforce)
        for cart in carts(kind, mode).envs
    ]
    for env in envs:
        env.reset()
    ended = [False] * COUNT
    found: list[list[Any]] = []
    for actions in wanted_actions(kind, steps):
        reported: list[Any] = []
        for number, env in enumerate(envs):
            if ended[number] and mode is AutoresetMode.NEXT_STEP:
                env.reset()
                ended[number] = False
                reported.append(None)
                continue
            _, reward, terminated, truncated, info = env.step(actions[number])
            reported.append((info["guard"] | {"reward": reward}, info["cost"]))
            ended[number] = terminated or truncated
            if ended[number] and mode is not AutoresetMode.NEXT_STEP:
                env.reset()
        found.append(reported)
    return found


def together(
    rules: str, kind: str, steps: int, mode: AutoresetMode, *, enforce: bool = True
) -> list[list[Any]]:
    """The same of all of them in one call."""
    envs = GuardedVectorEnv(carts(kind, mode), rules, **declared(kind), enforce=enforce)
    envs.reset()
    found: list[list[Any]] = []
    for actions in wanted_actions(kind, steps):
        _, rewards, terminated, truncated, infos = envs.step(actions)
        guard = infos["guard"] | {"reward": rewards}
        anew = ~guard["_executed"]
        for each in (rewards, infos["cost"], guard["feedback"], guard["intervened"]):
            assert not each[anew].any()
        found.append(
            [
                (
                    {name: guard[name][number] for name in guard if name[0] != "_"},
                    infos["cost"][number],
                )
                if guard["_executed"][number]
                else None
                for number in range(COUNT)
            ]
        )
        ended = terminated | truncated
        if mode is AutoresetMode.DISABLED and ended.any():
            envs.reset(options={"reset_mask": ended})
    return found


def plain(found: list[list[Any]]) -> list[list[Any]]:
    return [
        [
            None
            if each is None
            else ({name: np.asarray(value).tolist() for name, value in each[0].items()}, each[1])
            for each in reported
        ]
        for reported in found
    ]


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("enforce", [True, False])
@pytest.mark.parametrize("kind", ["speed", "choice", "place"])
def test_each_is_guarded_as_by_itself(
    rules: str, kind: str, enforce: bool, mode: AutoresetMode
) -> None:
    wanted = plain(alone(rules, kind, 40, mode, enforce=enforce))
    assert plain(together(rules, kind, 40, mode, enforce=enforce)) == wanted
    assert any(each and each[0]["intervened"] for reported in wanted for each in reported)
    assert any(each and sum(each[0]["feedback"]) for reported in wanted for each in reported)
    assert any(each and not each[0]["intervened"] for reported in wanted for each in reported)
    margins = [each[0]["margin"][0] for reported in wanted for each in reported if each]
    assert min(margins) < 0 < max(margins)


def test_the_last_observation_of_an_episode_is_seen_before_the_next_begins(rules: str) -> None:
    envs = GuardedVectorEnv(
        SyncVectorEnv([lambda: Cart(start=0.65, steps=2)], autoreset_mode=AutoresetMode.SAME_STEP),
        rules,
        **declared("speed"),
    )
    envs.reset()
    for _ in range(3):
        envs.step(np.array([[0.4]], np.float32))
        seen, _, _, truncated, infos = envs.step(np.array([[0.4]], np.float32))
        assert truncated.tolist() == [True]
        assert seen[0, 0] == pytest.approx(650.0)
        assert infos["guard"]["active"].tolist() == [[True, False]], "at 0.57 m, the last one"
        assert infos["cost"].tolist() == [1.0]


def test_masks_of_choices_are_those_of_the_next_step(rules: str) -> None:
    envs = GuardedVectorEnv(carts("choice", AutoresetMode.SAME_STEP), rules, **declared("choice"))
    _, infos = envs.reset()
    assert infos["action_mask"].tolist() == [[1, 1, 1, 0], *[[1, 1, 1, 1]] * 3]
    infos = envs.step(np.full(COUNT, 3))[4]
    assert infos["action_mask"].shape == (COUNT, len(CHOICES))


def test_environments_in_which_no_choice_passes_are_reported(rules: str) -> None:
    given = declared("choice") | {"act": {"linear.x": [0.1, 0.2, 0.3, 0.4]}}
    two = [lambda: Cart(start=0.45, kind="choice"), lambda: Cart(start=2.0, kind="choice")]
    envs = GuardedVectorEnv(SyncVectorEnv(two), rules, **given)
    for infos in (envs.reset()[1], envs.step(np.array([1, 1]))[4]):
        assert infos["no_choice_passes"].tolist() == [True, False]
        assert infos["_no_choice_passes"].all()


def test_only_environments_that_are_reset_by_a_mask_can_be_truncated(rules: str) -> None:
    for mode in (AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP):
        with pytest.raises(MappingError, match="reset by a mask"):
            GuardedVectorEnv(carts("speed", mode), rules, **declared("speed"), latched="truncate")
    two = [lambda: Cart(start=0.31), lambda: Cart(start=1.0)]
    envs = GuardedVectorEnv(
        SyncVectorEnv(two, autoreset_mode=AutoresetMode.DISABLED),
        rules,
        **declared("speed"),
        latched="truncate",
    )
    envs.reset()
    for _ in range(3):
        _, _, terminated, truncated, infos = envs.step(np.full((2, 1), 0.05, np.float32))
    assert infos["guard"]["active"].tolist() == [[True, True], [False, False]]
    assert (terminated.any(), truncated.tolist()) == (False, [True, False])
    envs.reset(options={"reset_mask": truncated})
    assert not envs.step(np.zeros((2, 1), np.float32))[3].any()


def test_environments_that_do_not_say_how_they_begin_anew(rules: str) -> None:
    env: VectorEnv[Any, Any, Any] = carts("speed", AutoresetMode.NEXT_STEP)
    env.metadata = {}
    with pytest.warns(UserWarning, match="does not say its autoreset_mode"):
        GuardedVectorEnv(env, rules, **declared("speed"))
