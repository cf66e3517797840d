"""The networks of step learners: two hidden layers, in Flax."""

from __future__ import annotations

from typing import Any

import flax.linen as nn
import jax.numpy as jnp
from skrl.models.jax import CategoricalMixin, DeterministicMixin, GaussianMixin, Model

_HIDDEN = 64
_SMALL = nn.initializers.variance_scaling(0.01, "fan_in", "normal")
_LOG_STD = -1.2
"""The spread of the first actions, which are scaled to [-1, 1], as its logarithm."""


class Gaussian(GaussianMixin, Model):  # type: ignore[misc]
    """A policy whose actions are spread as widely everywhere."""

    def __init__(self, observation_space: Any, action_space: Any, **given: Any) -> None:
        Model.__init__(
            self, observation_space=observation_space, action_space=action_space, **given
        )
        GaussianMixin.__init__(self, clip_log_std=True, min_log_std=-4.0, max_log_std=1.0)

    @nn.compact
    def __call__(self, inputs: Any, role: str) -> Any:  # noqa: ARG002
        """Mean and logarithm of the spread."""
        found = hidden(inputs["observations"])
        count = self.action_space.shape[0]
        spread = self.param("log_std", lambda _: jnp.full(count, _LOG_STD))
        return nn.Dense(count, kernel_init=_SMALL)(found), {"log_std": spread}


class Squashed(GaussianMixin, Model):  # type: ignore[misc]
    """A policy whose actions are spread by the observation, as soft actor-critic wants it."""

    def __init__(self, observation_space: Any, action_space: Any, **given: Any) -> None:
        Model.__init__(
            self, observation_space=observation_space, action_space=action_space, **given
        )
        GaussianMixin.__init__(
            self, clip_actions=True, clip_log_std=True, min_log_std=-5.0, max_log_std=1.0
        )

    @nn.compact
    def __call__(self, inputs: Any, role: str) -> Any:  # noqa: ARG002
        """Mean and logarithm of the spread."""
        found = hidden(inputs["observations"])
        count = self.action_space.shape[0]
        mean = nn.tanh(nn.Dense(count, kernel_init=_SMALL)(found))
        bias = nn.initializers.constant(_LOG_STD)
        return mean, {"log_std": nn.Dense(count, kernel_init=_SMALL, bias_init=bias)(found)}


class Categorical(CategoricalMixin, Model):  # type: ignore[misc]
    """A policy that chooses."""

    def __init__(self, observation_space: Any, action_space: Any, **given: Any) -> None:
        Model.__init__(
            self, observation_space=observation_space, action_space=action_space, **given
        )
        CategoricalMixin.__init__(self)

    @nn.compact
    def __call__(self, inputs: Any, role: str) -> Any:  # noqa: ARG002
        """The logarithm of how likely each choice is."""
        found = hidden(inputs["observations"])
        return nn.Dense(int(self.action_space.n), kernel_init=_SMALL)(found), {}


class Critic(DeterministicMixin, Model):  # type: ignore[misc]
    """The value of a state, or of an action in it."""

    def __init__(self, observation_space: Any, action_space: Any, **given: Any) -> None:
        Model.__init__(
            self, observation_space=observation_space, action_space=action_space, **given
        )
        DeterministicMixin.__init__(self)

    @nn.compact
    def __call__(self, inputs: Any, role: str) -> Any:
        """The value."""
        seen = inputs["observations"]
        if "critic" in role:
            seen = jnp.concatenate([seen, inputs["taken_actions"]], axis=-1)
        found = hidden(seen)
        return nn.Dense(1)(found), {}


def hidden(values: Any) -> Any:
    """Two layers. They are made before the last one, so that all networks name them alike."""
    for _ in range(2):
        values = nn.tanh(nn.Dense(_HIDDEN)(values))
    return values
