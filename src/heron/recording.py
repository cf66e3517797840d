"""A recorder of all topics to one MCAP file with ROS 2 messages, with the trace of a task next to
it.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores

from dslkit.writing import replacing_text
from ezskiros.engine.events import Event
from ezskiros.engine.tracing import TraceWriter
from heron.experiments import SimulatedNode
from heron.guard import Guard
from heron.messages import Message, store
from heron.robot.physics import Physics
from heron.topics import InProcess, Topic


class Recorder:
    """An observer. Stamps are simulation times; the simulation begins at `began_ns`."""

    def __init__(self, began_ns: int = 0) -> None:
        self._began_ns = began_ns
        self._ros1 = store()
        self._ros2 = store(Stores.ROS2_HUMBLE)
        self._topics: dict[Topic, None] = {}
        self._heard: list[tuple[str, int, bytes]] = []

    def attend(
        self,
        physics: Physics,
        carrier: InProcess,
        guard: Guard | None,  # noqa: ARG002
    ) -> Sequence[SimulatedNode]:
        """Subscribe to all topics."""
        self.listen(carrier, lambda: self._began_ns + physics.elapsed_ns)
        return []

    def listen(self, carrier: InProcess, clock: Callable[[], int]) -> None:
        """Listen to all topics that a carrier has by now. `clock` gives the stamps, in ns."""
        self._topics |= dict.fromkeys(carrier.topics)
        for topic in carrier.topics:
            carrier.subscribe(topic, partial(self._keep, clock, topic))

    def write(self, path: Path) -> None:
        """Write the whole recording into a new file. Raises `OSError`."""
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=path.parent) as folder:
            self._write_bag(Path(folder) / "bag")
            (written,) = Path(folder).glob("bag/*.mcap")
            written.rename(path)

    def _keep(self, clock: Callable[[], int], topic: Topic, message: Message) -> None:
        # At once: who publishes it may go on with the same message.
        data = self._ros1.serialize_ros1(message, _full(topic))
        self._heard.append((topic.name, clock(), bytes(data)))

    def _write_bag(self, folder: Path) -> None:
        with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
            connections = {
                topic.name: writer.add_connection(topic.name, _full(topic), typestore=self._ros2)
                for topic in self._topics
            }
            for name, at_ns, data in self._heard:
                connection = connections[name]
                writer.write(connection, at_ns, self._ros2.ros1_to_cdr(data, connection.msgtype))


def write_trace(
    path: Path, events: Sequence[tuple[float, Event]], period_ns: int, began_ns: int
) -> None:
    """The trace of a task that is ticked once in a period, with the stamps of the recording. Raises
    `OSError`.
    """
    start_s = events[0][0]
    with replacing_text(path) as file:
        trace = TraceWriter(file, began_ns + round(start_s * 1e9), "heron")
        for at_s, event in events:
            tick = 1 + round((at_s - start_s) * 1e9 / period_ns)
            trace.write(event, tick, at_s - start_s)


def _full(topic: Topic) -> str:
    return topic.type.replace("/", "/msg/")
