"""A minimal ROS 1 node for the experiments: it publishes, subscribes, and calls services.

The thread of the caller sends messages at once and receives them on request. Only new connections
are accepted by another thread.
"""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, cast
from urllib.parse import urlsplit
from xmlrpc.client import Error as XmlRpcError
from xmlrpc.client import ServerProxy
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

from rosbags.typesys import get_types_from_msg

from heron import messages
from heron.messages import Message
from heron.ros1.connection import Connection, Header
from heron.ros1.errors import Ros1Error
from heron.topics import Topic

_SUCCESS = 1
_ANY = "*"
_PATIENCE_S = 30.0
_LOOK_S = 0.05


@dataclass
class _Published:
    """A topic of this node, with its subscribers, by the names of their nodes."""

    topic: Topic
    listeners: dict[Connection, str] = field(default_factory=dict)


@dataclass
class _Heard:
    """A topic to which this node subscribes: its type, the addresses of its publishers, and the
    descriptions from the publishers.
    """

    kind: str
    receive: Callable[[Message], None]
    publishers: list[str] = field(default_factory=list)
    connections: dict[str, tuple[Connection, str]] = field(default_factory=dict)


class Ros1Node:
    """`host` is the address by which others reach this machine. To be closed."""

    def __init__(self, name: str, master: str, host: str) -> None:
        """Raises `Ros1Error` if there is no master, or the address is not of this machine."""
        self._name, self._host = name, host
        self._master_address = master
        self._published: dict[str, _Published] = {}
        self._heard: dict[str, _Heard] = {}
        try:
            self._door = socket.create_server((host, 0))
            self._slave = SimpleXMLRPCServer((host, 0), _Quiet, logRequests=False)
        except OSError as error:
            advice = "correct ROS_IP or ROS_HOSTNAME, or unset both"
            raise Ros1Error(f"{host} is not an address of this machine; {advice}") from error
        self._slave.register_function(self._request_topic, "requestTopic")
        self._slave.register_function(self._update_publishers, "publisherUpdate")
        self._address = f"http://{host}:{self._slave.server_address[1]}/"
        threading.Thread(target=self._slave.serve_forever, daemon=True).start()
        threading.Thread(target=self._welcome, daemon=True).start()
        try:
            self._ask_master("getPid")
        except Ros1Error:
            self._shut()
            raise

    def close(self) -> None:
        """Leave the network."""
        with suppress(Ros1Error):
            for topic in self._published:
                self._ask_master("unregisterPublisher", topic, self._address)
            for topic in self._heard:
                self._ask_master("unregisterSubscriber", topic, self._address)
        self._shut()

    def _shut(self) -> None:
        self._slave.shutdown()
        self._slave.server_close()
        self._door.shutdown(socket.SHUT_RDWR)  # wakes the waiting thread
        self._door.close()
        for published in self._published.values():
            for listener in published.listeners:
                listener.close()
        for heard in self._heard.values():
            for connection, _ in heard.connections.values():
                connection.close()

    # --- what goes out -----------------------------------------------------------------------

    def advertise(self, topic: Topic) -> None:
        """Announce that this node publishes a topic from now on."""
        if topic.name not in self._published:
            self._published[topic.name] = _Published(topic)
            self._ask_master("registerPublisher", topic.name, topic.type, self._address)

    def publish(self, topic: Topic, message: Message) -> None:
        """Send to all subscribers. A subscriber that cannot keep up is disconnected."""
        published = self._published[topic.name]
        if not published.listeners:
            return
        body = bytes(messages.store().serialize_ros1(message, messages.full_name(topic.type)))
        for listener in list(published.listeners):
            if not listener.takes(body):
                del published.listeners[listener]
                listener.close()

    def is_heard(self, topic: str, by: str) -> bool:
        """Say whether another node is connected to a topic of this one."""
        return topic in self._published and by in self._published[topic].listeners.values()

    def has_listeners(self, topic: str) -> bool:
        """Say whether anybody is connected to a topic of this one."""
        return topic in self._published and bool(self._published[topic].listeners)

    # --- what comes in -----------------------------------------------------------------------

    def subscribe(self, topic: str, kind: str, receive: Callable[[Message], None]) -> None:
        """`receive` gets the messages of other nodes, in `deliver`. The type may be `*`."""
        heard = self._heard[topic] = _Heard(kind, receive)
        found = self._ask_master("registerSubscriber", topic, kind, self._address)
        heard.publishers = heard.publishers or list(found)

    def hears(self, topic: str) -> bool:
        """Return True if a publisher of a topic is connected."""
        return bool(self._heard[topic].connections)

    def deliver(self) -> None:
        """Deliver all messages that have arrived. Raises `Ros1Error` if a publisher has gone."""
        for topic, heard in self._heard.items():
            for connection, kind in list(heard.connections.values()):
                try:
                    bodies = list(connection.waiting())
                except OSError as error:
                    raise Ros1Error(f"the publisher of {topic} is gone: {error}") from error
                for body in bodies:
                    heard.receive(messages.store().deserialize_ros1(body, kind))

    def connect(self) -> None:
        """Connect to new publishers of subscribed topics."""
        for topic, heard in self._heard.items():
            for publisher in set(heard.publishers) - heard.connections.keys() - {self._address}:
                with suppress(OSError, XmlRpcError):  # it may be on its way, or just ending
                    heard.connections[publisher] = self._connected(topic, publisher)

    def _connected(self, topic: str, publisher: str) -> tuple[Connection, str]:
        with ServerProxy(publisher) as asked:
            _, _, protocol = cast("Any", asked.requestTopic(self._name, topic, [["TCPROS"]]))
        connection = Connection.to(str(protocol[1]), int(protocol[2]))
        connection.send_header(
            {
                "callerid": self._name,
                "topic": topic,
                "type": _ANY,
                "md5sum": _ANY,
                "tcp_nodelay": "1",
            }
        )
        header = connection.header()
        if self._heard[topic].kind not in (_ANY, header["type"]):
            connection.close()
            wanted, reported = self._heard[topic].kind, header["type"]
            raise Ros1Error(f"{header['callerid']} publishes {topic} as {reported}, not {wanted}")
        return connection, _learned(header)

    # --- services ----------------------------------------------------------------------------

    def service(self, name: str) -> Service:
        """A service of another node. Raises `Ros1Error` if no node offers it."""
        found = urlsplit(str(self._ask_master("lookupService", name)))
        try:
            connection = Connection.to(str(found.hostname), int(found.port or 0))
            header = {"callerid": self._name, "service": name, "md5sum": _ANY, "persistent": "1"}
            connection.send_header(header)
            connection.header()
        except OSError as error:
            raise Ros1Error(f"{name} cannot be reached: {error}") from error
        return Service(name, connection)

    # --- others ------------------------------------------------------------------------------

    def wait_while(self, lacking: Callable[[], str | None]) -> None:
        """Connect to everything that is missing. After 30 s, raises `Ros1Error` with the rest."""
        end = time.monotonic() + _PATIENCE_S
        while (lack := lacking()) is not None:
            if time.monotonic() > end:
                raise Ros1Error(lack)
            time.sleep(_LOOK_S)
            self.connect()

    def _ask_master(self, query: str, *arguments: str) -> Any:
        try:
            with ServerProxy(self._master_address) as master:
                answer = cast("Any", getattr(master, query)(self._name, *arguments))
        except (OSError, XmlRpcError) as error:
            where = self._master_address
            advice = "start roscore, or set ROS_MASTER_URI"
            raise Ros1Error(f"there is no ROS master at {where}: {error}; {advice}") from error
        code, text, value = answer
        if code != _SUCCESS:
            raise Ros1Error(str(text))
        return value

    def _request_topic(self, _caller: Any, topic: Any, _protocols: Any) -> list[Any]:
        """Handle a request of another node to subscribe to a topic."""
        if topic not in self._published:
            return [0, f"{topic} is not published here", 0]
        return [_SUCCESS, "", ["TCPROS", self._host, self._door.getsockname()[1]]]

    def _update_publishers(self, _caller: Any, topic: Any, publishers: Any) -> list[Any]:
        """Handle the message of the master about the publishers of a topic."""
        if topic in self._heard:
            self._heard[topic].publishers = publishers
        return [_SUCCESS, "", 0]

    def _welcome(self) -> None:
        """Accept subscribers until the socket is closed."""
        with suppress(OSError):
            while True:
                visitor, _ = self._door.accept()
                connection = Connection(visitor)
                try:
                    self._let_in(connection)
                except (OSError, KeyError, ValueError):
                    connection.close()

    def _let_in(self, connection: Connection) -> None:
        """Raises `KeyError` for a topic that there is not."""
        wanted = connection.header()
        published = self._published[wanted["topic"]]
        kind = published.topic.type
        definition, digest = messages.store().generate_msgdef(messages.full_name(kind))
        if wanted["md5sum"] not in (_ANY, digest):
            connection.send_header({"error": f"{published.topic.name} carries {kind}"})
            raise ValueError(kind)
        connection.send_header(
            {
                "callerid": self._name,
                "topic": published.topic.name,
                "type": kind,
                "md5sum": digest,
                "message_definition": definition,
                "latching": "0",
            }
        )
        published.listeners[connection] = wanted["callerid"]


