"""Child processes that do not behave: all that they start is gone afterwards, and nobody waits."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from ezskiros.confinement.process import BrokenOffError, Send, messages
from support.parts import PROC, needs

# pytest may have threads, of which Python 3.12 warns; a command has one.
pytestmark = pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")


def heard(work: Callable[[Send], None], patience: float = 20.0) -> tuple[list[Any], str]:
    """The messages of a child, and why there were no more."""
    found: list[Any] = []
    with pytest.raises(BrokenOffError) as problem, closing(messages(work, patience)) as said:
        found.extend(said)
    return found, str(problem.value)


def test_messages_come_in_order() -> None:
    long = "x" * 300_000

    def work(send: Send) -> None:
        for number in range(100):
            send([number])
        send([long])

    found, reason = heard(work)
    assert found == [*([number] for number in range(100)), [long]]
    assert reason == "the code ended the process, with exit code 0"


def test_silence_is_not_waited_for() -> None:
    def work(send: Send) -> None:
        signal.signal(signal.SIGALRM, signal.SIG_IGN)
        send(["begun"])
        while True:
            pass

    start = time.monotonic()
    assert heard(work, patience=0.5) == ([["begun"]], "the code made no progress for 0.5 s")
    assert time.monotonic() - start < 20


def test_a_stopped_child_is_not_waited_for() -> None:
    found, reason = heard(lambda _: signal.raise_signal(signal.SIGSTOP), patience=0.5)
    assert (found, reason) == ([], "the code made no progress for 0.5 s")


def test_bytes_without_end_are_not_read() -> None:
    def work(_: Send) -> None:
        files = [number for number in range(3, 64) if _is_open(number)]
        while True:
            for file in files:
                os.write(file, b"x" * 65536)

    assert heard(work, patience=60.0) == ([], "the code sent an invalid message")


@needs(PROC)
@pytest.mark.parametrize("session", [False, True], ids=["of its group", "of another session"])
def test_what_a_daemon_leaves_behind_is_killed(tmp_path: Path, session: bool) -> None:
    name = tmp_path / "process"

    def work(send: Send) -> None:
        if os.fork() == 0:
            if session:
                os.setsid()
            if os.fork() == 0:
                name.write_text(str(os.getpid()))
                send(["begun"])
                time.sleep(600)
        time.sleep(0.2)

    assert heard(work, patience=2.0)[0] == [["begun"]]
    assert not Path(f"/proc/{name.read_text()}").exists()


def test_other_children_of_this_process_are_left_alone() -> None:
    other = os.fork()
    if other == 0:
        time.sleep(600)
        os._exit(0)
    try:
        heard(lambda _: None)
        assert os.waitpid(other, os.WNOHANG) == (0, 0)
    finally:
        os.kill(other, signal.SIGKILL)
        os.waitpid(other, 0)


def test_a_child_has_no_files_of_its_parent(tmp_path: Path) -> None:
    with (tmp_path / "open").open("w") as file:
        number = file.fileno()
        found, _ = heard(lambda send: send([_is_open(number), os.isatty(0)]))
    assert found == [[False, False]]


def _is_open(number: int) -> bool:
    try:
        os.fstat(number)
    except OSError:
        return False
    return True
