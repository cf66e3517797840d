"""Learners of step policies, from skrl (on JAX): PPO, SAC and DDQN.

Actions are scaled to [-1, 1]. An episode that ends by its time ends like any other: the time that
is left is part of an observation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol

import flax.serialization
import jax
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray
from skrl import config
from skrl.agents.jax.ddqn import DDQN, DDQN_CFG
from skrl.agents.jax.ppo import PPO, PPO_CFG
from skrl.agents.jax.sac import SAC, SAC_CFG
from skrl.memories.jax import RandomMemory
from skrl.resources.schedulers.jax import KLAdaptiveLR

from heron.learning.networks import Categorical, Critic, Gaussian, Squashed, is_choice

Floats = NDArray[np.float64]
_ROLLOUT = 64
_KEPT = 100_000
_FOREVER = 10**9
_EXPLORING = 100_000
"""Steps in which DDQN comes to choose by chance in one of 20 steps only."""


class StepLearner(Protocol):
    """Learns from the steps of several environments at once."""

    def act(self, observations: Floats) -> Any:
        """Actions to try, by chance."""

    def best(self, observations: Floats) -> Any:
        """The actions that are held for the best."""

    def learn(
        self,
        observations: Floats,
        actions: Any,
        rewards: Floats,
        following: Floats,
        ended: NDArray[np.bool_],
    ) -> None:
        """Learn from a step: what was seen, done and earned, and what was seen then."""

    def save(self, path: Path) -> None:
        """Keep what was learned."""

    def load(self, path: Path) -> None:
        """Know what was kept."""


class SkrlLearner:
    """An agent of skrl."""

    def __init__(
        self,
        algorithm: str,
        observations: spaces.Box,
        actions: spaces.Box | spaces.Discrete,
        count: int,
        seed: int,
    ) -> None:
        config.jax.backend = "jax"
        config.jax.key = jax.random.key_data(jax.random.key(seed))
        np.random.seed(seed)  # skrl's memories draw from it
        self._actions = actions
        scaled = actions if is_choice(actions) else spaces.Box(-1.0, 1.0, actions.shape)
        self._agent = AGENTS[algorithm](observations, scaled, count)
        self._models = {name: each for name, each in self._agent.models.items() if each is not None}
        self._agent.init()
        self._agent.enable_training_mode(True)
        self._step = 0

    def act(self, observations: Floats) -> Any:
        """Actions to try, by chance."""
        self._agent.pre_interaction(timestep=self._step, timesteps=_FOREVER)
        found, _ = self._agent.act(
            _floats(observations), None, timestep=self._step, timesteps=_FOREVER
        )
        return self._unscaled(np.asarray(found))

    def best(self, observations: Floats) -> Any:
        """The actions that are held for the best."""
        self._agent.enable_training_mode(False)
        found, more = self._agent.act(
            _floats(observations), None, timestep=_FOREVER, timesteps=_FOREVER
        )
        self._agent.enable_training_mode(True)
        return self._unscaled(np.asarray(more.get("mean_actions", found)))

    def learn(
        self,
        observations: Floats,
        actions: Any,
        rewards: Floats,
        following: Floats,
        ended: NDArray[np.bool_],
    ) -> None:
        """Learn from a step: what was seen, done and earned, and what was seen then."""
        self._agent.record_transition(
            observations=_floats(observations),
            states=None,
            actions=jax.numpy.asarray(self._scaled(actions)),
            rewards=_floats(rewards)[:, None],
            next_observations=_floats(following),
            next_states=None,
            terminated=jax.numpy.asarray(ended, jax.numpy.int8)[:, None],
            truncated=jax.numpy.zeros((len(ended), 1), jax.numpy.int8),
            infos={},
            timestep=self._step,
            timesteps=_FOREVER,
        )
        self._agent.post_interaction(timestep=self._step, timesteps=_FOREVER)
        self._step += 1

    def save(self, path: Path) -> None:
        """Keep what was learned."""
        known = {name: model.state_dict.params for name, model in self._models.items()}
        path.write_bytes(flax.serialization.to_bytes(known))

    def load(self, path: Path) -> None:
        """Know what was kept. Raises `ValueError` if that is of another learner."""
        known = {name: model.state_dict.params for name, model in self._models.items()}
        found = flax.serialization.from_bytes(known, path.read_bytes())
        for name, model in self._models.items():
            model.state_dict = model.state_dict.replace(params=found[name])

    def _unscaled(self, actions: Any) -> Any:
        if is_choice(self._actions):
            return actions.reshape(-1).astype(np.int64)
        low, high = self._actions.low, self._actions.high
        return low + (np.clip(actions, -1.0, 1.0) + 1.0) / 2.0 * (high - low)

    def _scaled(self, actions: Any) -> Any:
        if is_choice(self._actions):
            return np.asarray(actions)[:, None]
        low, high = self._actions.low, self._actions.high
        return (np.asarray(actions) - low) / (high - low) * 2.0 - 1.0


class ExecutedPPO(PPO):  # type: ignore[misc]
    """PPO that takes the actions of a transition for its own, also where they were changed."""

    def record_transition(self, *, observations: Any, actions: Any, **given: Any) -> None:
        """Note how likely these actions were."""
        inputs = {"observations": observations, "taken_actions": actions}
        _, outputs = self.policy.act(inputs, role="policy")
        self._current_log_prob = outputs["log_prob"]
        super().record_transition(observations=observations, actions=actions, **given)


def _ppo(observations: spaces.Box, actions: Any, count: int) -> Any:
    policy = Categorical if is_choice(actions) else Gaussian
    settings = PPO_CFG(
        rollouts=_ROLLOUT,
        learning_epochs=6,
        mini_batches=4,
        learning_rate=1e-3,
        learning_rate_scheduler=KLAdaptiveLR,
        learning_rate_scheduler_kwargs={"kl_threshold": 0.01},
        value_loss_scale=0.5,
    )
    models = _models({"policy": policy, "value": Critic}, observations, actions)
    memory = RandomMemory(memory_size=_ROLLOUT, num_envs=count)
    return _agent(ExecutedPPO, settings, models, memory, observations, actions)


def _sac(observations: spaces.Box, actions: Any, count: int) -> Any:
    settings = SAC_CFG(
        batch_size=256,
        gradient_steps=2,
        learning_rate=1e-3,
        learning_starts=50,
        random_timesteps=50,
        initial_entropy_value=0.1,
    )
    critics = ("critic_1", "critic_2", "target_critic_1", "target_critic_2")
    models = _models({"policy": Squashed, **dict.fromkeys(critics, Critic)}, observations, actions)
    memory = RandomMemory(memory_size=_KEPT // count, num_envs=count)
    return _agent(SAC, settings, models, memory, observations, actions)


def _ddqn(observations: spaces.Box, actions: Any, count: int) -> Any:
    settings = DDQN_CFG(
        batch_size=256,
        gradient_steps=2,
        learning_rate=5e-4,
        learning_starts=50,
        random_timesteps=50,
        exploration_scheduler=lambda step, _: max(0.05, 1.0 - step * count / _EXPLORING),
    )
    names = dict.fromkeys(("q_network", "target_q_network"), Critic)
    memory = RandomMemory(memory_size=_KEPT // count, num_envs=count)
    return _agent(
        DDQN, settings, _models(names, observations, actions), memory, observations, actions
    )


def _models(kinds: Mapping[str, type], observations: Any, actions: Any) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, kind in kinds.items():
        found[name] = kind(observation_space=observations, action_space=actions)
        found[name].init_state_dict(role=name)
    return found


def _agent(
    kind: type, settings: Any, models: Any, memory: Any, observations: Any, actions: Any
) -> Any:
    settings.experiment.write_interval = settings.experiment.checkpoint_interval = 0
    return kind(
        models=models,
        memory=memory,
        observation_space=observations,
        action_space=actions,
        cfg=settings,
    )


def _floats(values: Any) -> Any:
    return jax.numpy.asarray(values, jax.numpy.float32)


AGENTS: Mapping[str, Callable[..., Any]] = {"ppo": _ppo, "sac": _sac, "ddqn": _ddqn}