class Service:
    """A service of another node, which is asked again and again."""

    def __init__(self, name: str, connection: Connection) -> None:
        self._name, self._connection = name, connection

    def call(self, request: bytes = b"") -> bytes:
        """The answer of the service. Raises `Ros1Error`."""
        try:
            self._connection.send(request)
            has_worked = self._connection.take(1) != b"\0"
            answer = self._connection.receive()
        except OSError as error:
            raise Ros1Error(f"{self._name} does not answer: {error}") from error
        if not has_worked:
            raise Ros1Error(f"{self._name} has failed: {answer.decode('utf-8', 'replace')}")
        return answer

    def close(self) -> None:
        """Close the service."""
        self._connection.close()


class _Quiet(SimpleXMLRPCRequestHandler):
    """For every path: nodes of ROS have no fixed one."""

    rpc_paths = ()


def text(value: str) -> bytes:
    """A string, as requests have it."""
    encoded = value.encode()
    return len(encoded).to_bytes(4, "little") + encoded


def _learned(header: Header) -> str:
    """The type of the messages, as described by the publisher."""
    kind = messages.full_name(header["type"])
    store = messages.store()
    described = get_types_from_msg(header["message_definition"], kind)
    store.register({name: fields for name, fields in described.items() if name not in store.types})
    return kind
