"""Workers that are the nodes of a Ray cluster; what episodes need has to be installed there."""

from __future__ import annotations

import logging
import socket
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import Any

import ray

from campaign.workers import Result, UnreachableError, Work

_RETRIES = 3


@dataclass(frozen=True)
class RayCluster:
    """The one at `address`, a host:port. Episodes of a node that dies are run again on others."""

    address: str

    def results(self, work: Work, keys: Sequence[str]) -> Generator[Result, None, None]:
        """One result for each key, as they come. Raises `UnreachableError`."""
        try:
            self._knock()
            ray.init(address=self.address, log_to_driver=False, logging_level=logging.CRITICAL)
        except (OSError, RuntimeError, ValueError) as error:
            reason = str(error).splitlines()[0]
            raise UnreachableError(f"no Ray cluster at {self.address}: {reason}") from None
        try:
            remote = ray.remote(num_cpus=1, max_retries=_RETRIES)(work)
            waiting = {remote.remote(key): key for key in keys}
            while waiting:
                (done, *_), _ = ray.wait(list(waiting), num_returns=1)
                yield _result(waiting.pop(done), done)
        finally:
            ray.shutdown()

    def _knock(self) -> None:
        """Ray itself would try for minutes."""
        host, _, port = self.address.rpartition(":")
        socket.create_connection((host, int(port)), timeout=5).close()


def _result(key: str, done: Any) -> Result:
    try:
        return Result(key, ray.get(done))
    except ray.exceptions.RayTaskError as error:
        return Result(key, None, f"{type(error.cause).__name__}: {error.cause}")
    except ray.exceptions.RayError as error:
        return Result(key, None, f"{type(error).__name__}: {str(error).splitlines()[0]}")
