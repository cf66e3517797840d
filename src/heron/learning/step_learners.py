"""Learners of step policies, from skrl (on JAX): PPO and SAC.

Actions are scaled to [-1, 1]. An episode that reaches its time limit ends like any other: the
remaining time is part of the observation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import flax.serialization
import jax
import msgpack
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray
from skrl import config
from skrl.agents.jax.ppo import PPO, PPO_CFG
from skrl.agents.jax.sac import SAC, SAC_CFG
from skrl.memories.jax import RandomMemory
from skrl.resources.schedulers.jax import KLAdaptiveLR

from heron.learning.networks import Categorical, Critic, Gaussian, Squashed
from heron.learning.policy import INPUTS, Policy

Floats = NDArray[np.float64]
_ROLLOUT = 64
_KEPT = 100_000
_FOREVER = 10**9


class SkrlLearner:
    """An agent of skrl."""

    def __init__(
        self,
        algorithm: str,
        actions: spaces.Box | spaces.Discrete,
        count: int,
        seed: int,
    ) -> None:
        config.jax.backend = "jax"
        config.jax.key = jax.random.key_data(jax.random.key(seed))
        np.random.seed(seed)  # skrl's memories draw from it
        self._actions = actions
        scaled: spaces.Space[Any] = (
            actions
            if isinstance(actions, spaces.Discrete)
            else spaces.Box(-1.0, 1.0, actions.shape)
        )
        observations = spaces.Box(-np.inf, np.inf, (INPUTS,))
        self._agent = AGENTS[algorithm](observations, scaled, count)
        self._models = {name: each for name, each in self._agent.models.items() if each is not None}
        if algorithm == "sac":
            self._models["entropy"] = self._agent.log_entropy_coefficient
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

    def learn(
        self,
        observations: Floats,
        actions: Any,
        rewards: Floats,
        following: Floats,
        ended: NDArray[np.bool_],
    ) -> None:
        """Learn from a step: the observation, the action, the reward and the next observation."""
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

    def policy(self) -> Policy:
        """The best actions that are known."""
        found = self._models["policy"].state_dict.params["params"]
        layers = [
            (np.asarray(found[f"Dense_{i}"]["kernel"]), np.asarray(found[f"Dense_{i}"]["bias"]))
            for i in range(3)
        ]
        if isinstance(self._actions, spaces.Discrete):
            return Policy(layers)
        bounds = (self._actions.low.tolist(), self._actions.high.tolist())
        is_squashed = isinstance(self._models["policy"], Squashed)
        return Policy(layers, bounds, is_squashed=is_squashed)

    def save(self, steps: int) -> bytes:
        """The state of the training after this number of steps, for a later continuation."""
        return bytes(flax.serialization.to_bytes(self._known(steps)))

    def load(self, kept: bytes) -> int:
        """Restore a saved state, and return its steps. Raises `ValueError` if the state belongs to
        another learner.
        """
        try:
            found = flax.serialization.from_bytes(self._known(0), kept)
        except (ValueError, TypeError, AttributeError, KeyError, msgpack.UnpackException) as error:
            raise ValueError("this belongs to another learner") from error
        for name, model in self._models.items():
            model.state_dict = model.state_dict.replace(params=found["models"][name])
        for name, state in found["optimizers"].items():
            setattr(self._agent, name, getattr(self._agent, name).replace(state=state))
        for name, rate in found["rates"].items():
            setattr(self._agent, name, float(rate))
        memory = self._agent.memory
        memory.tensors |= {name: jax.numpy.asarray(each) for name, each in found["memory"].items()}
        memory.memory_index, memory.filled = int(found["index"]), bool(found["is_filled"])
        self._step = int(found["calls"])
        return int(found["steps"])

    def _known(self, steps: int) -> dict[str, Any]:
        fields = vars(self._agent)
        optimizers = [name for name in fields if name.endswith("optimizer")]
        rates = [name for name in fields if name.endswith("learning_rate")]
        return {
            "models": {name: model.state_dict.params for name, model in self._models.items()},
            "optimizers": {name: fields[name].state for name in optimizers},
            "rates": {name: fields[name] for name in rates},
            "memory": dict(self._agent.memory.tensors),
            "index": self._agent.memory.memory_index,
            "is_filled": self._agent.memory.filled,
            "calls": self._step,
            "steps": steps,
        }

    def _unscaled(self, actions: Any) -> Any:
        if isinstance(self._actions, spaces.Discrete):
            return actions.reshape(-1).astype(np.int64)
        low, high = self._actions.low, self._actions.high
        return low + (np.clip(actions, -1.0, 1.0) + 1.0) / 2.0 * (high - low)

    def _scaled(self, actions: Any) -> Any:
        if isinstance(self._actions, spaces.Discrete):
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
    policy = Categorical if isinstance(actions, spaces.Discrete) else Gaussian
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
        gradient_steps=8,
        learning_rate=5e-4,
        learning_starts=50,
        random_timesteps=50,
        initial_entropy_value=0.1,
    )
    critics = ("critic_1", "critic_2", "target_critic_1", "target_critic_2")
    models = _models({"policy": Squashed, **dict.fromkeys(critics, Critic)}, observations, actions)
    memory = RandomMemory(memory_size=_KEPT // count, num_envs=count)
    return _agent(SAC, settings, models, memory, observations, actions)


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


AGENTS: Mapping[str, Callable[..., Any]] = {"ppo": _ppo, "sac": _sac}
