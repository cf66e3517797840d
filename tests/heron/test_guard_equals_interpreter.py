"""The guard in this process says what the interpreter says of the messages that were carried."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from rosbags.typesys import Stores, get_typestore

from heron import messages
from heron.experiments.runner import SimulatedNode, run
from heron.guard import InProcessGuard
from heron.messages import Message
from heron.robot import (
    Base,
    DifferentialDrive,
    DriveParameters,
    Imu,
    ImuParameters,
    WheelOdometry,
    WheelOdometryParameters,
)
from heron.rules import FOLDER
from heron.scene import BaseParameters, CourseParameters, build_navigation, course
from heron.topics import IMU, JOYSTICK, ODOMETRY, InProcess
from heron.variants import Terrain
from rossmarie.driver import compile_file
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Machine, Verdict
from rossmarie.recordings.extraction import WantedParts, compile_extractor

Said = tuple[int, int, object]


def readers(machine: Machine) -> dict[str, tuple[int, Callable[[Message], ChannelValues]]]:
    """For each topic its channel, and what the rules read of a message."""
    store = get_typestore(Stores.ROS1_NOETIC)
    found = {}
    for index, channel in enumerate(machine.channels):
        slots = {
            number: slot
            for number, slot in enumerate(machine.slots)
            if machine.inputs[slot.input].channel == index
        }
        wanted = WantedParts(slots, {})
        read = compile_extractor(store, channel.message_type, wanted, machine.texts).read
        found[channel.topic] = (index, read)
    return found


class Hand:
    """Somebody drives over the bump."""

    period_ns = 100_000_000

    def __init__(self, carrier: InProcess) -> None:
        self._drive = carrier.publisher(JOYSTICK)

    def tick(self, now_ns: int) -> None:
        self._drive(messages.twist(0.45 if now_ns < 3_000_000_000 else 0.0, 0.0))


@pytest.mark.parametrize("rules", ["navigation", "navigation_deros"])
def test_verdicts_are_those_of_the_interpreter(rules: str) -> None:
    machine = compile_file(FOLDER / f"{rules}.ross").machine
    base, carrier = BaseParameters(), InProcess()
    physics = Base(build_navigation(course(Terrain.GENTLE, CourseParameters()), base))
    physics.data.qpos[0] = 1.5
    physics.settle(500)
    carried: list[tuple[int, str, Message]] = []

    def carry(name: str, message: Message) -> None:
        carried.append((physics.now_ns, name, message))

    for topic in (IMU, ODOMETRY):
        carrier.subscribe(topic, partial(carry, topic.name))
    generator = np.random.default_rng(7)
    guard = InProcessGuard(machine, carrier, lambda: physics.now_ns)
    nodes: list[SimulatedNode] = [
        Imu(physics, carrier, generator, ImuParameters()),
        WheelOdometry(physics, carrier, generator, base, WheelOdometryParameters()),
        DifferentialDrive(physics, carrier, base, DriveParameters()),
        guard,
        Hand(carrier),
    ]
    run(physics, nodes, 9_000_000_000, lambda: False)
    said = [(verdict.rule, verdict.at_ns, verdict.change) for verdict in guard.verdicts]
    assert said
    assert said == interpreted(machine, carried, physics.now_ns)


def interpreted(
    machine: Machine, carried: list[tuple[int, str, Message]], end_ns: int
) -> list[Said]:
    """The output of the interpreter, which begins with the first messages of all topics
    together.
    """
    interpreter, known = Interpreter(machine), readers(machine)
    first: dict[int, ChannelValues] = {}
    events = []
    for at_ns, topic, message in carried:
        channel, read = known[topic]
        if len(first) < len(known):
            first[channel] = read(message)
            if len(first) == len(known):
                events += interpreter.update(at_ns, first)
        else:
            events += interpreter.update(at_ns, {channel: read(message)})
    events += interpreter.advance(end_ns)
    found = [event for event in events if isinstance(event, Verdict)]
    return [(verdict.rule, verdict.at_ns, verdict.change) for verdict in found]
