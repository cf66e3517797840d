"""Scripts that need rospy, started cheaply: to import it takes longer than most of them run.

A server imports it once, and each script is a copy of that server (`ros1_python_server.py`).
"""

from __future__ import annotations

import json
import os
import select
import socket
import struct
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import IO

PYTHON = Path("/usr/bin/python3")
_SERVER = Path(__file__).with_name("ros1_python_server.py")
_NUMBER = struct.Struct("q")


class Script:
    """A running script: what `subprocess.Popen` would be for it."""

    def __init__(self, pid: int, stdin: IO[str], stdout: IO[str]) -> None:
        self.pid = pid
        self.stdin = stdin
        self.stdout = stdout
        self._ending = os.fdopen(os.pidfd_open(pid), "rb")

    def poll(self) -> int | None:
        """None while it runs. How it ended only its server knows."""
        return 0 if self._ending.closed or self._ends_within(0.0) else None

    def wait(self, timeout: float) -> None:
        """Wait until it has ended."""
        if not self._ending.closed and not self._ends_within(timeout):
            raise subprocess.TimeoutExpired(str(self.pid), timeout)

    def communicate(self, *, timeout: float) -> None:
        """Wait until it has ended; nobody speaks to it any more."""
        self.wait(timeout)
        for each in (self.stdin, self.stdout, self._ending):
            with suppress(BrokenPipeError):
                each.close()

    def send_signal(self, sig: int) -> None:
        """Send a signal."""
        os.kill(self.pid, sig)

    def _ends_within(self, seconds: float) -> bool:
        return bool(select.select([self._ending], [], [], seconds)[0])


class Python:
    """A server of scripts."""

    def __init__(self, variables: Mapping[str, str]) -> None:
        self._ours, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [PYTHON, _SERVER],
                stdin=theirs.fileno(),
                stdout=subprocess.DEVNULL,
                env=variables,
                start_new_session=True,
            )

    def start(
        self, arguments: Sequence[str], variables: Mapping[str, str], log: IO[bytes]
    ) -> Script:
        """Start a script, with its arguments, in a group of its own."""
        request = {"arguments": list(arguments), "variables": dict(variables)}
        (their_input, our_output), (our_input, their_output) = os.pipe(), os.pipe()
        with tempfile.TemporaryFile() as asked:
            asked.write(json.dumps(request).encode())
            asked.seek(0)
            files = [asked.fileno(), their_input, their_output, log.fileno()]
            socket.send_fds(self._ours, [b"!"], files)
        os.close(their_input)
        os.close(their_output)
        answer = self._ours.recv(_NUMBER.size)
        assert answer, f"the server of scripts has ended: {self._process.wait()}"
        return Script(_NUMBER.unpack(answer)[0], os.fdopen(our_output, "w"), os.fdopen(our_input))

    def end(self) -> None:
        """End it. Its scripts go on."""
        self._ours.close()
        self._process.wait()
