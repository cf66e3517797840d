"""Workers as nodes of a Ray cluster. The modules that the episodes need have to be installed on the
nodes.
"""

from __future__ import annotations

import logging
import signal
import socket
import time
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import Any

import ray

from dslkit.campaign.workers import EpisodeResult, UnreachableError, Work

_RETRIES = 3
_PERIOD_S = 5.0
_PATIENCE_S = 20.0  # after 60 s without its head, Ray ends this process


@dataclass(frozen=True)
class RayCluster:
    """The cluster at `address`, a host:port. If a node dies, other nodes run its episodes again."""

    address: str

    def results(self, work: Work, keys: Sequence[str]) -> Generator[EpisodeResult, None, None]:
        """Yield one result for each key, in the order of completion. Raises `UnreachableError`."""
        try:
            self._knock()
            ended = signal.getsignal(signal.SIGTERM)
            ray.init(address=self.address, log_to_driver=False, logging_level=logging.CRITICAL)
            signal.signal(signal.SIGTERM, ended)  # Ray has installed its own handler there
        except (OSError, RuntimeError, ValueError) as error:
            reason = str(error).splitlines()[0]
            raise UnreachableError(f"no Ray cluster at {self.address}: {reason}") from None
        try:
            remote = ray.remote(num_cpus=1, max_retries=_RETRIES)(work)
            waiting = {remote.remote(key): key for key in keys}
            there = time.monotonic()
            while waiting:
                done, _ = ray.wait(list(waiting), num_returns=1, timeout=_PERIOD_S)
                for each in done:
                    yield _result(waiting.pop(each), each)
                there = self._still_there(there)
        finally:
            ray.shutdown()

    def _still_there(self, last: float) -> float:
        """The last time at which the head answered. Raises `UnreachableError` if this is too long
        ago.
        """
        now = time.monotonic()
        if now - last < _PERIOD_S:
            return last
        try:
            self._knock()
        except OSError as error:
            if now - last < _PATIENCE_S:
                return last
            raise UnreachableError(f"the Ray cluster at {self.address} is gone: {error}") from None
        return now

    def _knock(self) -> None:
        """Try to connect. Ray itself would try for minutes."""
        host, _, port = self.address.rpartition(":")
        socket.create_connection((host, int(port)), timeout=5).close()


def _result(key: str, done: Any) -> EpisodeResult:
    try:
        return EpisodeResult(key, ray.get(done))
    except ray.exceptions.RayTaskError as error:
        return EpisodeResult(key, None, f"{type(error.cause).__name__}: {error.cause}")
    except ray.exceptions.RayError as error:
        return EpisodeResult(key, None, f"{type(error).__name__}: {str(error).splitlines()[0]}")
