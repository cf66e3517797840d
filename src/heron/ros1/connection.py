"""One TCPROS connection: a header of names and values in each direction, then bodies with their
lengths.
"""

from __future__ import annotations

import select
import socket
from collections.abc import Iterator, Mapping

Header = dict[str, str]
_SECONDS = 10.0
_LENGTH = 4


class Connection:
    """Waits 10 s at most. Raises `OSError` if the other side does not answer, or is gone."""

    def __init__(self, connected: socket.socket) -> None:
        self._socket = connected
        self._received = bytearray()
        connected.settimeout(_SECONDS)
        connected.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    @classmethod
    def to(cls, host: str, port: int) -> Connection:
        """A new one."""
        return cls(socket.create_connection((host, port), _SECONDS))

    def close(self) -> None:
        """Close the connection."""
        self._socket.close()

    # --- headers -----------------------------------------------------------------------------

    def send_header(self, header: Mapping[str, str]) -> None:
        """Send the identity of this node and the requested or offered topic."""
        lines = (f"{name}={value}".encode() for name, value in header.items())
        self.send(b"".join(len(line).to_bytes(_LENGTH, "little") + line for line in lines))

    def header(self) -> Header:
        """The header that the other side sends. Raises `ConnectionError` for a refusal."""
        body, found = self.receive(), {}
        while body:
            line, body = _cut(body)
            name, _, value = line.decode().partition("=")
            found[name] = value
        if "error" in found:
            raise ConnectionError(found["error"])
        return found

    # --- bodies ------------------------------------------------------------------------------

    def send(self, body: bytes) -> None:
        """One body."""
        self._socket.sendall(len(body).to_bytes(_LENGTH, "little") + body)

    def takes(self, body: bytes) -> bool:
        """Send one body, to a node that may have gone."""
        try:
            self.send(body)
        except OSError:
            return False
        return True

    def receive(self) -> bytes:
        """The next body."""
        return self.take(int.from_bytes(self.take(_LENGTH), "little"))

    def take(self, count: int) -> bytes:
        """So many bytes, whatever they are."""
        while len(self._received) < count:
            self._hear()
        taken = bytes(self._received[:count])
        del self._received[:count]
        return taken

    def waiting(self) -> Iterator[bytes]:
        """The bodies that have arrived."""
        while select.select([self._socket], [], [], 0)[0]:
            self._hear()
        while len(self._received) >= _LENGTH:
            end = _LENGTH + int.from_bytes(self._received[:_LENGTH], "little")
            if len(self._received) < end:
                return
            yield self.take(end)[_LENGTH:]

    def _hear(self) -> None:
        heard = self._socket.recv(65536)
        if not heard:
            raise ConnectionError("the other node has closed the connection")
        self._received += heard


def _cut(body: bytes) -> tuple[bytes, bytes]:
    end = _LENGTH + int.from_bytes(body[:_LENGTH], "little")
    return body[_LENGTH:end], body[end:]
