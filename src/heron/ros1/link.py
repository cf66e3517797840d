"""An episode with the generated guard node: time advances only after all nodes have received all
messages.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from heron import messages
from heron.guard import Guard, unfiltered
from heron.messages import Message
from heron.ros1.carrier import Ros1Carrier
from heron.ros1.errors import Ros1Error
from heron.ros1.guard import Ros1Guard, name_of
from heron.ros1.lockstep import Lockstep
from heron.ros1.node import Ros1Node
from heron.scene.scene import STEP_NS
from heron.topics import InProcess, Topic
from rossmarie.ir import Machine

CLOCK = Topic("/clock", "rosgraph_msgs/Clock")
_LONGEST_NS = 10_000_000  # between two clock messages, for timers that are due
_ON_ITS_WAY_S = 0.1  # longer than the connections of a busy machine need
_LOOK_S = 0.0002
_START = "restart the node with /use_sim_time set to true"


class Ros1Link:
    """`master` is the address of a running master, and `host` is the address of this machine for
    other machines. The node of the rules is there, or comes within 30 s. It must be newly started.
    """

    period_ns = STEP_NS

    def __init__(self, master: str, host: str) -> None:
        """Raises `Ros1Error` if there is no master."""
        self._node = Ros1Node("/heron", master, host)
        self._clock: Callable[[], int] = lambda: 0
        self._said_ns = -1
        self._machine: Machine | None = None
        self._guard: Ros1Guard | None = None
        self._lockstep: Lockstep | None = None

    def close(self) -> None:
        """Close all connections."""
        for one in (self._lockstep, self._guard):
            if one is not None:
                one.close()
        self._node.close()

    def carrier(self, clock: Callable[[], int]) -> InProcess:
        """The carrier by which the robot and its programs speak."""
        self._clock = clock
        self._node.advertise(CLOCK)
        return Ros1Carrier(self._node, self._announce)

    def guard(self, machine: Machine, carrier: InProcess, clock: Callable[[], int]) -> Guard:  # noqa: ARG002
        """The guard that keeps the robot safe by rules."""
        self._machine = machine
        self._guard = Ros1Guard(machine, self._node, carrier, self._announce)
        return self._guard

    def tick(self, now_ns: int) -> None:
        """All messages of this instant have been sent."""
        if self._said_ns != now_ns and now_ns % _LONGEST_NS:
            return
        self._announce()
        if self._lockstep is not None:
            self._lockstep.wait_for_all()
        self._node.connect()
        self._node.deliver()
        end = time.monotonic() + _ON_ITS_WAY_S
        while self._guard is not None and self._guard.owes and time.monotonic() < end:
            time.sleep(_LOOK_S)
            self._node.deliver()

    def _announce(self) -> None:
        """Says which time it is, before anything else is said at an instant."""
        now_ns = self._clock()
        if now_ns == self._said_ns:
            return
        if self._said_ns < 0:
            self._begin()
        self._said_ns = now_ns
        self._node.publish(CLOCK, _clock(now_ns))
        if self._lockstep is not None:
            self._lockstep.wait_for_time()

    def _begin(self) -> None:
        """Wait until the node of the guard is there."""
        if self._machine is None or self._guard is None:
            return
        machine, name = self._machine, name_of(self._machine)
        wanted = [CLOCK.name, *dict.fromkeys(channel.source for channel in machine.channels)]
        wanted += [unfiltered(command.topic) for command in machine.reactions.commands]

        def lacking() -> str | None:
            deaf = [topic for topic in wanted if not self._node.is_heard(topic, name)]
            if not deaf and self._node.hears(f"{name}/state"):
                return None
            if deaf == [CLOCK.name]:
                return f"the node {name} does not use the simulation time: {_START}"
            what = f"does not subscribe to {', '.join(deaf)}" if deaf else "says nothing"
            return f"the node {name} is missing, or has other rules: it {what}"

        self._node.wait_while(lacking)
        self._lockstep = Lockstep(self._node, name)
        self._lockstep.wait_for_all()
        self._node.deliver()
        if self._guard.has_begun:
            raise Ros1Error(f"the node {name} was used in an earlier run: {_START}")


def _clock(at_ns: int) -> Message:
    now = messages.new_message(CLOCK.type)
    now.clock = messages.Time(*divmod(at_ns, 1_000_000_000))
    return now
