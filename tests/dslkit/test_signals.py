"""Signals end what raises interrupts, also where Python cannot raise one."""

from __future__ import annotations

import subprocess
import sys

import pytest

from support.command_line import TIME_LIMIT_S

LOST = """
import os, signal, time
from dslkit import signals

class Thing:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(0.01)

signals.raise_interrupts()
try:
    Thing()
    time.sleep(10_000)
except KeyboardInterrupt:
    print("interrupted:", signals.exit_code())
"""


SLOWLY = LOST.replace(
    "signals.raise_interrupts()",
    """
at_once = signals._thread
class SlowThread:
    get_ident = signals._thread.get_ident

    def start_new_thread(self, *given):
        at_once.start_new_thread(*given)
        signals._thread = at_once
        for _ in range(10):
            time.sleep(0.01)

signals._thread = SlowThread()
signals.raise_interrupts()
""",
)
"""On a busy machine the interrupt comes again before the last one is told of."""


@pytest.mark.parametrize("code", [LOST, SLOWLY])
def test_an_interrupt_that_python_loses_comes_again(code: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT_S,
        check=False,
    )
    assert (done.stdout, done.stderr) == ("interrupted: 143\n", "")


def test_a_signal_that_is_ignored_stays_so() -> None:
    code = (
        "import signal; from dslkit import signals; signal.signal(signal.SIGINT, signal.SIG_IGN);"
        "signals.end_at_once(); signals.raise_interrupts(); signal.raise_signal(signal.SIGINT)"
    )
    done = subprocess.run([sys.executable, "-c", code], timeout=TIME_LIMIT_S, check=False)
    assert done.returncode == 0


def test_work_that_is_asked_to_end_goes_on_until_it_looks() -> None:
    code = (
        "import signal; from dslkit import signals; has_to_end = signals.ask_to_end();"
        "assert not has_to_end(); signal.raise_signal(signal.SIGTERM);"
        "assert has_to_end() and signals.exit_code() is None"
    )
    done = subprocess.run([sys.executable, "-c", code], timeout=TIME_LIMIT_S, check=False)
    assert done.returncode == 0
