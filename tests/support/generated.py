"""Generated tests, from a process of their own: values also depend on what z3 was asked before."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

_PROGRAM = """\
import sys
from pathlib import Path
from rossmarie.driver.generating import generate_tests

sys.stdout.write(generate_tests(Path(sys.argv[1])).text)
"""


def generated_tests(rules: Path) -> str:
    """The tests that `rossmarie test --write` writes for a rules file."""
    command = [sys.executable, "-c", _PROGRAM, str(rules)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout
