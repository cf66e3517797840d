"""A run that ends while questions are on their way to processes ends at once."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

RUN = """\
import signal, time
from rossmarie.driver.workers import answers

def ask(question):
    time.sleep(600)

def stop(*_):
    raise KeyboardInterrupt

if __name__ == "__main__":
    signal.signal(signal.SIGALRM, stop)
    signal.alarm(3)
    try:
        list(answers(ask, ["long" * 100_000] * 8, print))
    except KeyboardInterrupt:
        print("ended")
"""


def test_a_question_that_nobody_reads_any_more_keeps_nobody(tmp_path: Path) -> None:
    """It is longer than a pipe holds. Python before 3.11.5 waits for it for ever (gh-94777)."""
    (tmp_path / "run.py").write_text(RUN)
    done = subprocess.run(
        [sys.executable, "run.py"], cwd=tmp_path, capture_output=True, text=True, timeout=120,
        check=True,
    )  # fmt: skip
    assert done.stdout == "ended\n"
    assert "Traceback" not in done.stderr
