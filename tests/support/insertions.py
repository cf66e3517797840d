"""Episodes of the task of figure 4, recorded, and what each use of its rules says of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray
from rosbags.highlevel import AnyReader

import heron.learning  # noqa: F401  # registers the environments
from heron.guard import InProcessGuard
from heron.learning.arms import guarded
from heron.learning.on_topics import OnTopics
from heron.messages import Message
from heron.recording import Recorder
from heron.topics import InProcess, Topic
from heron.variants import LearningArm
from rossmarie.ir import Event, Machine

Floats = NDArray[np.float64]
Policy = Callable[[Floats, int], Any]
Heard = tuple[Topic, int, Message]
"""A message on a topic, and when it came (ns)."""


def into_the_fragile_part(seen: Floats, _step: int) -> Floats:
    """A policy that goes for what must not be touched."""
    return np.array([*(-3.0 * (seen[:3] - np.array([-0.5, 0.3, 0.75]))), -5.0])


def scraping(seen: Floats, step: int) -> Floats:
    """A policy that goes above the hole, presses the peg beside it, and drags it away and back: at
    some time the force is on it inside of v3, and then outside.
    """
    x, y, z = seen[:3] - np.array([-0.6, 0.0, 0.7])
    if z > 0.03 and max(abs(x), abs(y)) > 0.02:
        return np.array([-3.0 * x, -3.0 * y, -3.0 * (z - 0.06), 0.0])
    return np.array([0.3 * np.sin(step / 8), 0.3 * np.cos(step / 11), -0.3, 0.0])


def wandering(seed: int) -> Policy:
    """A policy by chance, whose actions change slowly."""
    chance = np.random.default_rng(seed)
    action = np.zeros(4)

    def act(_seen: Floats, _step: int) -> Floats:
        action[:] = 0.95 * action + chance.normal(0.0, 0.3, 4) * np.array([0.3, 0.3, 0.3, 5.0])
        return action

    return act


def recorded(arm: LearningArm, policy: Policy, seed: int, path: Path) -> list[Event]:
    """Run an episode and record it; gives what the wrapper around the environment said."""
    carrier, events = InProcess(), list[Event]()
    reported = OnTopics(gymnasium.make("heron/PegInHole-v1", disable_env_checker=True), carrier)
    recorder = Recorder()
    recorder.listen(carrier, reported.now_ns)
    env: Any = guarded(reported, arm)
    env.get_wrapper_attr("guard").on_event = events.append
    seen, _ = env.reset(seed=seed)
    step, is_over = 0, False
    while not is_over:
        action = np.clip(policy(seen, step), env.action_space.low, env.action_space.high)
        seen, _, terminated, truncated, _ = env.step(action.astype(np.float32))
        step, is_over = step + 1, terminated or truncated
    recorder.write(path)
    return events


def messages_of(recording: Path) -> Iterator[Heard]:
    """The messages of a recording."""
    with AnyReader([recording]) as reader:
        for connection, at_ns, data in reader.messages():
            name = connection.msgtype.replace("/msg/", "/")
            message = reader.deserialize(data, connection.msgtype)
            yield Topic(connection.topic, name), at_ns, message


def in_process(machine: Machine, heard: Sequence[Heard]) -> list[Event]:
    """The verdicts of Heron's guard about the messages, which come one by one."""
    carrier, now_ns = InProcess(), [0]
    guard = InProcessGuard(machine, carrier, lambda: now_ns[0])
    publish = {topic: carrier.publisher(topic) for topic, _, _ in heard}
    for at_ns, of_instant in groupby(heard, key=lambda each: each[1]):
        now_ns[0] = at_ns
        for topic, _, message in of_instant:
            publish[topic](message)
        guard.tick(at_ns)
    return list(guard.verdicts)
