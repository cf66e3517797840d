"""The node that is generated from the rules of a training says what the training said.

The messages of a node are no lines of a verdicts file: they lack since when conditions have been as
they are. All else of them is compared as lines, byte for byte, and so are the instants in ROS 1. In
ROS 2 a thread of its own hears the clock, and may be late by a step of it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.learning.arms import RULES
from heron.variants import LearningArm
from rossmarie.driver import compile_file
from rossmarie.driver.replay import replay_file
from rossmarie.ir import Machine, Verdict
from support.insertions import Policy, into_the_fragile_part, messages_of, recorded, scraping
from support.live import Ros, Wanted
from support.live_replay import verdicts_of
from support.recordings import Reading, store_of, write_kind

BEGIN_NS = 1_000_000_000
"""The stamp of the beginning: simulated time that is 0 has not begun."""
END_NS = BEGIN_NS + 5_000_000_000
NEAR_NS = {"ros1": 0, "ros2": 20_000_000}


def needs(_generation: str) -> Sequence[Wanted]:
    """The node of the rules of the training."""
    return [compile_file(RULES).machine]


pytestmark = [pytest.mark.builds(by=needs)]


@pytest.mark.parametrize("arm", [LearningArm.UNGUARDED, LearningArm.GUARD])
@pytest.mark.parametrize("policy", [into_the_fragile_part, scraping])
def test_a_node_says_what_the_training_said(
    ros: Ros, programs: Sequence[Path], arm: LearningArm, policy: Policy, tmp_path: Path
) -> None:
    machine = compile_file(RULES).machine
    episode = tmp_path / "episode.mcap"
    wrapped = recorded(arm, policy, 1, episode)
    said = [
        (event.at_ns, of_verdict(machine, event))
        for event in wrapped
        if isinstance(event, Verdict) and event.at_ns <= END_NS - BEGIN_NS
    ]
    assert len({json.loads(each)[0] for _, each in said}) >= 4
    kind = {"ros1": "bag", "ros2": "mcap directory"}[ros.name]
    played = write_kind(tmp_path, kind, list(readings(machine, episode, kind)))
    replay, _ = replay_file(RULES, played, topic_map={})
    assert replay.start_ns == BEGIN_NS
    assert [
        (event.at_ns - BEGIN_NS, of_verdict(machine, event))
        for event in replay.events
        if isinstance(event, Verdict)
    ] == said
    reported = verdicts_of(
        ros, programs[0], tmp_path / "latched", lambda: ros.play(played), len(said)
    )
    assert "\n".join(map(of_message, reported)) == "\n".join(each for _, each in said)
    instants = [round(each["at"] * 1e9) - BEGIN_NS for each in reported]
    assert instants == [pytest.approx(at_ns, rel=0, abs=NEAR_NS[ros.name]) for at_ns, _ in said]


def readings(machine: Machine, episode: Path, kind: str) -> Iterator[Reading]:
    """The messages of the first seconds of an episode, with stamps from `BEGIN_NS` on."""
    store, topics = store_of(kind), {channel.topic for channel in machine.channels}
    for topic, at_ns, message in messages_of(episode):
        if topic.name in topics and at_ns + BEGIN_NS <= END_NS:
            name = topic.type.replace("/", "/msg/")
            yield topic.name, at_ns + BEGIN_NS, name, of_store(store, message)


def of_store(store: Any, message: Any) -> Any:
    """The same message, of the classes of a store; in headers of ROS 1 there is a counter, too."""
    kind = getattr(message, "__msgtype__", None)
    if kind is None:
        return message
    fields = [name for name, _ in store.fielddefs[kind][1]]
    return store.types[kind](
        **{name: of_store(store, getattr(message, name, 0)) for name in fields}
    )


def of_message(reported: Any) -> str:
    """A verdict as a node tells it, as a line: all that it has in common with a `Verdict`."""
    values = [[each["name"], each["value"], each["unit"]] for each in reported["values"]]
    return line(
        reported["rule"], reported["change"], reported["categories"], reported["clears"], values
    )


def of_verdict(machine: Machine, verdict: Verdict) -> str:
    """The line of the same verdict."""
    rule = machine.rules[verdict.rule]
    signals = [machine.signals[signal] for signal in rule.signals]
    values = [
        [signal.text, value * signal.scale + signal.offset, signal.unit]
        for signal, value in zip(signals, verdict.values, strict=True)
    ]
    categories = [each.value for each in rule.categories]
    return line(rule.name, int(verdict.change), categories, rule.contract, values)


def line(*fields: object) -> str:
    return json.dumps(fields)
