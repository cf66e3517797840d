"""Queries that are on their way to a process when it ends keep nobody.

They are longer than a pipe holds. Python before 3.11.5 waits for ever until somebody reads them
(gh-94777).
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

RUN = """\
import os, signal, time
from rossmarie.driver.workers import answers

def wait(query):
    time.sleep(600)

def die(query):
    os.kill(os.getpid(), signal.SIGKILL)

def stop(*_):
    raise KeyboardInterrupt

if __name__ == "__main__":
    signal.signal(signal.SIGALRM, stop)
    signal.alarm({seconds})
    try:
        print(list(answers({ask}, ["long" * 100_000] * 4, lambda _: None)))
    except KeyboardInterrupt:
        print("ended")
"""


@pytest.mark.parametrize(
    ("ask", "seconds", "reported"),
    [("wait", 3, "ended\n"), ("die", 100, "[None, None, None, None]\n")],
    ids=["the run is interrupted", "the system ends a process"],
)
def test_it_ends_at_once(ask: str, seconds: int, reported: str, tmp_path: Path) -> None:
    (tmp_path / "run.py").write_text(RUN.format(ask=ask, seconds=seconds))
    done = subprocess.run(
        [sys.executable, "run.py"], cwd=tmp_path, capture_output=True, text=True, timeout=120,
        check=True,
    )  # fmt: skip
    assert done.stdout == reported
    assert "Traceback" not in done.stderr
