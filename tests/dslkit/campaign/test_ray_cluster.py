"""A campaign on a real cluster of two nodes, of which one is killed."""

from __future__ import annotations

import io
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from support.parts import RAY, require

require(RAY)

from rich.console import Console

from dslkit.campaign import Bar, Journal, UnreachableError, ray_cluster, run
from dslkit.campaign.ray_cluster import RayCluster
from dslkit.campaign.workers import EpisodeResult
from support import campaigns
from support.campaigns import work

pytestmark = pytest.mark.filterwarnings("ignore")  # those of Ray
PROGRAM = Path(sys.executable).with_name("ray")


@contextmanager
def node(*arguments: str) -> Iterator[subprocess.Popen[str]]:
    """A node in a process group of its own, which is killed in the end."""
    started = subprocess.Popen(
        [PROGRAM, "start", "--block", "--num-cpus=1", "--disable-usage-stats", *arguments],
        env={**os.environ, "PYTHONPATH": str(Path(campaigns.__file__).parents[1])},
        start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True,
    )  # fmt: skip
    try:
        yield started
    finally:
        end(started)


def end(started: subprocess.Popen[str]) -> None:
    """Without a word to the others."""
    for process in members(started.pid):
        os.kill(process, signal.SIGKILL)
    started.wait(timeout=30)


def members(session: int) -> list[int]:
    """All processes of a node: they have their groups, but one session, or its descendants."""
    parents, sessions = {}, {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            _, parent, _, its_session = stat.read_text().rpartition(")")[2].split()[:4]
        except OSError:
            continue
        parents[int(stat.parent.name)] = int(parent)
        sessions[int(stat.parent.name)] = int(its_session)
    found = {process for process, its in sessions.items() if its == session}
    while more := {process for process, parent in parents.items() if parent in found} - found:
        found |= more
    return sorted(found)


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        port: int = listener.getsockname()[1]
        return port


class Killer:
    """A witness that ends a node when `count` episodes are done."""

    def __init__(self, victim: subprocess.Popen[str], count: int = 5) -> None:
        self._victim = victim
        self._count = count
        self.heard: list[EpisodeResult] = []

    def begin(self, count: int, done: int) -> None:
        pass

    def hear(self, result: EpisodeResult) -> None:
        self.heard.append(result)
        if len(self.heard) == self._count:
            end(self._victim)


def cluster() -> tuple[str, list[str]]:
    """The address of a cluster that is still to be started, and the arguments of its head."""
    port = free_port()
    head = ["--head", f"--port={port}", "--node-ip-address=127.0.0.1", "--include-dashboard=false"]
    return f"127.0.0.1:{port}", head


def wait_for_nodes(address: str, count: int) -> None:
    """Until so many are there."""
    code = (
        "import ray, sys; ray.init(address=sys.argv[1], log_to_driver=False);"
        "print(sum(node['Alive'] for node in ray.nodes()))"
    )
    until = time.monotonic() + 90
    while time.monotonic() < until:
        asked = subprocess.run(
            [sys.executable, "-c", code, address], capture_output=True, text=True, check=False
        )
        if asked.stdout.strip() == str(count):
            return
        time.sleep(0.5)
    pytest.fail("the nodes of Ray do not come up")


def test_no_episode_is_lost_or_counted_twice_when_a_node_dies(tmp_path: Path) -> None:
    address, head = cluster()
    keys = [f"slow:{number}" for number in range(24)]
    path = tmp_path / "journal.jsonl"
    with node(*head):
        wait_for_nodes(address, 1)
        with node(f"--address={address}") as second:
            wait_for_nodes(address, 2)
            killer = Killer(second)
            with Journal(path, "test") as journal:
                found = run(keys, work, journal, RayCluster(address), killer)
            assert second.poll() is not None
        assert found.failures == ()
        assert list(found.values) == keys
        assert sorted(result.key for result in killer.heard) == sorted(keys)
        lines = path.read_text(encoding="utf-8").splitlines()[1:]
        assert sorted(json.loads(line)["key"] for line in lines) == sorted(keys)
        shown = io.StringIO()
        with Journal(path, "test") as journal, Bar(Console(file=shown, width=99), "test") as bar:
            failed = run([*keys, "raise:no"], work, journal, RayCluster(address), bar)
        assert [failure.reason for failure in failed.failures] == ["ValueError: no"]
        assert "24 of 25 are already done" in shown.getvalue()


def test_a_head_that_dies_is_reported_before_ray_ends_this_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ray_cluster, "_PERIOD_S", 0.5)
    monkeypatch.setattr(ray_cluster, "_PATIENCE_S", 2.0)
    address, head = cluster()
    path = tmp_path / "journal.jsonl"
    with node(*head) as first:
        wait_for_nodes(address, 1)
        before = signal.getsignal(signal.SIGTERM)
        killer = Killer(first, 2)
        with (
            Journal(path, "test") as journal,
            pytest.raises(UnreachableError, match="is gone"),
        ):
            run(
                [f"slow:{number}" for number in range(99)],
                work,
                journal,
                RayCluster(address),
                killer,
            )
    assert signal.getsignal(signal.SIGTERM) is before
    with Journal(path, "test") as journal:
        assert set(journal.values) == {result.key for result in killer.heard}


def test_a_cluster_that_is_not_there_is_reported() -> None:
    workers = RayCluster(f"127.0.0.1:{free_port()}")
    with pytest.raises(UnreachableError, match="no Ray cluster at"):
        list(workers.results(work, ["a:"]))
